#include "src/export/vtk_export.h"

#include <fmt/format.h>

#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

enum Series : std::size_t { grains, contacts, walls };
constexpr std::array k_series{"grains", "contacts", "walls"};

std::string file_of(const char* series, std::size_t frame) { return fmt::format("{}/{:06}.vtp", series, frame); }
fs::path collection_of(const fs::path& folder, const char* series) { return folder / fmt::format("{}.pvd", series); }

}  // namespace

VtkExport::VtkExport(fs::path folder, const TrajectoryReader& recording, int disk_sides)
    : folder_(std::move(folder)), recording_(recording), grains_(recording.scene(), disk_sides) {
    for (const char* series : k_series) make_folder(folder_ / series);
}

void VtkExport::add(const StoredFrame& frame) {
    const Picture picture = picture_of(recording_.scene(), frame);
    write(grains, grains_.at(picture), picture.time);
    write(contacts, contact_points(picture, recording_.time_step()), picture.time);
    write(walls, wall_lines(picture), picture.time);
}

void VtkExport::write(std::size_t series, const PolyData& data, double time) {
    std::vector<TimedFile>& files = files_[series];
    files.push_back({time, file_of(k_series[series], files.size())});
    TextFile file(folder_ / files.back().file);
    file.write(vtp_text(data, time));
    file.close();
}

void VtkExport::finish() {
    for (std::size_t s = 0; s < k_series.size(); ++s) {
        write_whole_file(collection_of(folder_, k_series[s]), pvd_text(files_[s]));
    }
}

void VtkExport::remove(const fs::path& folder) {
    for (const char* series : k_series) {
        const fs::path collection = collection_of(folder, series);
        remove_file(collection);
        remove_file(collection.string() + ".part");
    }
    for (const char* series : k_series) {
        std::size_t frames = 0;
        while (fs::exists(folder / file_of(series, frames))) ++frames;
        // The last first: whatever ends this in between, what is left is found again.
        while (frames > 0) remove_file(folder / file_of(series, --frames));
        remove_if_empty(folder / series);
    }
}

}  // namespace polargrain
