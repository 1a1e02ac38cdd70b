#include <gtest/gtest.h>

#include "src/core/random.h"
#include "src/engines/contact/motion_update.h"

namespace polargrain {
namespace {

constexpr GrainIndex k_a = 0, k_b = 1, k_c = 2, k_d = 3;

/// [HN94, Fig. 9]: trial B' and C' overlap; D' overlaps A; A', C' and D' overlap what B leaves.
TrialOverlaps figure_9() {
    TrialOverlaps found;
    found.blocked.assign(4, 0);
    found.conflicts = {{k_b, k_c}};
    found.order = {{k_b, k_a}, {k_a, k_d}, {k_b, k_c}};
    return found;
}

TEST(MotionUpdate, Figure9CountsDependants) {
    MotionUpdate update;
    update.decide(figure_9());
    EXPECT_EQ(update.dependants(k_a), 1);
    EXPECT_EQ(update.dependants(k_b), 3);
    EXPECT_EQ(update.dependants(k_c), 0);
    EXPECT_EQ(update.dependants(k_d), 0);
    const WarshallClosure closure(4, figure_9().order);
    EXPECT_TRUE(closure.related(k_b, k_d)) << "B before A before D";
    EXPECT_FALSE(closure.related(k_a, k_c));
}

TEST(MotionUpdate, Figure9RejectsCAlone) {
    MotionUpdate update;
    EXPECT_EQ(update.decide(figure_9()), (std::vector<char>{0, 0, 1, 0}));
}

TEST(MotionUpdate, RejectionTakesTheDependantsAlong) {
    TrialOverlaps found = figure_9();
    found.blocked[k_a] = 1;
    MotionUpdate update;
    EXPECT_EQ(update.decide(found), (std::vector<char>{1, 0, 1, 1}));
}

TEST(MotionUpdate, OnATieTheLowerNumberStays) {
    TrialOverlaps found;
    found.blocked.assign(2, 0);
    found.conflicts = {{k_a, k_b}};
    MotionUpdate update;
    EXPECT_EQ(update.decide(found), (std::vector<char>{1, 0}));
}

TEST(MotionUpdate, ARingWaitsForItself) {
    TrialOverlaps found;
    found.blocked.assign(3, 0);
    found.order = {{k_a, k_b}, {k_b, k_c}, {k_c, k_a}};
    MotionUpdate update;
    EXPECT_EQ(update.decide(found), (std::vector<char>{0, 0, 0})) << "all move at once";
    EXPECT_EQ(update.dependants(k_a), 2) << "a grain is not its own dependant";
    found.blocked[k_b] = 1;
    EXPECT_EQ(update.decide(found), (std::vector<char>{1, 1, 1}));
}

TEST(ReachCount, EqualsWarshallOnRandomGraphs) {
    RandomStream random(5, RandomPurpose::test);
    for (int graph = 0; graph < 200; ++graph) {
        const auto n = static_cast<GrainIndex>(2 + random.uniform() * 150);
        std::vector<MoveOrder> order;
        const auto edges = static_cast<int>(random.uniform() * 2.5 * n);
        for (int k = 0; k < edges; ++k) {
            const auto a = static_cast<GrainIndex>(random.uniform() * n);
            const auto b = static_cast<GrainIndex>(random.uniform() * n);
            if (a != b) order.emplace_back(a, b);
        }
        const WarshallClosure closure(n, order);
        ReachCount reach;
        reach.build(n, order);
        for (GrainIndex a = 0; a < n; ++a) {
            ASSERT_EQ(reach.dependants(a), closure.dependants(a)) << "seed 5, graph " << graph << ", grain " << a;
        }
    }
}

TEST(MotionUpdate, NeverLeavesAnOverlapInRandomGraphs) {
    RandomStream random(6, RandomPurpose::test);
    MotionUpdate update;
    for (int graph = 0; graph < 500; ++graph) {
        const auto n = static_cast<GrainIndex>(2 + random.uniform() * 60);
        TrialOverlaps found;
        for (GrainIndex k = 0; k < n; ++k) found.blocked.push_back(random.uniform() < 0.05 ? 1 : 0);
        for (GrainIndex a = 0; a < n; ++a) {
            for (GrainIndex b = a + 1; b < n; ++b) {
                if (random.uniform() < 0.03) found.conflicts.emplace_back(a, b);
                if (random.uniform() < 0.03) found.order.emplace_back(a, b);
                if (random.uniform() < 0.03) found.order.emplace_back(b, a);
            }
        }
        const auto& rejected = update.decide(found);
        const auto stays = [&](GrainIndex k) { return rejected[Grains::at(k)] != 0; };
        for (GrainIndex k = 0; k < n; ++k) ASSERT_TRUE(!found.blocked[Grains::at(k)] || stays(k));
        for (const auto& [a, b] : found.conflicts) ASSERT_TRUE(stays(a) || stays(b));
        for (const auto& [a, b] : found.order) ASSERT_TRUE(!stays(a) || stays(b));
    }
}

}  // namespace
}  // namespace polargrain
