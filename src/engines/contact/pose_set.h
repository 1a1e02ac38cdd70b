#pragma once

#include <limits>
#include <vector>

#include "src/geometry/pose.h"

namespace polargrain {

/// Poses of all grains at one instant.
struct PoseSet {
    std::vector<Vec2> centre;
    std::vector<double> angle;
    std::vector<Pose> pose;

    /// New ones are nowhere, so that no grain is taken to stand already where it is put.
    void resize(std::size_t n) {
        centre.resize(n, Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
        angle.resize(n);
        pose.resize(n);
    }
    void refresh(std::size_t k) { pose[k] = Pose::at(centre[k], angle[k]); }
};

}  // namespace polargrain
