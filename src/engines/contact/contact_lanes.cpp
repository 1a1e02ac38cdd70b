#include "src/engines/contact/contact_lanes.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>

namespace polargrain {

namespace {

/// Blocks that a thread takes at a time, where their order does not matter.
constexpr std::size_t k_blocks_a_run = 512;

/// Of a group; a grain with more contacts in it gets blocks of their own for the rest.
constexpr std::int32_t k_colours = 64;

/// Of a group: nothing of the next sweep has been done.
constexpr char k_not_yet = 2;

constexpr double k_unbounded = std::numeric_limits<double>::infinity();

static_assert(sizeof(SolverBody) == k_body_stride * sizeof(double) && offsetof(SolverBody, velocity) == 0 &&
              offsetof(SolverBody, spin) == 2 * sizeof(double) &&
              offsetof(SolverBody, inverse_mass) == 3 * sizeof(double));

double* numbers(std::vector<SolverBody>& bodies) { return bodies.front().velocity.data(); }
const double* numbers(const std::vector<SolverBody>& bodies) { return bodies.front().velocity.data(); }

}  // namespace

ContactLanes::ContactLanes(const Scene& scene) : parallel_(std::max(1, scene.threads)) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        widest_ = std::max(widest_, 2.0 * outer_radius(scene.shape_of(k)));
    }
}

void ContactLanes::lay_out(const std::vector<GapContact>& contacts, const std::vector<Vec2>& centres,
                           std::vector<SolverBody>& bodies) {
    cut_into_strips(contacts.size(), centres);
    colour(contacts, bodies.size());
    place(contacts);
    fill(contacts, bodies);
}

/// Strips of equal width across the longer side of where the grains are, wide enough that few contacts span two.
void ContactLanes::cut_into_strips(std::size_t contacts, const std::vector<Vec2>& centres) {
    constexpr std::size_t k_contacts_a_strip = 1000;
    constexpr double k_least_width = 3.0;  // diameters of the largest grain
    strips_ = 1;
    strip_.assign(centres.size(), 0);
    if (contacts < 2 * k_contacts_a_strip) return;
    Vec2 low = centres.front();
    Vec2 high = centres.front();
    for (const Vec2& c : centres) {
        low = low.cwiseMin(c);
        high = high.cwiseMax(c);
    }
    const Vec2 extent = high - low;
    const int axis = extent.x() >= extent.y() ? 0 : 1;
    if (extent[axis] <= 0.0) return;  // one grain with thousands of contacts
    const double most = extent[axis] / (k_least_width * widest_);
    strips_ = std::max<std::size_t>(1, std::min(contacts / k_contacts_a_strip, static_cast<std::size_t>(most)));
    const double per_width = static_cast<double>(strips_) / extent[axis];
    for (std::size_t k = 0; k < centres.size(); ++k) {
        const auto strip = static_cast<std::int32_t>((centres[k][axis] - low[axis]) * per_width);
        strip_[k] = std::min(strip, static_cast<std::int32_t>(strips_) - 1);
    }
}

/// Groups are numbered: strips, borders after each strip but the last, and one for what spans more.
std::size_t ContactLanes::choose_group(const GapContact& c) {
    const std::int32_t i = strip_[Grains::at(c.i)];
    const std::int32_t j = is_wall(c.j) ? i : strip_[Grains::at(c.j)];
    if (i == j) return static_cast<std::size_t>(i);
    const auto border = static_cast<std::int32_t>(strips_) + std::min(i, j);
    std::int32_t& of_i = border_[Grains::at(c.i)];
    std::int32_t& of_j = border_[Grains::at(c.j)];
    const auto can_be = [border](std::int32_t of) { return of < 0 || of == border; };
    if (std::abs(i - j) > 1 || !can_be(of_i) || !can_be(of_j)) return 2 * strips_ - 1;
    of_i = of_j = border;
    return static_cast<std::size_t>(border);
}

/// The lowest colour that neither grain has yet in the group.
void ContactLanes::colour(const std::vector<GapContact>& contacts, std::size_t grains) {
    groups_.clear();
    for (std::size_t g = 0; g < strips_; ++g) groups_.push_back({k_within, 0, 0});
    for (std::size_t g = 0; g + 1 < strips_; ++g) groups_.push_back({k_border, 0, 0});
    groups_.push_back({k_far, 0, 0});
    taken_.assign(k_phases * grains, 0);
    size_of_.assign(groups_.size() * (k_colours + 1), 0);
    colour_.clear();
    group_.clear();
    border_.assign(strip_.size(), -1);
    for (const GapContact& c : contacts) {
        const std::size_t group = choose_group(c);
        group_.push_back(static_cast<std::int32_t>(group));
        std::uint64_t* taken = taken_.data() + groups_[group].phase * grains;
        std::uint64_t wall = 0;
        std::uint64_t& of_i = taken[Grains::at(c.i)];
        std::uint64_t& of_j = is_wall(c.j) ? wall : taken[Grains::at(c.j)];
        const int colour = std::countr_one(of_i | of_j);
        if (colour < k_colours) {
            of_i |= std::uint64_t{1} << colour;
            of_j |= std::uint64_t{1} << colour;
        }
        colour_.push_back(colour);
        ++size_of_[group * (k_colours + 1) + static_cast<std::size_t>(colour)];
    }
}

