#pragma once

#include <vector>

#include "src/engines/contact/gap_detection.h"
#include "tests/support/scenes.h"

namespace polargrain::testing {

/// Of the disks of such tests [m], and the gap at which two of them rest.
inline constexpr double k_radius = 0.01;
inline constexpr double k_gap = 2.0 * k_radius * GapDetection::k_resting;

inline void place(PoseSet& poses, std::size_t k, const Vec2& centre, double angle) {
    poses.centre[k] = centre;
    poses.angle[k] = angle;
    poses.refresh(k);
}

/// Grains that try to move: where they stand, where they want to go, and what the engine `contact` finds there.
struct TrialMoves {
    static constexpr double k_dt = 1e-3;  ///< of the step that they are part of [s]

    explicit TrialMoves(Scene the_scene) : scene(std::move(the_scene)), detection(scene) {
        const auto n = static_cast<std::size_t>(scene.grains.size());
        before.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            const auto g = static_cast<GrainIndex>(k);
            place(before, k, scene.grains.position(g), scene.grains.angle[k]);
            bodies.push_back({scene.grains.velocity(g), scene.grains.spin[k], 1.0 / scene.grains.mass[k],
                              1.0 / scene.grains.inertia[k], false});
        }
        trial = before;
    }

    const Scene scene;
    PoseSet before, trial;
    std::vector<SolverBody> bodies;
    GapDetection detection;

    void move(GrainIndex grain, const Vec2& way, double turn = 0.0) {
        const std::size_t k = Grains::at(grain);
        place(trial, k, trial.centre[k] + way, trial.angle[k] + turn);
    }

    void detect() { detection.detect(before, trial, bodies, 0.0, k_dt, k_dt); }

    double resting() const { return detection.resting_gap(0, wall_body(0)); }

    /// Overlaps at the trial poses, as an independent test counts them.
    int overlaps() const {
        Grains grains = scene.grains;
        for (std::size_t k = 0; k < trial.centre.size(); ++k) {
            grains.set_position(static_cast<GrainIndex>(k), trial.centre[k]);
            grains.angle[k] = trial.angle[k];
        }
        return count_overlaps(scene, grains, k_dt, 1e-10);
    }
};

/// Sum of mass times way from one set of poses to another: zero where a move needs no force from outside [kg].
inline Vec2 moved_mass(const std::vector<SolverBody>& bodies, const PoseSet& from, const PoseSet& to) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = 0; k < bodies.size(); ++k) sum += (to.centre[k] - from.centre[k]) / bodies[k].inverse_mass;
    return sum;
}

/// The same of turns: its moment about the origin, and what the grains have turned [kg m].
inline double turned_mass(const std::vector<SolverBody>& bodies, const PoseSet& from, const PoseSet& to) {
    double sum = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        sum += cross(from.centre[k], Vec2(to.centre[k] - from.centre[k])) / bodies[k].inverse_mass +
               (to.angle[k] - from.angle[k]) / bodies[k].inverse_inertia;
    }
    return sum;
}

/// Have two sets the same poses, to the last bit?
inline bool same_poses(const PoseSet& p, const PoseSet& q) { return p.centre == q.centre && p.angle == q.angle; }

}  // namespace polargrain::testing
