#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "src/core/error.h"
#include "src/record/impacts_csv.h"
#include "src/record/series_csv.h"
#include "src/record/trajectory_h5.h"
#include "src/record/trajectory_reader.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::content;
using ::testing::HasSubstr;
using testing::report_at;
using testing::run_info;
using testing::small_scene;
using testing::TemporaryFolder;
using testing::world_at;
namespace fs = std::filesystem;

/// Hands the steps first ... last to a sink, a sample every third.
void feed(Sink& sink, const Scene& scene, std::int64_t first, std::int64_t last) {
    const Totals totals;
    for (std::int64_t step = first; step <= last; ++step) {
        const World world = world_at(scene, step, run_info().dt);
        const StepReport report = report_at(scene, step);
        if (step > 0) sink.step(world, run_info().dt, report);
        if (step % 3 == 0) sink.sample({scene, world, report, totals});
    }
}

using MakeSink = std::unique_ptr<Sink> (*)(const fs::path&);

struct Case {
    const char* name;
    MakeSink make;
};

class ResumedFile : public ::testing::TestWithParam<Case> {};

/// Written without interruption, and cut at `kept` with `lost` more steps written before a kill: the same bytes.
TEST_P(ResumedFile, IsWhatItWouldHaveBeen) {
    const TemporaryFolder folder("resumed");
    const Scene scene = small_scene();
    constexpr std::int64_t last = 200;
    {
        const auto sink = GetParam().make(folder / "whole");
        sink->begin(scene, run_info());
        feed(*sink, scene, 0, last);
        sink->end();
    }
    for (const std::int64_t kept : {0, 1, 3, 100, 150}) {
        for (const std::int64_t lost : {0, 1, 40}) {
            Checkpoint saved;
            const auto killed = GetParam().make(folder / "resumed");
            killed->begin(scene, run_info());
            feed(*killed, scene, 0, kept);
            killed->save(saved);
            feed(*killed, scene, kept + 1, kept + lost);

            const auto sink = GetParam().make(folder / "resumed");
            sink->resume(scene, run_info(), saved);
            feed(*sink, scene, kept + 1, last);
            sink->end();
            EXPECT_EQ(content(folder / "resumed"), content(folder / "whole"))
                << "checkpoint at step " << kept << ", killed " << lost << " steps later";
        }
    }
}

TEST_P(ResumedFile, IsRefusedWhereItIsShorterThanTheCheckpointSays) {
    const TemporaryFolder folder("resumed");
    const Scene scene = small_scene();
    const auto sink = GetParam().make(folder / "file");
    sink->begin(scene, run_info());
    feed(*sink, scene, 0, 100);
    Checkpoint saved;
    sink->save(saved);
    EXPECT_NO_THROW(GetParam().make(folder / "file")->check(scene, saved));
    fs::resize_file(folder / "file", fs::file_size(folder / "file") / 2);
    EXPECT_THROW(GetParam().make(folder / "file")->check(scene, saved), InputError);
    EXPECT_FALSE(fs::exists(folder / "file.part"));
    EXPECT_THROW(GetParam().make(folder / "file")->resume(scene, run_info(), saved), InputError);
    fs::remove(folder / "file");
    EXPECT_THROW(GetParam().make(folder / "file")->resume(scene, run_info(), saved), InputError);
}

INSTANTIATE_TEST_SUITE_P(Sinks, ResumedFile,
                         ::testing::Values(Case{"series",
                                                [](const fs::path& p) -> std::unique_ptr<Sink> {
                                                    return std::make_unique<SeriesCsv>(p, 1.0);
                                                }},
                                           Case{"impacts",
                                                [](const fs::path& p) -> std::unique_ptr<Sink> {
                                                    return std::make_unique<ImpactsCsv>(p, 1.0);
                                                }},
                                           Case{"trajectory",
                                                [](const fs::path& p) -> std::unique_ptr<Sink> {
                                                    return std::make_unique<TrajectoryH5>(p, 1.0, Provenance{});
                                                }}),
                         [](const auto& sink) { return std::string(sink.param.name); });

/// A kill in the midst of HDF5's own book-keeping, at its worst: nothing of it is left.
TEST(ResumedTrajectory, NeedsNothingThatHdf5KeepsForItself) {
    const TemporaryFolder folder("resumed");
    const fs::path file = folder / "trajectory.h5";
    const Scene scene = small_scene();
    TrajectoryH5 whole(folder / "whole.h5", 1.0, {});
    whole.begin(scene, run_info());
    feed(whole, scene, 0, 120);
    whole.end();

    Checkpoint saved;
    TrajectoryH5 killed(file, 1.0, {});
    killed.begin(scene, run_info());
    feed(killed, scene, 0, 99);
    killed.save(saved);
    std::string bytes = content(file);
    std::vector<bool> rows(bytes.size(), false);
    constexpr std::size_t chunk = 8192;
    const Checkpoint part = saved.part("places");
    for (const auto& [key, places] : part.all_integers()) {
        if (key == "contacts") continue;
        for (const std::int64_t place : places) {
            for (std::size_t k = 0; k < chunk; ++k) rows.at(static_cast<std::size_t>(place) + k) = true;
        }
    }
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        if (!rows[k]) bytes[k] = '\xA5';
    }
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_THROW(TrajectoryReader{file}, InputError) << "the library cannot open it any more";

    TrajectoryH5 resumed(file, 1.0, {});
    resumed.resume(scene, run_info(), saved);
    feed(resumed, scene, 100, 120);
    resumed.end();
    EXPECT_EQ(content(file), content(folder / "whole.h5"));
}

TEST(ResumedTrajectory, IsRefusedWhereItsNumbersAreOthers) {
    const TemporaryFolder folder("resumed");
    const fs::path file = folder / "trajectory.h5";
    const Scene scene = small_scene();
    Checkpoint saved;
    TrajectoryH5 sink(file, 1.0, {});
    sink.begin(scene, run_info());
    feed(sink, scene, 0, 30);
    sink.save(saved);
    std::string bytes = content(file);
    bytes[static_cast<std::size_t>(saved.part("places").integers("velocity").at(0)) + 20] ^= 1;
    std::ofstream(file, std::ios::binary) << bytes;
    try {
        TrajectoryH5(file, 1.0, {}).resume(scene, run_info(), saved);
        FAIL() << "a changed velocity was taken";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("has been changed since"));
    }
    EXPECT_EQ(content(file), bytes) << "refusing changes nothing";
}

}  // namespace
}  // namespace polargrain
