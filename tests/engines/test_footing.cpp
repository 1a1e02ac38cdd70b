#include <gtest/gtest.h>

#include <cmath>

#include "src/engines/contact/footing.h"

namespace polargrain {
namespace {

/// A rod of mass 1 and length 1 that stands on a floor, its foot at the origin.
struct StandingRod {
    SolverBody body;
    Vec2 centre{0.0, 0.5};
    GapContact foot;

    StandingRod() {
        body.inverse_mass = 1.0;
        body.inverse_inertia = 12.0;
        foot.i = 0;
        foot.j = wall_body(0);
        foot.friction = 0.5;
    }
};

/// Takes an impulse at a point.
void take(Footing& footing, const Vec2& p, const Vec2& point) { footing.take(p, footing.moment(p, point)); }

TEST(Footing, TurnsAboutTheFootWithTheMomentOfInertiaAboutIt) {
    const StandingRod rod;
    Footing footing(rod.body, rod.centre, rod.foot, Grip::holds);
    const Vec2 top{0.0, 1.0};
    const Vec2 answer = footing.after({1.0, 0.0}, footing.moment({1.0, 0.0}, top)).velocity_at(top);
    EXPECT_NEAR(answer.x(), 3.0, 1e-12);  // L^2 / (m L^2 / 3)
    EXPECT_NEAR(answer.y(), 0.0, 1e-12);
    take(footing, {1.0, 0.0}, top);
    EXPECT_NEAR(footing.velocity_at({0.0, 0.0}).norm(), 0.0, 1e-12);
    EXPECT_NEAR(footing.foot_impulse().x(), 0.5, 1e-12);  // m v of the centre, 3/2, less the blow
}

TEST(Footing, GetsNothingFromABlowAtTheCentreOfPercussion) {
    const StandingRod rod;
    Footing footing(rod.body, rod.centre, rod.foot, Grip::holds);
    take(footing, {1.0, 0.0}, {0.0, 2.0 / 3.0});
    EXPECT_NEAR(footing.foot_impulse().norm(), 0.0, 1e-12);
}

TEST(Footing, HoldsOnlyWithinTheConeAndSlipsBeyondIt) {
    const StandingRod rod;
    const Vec2 middle{0.0, 0.5};
    const Vec2 steep{0.3, -1.0};  // pushes the foot down more than along
    Footing held(rod.body, rod.centre, rod.foot, Grip::holds);
    take(held, steep, middle);
    EXPECT_TRUE(held.is_consistent());

    const Vec2 flat{1.0, -0.2};
    Footing torn(rod.body, rod.centre, rod.foot, Grip::holds);
    take(torn, flat, middle);
    EXPECT_FALSE(torn.is_consistent());
    int consistent = 0;
    for (const Grip grip : {Grip::slips_back, Grip::slips_ahead}) {
        Footing slips(rod.body, rod.centre, rod.foot, grip);
        take(slips, flat, middle);
        if (!slips.is_consistent()) continue;
        ++consistent;
        EXPECT_NEAR(slips.velocity_at({0.0, 0.0}).y(), 0.0, 1e-12) << "the floor holds it up";
        EXPECT_GT(slips.velocity_at({0.0, 0.0}).x(), 0.0) << "it slips the way it is driven";
        EXPECT_NEAR(slips.foot_impulse().x(), -0.5 * slips.foot_impulse().y(), 1e-12) << "friction at its limit";
        EXPECT_GT(slips.friction_loss(), 0.0);
        EXPECT_NEAR(slips.restitution_loss(), 0.0, 1e-12) << "the foot did not move towards the floor";
    }
    EXPECT_EQ(consistent, 1);
}

TEST(Footing, DoesNotHoldABodyDown) {
    const StandingRod rod;
    for (const Grip grip : {Grip::holds, Grip::slips_back, Grip::slips_ahead}) {
        Footing lifted(rod.body, rod.centre, rod.foot, grip);
        take(lifted, {0.1, 1.0}, {0.0, 0.5});
        EXPECT_FALSE(lifted.is_consistent());
    }
}

TEST(Footing, BooksWhatStoppingAMovingFootTakes) {
    StandingRod rod;
    rod.body.velocity = {0.02, -0.01};
    rod.body.spin = 0.03;
    const Footing footing(rod.body, rod.centre, rod.foot, Grip::holds);
    EXPECT_NEAR(footing.velocity_at({0.0, 0.0}).norm(), 0.0, 1e-15);
    const double spin = footing.velocity_at({0.0, 1.0}).x() / -1.0;
    const double before = 0.5 * (rod.body.velocity.squaredNorm() + 0.03 * 0.03 / 12.0);
    EXPECT_NEAR(footing.restitution_loss() + footing.friction_loss(), before - 0.5 * spin * spin / 3.0, 1e-15);
}

}  // namespace
}  // namespace polargrain
