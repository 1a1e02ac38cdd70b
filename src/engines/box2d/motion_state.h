#pragma once

#include <vector>

#include "src/model/grains.h"

namespace polargrain {

/// The part of Grains that changes in a step.
struct MotionState {
    std::vector<double> x, y, angle, vx, vy, spin;

    static MotionState of(const Grains& g) { return {g.x, g.y, g.angle, g.vx, g.vy, g.spin}; }
    void put(Grains& g) const { g.x = x, g.y = y, g.angle = angle, g.vx = vx, g.vy = vy, g.spin = spin; }
    bool same_as(const Grains& g) const {
        return x == g.x && y == g.y && angle == g.angle && vx == g.vx && vy == g.vy && spin == g.spin;
    }
};

}  // namespace polargrain
