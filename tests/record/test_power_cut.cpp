#include <gtest/gtest.h>

#include "src/record/impacts_csv.h"
#include "src/record/series_csv.h"
#include "src/record/trajectory_h5.h"
#include "tests/record/small_scene.h"
#include "tests/record/synced_files.h"

namespace polargrain {
namespace {

TEST(PowerCut, LosesNothingOfARunThatHasComeToItsEnd) {
    const testing::TemporaryFolder folder("power-cut");
    const Scene scene = testing::small_scene();
    SeriesCsv series(folder / "series.csv", 0.004);
    TrajectoryH5 trajectory(folder / "trajectory.h5", 0.004, {});
    ImpactsCsv impacts(folder / "impacts.csv", 0.004);
    for (Sink* sink : {static_cast<Sink*>(&series), static_cast<Sink*>(&trajectory), static_cast<Sink*>(&impacts)}) {
        sink->begin(scene, testing::run_info());
        const StepReport report = testing::report_at(scene, 4);
        sink->sample({scene, testing::world_at(scene, 4, 0.001), report, Totals{}});
        sink->end();
    }
    for (const char* file : {"series.csv", "trajectory.h5", "impacts.csv"}) {
        EXPECT_TRUE(testing::is_on_disk(folder / file)) << file;
    }
}

}  // namespace
}  // namespace polargrain
