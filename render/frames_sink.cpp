#include "render/frames_sink.h"

#include <fmt/format.h>

#include "render/frame.h"
#include "render/picture.h"
#include "src/core/error.h"

namespace polargrain {

FramesSink::FramesSink(std::filesystem::path folder, FrameSettings settings)
    : folder_(std::move(folder)), settings_(std::move(settings)) {}

void FramesSink::begin(const Scene& scene, const RunInfo& info) {
    std::error_code failed;
    std::filesystem::create_directories(folder_, failed);
    if (failed) throw RunError(fmt::format("{}: cannot make the folder: {}", folder_.string(), failed.message()));
    style_ = make_frame_style(settings_, scene, info.title);
    count_ = 0;
    index_.emplace(folder_ / "index.csv");
    index_->write("file,time,step\n");
    index_->flush();
}

void FramesSink::sample(const Sample& sample) {
    const std::string file = fmt::format("{:06}.{}", count_, settings_.format);
    draw_frame(picture_of(sample.scene, sample.world, sample.report), style_, folder_ / file);
    index_->write(fmt::format("{},{},{}\n", file, sample.world.time, sample.world.step));
    index_->flush();
    ++count_;
}

void FramesSink::end() { index_->close(); }

}  // namespace polargrain
