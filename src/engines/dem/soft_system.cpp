#include "src/engines/dem/soft_system.h"

#include <algorithm>
#include <cmath>

#include "src/model/contact_law.h"

namespace polargrain {

namespace {

/// Below that many candidates a thread costs more than it brings.
constexpr std::size_t k_pairs_worth_a_thread = 300;

/// Candidates whose contacts stay in a core's cache until their forces are summed.
constexpr std::size_t k_batch = 512;

bool before(const SoftContact& c, BodyIndex a, BodyIndex b) { return c.a != a ? c.a < a : c.b < b; }

}  // namespace

SoftSystem::SoftSystem(const Scene& scene, const DemSettings& settings)
    : scene_(scene),
      laws_(scene, settings),
      walls_(scene),
      candidates_(scene, settings),
      parallel_(std::max(1, scene.threads)) {
    shares_.assign(static_cast<std::size_t>(std::max(1, scene.threads)),
                   Share{TouchFinder(settings), {}, {}, {}, {}, {}, 0, 0});
    adopt(own_numbers(scene.grains.size()));
    any_polygon_ = std::any_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return !body.disk; });
}

void SoftSystem::accelerations(double time, std::span<const double> x, std::span<const double> v, std::span<double> a) {
    time_ = time;
    evaluated_x_ = x;
    walls_.place(time);
    candidates_.update(x, walls_);
    place_polygons(x);
    find_contacts(x, v, a);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        a[3 * k] = a[3 * k] * bodies_[k].inverse_mass + scene_.gravity.x();
        a[3 * k + 1] = a[3 * k + 1] * bodies_[k].inverse_mass + scene_.gravity.y();
        a[3 * k + 2] *= bodies_[k].inverse_inertia;
    }
}

void SoftSystem::find_contacts(std::span<const double> x, std::span<const double> v, std::span<double> forces) {
    recalled_.assign(contacts_.size(), 0);
    next_turnover_ = {};
    std::fill(forces.begin(), forces.end(), 0.0);
    const std::size_t used = std::min(shares_.size(), 1 + candidates_.pairs().size() / k_pairs_worth_a_thread);
    for (std::size_t t = 0; t < used; ++t) shares_[t].clear();
    if (used == 1) {
        find_alone(x, v, forces);
    } else {
        find_together(used, x, v, forces);
    }
    next_.swap(shares_[0].found);
    next_missed_.swap(shares_[0].missed);
    for (std::size_t t = 0; t < used; ++t) next_turnover_.born += shares_[t].born;
    next_ended_.clear();
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
        if (recalled_[k] != 0) continue;
        drop(contacts_[k]);
        next_ended_.push_back(k);
    }
}

// The forces of a batch are summed while it is in the cache still.
void SoftSystem::find_alone(std::span<const double> x, std::span<const double> v, std::span<double> forces) {
    Share& share = shares_[0];
    meet_walls(share, x, v);
    const std::span<const GrainPair> pairs = candidates_.pairs();
    std::size_t summed = 0;
    for (std::size_t first = 0; first < pairs.size() || summed < share.found.size(); first += k_batch) {
        const std::size_t begin = std::min(first, pairs.size());
        meet_grains(share, pairs.subspan(begin, std::min(k_batch, pairs.size() - begin)), x, v);
        sum_forces(std::span(share.found).subspan(summed), x, forces);
        summed = share.found.size();
    }
}

// Each thread takes a run of the sorted pairs, the first the walls besides; one after the other their finds are sorted.
void SoftSystem::find_together(std::size_t used, std::span<const double> x, std::span<const double> v,
                               std::span<double> forces) {
    const std::span<const GrainPair> pairs = candidates_.pairs();
    parallel_.each(used, [&](std::size_t number) {
        const std::size_t first = pairs.size() * number / used;
        const std::size_t last = pairs.size() * (number + 1) / used;
        if (number == 0) meet_walls(shares_[0], x, v);
        meet_grains(shares_[number], pairs.subspan(first, last - first), x, v);
    });
    Share& all = shares_[0];
    for (std::size_t t = 1; t < used; ++t) {
        for (Miss& miss : shares_[t].missed) {
            miss.contact += all.found.size();
            all.missed.push_back(miss);
        }
        all.found.insert(all.found.end(), shares_[t].found.begin(), shares_[t].found.end());
    }
    sum_forces(all.found, x, forces);
}

