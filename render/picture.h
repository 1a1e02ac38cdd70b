#pragma once

#include <span>
#include <vector>

#include "src/model/scene.h"
#include "src/model/step_report.h"
#include "src/record/trajectory_reader.h"

namespace polargrain {

/// A wall where it is at one instant.
struct PlacedWall {
    std::vector<Vec2> points;  ///< [m]; the solid side is on the right of the direction of travel
    Pose pose;                 ///< that took the rest points there
    int number = 0;            ///< of the wall in the scene
};

/// What there is to be seen at one instant, whether it comes from a run or from a recording. Refers to the scene,
/// the grains and the contacts it was made of, which outlive it.
struct Picture {
    double time = 0.0;  ///< [s]
    const Scene& scene;
    const Grains& grains;
    std::vector<PlacedWall> walls;  ///< only those present at that time
    std::span<const Contact> contacts;
};

Picture picture_of(const Scene& scene, const World& world, const StepReport& report);
Picture picture_of(const Scene& scene, const StoredFrame& frame);

}  // namespace polargrain
