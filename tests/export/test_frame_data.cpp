#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/export/frame_data.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::report_at;
using testing::small_scene;
using testing::world_at;

constexpr double k_dt = 0.001;
constexpr int k_sides = 12;

/// The small scene at one of its steps.
struct Instant {
    explicit Instant(std::int64_t step) : world(world_at(scene, step, k_dt)), report(report_at(scene, step)) {}
    Picture picture() const { return picture_of(scene, world, report); }

    Scene scene = small_scene();
    World world;
    StepReport report;
};

template <typename T>
const std::vector<T>& values(const std::vector<NamedNumbers>& data, const std::string& name) {
    for (const NamedNumbers& numbers : data) {
        if (numbers.name == name) return std::get<std::vector<T>>(numbers.values);
    }
    throw std::logic_error("no " + name);
}

/// Every array is as long as there are points or cells for it.
void expect_full(const PolyData& data) {
    const auto check = [](const std::vector<NamedNumbers>& arrays, std::size_t count) {
        for (const NamedNumbers& numbers : arrays) {
            const std::size_t size = std::visit([](const auto& list) { return list.size(); }, numbers.values);
            EXPECT_EQ(size, count * static_cast<std::size_t>(numbers.components)) << numbers.name;
        }
    };
    check(data.point_data, data.points.size());
    check(data.cell_data, data.verts.size() + data.lines.size() + data.polys.size());
}

TEST(GrainCells, OutlinesStandWhereTheGrainsAre) {
    const Instant now(7);
    const PolyData data = GrainCells(now.scene, k_sides).at(now.picture());
    expect_full(data);
    const auto& grain = values<std::int32_t>(data.cell_data, "grain");
    const Grains& grains = now.world.grains;
    std::int32_t from = 0;
    for (std::size_t c = 0; c < data.polys.size(); from = data.polys.ends[c++]) {
        const Shape& shape = now.scene.shape_of(grain[c]);
        const Pose pose = grains.pose(grain[c]);
        for (std::int32_t k = from; k < data.polys.ends[c]; ++k) {
            const Vec2 point =
                data.points.at(static_cast<std::size_t>(data.polys.corners[static_cast<std::size_t>(k)]));
            const Vec2 local = pose.to_local(point);
            if (const auto* disk = std::get_if<Disk>(&shape)) {
                EXPECT_NEAR(local.norm(), disk->radius(), 1e-16);
            } else {
                double nearest = 1.0;
                for (const Vec2& v : std::get<PolarPolygon>(shape).vertices()) {
                    nearest = std::min(nearest, (v - local).norm());
                }
                EXPECT_LT(nearest, 1e-16);
            }
        }
    }
    EXPECT_EQ(from, static_cast<std::int32_t>(data.polys.corners.size()));
}

TEST(GrainCells, EachPieceCarriesTheStateOfItsGrain) {
    const Instant now(5);
    const PolyData data = GrainCells(now.scene, k_sides).at(now.picture());
    const auto& grain = values<std::int32_t>(data.cell_data, "grain");
    EXPECT_THAT(grain, ::testing::ElementsAre(0, 1, 2, 2, 3, 3)) << "two disks, two brackets of two pieces each";
    EXPECT_THAT(values<std::int32_t>(data.cell_data, "piece"), ::testing::ElementsAre(0, 0, 0, 1, 0, 1));
    EXPECT_THAT(values<std::int32_t>(data.cell_data, "shape"), ::testing::ElementsAre(0, 0, 1, 1, 2, 2));
    EXPECT_THAT(values<std::int32_t>(data.cell_data, "material"), ::testing::ElementsAre(0, 1, 0, 0, 1, 1));
    const Grains& grains = now.world.grains;
    for (std::size_t c = 0; c < grain.size(); ++c) {
        const GrainIndex k = grain[c];
        const std::size_t at = Grains::at(k);
        EXPECT_EQ(values<double>(data.cell_data, "mass")[c], grains.mass[at]);
        EXPECT_EQ(values<double>(data.cell_data, "angle")[c], grains.angle[at]);
        EXPECT_EQ(values<double>(data.cell_data, "spin")[c], grains.spin[at]);
        EXPECT_EQ(values<double>(data.cell_data, "speed")[c], grains.velocity(k).norm());
        for (const auto& [name, vector] :
             {std::pair{"position", grains.position(k)}, {"velocity", grains.velocity(k)}}) {
            const auto& numbers = values<double>(data.cell_data, name);
            EXPECT_EQ(numbers[3 * c], vector.x());
            EXPECT_EQ(numbers[3 * c + 1], vector.y());
            EXPECT_EQ(numbers[3 * c + 2], 0.0);
        }
    }
}

TEST(ContactPoints, AreThoseOfTheStepWithForcesOverIt) {
    const Instant now(5);
    ASSERT_EQ(now.report.contacts.size(), 2u);
    const PolyData data = contact_points(now.picture(), k_dt);
    expect_full(data);
    EXPECT_EQ(data.verts.size(), 2u);
    EXPECT_THAT(values<std::int32_t>(data.point_data, "a"), ::testing::ElementsAre(-1, -1)) << "the floor";
    EXPECT_THAT(values<std::int32_t>(data.point_data, "b"), ::testing::ElementsAre(0, 1));
    for (std::size_t c = 0; c < 2; ++c) {
        const Contact& contact = now.report.contacts[c];
        EXPECT_EQ(data.points[c], contact.point);
        EXPECT_EQ(values<double>(data.point_data, "gap")[c], contact.gap);
        EXPECT_EQ(values<double>(data.point_data, "normal")[3 * c + 1], 1.0);
        EXPECT_EQ(values<double>(data.point_data, "impulse")[3 * c + 1], contact.impulse.y());
        EXPECT_DOUBLE_EQ(values<double>(data.point_data, "force")[3 * c + 1], contact.impulse.y() / k_dt);
    }
}

TEST(WallLines, MoveAndGoAsTheWallsDo) {
    for (const std::int64_t step : {0, 9, 10, 12}) {
        const Instant now(step);
        const PolyData data = wall_lines(now.picture());
        expect_full(data);
        const auto& walls = values<std::int32_t>(data.cell_data, "wall");
        if (step < 10) {
            EXPECT_THAT(walls, ::testing::ElementsAre(0, 1, 2, 3));
        } else {
            EXPECT_THAT(walls, ::testing::ElementsAre(0, 1, 2)) << "the gate is gone from 0.01 s on";
        }
        const double time = static_cast<double>(step) * k_dt;
        ASSERT_EQ(data.points.size(), 2 * walls.size());
        EXPECT_EQ(data.points[0], Vec2(0.0, 0.0));
        EXPECT_NEAR(data.points[2].x(), -0.01 + 0.002 * std::sin(2.0 * k_pi * 20.0 * time), 1e-15) << "the shaker";
        const Vec2 paddle = data.points[5] - Vec2(0.2, 0.05);
        EXPECT_NEAR(std::atan2(paddle.y(), paddle.x()), 3.0 * time, 1e-12) << "the paddle turns";
        EXPECT_NEAR(paddle.norm(), 0.05, 1e-15);
    }
}

TEST(FrameData, OfNothingIsEmpty) {
    const Scene scene;
    const World world = initial_world(scene);
    const Picture picture = picture_of(scene, world, StepReport{});
    for (const PolyData& data :
         {GrainCells(scene, k_sides).at(picture), contact_points(picture, k_dt), wall_lines(picture)}) {
        expect_full(data);
        EXPECT_TRUE(data.points.empty());
    }
}

}  // namespace
}  // namespace polargrain
