#pragma once

#include <array>
#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/lane_kernels.h"
#include "src/model/scene.h"

namespace polargrain {

/// How hard lasting contacts are solved in a sub-step.
struct SweepEffort {
    int sweeps;      ///< at most
    double settled;  ///< a sweep that changes no velocity by more [m/s] ends the solve
    /// A sweep back ends with the strips and the next one begins with them: a strip that has changed gets both while it
    /// is in the cache. Not where a bed is at rest: its last digits settle worse.
    bool in_pairs;
};

/// The contacts of a step in blocks of eight that share no grain, for the solver's loops over all of them.
///
/// Large beds are cut into strips. A strip's own contacts touch nobody in another strip; those across borders come
/// after them. Contacts that span more than two strips, or of a grain with contacts across both borders, come last.
/// Threads take whole strips or borders, which also keeps what they work on in their caches. Within each, contacts get
/// colours, so that two of one grain have different ones, in the order in which they were found; blocks are filled
/// colour by colour. So the order of a sweep follows from the contacts alone, and any number of threads gives the same
/// bits.
///
/// What changes within the step (open gap, impulses, travel) stands here, everything else of a contact in GapContact.
class ContactLanes {
public:
    explicit ContactLanes(const Scene& scene);

    /// Lays the contacts out. `bodies` are the grains, `centres` where they are; what stands for walls and for empty
    /// lanes is added behind the bodies.
    void lay_out(const std::vector<GapContact>& contacts, const std::vector<Vec2>& centres,
                 std::vector<SolverBody>& bodies);

    /// A contact's constants, gap and impulses, again: after its normal has changed.
    void put(const GapContact& c, std::size_t contact, const std::vector<SolverBody>& bodies);

    /// The same for a contact without impulses, which is open by so much [m].
    void turn(const GapContact& c, std::size_t contact, const std::vector<SolverBody>& bodies, double open);

    /// Puts gap, impulses and the sums of impulses since the last call into the contact. Returns the sum, on i [N s/m].
    Vec2 take(std::size_t contact, GapContact& c);

    /// Gauss-Seidel sweeps, to and fro, until one has changed little; returns whether one has.
    bool sweep(std::vector<SolverBody>& bodies, double h, const SweepEffort& effort);
    LaneLosses move(const std::vector<SolverBody>& bodies, const LaneMove& move);

    /// Contacts are swept in groups. Calls work(group) for each that has contacts, those that share no grain on several
    /// threads.
    template <typename Work>
    void each_group(bool backwards, const Work& work) const;
    std::size_t groups() const { return groups_.size(); }
    std::size_t group_of(std::size_t contact) const { return static_cast<std::size_t>(group_[contact]); }

    /// Marks the grains that have a contact with an impulse.
    void mark_pushed(std::vector<char>& pushed) const;

    /// Calls visit(contact) for every contact that the last move has carried past its bounds, in order of blocks.
    template <typename Visit>
    void each_left(Visit visit) const;

    /// Contacts that may strike in the next sub-step, by the speeds of the last move.
    void find_closing(std::vector<std::int32_t>& closing) const;

    /// Gap less resting gap [m].
    double open(std::size_t contact) const { return block(contact).open.of[lane(contact)]; }
    void widen(std::size_t contact, double way) { block(contact).open.of[lane(contact)] += way; }
    double normal_impulse(std::size_t contact) const { return block(contact).normal_impulse.of[lane(contact)]; }
    double tangent_impulse(std::size_t contact) const { return block(contact).tangent_impulse.of[lane(contact)]; }
    void set_impulse(std::size_t contact, const Vec2& impulse) {
        block(contact).normal_impulse.of[lane(contact)] = impulse.x();
        block(contact).tangent_impulse.of[lane(contact)] = impulse.y();
    }
    /// Travel against its bounds: past the upper one?
    bool beyond_high(std::size_t contact) const {
        const TravelBlock& t = travels_[place_[contact] / k_lanes];
        return t.travel.of[lane(contact)] > t.high.of[lane(contact)];
    }

    /// The body that stands for the wall of a contact.
    SolverBody& wall_body_of(std::size_t contact, std::vector<SolverBody>& bodies) const {
        return bodies[static_cast<std::size_t>(block(contact).j[lane(contact)])];
    }

private:
    enum Phase : std::uint8_t { k_within, k_border, k_far, k_phases };
    /// Contacts that one thread takes: their blocks, one after the other.
    struct Group {
        Phase phase;
        std::ptrdiff_t first, last;
    };

    std::size_t choose_group(const GapContact& c);
    void cut_into_strips(std::size_t contacts, const std::vector<Vec2>& centres);
    void colour(const std::vector<GapContact>& contacts, std::size_t grains);
    void place(const std::vector<GapContact>& contacts);
    void fill(const std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies);
    LaneBlock& block(std::size_t contact) { return blocks_[place_[contact] / k_lanes]; }
    const LaneBlock& block(std::size_t contact) const { return blocks_[place_[contact] / k_lanes]; }
    std::size_t lane(std::size_t contact) const { return place_[contact] % k_lanes; }

    Parallel parallel_;
    double widest_ = 0.0;  ///< largest diameter of a grain [m]
    std::size_t strips_ = 1;
    std::vector<std::int32_t> strip_;    ///< of a grain
    std::vector<std::int32_t> border_;   ///< of a grain: the group across a border that it belongs to; -1: none yet
    std::vector<std::int32_t> group_;    ///< of a contact
    std::vector<std::uint64_t> taken_;   ///< per phase and grain: the colours of its contacts
    std::vector<std::int32_t> colour_;   ///< of a contact
    std::vector<std::int32_t> size_of_;  ///< per group and colour: contacts, then where the next one goes
    std::vector<std::uint32_t> place_;   ///< of a contact: block and lane
    std::vector<Group> groups_;
    std::array<std::vector<std::size_t>, k_phases> of_phase_;  ///< groups with contacts
    std::vector<char> changed_;                                ///< per group: by the last sweep
    std::vector<char> ahead_;                                  ///< per group: by its pass of the next sweep
    std::vector<LaneBlock> blocks_;
    std::vector<TravelBlock> travels_;
    std::vector<LaneLosses> losses_;
};

template <typename Work>
void ContactLanes::each_group(bool backwards, const Work& work) const {
    for (std::size_t p = 0; p < k_phases; ++p) {
        const std::vector<std::size_t>& groups = of_phase_[backwards ? k_phases - 1 - p : p];
        parallel_.each(groups.size(), [&](std::size_t n) { work(groups[n]); });
    }
}

template <typename Visit>
void ContactLanes::each_left(Visit visit) const {
    for (const TravelBlock& t : travels_) {
        if (t.left == 0) continue;
        for (int n = 0; n < k_lanes; ++n) {
            if ((t.left >> n & 1) != 0) visit(static_cast<std::size_t>(t.contact[n]));
        }
    }
}

}  // namespace polargrain
