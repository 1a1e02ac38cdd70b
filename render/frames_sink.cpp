#include "render/frames_sink.h"

#include <fmt/format.h>

#include "render/frame.h"
#include "render/picture.h"
#include "src/core/error.h"

namespace polargrain {

FramesSink::FramesSink(std::filesystem::path folder, FrameSettings settings)
    : folder_(std::move(folder)), settings_(std::move(settings)) {}

void FramesSink::begin(const Scene& scene, const RunInfo& info) {
    make_folder(folder_);
    style_ = make_frame_style(settings_, scene, info.title, info.dt);
    count_ = synced_ = 0;
    index_.emplace(folder_ / "index.csv");
    index_->write("file,time,step\n");
    index_->flush();
}

std::filesystem::path FramesSink::file_of(std::int64_t frame) const {
    return folder_ / fmt::format("{:06}.{}", frame, settings_.format);
}

void FramesSink::sync() {
    for (; synced_ < count_; ++synced_) sync_file(file_of(synced_));
    index_->sync();
    sync_file(folder_);
}

void FramesSink::save(Checkpoint& checkpoint) {
    sync();
    index_->save(checkpoint);
    checkpoint.put("count", std::vector{count_});
}

void FramesSink::check(const Scene& /*scene*/, const Checkpoint& saved) const {
    for (std::int64_t frame = 0; frame < saved.integers("count").at(0); ++frame) {
        require(std::filesystem::exists(file_of(frame)), "{}: is missing, but was there when the checkpoint was made",
                file_of(frame).string());
    }
    TextFile::check(folder_ / "index.csv", saved);
}

void FramesSink::resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) {
    check(scene, saved);
    style_ = make_frame_style(settings_, scene, info.title, info.dt);
    count_ = synced_ = saved.integers("count").at(0);
    for (std::int64_t frame = count_; std::filesystem::remove(file_of(frame)); ++frame) {
    }
    index_.emplace(folder_ / "index.csv", saved);
}

void FramesSink::sample(const Sample& sample) {
    const std::filesystem::path file = file_of(count_);
    draw_frame(picture_of(sample.scene, sample.world, sample.report), style_, file);
    index_->write(fmt::format("{},{},{}\n", file.filename().string(), sample.world.time, sample.world.step));
    index_->flush();
    ++count_;
}

void FramesSink::end() {
    sync();
    index_->close();
}

}  // namespace polargrain
