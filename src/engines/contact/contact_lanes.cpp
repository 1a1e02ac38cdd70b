#include "src/engines/contact/contact_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace polargrain {

namespace {

constexpr double k_unbounded = std::numeric_limits<double>::infinity();

static_assert(sizeof(SolverBody) == k_body_stride * sizeof(double) && offsetof(SolverBody, velocity) == 0 &&
              offsetof(SolverBody, spin) == 2 * sizeof(double) &&
              offsetof(SolverBody, inverse_mass) == 3 * sizeof(double));

double* numbers(std::vector<SolverBody>& bodies) { return bodies.front().velocity.data(); }
const double* numbers(const std::vector<SolverBody>& bodies) { return bodies.front().velocity.data(); }

}  // namespace

/// The lowest colour that neither grain has yet. A grain with more contacts than there are colours gives the rest runs
/// of their own.
void ContactLanes::colour(const std::vector<GapContact>& contacts, std::size_t grains) {
    taken_.assign(grains, 0);
    colour_of_.clear();
    std::int32_t size_of[k_colours] = {};
    std::int32_t surplus = 0;
    for (const GapContact& c : contacts) {
        std::uint64_t& of_i = taken_[Grains::at(c.i)];
        std::uint64_t wall = 0;
        std::uint64_t& of_j = is_wall(c.j) ? wall : taken_[Grains::at(c.j)];
        const std::uint64_t both = of_i | of_j;
        if (both == ~std::uint64_t{0}) {
            colour_of_.push_back(k_colours + surplus++);
            continue;
        }
        const int colour = std::countr_one(both);
        of_i |= std::uint64_t{1} << colour;
        of_j |= std::uint64_t{1} << colour;
        colour_of_.push_back(colour);
        ++size_of[colour];
    }
    runs_.clear();
    std::ptrdiff_t block = 0;
    for (const std::int32_t size : size_of) {
        if (size == 0) break;
        const std::ptrdiff_t blocks = (size + k_lanes - 1) / k_lanes;
        runs_.push_back({block, block + blocks});
        block += blocks;
    }
    for (std::int32_t k = 0; k < surplus; ++k, ++block) runs_.push_back({block, block + 1});

    std::uint32_t next[k_colours] = {};
    for (std::size_t c = 0; c < std::min<std::size_t>(runs_.size(), k_colours); ++c) {
        next[c] = static_cast<std::uint32_t>(runs_[c].first * k_lanes);
    }
    const auto first_surplus = static_cast<std::uint32_t>((block - surplus) * k_lanes);
    place_.resize(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const std::int32_t c = colour_of_[k];
        place_[k] = c < k_colours ? next[c]++ : first_surplus + static_cast<std::uint32_t>((c - k_colours) * k_lanes);
    }
}

void ContactLanes::lay_out(const std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, int threads) {
    threads_ = threads;
    grains_ = bodies.size();
    colour(contacts, grains_);
    const auto count = static_cast<std::size_t>(runs_.empty() ? 0 : runs_.back().last);
    blocks_.assign(count, LaneBlock{});
    travels_.resize(count);
    losses_.resize(count);
    for (TravelBlock& t : travels_) {
        t = {};
        std::fill(std::begin(t.low.of), std::end(t.low.of), -k_unbounded);
        std::fill(std::begin(t.high.of), std::end(t.high.of), k_unbounded);
        std::fill(std::begin(t.contact), std::end(t.contact), -1);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const std::size_t n = lane(k);
        LaneBlock& b = block(k);
        b.i[n] = contacts[k].i;
        b.j[n] = contacts[k].j;
        if (is_wall(contacts[k].j)) {
            b.j[n] = static_cast<std::int32_t>(bodies.size());
            bodies.emplace_back();
        }
        travels_[place_[k] / k_lanes].contact[n] = static_cast<std::int32_t>(k);
        put(contacts[k], k, bodies);
    }
    // Threads may work on blocks at the same time: each with empty lanes gets a body of its own for them.
    for (std::size_t b = 0; b < count; ++b) {
        bool empty = false;
        for (int n = 0; n < k_lanes; ++n) {
            if (travels_[b].contact[n] >= 0) continue;
            blocks_[b].i[n] = blocks_[b].j[n] = static_cast<std::int32_t>(bodies.size());
            empty = true;
        }
        if (empty) bodies.emplace_back();
    }
}

