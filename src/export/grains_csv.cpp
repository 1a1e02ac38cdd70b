#include "src/export/grains_csv.h"

#include <fmt/format.h>

#include <iterator>

namespace polargrain {

namespace fs = std::filesystem;

namespace {

fs::path place_in(const fs::path& folder) { return folder / "grains.csv"; }
fs::path part_of(const fs::path& path) { return path.string() + ".part"; }

}  // namespace

GrainsCsv::GrainsCsv(const fs::path& folder) : path_(place_in(folder)), part_(part_of(path_)), file_(part_) {
    file_.write("time,step,grain,x,y,angle,vx,vy,spin\n");
}

void GrainsCsv::add(const StoredFrame& frame) {
    const Grains& grains = frame.world.grains;
    std::string rows;
    for (std::size_t k = 0; k < grains.x.size(); ++k) {
        fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{}\n", frame.world.time, frame.world.step, k,
                       grains.x[k], grains.y[k], grains.angle[k], grains.vx[k], grains.vy[k], grains.spin[k]);
    }
    file_.write(rows);
}

void GrainsCsv::finish() {
    file_.close();
    put_in_place(part_, path_);
}

void GrainsCsv::remove(const fs::path& folder) {
    remove_file(place_in(folder));
    remove_file(part_of(place_in(folder)));
}

}  // namespace polargrain
