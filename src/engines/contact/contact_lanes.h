#pragma once

#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/lane_kernels.h"

namespace polargrain {

/// The contacts of a step in blocks of eight that share no grain, for the solver's loops over all of them.
///
/// Contacts get colours so that two of one grain have different ones, in the order in which they were found; blocks are
/// filled colour by colour. So the order of a sweep follows from the contacts alone, a block is computed with vector
/// instructions, and the blocks of a colour by any number of threads, with the same bits. What changes within the step
/// (open gap, impulses, travel) stands here, everything else of a contact stays in GapContact.
class ContactLanes {
public:
    /// Lays the contacts out. `bodies` are the grains; walls and empty lanes are added behind them.
    void lay_out(const std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, int threads);

    /// A contact's constants, gap and impulses, again: after its normal has changed.
    void put(const GapContact& c, std::size_t contact, const std::vector<SolverBody>& bodies);

    /// Puts gap, impulses and the sums of impulses since the last call into the contact. Returns the sum, on i [N s/m].
    Vec2 take(std::size_t contact, GapContact& c);

    bool sweep(std::vector<SolverBody>& bodies, double h, double settled, bool backwards);
    LaneLosses move(const std::vector<SolverBody>& bodies, const LaneMove& move);

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
    static constexpr std::int32_t k_colours = 64;
    /// Blocks of one colour: any order.
    struct Run {
        std::ptrdiff_t first, last;
    };

    void colour(const std::vector<GapContact>& contacts, std::size_t grains);
    LaneBlock& block(std::size_t contact) { return blocks_[place_[contact] / k_lanes]; }
    const LaneBlock& block(std::size_t contact) const { return blocks_[place_[contact] / k_lanes]; }
    std::size_t lane(std::size_t contact) const { return place_[contact] % k_lanes; }

    int threads_ = 1;
    std::vector<std::uint64_t> taken_;     ///< colours of a grain's contacts
    std::vector<std::int32_t> colour_of_;  ///< of a contact
    std::vector<std::uint32_t> place_;     ///< of a contact: block and lane
    std::vector<Run> runs_;
    std::vector<LaneBlock> blocks_;
    std::vector<TravelBlock> travels_;
    std::vector<LaneLosses> losses_;
    std::size_t grains_ = 0;
};

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