void ContactLanes::put(const GapContact& c, std::size_t contact, const std::vector<SolverBody>& bodies) {
    LaneBlock& b = block(contact);
    TravelBlock& t = travels_[place_[contact] / k_lanes];
    const std::size_t n = lane(contact);
    const SolverBody& i = bodies[static_cast<std::size_t>(b.i[n])];
    const SolverBody& j = bodies[static_cast<std::size_t>(b.j[n])];
    b.normal_x.of[n] = c.normal.x();
    b.normal_y.of[n] = c.normal.y();
    b.arm_ni.of[n] = c.arm_ni;
    b.arm_ti.of[n] = c.arm_ti;
    b.arm_nj.of[n] = c.arm_nj;
    b.arm_tj.of[n] = c.arm_tj;
    b.spin_ni.of[n] = i.inverse_inertia * c.arm_ni;
    b.spin_ti.of[n] = i.inverse_inertia * c.arm_ti;
    b.spin_nj.of[n] = j.inverse_inertia * c.arm_nj;
    b.spin_tj.of[n] = j.inverse_inertia * c.arm_tj;
    b.mass_n.of[n] = c.active ? c.mass_n : 0.0;
    b.mass_t.of[n] = c.active ? c.mass_t : 0.0;
    b.friction.of[n] = c.friction;
    b.open.of[n] = c.gap - c.resting;
    b.normal_impulse.of[n] = c.normal_impulse;
    b.tangent_impulse.of[n] = c.tangent_impulse;
    t.low.of[n] = c.active ? c.low : -k_unbounded;
    t.high.of[n] = c.active ? c.high : k_unbounded;
}

Vec2 ContactLanes::take(std::size_t contact, GapContact& c) {
    const LaneBlock& b = block(contact);
    TravelBlock& t = travels_[place_[contact] / k_lanes];
    const std::size_t n = lane(contact);
    c.gap = b.open.of[n] + c.resting;
    c.normal_impulse = b.normal_impulse.of[n];
    c.tangent_impulse = b.tangent_impulse.of[n];
    const Vec2 sum = t.sum_normal.of[n] * c.normal + t.sum_tangent.of[n] * c.tangent();
    t.sum_normal.of[n] = 0.0;
    t.sum_tangent.of[n] = 0.0;
    return sum;
}

bool ContactLanes::sweep(std::vector<SolverBody>& bodies, double h, double settled, bool backwards) {
    const LaneKernels& kernels = lane_kernels();
    bool changed = false;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        const Run& run = runs_[backwards ? runs_.size() - 1 - k : k];
        changed |= kernels.sweep(blocks_.data(), run.first, run.last, backwards, numbers(bodies), 1.0 / h, settled);
    }
    return changed;
}

LaneLosses ContactLanes::move(const std::vector<SolverBody>& bodies, const LaneMove& move) {
    return lane_kernels().move(blocks_.data(), travels_.data(), 0, static_cast<std::ptrdiff_t>(blocks_.size()),
                               numbers(bodies), move);
}

void ContactLanes::mark_pushed(std::vector<char>& pushed) const {
    for (const LaneBlock& b : blocks_) {
        for (int n = 0; n < k_lanes; ++n) {
            if (b.normal_impulse.of[n] == 0.0) continue;
            pushed[static_cast<std::size_t>(b.i[n])] = 1;
            pushed[static_cast<std::size_t>(b.j[n])] = 1;
        }
    }
}

void ContactLanes::find_closing(std::vector<std::int32_t>& closing) const {
    closing.clear();
    for (const TravelBlock& t : travels_) {
        if (t.closes == 0) continue;
        for (int n = 0; n < k_lanes; ++n) {
            if ((t.closes >> n & 1) != 0) closing.push_back(t.contact[n]);
        }
    }
}

}  // namespace polargrain
