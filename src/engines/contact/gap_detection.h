#pragma once

#include <span>
#include <vector>

#include "src/core/parallel.h"
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
/// The list of pairs is kept over steps (PairList). Whatever has not moved by a single bit since it was looked at, and
/// looks as far ahead as then, has the contacts that it had: the rest of a bed costs a copy. Order of the result: pairs
/// of grains ascending, then grains with wall pieces ascending; threads take runs of both, so that it does not depend
/// on their number.
class GapDetection {
public:
    explicit GapDetection(const Scene& scene);

    /// Detects at the poses `now`; `before` are the last poses that did not overlap. Velocities decide how far ahead to
    /// look. time_before, time_now: for moving and removed walls.
    void detect(const PoseSet& before, const PoseSet& now, const std::vector<SolverBody>& bodies, double time_before,
                double time_now, double dt);

    /// Detects again only what a moved grain takes part in; the rest is kept. From then on contacts are to be reached
    /// through their pairs: among them stand some that have been replaced.
    void detect_moved(const PoseSet& before, const PoseSet& now, const std::vector<char>& moved);

    /// Gives pairs and contacts away, in order, and takes the old ones in exchange, whose memory is used again. The old
    /// impulses go over to the contacts of the same features, as first guesses of the solver.
    void hand_over(std::vector<PairContacts>& pairs, std::vector<GapContact>& contacts);

    const std::vector<GapContact>& contacts() const { return found_.contacts; }
    const std::vector<PairContacts>& pairs() const { return found_.pairs; }
    const GapContact* begin_of(const PairContacts& pair) const { return found_.contacts.data() + pair.first; }
    const GapContact* end_of(const PairContacts& pair) const { return begin_of(pair) + pair.count; }
    const std::vector<GrainPair>& near_pairs() const { return list_.pairs(); }

    /// The gap at which two bodies rest [m]: k_resting of the smaller one's mean diameter.
    double resting_gap(BodyIndex i, BodyIndex j) const;

    double radius(GrainIndex k) const { return list_.radius(k); }

    static constexpr double k_resting = 1e-3;

private:
    void place_walls(double time_before, double time_now);
    void find_agitation(const PoseSet& now, const std::vector<SolverBody>& bodies, double dt);
    double margin(BodyIndex i, BodyIndex j) const;
    void find_moved(const PoseSet& before, const PoseSet& now);

    /// Contacts in the order of their pairs, and the bare points that they were made from.
    struct Found {
        std::vector<GapContact> contacts;
        std::vector<PairContacts> pairs;
        std::vector<GapPoint> points;

        void clear();
        void swap(Found& other);
        void resize(std::size_t contact_count, std::size_t pair_count);
        /// Copies more into the places from the given ones on.
        void put(const Found& more, std::size_t first_contact, std::size_t first_pair);
    };
    /// What a thread works on: a run of pairs, or of grains with walls.
    struct Share {
        Found found;
        std::vector<GapPoint> scratch;
        std::size_t cursor = 0;                         ///< in the last detection's pairs
        std::size_t first_contact = 0, first_pair = 0;  ///< where its finds go
    };

    void detect_all(const PoseSet& before, const PoseSet& now);
    void detect_pairs(Share& share, std::span<const GrainPair> pairs, const PoseSet& now) const;
    void detect_walls(Share& share, GrainIndex first, GrainIndex last, const PoseSet& before, const PoseSet& now) const;
    void gather(std::size_t shares, Found& all);
    void splice(const std::vector<char>& moved);
    void put_in_order();
    void match(const std::vector<PairContacts>& old_pairs, std::vector<GapContact>& old_contacts);
    void keep(Share& share, const PairContacts& key) const;
    void detect_pair(Share& share, const PoseSet& now, GrainIndex a, GrainIndex b) const;
    void detect_wall(Share& share, const PoseSet& before, const PoseSet& now, GrainIndex k, std::int32_t piece) const;
    void store(Share& share, const PairContacts& pair, std::span<const GapPoint> points) const;

    struct Piece {
        int wall;
        GapPiece geometry;
    };

    const Scene& scene_;
    Parallel parallel_;
    PairList list_;
    std::vector<double> diameter_;
    std::vector<double> look_ahead_;  ///< per grain: dt x the largest speed relative to anything near [m]
    std::vector<double> pair_way_;    ///< per listed pair: the same of the two alone; 0 if they cannot meet
    std::vector<double> clearance_;
    std::vector<Piece> pieces_;
    std::vector<double> wall_speed_;
    double gravity_way_ = 0.0;  ///< 2 g dt^2
    Found found_;
    std::vector<Share> shares_;
    Found ordered_;  ///< to put contacts in order in
    Found patch_;    ///< what has been detected again
    std::vector<PairContacts> merged_pairs_;
    std::vector<GrainPair> affected_pairs_;
    std::vector<GrainIndex> affected_grains_;
    std::size_t in_order_ = 0;  ///< contacts when they were last in order
    bool spliced_ = false;      ///< some contacts have been replaced, and new ones stand behind the others
    bool handed_over_ = false;  ///< found_ holds what came in exchange
    // Of the last detection: its pairs and points, and what it saw.
    std::vector<PairContacts> last_pairs_;
    std::vector<GapPoint> last_points_;
    std::vector<Pose> seen_;
    std::vector<double> seen_ahead_;
    double seen_gravity_way_ = 0.0;
    std::size_t seen_pieces_ = 0;
    std::vector<char> moved_;
};

}  // namespace polargrain
