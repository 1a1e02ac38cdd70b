#include "src/engines/contact/trial_check.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

bool circles_meet(const Vec2& a, const Vec2& b, double reach) { return (a - b).squaredNorm() < reach * reach; }

Motion motion_of(const Grains& grains, GrainIndex k) { return {grains.velocity(k), grains.spin[Grains::at(k)]}; }

/// The contact of grains a < b at the given poses, as it is recorded.
std::optional<RecordedContact> contact_between(const Scene& scene, const Grains& grains, GrainIndex a,
                                               const Pose& pose_a, GrainIndex b, const Pose& pose_b) {
    const auto contact = find_contact(PlacedShape{scene.shape_of(b), pose_b, motion_of(grains, b)},
                                      PlacedShape{scene.shape_of(a), pose_a, motion_of(grains, a)});
    if (!contact) return std::nullopt;
    return RecordedContact{a, b, contact->point, contact->normal, pose_a.centre, pose_b.centre, contact->depth};
}

/// Is the line of a piece within a circle's reach? Quicker to tell than whether a grain overlaps the piece.
bool reaches_line(const Vec2& centre, double radius, const WallPiece& piece) {
    const Vec2 along = piece.b - piece.a;
    const double height = cross(along, centre - piece.a);  // times the length
    return height * height < radius * radius * along.squaredNorm();
}

/// A point on the side of the piece that the grain belongs to. Nothing overlaps a wall at rest, so there it is where
/// the grain's centre is; a moving wall may have run over the grain, and acts on its free side, the left, only.
Vec2 home_side(const WallPiece& piece, bool moves, const Vec2& centre) {
    if (!moves) return centre;
    const double length = std::sqrt((piece.b - piece.a).squaredNorm());
    const Vec2 along = (piece.b - piece.a) / length;
    return piece.a + left_normal(along) * length;
}

bool by_bodies(const RecordedContact& p, const RecordedContact& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); }

}  // namespace

void take_trial(Grains& grains, const Vec2& gravity, double dt, TrialConfiguration& c) {
    const std::size_t n = grains.x.size();
    c.current.resize(n);
    c.trial.resize(n);
    c.trial_angle.resize(n);
    const Vec2 fall = 0.5 * dt * dt * gravity;
    const Vec2 kick = dt * gravity;
    for (std::size_t k = 0; k < n; ++k) {
        const auto g = static_cast<GrainIndex>(k);
        const Vec2 x = grains.position(g);
        const Vec2 v = grains.velocity(g);
        c.current[k] = Pose::at(x, grains.angle[k]);
        c.trial_angle[k] = grains.angle[k] + dt * grains.spin[k];
        c.trial[k] = Pose::at(x + dt * v + fall, c.trial_angle[k]);
        grains.set_velocity(g, v + kick);
    }
}

TrialCheck::TrialCheck(const Scene& scene) : scene_(scene), pairs_(scene) {}

void TrialCheck::run(const TrialConfiguration& configuration, const Grains& grains, double time, double trial_time,
                     std::vector<RecordedContact>& contacts) {
    overlaps_.conflicts.clear();
    overlaps_.order.clear();
    overlaps_.blocked.assign(grains.x.size(), 0);
    contacts.clear();
    check_walls(configuration, grains, time, trial_time, contacts);
    check_pairs(configuration, grains, contacts);
}

void TrialCheck::check_walls(const TrialConfiguration& configuration, const Grains& grains, double time,
                             double trial_time, std::vector<RecordedContact>& contacts) {
    place_pieces(scene_.walls, trial_time, pieces_);
    walls_.place(pieces_);
    wall_motions_.clear();
    for (const Wall& wall : scene_.walls) wall_motions_.push_back(wall_motion(wall_state(wall, trial_time)));
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const Pose& pose = configuration.trial[Grains::at(k)];
        const Vec2& centre = configuration.current[Grains::at(k)].centre;
        const double radius = pairs_.radius(k);
        walls_.find(pose.centre, radius, near_);
        for (const std::int32_t number : near_) {
            const PlacedPiece& piece = pieces_[static_cast<std::size_t>(number)];
            const Shape& shape = scene_.shape_of(k);
            if (!reaches_line(pose.centre, radius, piece.piece) || !overlap(shape, pose, piece.piece)) continue;
            const Motion& wall = wall_motions_[static_cast<std::size_t>(piece.wall)];
            const Wall& owner = scene_.walls[static_cast<std::size_t>(piece.wall)];
            const PlacedShape placed{shape, pose, motion_of(grains, k)};
            const auto contact = find_contact(placed, piece.piece, wall, home_side(piece.piece, owner.moves(), centre));
            if (!contact) continue;
            contacts.push_back(
                {wall_body(piece.wall), k, contact->point, contact->normal, Vec2::Zero(), pose.centre, contact->depth});
            if (owner.moves() && recedes(placed, *contact, owner, time, trial_time - time)) continue;
            overlaps_.blocked[Grains::at(k)] = 1;
        }
    }
}

