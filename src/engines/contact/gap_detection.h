#pragma once

#include <span>
#include <vector>

#include "src/core/parallel.h"
#include "src/detect/gap_points.h"
#include "src/detect/pair_list.h"
#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/gap_walls.h"
#include "src/engines/contact/pose_set.h"
#include "src/model/scene.h"

namespace polargrain {

/// Finds the points at which bodies may meet in a configuration and, in the same pass, which of them overlap in it.
/// Once the configuration is accepted, speculative contacts are made of the points.
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

    /// From now on the poses `before` are known not to overlap, which saves most of the tests.
    void begin_clean() { clean_ = true; }
    bool began_clean() const { return clean_; }

    /// Detects again only what a moved grain takes part in; the rest is kept.
    void detect_moved(const PoseSet& before, const PoseSet& now, const std::vector<char>& moved);

    /// Makes contacts of what has been found, in order, in place of the old ones, whose impulses go over to the
    /// contacts of the same features as first guesses of the solver.
    void hand_over(std::vector<PairContacts>& pairs, std::vector<GapContact>& contacts);

    const std::vector<PairContacts>& pairs() const { return found_.pairs; }
    /// How many of them overlap.
    int overlapping() const;
    std::span<const GapPoint> points_of(const PairContacts& pair) const { return found_.of(pair); }
    const std::vector<GrainPair>& near_pairs() const { return list_.pairs(); }

    /// The gap at which two bodies rest [m]: k_resting of the smaller one's mean diameter.
    double resting_gap(BodyIndex i, BodyIndex j) const;

    double radius(GrainIndex k) const { return list_.radius(k); }

    static constexpr double k_resting = 1e-3;

private:
    static constexpr std::size_t k_run = 1024;  ///< pairs or grains that a thread takes at a time

    template <typename Work>
    void each_grain(const Work& work) const {
        parallel_.runs(diameter_.size(), k_run, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) work(k);
        });
    }
    void find_agitation(const PoseSet& now, const std::vector<SolverBody>& bodies, double dt);
    double margin(BodyIndex i, BodyIndex j) const;
    void find_moved(const PoseSet& before, const PoseSet& now);

    /// Pairs, and their points in the same order.
    struct Found {
        std::vector<PairContacts> pairs;
        std::vector<GapPoint> points;

        std::span<const GapPoint> of(const PairContacts& pair) const {
            return {points.data() + pair.first, static_cast<std::size_t>(pair.count)};
        }
        void clear();
        void swap(Found& other);
        void resize(std::size_t point_count, std::size_t pair_count);
        /// Copies more into the places from the given ones on.
        void put(const Found& more, std::size_t first_point, std::size_t first_pair);
    };
    /// What a thread works on: a run of pairs, or of grains with walls.
    struct Share {
        Found found;
        std::vector<GapPoint> scratch;
        std::vector<std::int32_t> near;               ///< wall pieces
        std::size_t cursor = 0;                       ///< in the last detection's pairs
        std::size_t first_point = 0, first_pair = 0;  ///< where its finds go
    };

    void detect_all(const PoseSet& before, const PoseSet& now);
    void detect_pairs(Share& share, std::span<const GrainPair> pairs, const PoseSet& before, const PoseSet& now) const;
    void detect_walls(Share& share, GrainIndex first, GrainIndex last, const PoseSet& before, const PoseSet& now) const;
    void gather(std::size_t shares, Found& all);
    void splice(const std::vector<char>& moved);
    void put_in_order();
    void replace(PairContacts& pair, const PairContacts* old);
    void keep(Share& share, const PairContacts& key) const;
    void detect_pair(Share& share, const PoseSet& before, const PoseSet& now, GrainIndex a, GrainIndex b) const;
    bool still_apart(double clearance, const PoseSet& before, const PoseSet& now, GrainIndex a, GrainIndex b) const;
    void find_turn(const PoseSet& before, const PoseSet& now, std::size_t k);
    void find_near_walls(Share& share, const PoseSet& now, GrainIndex k) const;
    void detect_wall(Share& share, const PoseSet& before, const PoseSet& now, GrainIndex k, std::int32_t piece) const;
    static void store(Share& share, const PairContacts& pair, std::span<const GapPoint> points);

    const Scene& scene_;
    Parallel parallel_;
    PairList list_;
    GapWalls walls_;
    std::vector<double> diameter_;
    std::vector<double> look_ahead_;  ///< per grain: dt x the largest speed relative to anything near [m]
    std::vector<double> pair_way_;    ///< per listed pair: the same of the two alone; 0 if they cannot meet
    std::vector<double> clearance_;
    std::vector<double> turn_way_;  ///< per grain: how far its turn since `before` has taken any point of it [m]
    double gravity_way_ = 0.0;      ///< 2 g dt^2
    Found found_;
    std::vector<Share> shares_;
    Found ordered_;  ///< to put points in order in
    Found patch_;    ///< what has been detected again
    std::vector<PairContacts> merged_pairs_;
    std::vector<GapContact> made_;  ///< to make contacts in
    std::size_t in_order_ = 0;      ///< points when they were last in order
    bool spliced_ = false;          ///< some points have been replaced, and new ones may stand behind the others
    // The last detection, and what it saw.
    Found last_;
    std::vector<Pose> seen_;
    std::vector<double> seen_ahead_;
    double seen_gravity_way_ = 0.0;
    std::size_t seen_pieces_ = 0;
    std::vector<char> moved_;
    bool clean_ = false;
};

}  // namespace polargrain