void SoftSystem::accept(double time, std::span<const double> x) {
    contacts_.swap(next_);
    ended_.swap(next_ended_);
    missed_.swap(next_missed_);
    turnover_ = next_turnover_;
    accepted_time_ = time;
    previous_x_.swap(accepted_x_);
    accepted_x_.assign(x.begin(), x.end());
}

void SoftSystem::add_ended(std::vector<SoftContact>& ended) const {
    for (const std::size_t k : ended_) {
        ended.push_back(next_[k]);
        ended.back().impulse += weight_ * next_[k].force();
    }
}

void SoftSystem::set_accepted(double time, std::span<const double> x) {
    walls_.place(time);
    accepted_time_ = time;
    accepted_x_.assign(x.begin(), x.end());
}

void SoftSystem::place_polygons(std::span<const double> x) {
    if (!any_polygon_) return;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const Vec2 centre(x[3 * k], x[3 * k + 1]);
        if (bodies_[k].disk) {
            poses_[k].centre = centre;
        } else {
            poses_[k] = Pose::at(centre, x[3 * k + 2]);
        }
    }
}

void SoftSystem::meet_walls(Share& share, std::span<const double> x, std::span<const double> v) {
    const std::vector<SoftPiece>& pieces = walls_.pieces();
    const std::vector<WallCandidate>& near = candidates_.at_walls();
    share.touches.clear();
    for (std::size_t k = 0; k < near.size(); ++k) {
        const SoftPiece& piece = pieces[static_cast<std::size_t>(near[k].piece)];
        const GrainIndex grain = near[k].grain;
        if (walls_.present(piece)) touch_piece(share, static_cast<std::size_t>(near[k].piece), grain, x);
        // Pieces of one wall that a grain touches are one pair.
        const bool goes_on = k + 1 < near.size() && near[k + 1].grain == grain &&
                             pieces[static_cast<std::size_t>(near[k + 1].piece)].wall == piece.wall;
        if (goes_on) continue;
        add_contacts(share, wall_body(piece.wall), grain, x, v);
        share.touches.clear();
    }
}

void SoftSystem::touch_piece(Share& share, std::size_t piece, GrainIndex grain, std::span<const double> x) const {
    const std::vector<SoftPiece>& pieces = walls_.pieces();
    const Body& body = bodies_[Grains::at(grain)];
    if (!body.disk) {
        const auto& polygon = std::get<PolarPolygon>(*body.shape);
        const double stiffness = law_of(wall_body(pieces[piece].wall), grain).linear_stiffness;
        share.geometry.find(pieces[piece], polygon, poses_[Grains::at(grain)], stiffness, share.touches);
        return;
    }
    const ChainTouch touch = touch_chain(pieces, piece, place(x, grain));
    const Vec2 way = place(x, grain) - touch.nearest;
    const double squared = way.squaredNorm();
    if (!touch.touches || squared >= body.radius * body.radius || !(squared > 0.0)) return;
    const double distance = std::sqrt(squared);
    share.touches.push_back({touch.nearest, way / distance, body.radius - distance, 0.0, true, 0.0, 0.0});
}

