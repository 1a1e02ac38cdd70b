#pragma once

#include <algorithm>
#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/model/grains.h"

namespace polargrain {

/// How far a grain is moved without a force, to open gaps.
struct Shift {
    Vec2 way = Vec2::Zero();  ///< [m]
    double turn = 0.0;        ///< [rad]
};

/// One grain of a gap that is to be opened.
struct OpeningSide {
    GrainIndex grain = -1;    ///< none: a wall, or a grain that does not give way
    Vec2 way = Vec2::Zero();  ///< what a push of one moves it by [1/kg]
    double turn = 0.0, arm = 0.0;

    static OpeningSide of(GrainIndex grain, const SolverBody& body, const Vec2& normal, double arm) {
        return {grain, body.inverse_mass * normal, body.inverse_inertia * arm, arm};
    }

    /// How much its shift has opened the gap along the normal [m].
    double opened(const std::vector<Shift>& shifts, const Vec2& normal) const {
        if (grain < 0) return 0.0;
        const Shift& s = shifts[Grains::at(grain)];
        return normal.dot(s.way) + arm * s.turn;
    }

    void stay(std::vector<Shift>& shifts) const {
        if (grain >= 0) shifts[Grains::at(grain)] = {};
    }

    void take(std::vector<Shift>& shifts, double push) const {
        if (grain < 0) return;
        shifts[Grains::at(grain)].way += push * way;
        shifts[Grains::at(grain)].turn += push * turn;
    }
};

/// A gap in a unilateral, frictionless Gauss-Seidel on shifts, weighted by mass and inertia: below its aim it is opened
/// to it, above it may close to it.
struct GapOpening {
    Vec2 normal = Vec2::UnitY();
    double gap = 0.0, aim = 0.0;  ///< [m]
    double mass = 0.0;            ///< effective, along the normal [kg/m]
    double push = 0.0;            ///< so far [kg], impulse of displacement per metre of depth
    OpeningSide i, j;

    /// What the shifts have made of it [m].
    double shifted(const std::vector<Shift>& shifts) const {
        return gap + i.opened(shifts, normal) - j.opened(shifts, normal);
    }

    /// Have the shifts closed it until its two grains overlap?
    bool overlaps(const std::vector<Shift>& shifts) const {
        const double now = shifted(shifts);
        return now < 0.0 && now < gap;
    }

    /// Where they have: takes those of the two grains back.
    void hold(std::vector<Shift>& shifts) const {
        if (!overlaps(shifts)) return;
        i.stay(shifts);
        j.stay(shifts);
    }

    /// Returns whether it has moved anything.
    bool relax(std::vector<Shift>& shifts) {
        const double wanted = std::max(0.0, push + mass * (aim - shifted(shifts)));
        const double change = wanted - push;
        if (change == 0.0) return false;
        push = wanted;
        i.take(shifts, change);
        j.take(shifts, -change);
        return true;
    }
};

}  // namespace polargrain
