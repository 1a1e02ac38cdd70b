#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/core/error.h"
#include "src/theory/foot_friction.h"

namespace polargrain {
namespace {

/// Opalene of [HN94, Table 1]; gap in thicknesses.
DominoRow opalene(double gap, double restitution = 0.85) {
    const double thickness = 7.5 / 41.8;
    return {thickness, gap * thickness, restitution, 0.18};
}

TEST(FootFriction, OfAHeldStrikerIsTheClosedForm) {
    for (const double gap : {1.0, 2.0, 3.0, 5.0}) {
        const DominoRow row = opalene(gap);
        const double h = row.thickness;
        const double rate = (std::sqrt(1.0 - row.gap * row.gap) - row.friction * h) / ((1.0 + h * h) / 3.0);
        const double exact = std::abs(0.5 * rate - 1.0) / (0.5 * rate * h + row.friction);
        EXPECT_NEAR(foot_friction(row, StrikerFoot::held), exact, 1e-12) << gap;
    }
    EXPECT_NEAR(foot_friction(opalene(1.0), StrikerFoot::held), 0.89, 5e-3);
}

TEST(FootFriction, OfPlasticBlowsDoesNotDependOnTheStrikersFoot) {
    for (const double gap : {1.0, 1.7, 3.0}) {
        const DominoRow row = opalene(gap, 0.0);
        EXPECT_NEAR(foot_friction(row, StrikerFoot::free), foot_friction(row, StrikerFoot::held), 1e-12) << gap;
    }
}

/// The blow of a free striker in small impulses, velocities of both bodies kept one by one. A foot impulse holds the
/// front bottom corner of the struck one after each.
double in_small_impulses(const DominoRow& row) {
    const double d = 1e-6;
    const double h = row.thickness, high = std::sqrt(1.0 - row.gap * row.gap);
    const double inertia = (1.0 + h * h) / 12.0;
    // Corner of the striker from its centre of mass; contact and foot of the struck from its own.
    const double ax = 0.5 * (h * high + row.gap), ay = 0.5 * (high - h * row.gap);
    const double bx = -0.5 * h, by = high - 0.5, fx = 0.5 * h, fy = -0.5;
    // The striker turns clockwise at 1 about its foot.
    double vx = high - ay, vy = -row.gap + ax, w = -1.0;
    double ux = 0.0, uy = 0.0, s = 0.0;
    double along = 0.0, across = 0.0, work = 0.0, given = 0.0;
    while (true) {
        const double closing = (vx - w * ay) - (ux - s * by);
        const double sliding = (vy + w * ax) - (uy + s * bx);
        if (closing > 0.0) {
            work += closing * d;
        } else {
            given -= closing * d;
            if (given >= row.restitution * row.restitution * work) return std::abs(along) / across;
        }
        const double f = -row.friction * std::tanh(sliding / 1e-4) * d;
        vx -= d;
        vy += f;
        w += (ax * f + ay * d) / inertia;
        ux += d;
        uy -= f;
        s += (-bx * f - by * d) / inertia;
        // Floor impulse (px, py) that stops the foot: two equations.
        const double cx = -(ux - s * fy), cy = -(uy + s * fx);
        const double xx = 1.0 + fy * fy / inertia, yy = 1.0 + fx * fx / inertia, xy = -fx * fy / inertia;
        const double det = xx * yy - xy * xy;
        const double px = (yy * cx - xy * cy) / det, py = (xx * cy - xy * cx) / det;
        ux += px;
        uy += py;
        s += (fx * py - fy * px) / inertia;
        along += px;
        across += py;
    }
}

TEST(FootFriction, OfAStrikerThatIsLetGoIsThatOfManySmallImpulses) {
    for (const double gap : {1.0, 1.25, 1.7, 3.0}) {
        const double small = in_small_impulses(opalene(gap));
        const double exact = foot_friction(opalene(gap), StrikerFoot::free);
        fmt::print("gap {} h: {:.4f}, in small impulses {:.4f}, held {:.4f}\n", gap, exact, small,
                   foot_friction(opalene(gap), StrikerFoot::held));
        EXPECT_NEAR(small, exact, 1e-3) << gap;
    }
}

TEST(FootFriction, IsRefusedForRowsThatCannotTopple) {
    EXPECT_THROW(foot_friction({0.1, 1.0, 0.5, 0.2}, StrikerFoot::held), InputError);
}

}  // namespace
}  // namespace polargrain
