#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/core/random.h"
#include "src/engines/dem/numbering.h"
#include "tests/dem/dem_runs.h"

namespace polargrain {
namespace {

/// Rows of touching disks in a box, numbered row by row or, `mixed`, at random.
Scene rows_of_disks(bool mixed) {
    constexpr int k_across = 80;
    constexpr int k_up = 60;
    constexpr double k_pitch = 0.0199;
    Scene scene = testing::empty_scene(0.5, 0.4);
    const ShapeIndex disk = testing::add_disk(scene, 0.01);
    testing::add_box(scene, (k_across + 0.6) * k_pitch, 2.0 * k_up * k_pitch);
    std::vector<Grain> grains;
    RandomStream random(3, RandomPurpose::test);
    for (int row = 0; row < k_up; ++row) {
        for (int column = 0; column < k_across; ++column) {
            const double x = (column + 0.55 + 0.5 * (row % 2) + random.uniform(-0.01, 0.01)) * k_pitch;
            grains.push_back({disk, 0, {x, (0.52 + 0.87 * row) * k_pitch}});
        }
    }
    for (std::size_t k = grains.size(); mixed && k > 1; --k) {
        std::swap(grains[k - 1], grains[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    }
    for (const Grain& grain : grains) scene.add(grain);
    return scene;
}

struct MixedBed {
    static constexpr double k_step = 1e-4;  ///< [s]
    std::unique_ptr<Engine> engine;
    World world;
    StepReport report;

    explicit MixedBed(const Scene& scene, const DemSettings& settings = {})
        : engine(make_dem(scene, settings)), world(initial_world(scene)) {}

    void take(int steps) {
        for (int k = 0; k < steps; ++k) engine->step(world, k_step, report);
    }
    Checkpoint saved() const {
        Checkpoint checkpoint;
        engine->save(checkpoint);
        return checkpoint;
    }
};

bool numbered_as_the_scene(const Checkpoint& checkpoint) {
    const auto& numbers = checkpoint.integers("dem/numbers");
    return std::is_sorted(numbers.begin(), numbers.end());
}

TEST(MixedBed, IsRenumberedAndAnOrderlyOneIsNot) {
    const Scene mixed_scene = rows_of_disks(true);
    MixedBed mixed(mixed_scene);
    mixed.take(5);
    EXPECT_TRUE(numbered_as_the_scene(mixed.saved()));
    mixed.take(10);
    EXPECT_FALSE(numbered_as_the_scene(mixed.saved()));
    const Scene orderly_scene = rows_of_disks(false);
    MixedBed orderly(orderly_scene);
    orderly.take(15);
    EXPECT_TRUE(numbered_as_the_scene(orderly.saved()));
}

TEST(MixedBed, KeepsItsBitsOverThreadsAndAfterResumptions) {
    Scene scene = rows_of_disks(true);
    for (const auto integrator : {SoftIntegrator::velocity_verlet, SoftIntegrator::position_verlet}) {
        DemSettings settings;
        settings.integrator = integrator;
        scene.threads = 1;
        MixedBed whole(scene, settings);
        whole.take(20);
        scene.threads = 3;
        MixedBed shared(scene, settings);
        shared.take(20);
        EXPECT_EQ(state_hash(shared.world), state_hash(whole.world));
        scene.threads = 1;
        for (const int before : {5, 8, 13}) {
            MixedBed first(scene, settings);
            first.take(before);
            MixedBed second(scene, settings);
            second.engine->load(first.saved());
            second.world = first.world;
            second.take(20 - before);
            EXPECT_EQ(state_hash(second.world), state_hash(whole.world)) << "resumed after " << before << " steps";
        }
    }
}

TEST(MixedBed, ReportsContactsUnderTheScenesNumbers) {
    const Scene scene = rows_of_disks(true);
    MixedBed bed(scene);
    bed.take(19);
    const Grains before = bed.world.grains;
    bed.take(1);
    ASSERT_FALSE(numbered_as_the_scene(bed.saved()));
    const std::vector<Contact>& contacts = bed.report.contacts;
    ASSERT_GT(contacts.size(), 1000U);
    const auto pair = [](const Contact& c) { return std::pair(c.a, c.b); };
    const Grains& grains = bed.world.grains;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const Contact& c = contacts[k];
        ASSERT_LT(c.a, c.b);
        if (k > 0) {
            EXPECT_LE(pair(contacts[k - 1]), pair(c));
        }
        if (is_wall(c.a)) continue;
        const Vec2 way = grains.position(c.b) - grains.position(c.a);
        if (c.gap < 0.0) {
            EXPECT_NEAR(way.dot(c.normal), 0.02 + c.gap, 1e-12);
        }
    }
    // What the report says pushed a grain moved it.
    std::vector<Vec2> momentum(grains.x.size(), Vec2::Zero());
    for (const Contact& c : contacts) {
        momentum[Grains::at(c.b)] += c.impulse;
        if (!is_wall(c.a)) momentum[Grains::at(c.a)] -= c.impulse;
    }
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const Vec2 gained =
            grains.mass[Grains::at(k)] * (grains.velocity(k) - before.velocity(k) - MixedBed::k_step * scene.gravity);
        ASSERT_LT((gained - momentum[Grains::at(k)]).norm(), 1e-12);
    }
}

// Friction remembers across a renumbering: the same motion comes out but for rounding. Velocity Verlet would mend one
// pair after the other, in their order.
TEST(MixedBed, MovesAsTheOrderlyOne) {
    const Scene orderly_scene = rows_of_disks(false);
    const Scene mixed_scene = rows_of_disks(true);
    DemSettings settings;
    settings.integrator = SoftIntegrator::position_verlet;
    MixedBed orderly(orderly_scene, settings);
    MixedBed mixed(mixed_scene, settings);
    orderly.take(12);
    mixed.take(12);
    const auto sorted = [](const World& world) {
        std::vector<std::pair<double, double>> places;
        for (GrainIndex k = 0; k < world.grains.size(); ++k) {
            places.emplace_back(world.grains.x[Grains::at(k)], world.grains.angle[Grains::at(k)]);
        }
        std::sort(places.begin(), places.end());
        return places;
    };
    const auto one = sorted(orderly.world);
    const auto other = sorted(mixed.world);
    for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_NEAR(one[k].first, other[k].first, 1e-12);
        EXPECT_NEAR(one[k].second, other[k].second, 1e-10);
    }
}

TEST(Numbering, GoesByRowsAcrossTheShorterSide) {
    Grains grains;
    grains.x = {0.0, 5.1, 0.1, 5.0, 9.0};
    grains.y = {1.0, 0.5, 0.2, 0.1, 0.3};
    EXPECT_EQ(numbers_by_rows(grains, 2.0), (Numbering{2, 0, 3, 1, 4}));
    std::swap(grains.x, grains.y);
    EXPECT_EQ(numbers_by_rows(grains, 2.0), (Numbering{2, 0, 3, 1, 4}));
}

TEST(Numbering, MovesCoordinatesBehindAHeadOfTheirOwn) {
    const Numbering from{1, 0};
    const Numbering to{0, 1};
    std::vector<double> values{9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    move_coordinates(from, to, values);
    EXPECT_EQ(values, (std::vector<double>{9.0, 4.0, 5.0, 6.0, 1.0, 2.0, 3.0}));
    std::vector<double> none;
    move_coordinates(from, to, none);
    EXPECT_TRUE(none.empty());
}

TEST(PairSorter, SortsWallsFirstAndKeepsTheOrderOfEquals) {
    PairSorter sorter;
    const std::vector<PairSorter::Pair> pairs{{2, 3}, {-1, 2}, {0, 3}, {-2, 1}, {2, 3}, {0, 1}};
    EXPECT_EQ(sorter.sort(pairs, 2, 4), (std::vector<std::uint32_t>{3, 1, 5, 2, 0, 4}));
}

}  // namespace
}  // namespace polargrain
