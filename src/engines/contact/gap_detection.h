#pragma once

#include <vector>

#include "src/detect/gap_points.h"
#include "src/detect/pair_list.h"
#include "src/engines/contact/gap_contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// Poses of all grains at one instant.
struct PoseSet {
    std::vector<Vec2> centre;
    std::vector<double> angle;
    std::vector<Pose> pose;

    void resize(std::size_t n);
    void refresh(std::size_t k) { pose[k] = Pose::at(centre[k], angle[k]); }
};

/// The contacts of one pair of bodies: a run of the contact array.
struct PairContacts {
    BodyIndex i = 0, j = 0;
    std::int32_t piece = -1;  ///< of the wall pieces, where j is a wall
    std::int32_t first = 0, count = 0;
    bool overlapping = false;
};

/// Finds the speculative contacts of a configuration and, in the same pass, which bodies overlap in it.
///
/// The list of pairs is kept over steps (PairList); every listed pair is looked at whenever detect() runs. Order of the
/// result: pairs of grains ascending, then grains with wall pieces ascending.
class GapDetection {
public:
    explicit GapDetection(const Scene& scene);

    /// Detects at the poses `now`; `before` are the last poses that did not overlap. Velocities decide how far ahead to
    /// look. time_before, time_now: for moving and removed walls.
    void detect(const PoseSet& before, const PoseSet& now, const std::vector<SolverBody>& bodies, double time_before,
                double time_now, double dt);

    /// Detects again only what a moved grain takes part in; the rest is kept.
    void detect_moved(const PoseSet& before, const PoseSet& now, const std::vector<char>& moved);

    std::vector<GapContact>& contacts() { return contacts_; }
    const std::vector<GapContact>& contacts() const { return contacts_; }
    std::vector<PairContacts>& pairs() { return pairs_; }
    const std::vector<PairContacts>& pairs() const { return pairs_; }
    const std::vector<GrainPair>& near_pairs() const { return list_.pairs(); }

    /// The gap at which two bodies rest [m]: k_resting of the smaller one's mean diameter.
    double resting_gap(BodyIndex i, BodyIndex j) const;

    /// Takes the impulses of old contacts over to those of the same features, as first guesses of the solver.
    void match(const std::vector<PairContacts>& old_pairs, std::vector<GapContact>& old_contacts);

    double radius(GrainIndex k) const { return list_.radius(k); }

    static constexpr double k_resting = 1e-3;

private:
    void place_walls(double time_before, double time_now);
    void find_agitation(const PoseSet& now, const std::vector<SolverBody>& bodies, double dt);
    double margin(BodyIndex i, BodyIndex j) const;
    void detect_pair(const PoseSet& now, GrainIndex a, GrainIndex b);
    void detect_wall(const PoseSet& before, const PoseSet& now, GrainIndex k, std::int32_t piece);
    void store(BodyIndex i, BodyIndex j, std::int32_t piece, bool overlapping);

    struct Piece {
        int wall;
        GapPiece geometry;
    };

    const Scene& scene_;
    PairList list_;
    std::vector<double> diameter_;
    std::vector<double> look_ahead_;  ///< per grain: dt x the largest speed relative to anything near [m]
    std::vector<double> clearance_;
    std::vector<Piece> pieces_;
    std::vector<double> wall_speed_;
    double gravity_way_ = 0.0;  ///< 2 g dt^2
    std::vector<GapContact> contacts_, kept_;
    std::vector<PairContacts> pairs_, kept_pairs_;
    std::vector<GapPoint> points_;
};

}  // namespace polargrain
