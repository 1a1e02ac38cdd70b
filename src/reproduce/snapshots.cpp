#include "src/reproduce/snapshots.h"

#include <fmt/format.h>

#include "src/record/text_file.h"

namespace polargrain {

void draw_snapshots(const TrajectoryReader& recording, const std::vector<LabelledFrame>& cells, const FrameStyle& style,
                    const std::filesystem::path& stem, const ContactSheetSettings& settings) {
    for (const char* extension : {".png", ".pdf"}) {
        contact_sheet(recording, cells, style, stem.string() + extension, settings);
    }
    std::string text = "label,time,grain,x,y,angle,vx,vy,spin\n";
    for (const LabelledFrame& cell : cells) {
        const StoredFrame frame = recording.frame(cell.frame);
        const Grains& grains = frame.world.grains;
        for (std::size_t k = 0; k < grains.x.size(); ++k) {
            text += fmt::format("{},{},{},{},{},{},{},{},{}\n", cell.label, recording.time(cell.frame), k, grains.x[k],
                                grains.y[k], grains.angle[k], grains.vx[k], grains.vy[k], grains.spin[k]);
        }
    }
    write_whole_file(stem.string() + ".csv", text);
}

}  // namespace polargrain