/// The moving-floor rule: a trial pose may overlap a moving wall as long as the grain recedes from it [HN94, sec.
/// 3.7.2]. Judged as the contact stage has left the two, before gravity's part of the step: a grain that rides on a
/// rising floor would otherwise stay behind for ever.
bool TrialCheck::recedes(const PlacedShape& grain, const ContactGeometry& contact, const Wall& wall, double time,
                         double dt) const {
    constexpr double k_round_off = 1e-6;  // of what gravity gives in a step
    const Vec2 kick = dt * scene_.gravity;
    const Vec2 of_wall = wall_state(wall, time).velocity_at(contact.point);
    const Vec2 relative = grain.velocity_at(contact.point) - kick - of_wall;
    return relative.dot(contact.normal) >= -k_round_off * std::sqrt(kick.squaredNorm());
}

void TrialCheck::check_pairs(const TrialConfiguration& configuration, const Grains& grains,
                             std::vector<RecordedContact>& contacts) {
    pairs_.update(configuration.current, configuration.trial);
    for (const auto& [a, b] : pairs_.pairs()) {
        const std::size_t i = Grains::at(a);
        const std::size_t j = Grains::at(b);
        const double reach = pairs_.radius(a) + pairs_.radius(b);
        const Shape& shape_a = scene_.shape_of(a);
        const Shape& shape_b = scene_.shape_of(b);
        if (circles_meet(configuration.trial[i].centre, configuration.trial[j].centre, reach) &&
            overlap(shape_a, configuration.trial[i], shape_b, configuration.trial[j])) {
            overlaps_.conflicts.emplace_back(a, b);
            const auto contact = contact_between(scene_, grains, a, configuration.trial[i], b, configuration.trial[j]);
            if (contact) contacts.push_back(*contact);
        }
        if (circles_meet(configuration.current[i].centre, configuration.trial[j].centre, reach) &&
            overlap(shape_a, configuration.current[i], shape_b, configuration.trial[j])) {
            overlaps_.order.emplace_back(a, b);
        }
        if (circles_meet(configuration.trial[i].centre, configuration.current[j].centre, reach) &&
            overlap(shape_a, configuration.trial[i], shape_b, configuration.current[j])) {
            overlaps_.order.emplace_back(b, a);
        }
    }
}

void TrialCheck::record(const TrialConfiguration& configuration, const Grains& grains,
                        const std::vector<char>& rejected, std::vector<RecordedContact>& contacts) const {
    std::stable_sort(contacts.begin(), contacts.end(), by_bodies);
    const std::size_t sorted = contacts.size();
    // A grain rejected for the sake of one that stays has run into that one's current pose.
    for (const auto& [stays, dependant] : overlaps_.order) {
        if (!rejected[Grains::at(stays)] || !rejected[Grains::at(dependant)]) continue;
        const RecordedContact key{std::min(stays, dependant), std::max(stays, dependant)};
        const auto end = contacts.begin() + static_cast<std::ptrdiff_t>(sorted);
        if (std::binary_search(contacts.begin(), end, key, by_bodies)) continue;
        const bool first_stays = stays < dependant;
        const auto contact = contact_between(
            scene_, grains, key.a, (first_stays ? configuration.current : configuration.trial)[Grains::at(key.a)],
            key.b, (first_stays ? configuration.trial : configuration.current)[Grains::at(key.b)]);
        if (contact) contacts.push_back(*contact);
    }
    std::stable_sort(contacts.begin(), contacts.end(), by_bodies);
}

}  // namespace polargrain