void SoftSystem::meet_grains(Share& share, std::span<const GrainPair> pairs, std::span<const double> x,
                             std::span<const double> v) {
    share.touches.clear();
    for (const auto& [a, b] : pairs) {
        const std::size_t i = Grains::at(a);
        const std::size_t j = Grains::at(b);
        const double dx = x[3 * j] - x[3 * i];
        const double dy = x[3 * j + 1] - x[3 * i + 1];
        const double reach = bodies_[i].radius + bodies_[j].radius;
        const double squared = dx * dx + dy * dy;
        if (squared >= reach * reach || !(squared > 0.0)) continue;
        if (bodies_[i].disk && bodies_[j].disk) {
            const double distance = std::sqrt(squared);
            const Vec2 normal(dx / distance, dy / distance);
            const double depth = reach - distance;
            const Vec2 point = place(x, a) + (bodies_[i].radius - 0.5 * depth) * normal;
            share.touches.push_back({point, normal, depth, 0.0, true, 0.0, 0.0});
        } else {
            share.geometry.find(*bodies_[i].shape, poses_[i], *bodies_[j].shape, poses_[j],
                                law_of(a, b).linear_stiffness, share.touches);
        }
        add_contacts(share, a, b, x, v);
        share.touches.clear();
    }
}

const PairSoftLaw& SoftSystem::law_of(BodyIndex a, BodyIndex b) const {
    const MaterialIndex of_a =
        is_wall(a) ? scene_.walls[static_cast<std::size_t>(wall_index(a))].material : bodies_[Grains::at(a)].material;
    return laws_.of(of_a, bodies_[Grains::at(b)].material);
}

double SoftSystem::restitution_at_birth(BodyIndex a, BodyIndex b) const {
    const GrainIndex of_b = numbers_[Grains::at(b)];
    if (is_wall(a)) return drawn_restitution(scene_, step_, a, of_b);
    const GrainIndex of_a = numbers_[Grains::at(a)];
    return drawn_restitution(scene_, step_, std::min(of_a, of_b), std::max(of_a, of_b));
}

/// 1 / (what a unit impulse along the normal changes the closing speed by).
double SoftSystem::effective_mass(const SoftContact& contact, const Vec2& arm_a, const Vec2& arm_b) const {
    const auto share = [&](BodyIndex body, const Vec2& arm) {
        const Body& grain = bodies_[Grains::at(body)];
        const double lever = grain.disk ? 0.0 : cross(arm, contact.normal);
        return grain.inverse_mass + lever * lever * grain.inverse_inertia;
    };
    return 1.0 / (share(contact.b, arm_b) + (is_wall(contact.a) ? 0.0 : share(contact.a, arm_a)));
}

void SoftSystem::add_contacts(Share& share, BodyIndex a, BodyIndex b, std::span<const double> x,
                              std::span<const double> v) {
    if (share.touches.empty()) return;
    recall(share, a, b);
    for (std::size_t k = 0; k < share.touches.size(); ++k) {
        add_contact(share, a, b, share.touches[k], share.memory[k], x, v);
    }
}