/// Where blocks and contacts stand: group by group, colour by colour.
void ContactLanes::place(const std::vector<GapContact>& contacts) {
    std::int32_t block = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        groups_[g].first = block;
        for (std::int32_t colour = 0; colour <= k_colours; ++colour) {
            std::int32_t& size = size_of_[g * (k_colours + 1) + static_cast<std::size_t>(colour)];
            const std::int32_t blocks = colour < k_colours ? (size + k_lanes - 1) / k_lanes : size;
            size = block * k_lanes;
            block += blocks;
        }
        groups_[g].last = block;
    }
    for (std::vector<std::size_t>& groups : of_phase_) groups.clear();
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        if (groups_[g].first < groups_[g].last) of_phase_[groups_[g].phase].push_back(g);
    }
    place_.resize(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        std::int32_t& next = size_of_[group_of(k) * (k_colours + 1) + static_cast<std::size_t>(colour_[k])];
        place_[k] = static_cast<std::uint32_t>(next);
        next += colour_[k] < k_colours ? 1 : k_lanes;
    }
}

void ContactLanes::fill(const std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies) {
    const auto count = static_cast<std::size_t>(groups_.back().last);
    blocks_.resize(count);
    travels_.resize(count);
    parallel_.runs(count, k_blocks_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            blocks_[b] = {};
            travels_[b] = {};
            std::fill(std::begin(travels_[b].low.of), std::end(travels_[b].low.of), -k_unbounded);
            std::fill(std::begin(travels_[b].high.of), std::end(travels_[b].high.of), k_unbounded);
            std::fill(std::begin(travels_[b].contact), std::end(travels_[b].contact), -1);
        }
    });
    for (std::size_t k = first_with_wall(contacts); k < contacts.size(); ++k) {
        block(k).j[lane(k)] = static_cast<std::int32_t>(bodies.size());
        bodies.emplace_back();
    }
    // Threads may work on blocks at the same time: each has a body of its own for its empty lanes.
    const std::size_t nobody = bodies.size();
    bodies.resize(nobody + count);
    parallel_.runs(contacts.size(), k_lanes * k_blocks_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            block(k).i[lane(k)] = contacts[k].i;
            if (!is_wall(contacts[k].j)) block(k).j[lane(k)] = contacts[k].j;
            travels_[place_[k] / k_lanes].contact[lane(k)] = static_cast<std::int32_t>(k);
            put(contacts[k], k, bodies);
        }
    });
    parallel_.runs(count, k_blocks_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            for (int n = 0; n < k_lanes; ++n) {
                if (travels_[b].contact[n] < 0)
                    blocks_[b].i[n] = blocks_[b].j[n] = static_cast<std::int32_t>(nobody + b);
            }
        }
    });
}

void ContactLanes::put(const GapContact& c, std::size_t contact, const std::vector<SolverBody>& bodies) {
    turn(c, contact, bodies, c.gap - c.resting);
    LaneBlock& b = block(contact);
    b.normal_impulse.of[lane(contact)] = c.normal_impulse;
    b.tangent_impulse.of[lane(contact)] = c.tangent_impulse;
}

void ContactLanes::turn(const GapContact& c, std::size_t contact, const std::vector<SolverBody>& bodies, double open) {
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
    b.open.of[n] = open;
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

bool ContactLanes::sweep(std::vector<SolverBody>& bodies, double h, const SweepEffort& effort) {
    const LaneKernels& kernels = lane_kernels();
    const auto pass = [&](std::size_t g, bool backwards) -> char {
        return kernels.sweep(blocks_.data(), groups_[g].first, groups_[g].last, backwards, numbers(bodies), 1.0 / h,
                             effort.settled);
    };
    changed_.resize(groups_.size());
    ahead_.assign(groups_.size(), k_not_yet);
    for (int s = 0; s < effort.sweeps; ++s) {
        const bool backwards = s % 2 != 0;
        const bool pairs = effort.in_pairs && backwards && s + 1 < effort.sweeps;
        std::fill(changed_.begin(), changed_.end(), char{0});
        each_group(backwards, [&](std::size_t g) {
            const bool done = !backwards && ahead_[g] != k_not_yet;
            changed_[g] = done ? ahead_[g] : pass(g, backwards);
            ahead_[g] = k_not_yet;
            if (pairs && groups_[g].phase == k_within && changed_[g]) ahead_[g] = pass(g, false);
        });
        if (std::all_of(changed_.begin(), changed_.end(), [](char changed) { return changed == 0; })) return true;
    }
    return false;
}

/// Losses are summed in pieces of a fixed size, whatever the number of threads.
LaneLosses ContactLanes::move(const std::vector<SolverBody>& bodies, const LaneMove& move) {
    const LaneKernels& kernels = lane_kernels();
    losses_.resize((blocks_.size() + k_blocks_a_run - 1) / k_blocks_a_run);
    parallel_.runs(blocks_.size(), k_blocks_a_run, [&](std::size_t first, std::size_t last) {
        losses_[first / k_blocks_a_run] =
            kernels.move(blocks_.data(), travels_.data(), static_cast<std::ptrdiff_t>(first),
                         static_cast<std::ptrdiff_t>(last), numbers(bodies), move);
    });
    LaneLosses sum;
    for (const LaneLosses& piece : losses_) {
        sum.normal += piece.normal;
        sum.tangent += piece.tangent;
    }
    return sum;
}

void ContactLanes::mark_pushed(std::vector<char>& pushed) const {
    // Several threads may mark the same grain.
    const auto mark = [&](std::int32_t body) {
        std::atomic_ref(pushed[static_cast<std::size_t>(body)]).store(1, std::memory_order_relaxed);
    };
    parallel_.runs(blocks_.size(), k_blocks_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const LaneBlock& of = blocks_[b];
            for (int lane = 0; lane < k_lanes; ++lane) {
                if (of.normal_impulse.of[lane] == 0.0) continue;
                mark(of.i[lane]);
                mark(of.j[lane]);
            }
        }
    });
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
