#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "src/core/error.h"
#include "src/core/random.h"
#include "src/record/trajectory_h5.h"
#include "src/record/trajectory_reader.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::content;
using ::testing::HasSubstr;
using testing::report_at;
using testing::small_scene;
using testing::TemporaryFolder;
using testing::world_at;

void write_good(const fs::path& path) {
    const Scene scene = small_scene();
    TrajectoryH5 trajectory(path, 0.004, {"1.2.3", "g++", "A. Tester"});
    trajectory.begin(scene, testing::run_info());
    for (int f = 0; f < 5; ++f) {
        const StepReport report = report_at(scene, 4 * f);
        trajectory.sample({scene, world_at(scene, 4 * f, 0.001), report, Totals{}});
    }
    trajectory.end();
}

/// All of the file; what is thrown must be an error of ours.
void read_all(const fs::path& path) {
    try {
        const TrajectoryReader reader(path);
        for (int f = 0; f < reader.frames(); ++f) {
            try {
                reader.frame(f);
            } catch (const RunError& error) {
                EXPECT_THAT(error.what(), HasSubstr(path.string()));
            }
        }
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(path.string()));
    }
}

TEST(DamagedTrajectory, IsReadOrRefusedByNameAndNeverCrashesTheReader) {
    const TemporaryFolder folder("h5-damaged");
    write_good(folder / "good.h5");
    const std::string good = content(folder / "good.h5");
    const std::size_t texts = good.find("GCOL");  // the one place that no checksum guards and that holds lengths
    ASSERT_NE(texts, std::string::npos);
    constexpr std::uint64_t seed = 20;
    RandomStream random(seed, RandomPurpose::test, 0);
    const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
    for (int k = 0; k < 200; ++k) {
        std::string bad = good;
        const bool in_texts = k % 2 == 0;
        for (std::size_t flips = 1 + below(3); flips > 0; --flips) {
            const std::size_t at = in_texts ? texts + 8 + below(400) : below(good.size());
            bad[at] = static_cast<char>(below(256));
        }
        if (k % 10 == 1) bad.resize(below(bad.size()));
        std::ofstream(folder / "bad.h5", std::ios::binary) << bad;
        SCOPED_TRACE(::testing::Message() << "seed " << seed << ", case " << k);
        read_all(folder / "bad.h5");
    }
}

/// Writes other numbers into a dataset by the plain C interface.
template <typename T>
void overwrite(const fs::path& path, const char* name, hid_t type, T value) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    const std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), value);
    ASSERT_GE(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(file);
}

TEST(DamagedTrajectory, ThatPointsToNothingIsRefused) {
    const TemporaryFolder folder("h5-indices");
    for (const char* name : {"/particles/grains/shape", "/particles/grains/material"}) {
        for (const std::int32_t index : {-1, 99, 2'000'000'000}) {
            write_good(folder / "t.h5");
            overwrite(folder / "t.h5", name, H5T_NATIVE_INT32, index);
            EXPECT_THROW(TrajectoryReader(folder / "t.h5"), InputError) << name << " " << index;
        }
    }
    for (const char* name : {"/particles/grains/mass", "/particles/grains/position/value",
                             "/polargrain/walls/floor/points", "/polargrain/shapes/bracket/vertices"}) {
        for (const double value : {std::nan(""), 1e300}) {
            write_good(folder / "t.h5");
            overwrite(folder / "t.h5", name, H5T_NATIVE_DOUBLE, value);
            EXPECT_THROW(TrajectoryReader(folder / "t.h5"), InputError) << name << " " << value;
        }
    }
    const auto read_frames = [&] {
        const TrajectoryReader reader(folder / "t.h5");
        for (int f = 0; f < reader.frames(); ++f) reader.frame(f);
    };
    write_good(folder / "t.h5");
    overwrite(folder / "t.h5", "/polargrain/contacts/bodies", H5T_NATIVE_INT32, 77);
    EXPECT_ANY_THROW(read_frames()) << "contacts of grain 77";
    for (const std::int64_t value : {std::int64_t{-1}, std::int64_t{1} << 40}) {
        for (const char* name : {"/polargrain/contacts/first", "/polargrain/contacts/count"}) {
            write_good(folder / "t.h5");
            overwrite(folder / "t.h5", name, H5T_NATIVE_INT64, value);
            EXPECT_ANY_THROW(read_frames()) << name << " " << value;
        }
    }
}

}  // namespace
}  // namespace polargrain