void SoftSystem::add_contact(Share& share, BodyIndex a, BodyIndex b, const Touch& touch, const SoftContact* old,
                             std::span<const double> x, std::span<const double> v) {
    SoftContact& contact = share.found.emplace_back();
    contact.a = a;
    contact.b = b;
    contact.point = touch.point;
    contact.normal = touch.normal;
    contact.depth = touch.depth;
    const Vec2 arm_b = touch.point - place(x, b);
    const Vec2 tangent = left_normal(touch.normal);
    Vec2 relative = velocity_at(v, b, arm_b);
    double spin = spin_of(v, b);
    const Shift shift_b = shift_of(b, accepted_x_, x);
    Vec2 way = shift_b.way + cross(shift_b.turn, arm_b);
    Shift shift_a;
    Vec2 arm_a = Vec2::Zero();
    if (is_wall(a)) {
        const Motion& wall = walls_.motion(a);
        const Vec2 wall_velocity = wall.velocity + cross(wall.spin, touch.point);
        relative -= wall_velocity;
        spin -= wall.spin;
        const Motion& going = walls_.going(a);
        way -= (time_ - accepted_time_) * (going.velocity + cross(going.spin, touch.point));
    } else {
        arm_a = touch.point - place(x, a);
        relative -= velocity_at(v, a, arm_a);
        spin -= spin_of(v, a);
        shift_a = shift_of(a, accepted_x_, x);
        way -= shift_a.way + cross(shift_a.turn, arm_a);
    }
    const PairSoftLaw& law = law_of(a, b);
    // Springs by depth ask for it once only.
    const double mass = old == nullptr || !touch.by_depth ? effective_mass(contact, arm_a, arm_b) : 0.0;
    double sliding_way = way.dot(tangent);
    if (old != nullptr) {
        contact.take_memory(*old, weight_);
    } else {
        // The sliding before it was born is not the spring's business.
        sliding_way = 0.0;
        contact.damping = damping_of(law, restitution_at_birth(a, b), mass, touch.by_depth, share.ratio);
        ++share.born;
    }
    respond(law, touch, mass, {-relative.dot(touch.normal), relative.dot(tangent), spin}, sliding_way, contact);
    const double old_way = old != nullptr ? way_of(*old, shift_a, shift_b, accepted_x_, time_ - accepted_time_) : 0.0;
    find_miss(share, old, way.dot(touch.normal), old_way);
}

/// Which old contact of a pair goes on in which of its touches: those that are nearest to one another first, so that a
/// grain which rolls up against a second face of a wall leaves the memory of the first where it is.
void SoftSystem::recall(Share& share, BodyIndex a, BodyIndex b) {
    std::size_t& first = share.cursor;
    while (first < contacts_.size() && before(contacts_[first], a, b)) ++first;
    std::size_t end = first;
    while (end < contacts_.size() && contacts_[end].a == a && contacts_[end].b == b) ++end;
    share.memory.resize(share.touches.size());
    if (end - first == 1 && share.touches.size() == 1) {
        recalled_[first] = 1;
        share.memory[0] = &contacts_[first];
        return;
    }
    share.memory.assign(share.touches.size(), nullptr);
    for (std::size_t left = std::min(end - first, share.touches.size()); left > 0; --left) {
        std::size_t old = end;
        std::size_t now = 0;
        double least = 0.0;
        for (std::size_t k = first; k < end; ++k) {
            for (std::size_t t = 0; t < share.touches.size() && recalled_[k] == 0; ++t) {
                if (share.memory[t] != nullptr) continue;
                const double distance = (contacts_[k].point - share.touches[t].point).squaredNorm();
                if (old != end && distance >= least) continue;
                old = k;
                now = t;
                least = distance;
            }
        }
        recalled_[old] = 1;
        share.memory[now] = &contacts_[old];
    }
}

void SoftSystem::drop(const SoftContact& contact) {
    if (is_wall(contact.a) && !scene_.walls[static_cast<std::size_t>(wall_index(contact.a))].present(time_)) {
        next_turnover_.dropped += contact.stored_normal;
    }
}

void SoftSystem::sum_forces(std::span<const SoftContact> contacts, std::span<const double> x,
                            std::span<double> forces) {
    Turnover found = next_turnover_;
    for (const SoftContact& c : contacts) {
        found.hysteresis += c.hysteresis;
        found.deepest = std::max(found.deepest, c.depth);
        found.stored.add(c);
        const Vec2 force = c.force();
        const std::size_t j = 3 * Grains::at(c.b);
        forces[j] += force.x();
        forces[j + 1] += force.y();
        forces[j + 2] += cross(c.point - place(x, c.b), force) + c.moment;
        if (is_wall(c.a)) continue;
        const std::size_t i = 3 * Grains::at(c.a);
        forces[i] -= force.x();
        forces[i + 1] -= force.y();
        forces[i + 2] -= cross(c.point - place(x, c.a), force) + c.moment;
    }
    next_turnover_ = found;
}

}  // namespace polargrain
