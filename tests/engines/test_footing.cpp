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

TEST(Footing, TurnsAboutTheFootWithTheMomentOfInertiaAboutIt) {
    const StandingRod rod;
    Footing footing(rod.body, rod.centre, rod.foot, Grip::holds);
    const Vec2 top{0.0, 1.0};
    const Vec2 answer = footing.answer({1.0, 0.0}, top);
    EXPECT_NEAR(answer.x(), 3.0, 1e-12);  // L^2 / (m L^2 / 3)
    EXPECT_NEAR(answer.y(), 0.0, 1e-12);
    footing.take({1.0, 0.0}, top);
    EXPECT_NEAR(footing.velocity_at({0.0, 0.0}).norm(), 0.0, 1e-12);
    EXPECT_NEAR(footing.foot_impulse().x(), 0.5, 1e-12);  // m v of the centre, 3/2, less the blow
}

TEST(Footing, GetsNothingFromABlowAtTheCentreOfPercussion) {
    const StandingRod rod;
    Footing footing(rod.body, rod.centre, rod.foot, Grip::holds);
    footing.take({1.0, 0.0}, {0.0, 2.0 / 3.0});
    EXPECT_NEAR(footing.foot_impulse().norm(), 0.0, 1e-12);
}

TEST(Footing, HoldsOnlyWithinTheConeAndSlipsBeyondIt) {
    const StandingRod rod;
    const Vec2 middle{0.0, 0.5};
    const Vec2 steep{0.3, -1.0};  // pushes the foot down more than along
    Footing held(rod.body, rod.centre, rod.foot, Grip::holds);
    held.take(steep, middle);
    EXPECT_TRUE(held.is_consistent());

    const Vec2 flat{1.0, -0.2};
    Footing torn(rod.body, rod.centre, rod.foot, Grip::holds);
    torn.take(flat, middle);
    EXPECT_FALSE(torn.is_consistent());
    int consistent = 0;
    for (const Grip grip : {Grip::slips_back, Grip::slips_ahead}) {
        Footing slips(rod.body, rod.centre, rod.foot, grip);
        slips.take(flat, middle);
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
        lifted.take({0.1, 1.0}, {0.0, 0.5});
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

TEST(Footing, OfFreeBodiesGivesThePairsFrame) {
    SolverBody a;
    a.inverse_mass = 2.0;
    a.inverse_inertia = 700.0;
    SolverBody b;
    b.inverse_mass = 3.0;
    b.inverse_inertia = 500.0;
    const Vec2 normal = Vec2(0.6, 0.8);
    const Vec2 point{0.01, 0.02};
    const ContactFrame general = contact_frame(normal, point, Footing(a, {0.03, 0.05}), Footing(b, {-0.01, 0.0}));
    const ContactFrame pair =
        contact_frame(normal, point - Vec2(0.03, 0.05), {2.0, 700.0}, point - Vec2(-0.01, 0.0), {3.0, 500.0});
    EXPECT_NEAR(general.b1, pair.b1, 1e-12);
    EXPECT_NEAR(general.b2, pair.b2, 1e-12);
    EXPECT_NEAR(general.b3, pair.b3, 1e-12);
    EXPECT_NEAR(general.b4, pair.b3, 1e-12);
}

}  // namespace
}  // namespace polargrain
