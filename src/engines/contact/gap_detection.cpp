#include "src/engines/contact/gap_detection.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

bool before_pair(const PairContacts& p, const PairContacts& q) {
    const bool wall_p = is_wall(p.j);
    const bool wall_q = is_wall(q.j);
    if (wall_p != wall_q) return !wall_p;
    if (wall_p) return p.i < q.i || (p.i == q.i && p.piece < q.piece);
    return p.j < q.j || (p.j == q.j && p.i < q.i);
}

}  // namespace

GapDetection::GapDetection(const Scene& scene)
    : scene_(scene), parallel_(std::max(1, scene.threads)), list_(scene), walls_(scene) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        diameter_.push_back(outer_radius(scene.shape_of(k)) + inner_radius(scene.shape_of(k)));
    }
    look_ahead_.assign(diameter_.size(), 0.0);
}

double GapDetection::resting_gap(BodyIndex i, BodyIndex j) const {
    const double d = diameter_[Grains::at(i)];
    return k_resting * (is_wall(j) ? d : std::min(d, diameter_[Grains::at(j)]));
}

double GapDetection::margin(BodyIndex i, BodyIndex j) const {
    const double ahead =
        is_wall(j) ? look_ahead_[Grains::at(i)] : std::max(look_ahead_[Grains::at(i)], look_ahead_[Grains::at(j)]);
    return resting_gap(i, j) + gravity_way_ + ahead;
}

/// How far ahead to look: per grain, dt times the largest speed at which a grain that it may meet in a step, or a wall,
/// comes nearer. Whether two grains may meet is judged by their motion alone, so that what else is listed does not
/// matter.
void GapDetection::find_agitation(const PoseSet& now, const std::vector<SolverBody>& bodies, double dt) {
    const auto surface_speed = [&](GrainIndex k) { return std::abs(bodies[Grains::at(k)].spin) * list_.radius(k); };
    const std::span<const GrainPair> pairs = list_.pairs();
    pair_way_.resize(pairs.size());
    parallel_.runs(pairs.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            const auto [a, b] = pairs[n];
            const Vec2 relative = bodies[Grains::at(a)].velocity - bodies[Grains::at(b)].velocity;
            const double way = dt * (std::sqrt(relative.squaredNorm()) + surface_speed(a) + surface_speed(b));
            const double reach = list_.radius(a) + list_.radius(b) + way + gravity_way_ + resting_gap(b, a);
            const double distance2 = (now.centre[Grains::at(a)] - now.centre[Grains::at(b)]).squaredNorm();
            pair_way_[n] = distance2 < reach * reach ? way : 0.0;
        }
    });
    std::fill(look_ahead_.begin(), look_ahead_.end(), 0.0);
    for (std::size_t n = 0; n < pairs.size(); ++n) {
        const auto [a, b] = pairs[n];
        look_ahead_[Grains::at(a)] = std::max(look_ahead_[Grains::at(a)], pair_way_[n]);
        look_ahead_[Grains::at(b)] = std::max(look_ahead_[Grains::at(b)], pair_way_[n]);
    }
    const auto look_at_walls = [&](GrainIndex k) {
        const double own = dt * (std::sqrt(bodies[Grains::at(k)].velocity.squaredNorm()) + surface_speed(k));
        const double rest = list_.radius(k) + gravity_way_ + k_resting * diameter_[Grains::at(k)];
        const double most_ahead = own + dt * walls_.top_speed();
        if (most_ahead <= look_ahead_[Grains::at(k)]) return;
        walls_.search().any_near(now.centre[Grains::at(k)], rest + most_ahead, [&](std::int32_t number) {
            const double ahead = own + dt * walls_.speed(number);
            if (ahead <= look_ahead_[Grains::at(k)]) return false;
            const WallPiece& piece = walls_.geometry(number).now;
            const Vec2 along = piece.b - piece.a;
            const Vec2 from = now.centre[Grains::at(k)] - piece.a;
            const double length2 = along.squaredNorm();
            const double reach = list_.radius(k) + ahead + gravity_way_ + k_resting * diameter_[Grains::at(k)];
            const double s = std::clamp(from.dot(along) / length2, 0.0, 1.0);
            if ((from - s * along).squaredNorm() < reach * reach) look_ahead_[Grains::at(k)] = ahead;
            return false;
        });
    };
    each_grain([&](std::size_t k) { look_at_walls(static_cast<GrainIndex>(k)); });
}

void GapDetection::Found::clear() {
    pairs.clear();
    points.clear();
}

void GapDetection::Found::swap(Found& other) {
    pairs.swap(other.pairs);
    points.swap(other.points);
}

void GapDetection::Found::resize(std::size_t point_count, std::size_t pair_count) {
    points.resize(point_count);
    pairs.resize(pair_count);
}

void GapDetection::Found::put(const Found& more, std::size_t first_point, std::size_t first_pair) {
    std::copy(more.points.begin(), more.points.end(), points.begin() + static_cast<std::ptrdiff_t>(first_point));
    for (const PairContacts& pair : more.pairs) {
        pairs[first_pair] = pair;
        pairs[first_pair++].first += static_cast<std::int32_t>(first_point);
    }
}

void GapDetection::store(Share& share, const PairContacts& pair, std::span<const GapPoint> points) {
    if (points.empty() && !pair.overlapping) return;
    Found& found = share.found;
    found.pairs.push_back(pair);
    found.pairs.back().first = static_cast<std::int32_t>(found.points.size());
    found.pairs.back().count = static_cast<std::int32_t>(points.size());
    found.points.insert(found.points.end(), points.begin(), points.end());
}

/// Two grains that did not overlap can do so only after a vertex of one has come to the outline of the other. Where
/// each is farther from it now than the two have moved past one another since, none has. (Their common way does not
/// matter.)
bool GapDetection::still_apart(double clearance, const PoseSet& before, const PoseSet& now, GrainIndex a,
                               GrainIndex b) const {
    constexpr double k_sure = 1e-3;  // of the resting gap: far more than round-off, and than what counts as touching
    if (!clean_) return false;
    const std::size_t i = Grains::at(a);
    const std::size_t j = Grains::at(b);
    const double spare = clearance - turn_way_[i] - turn_way_[j] - k_sure * resting_gap(b, a);
    if (spare <= 0.0) return false;
    const Vec2 way = (now.centre[i] - before.centre[i]) - (now.centre[j] - before.centre[j]);
    return way.squaredNorm() < spare * spare;
}

void GapDetection::find_turn(const PoseSet& before, const PoseSet& now, std::size_t k) {
    const Pose& p = before.pose[k];
    const Pose& q = now.pose[k];
    const Vec2 chord(q.cosine - p.cosine, q.sine - p.sine);
    turn_way_[k] = list_.radius(static_cast<GrainIndex>(k)) * std::sqrt(chord.squaredNorm());
}

void GapDetection::detect_pair(Share& share, const PoseSet& before, const PoseSet& now, GrainIndex a,
                               GrainIndex b) const {
    const Pose& pose_a = now.pose[Grains::at(a)];
    const Pose& pose_b = now.pose[Grains::at(b)];
    const GapRules rules{margin(b, a), resting_gap(b, a)};
    const double reach = list_.radius(a) + list_.radius(b) + rules.margin;
    if ((pose_a.centre - pose_b.centre).squaredNorm() >= reach * reach) return;
    share.scratch.clear();
    const Shape& shape_a = scene_.shape_of(a);
    const Shape& shape_b = scene_.shape_of(b);
    const Separation separation = find_gap_points(shape_b, pose_b, shape_a, pose_a, rules, share.scratch);
    const bool overlapping = !separation.apart && !still_apart(separation.clearance, before, now, a, b) &&
                             overlap(shape_a, pose_a, shape_b, pose_b);
    store(share, {b, a, -1, 0, 0, overlapping}, share.scratch);
}

/// The pieces that a grain has to do with: the same for a grain that has not moved and looks as far ahead as before.
void GapDetection::find_near_walls(Share& share, const PoseSet& now, GrainIndex k) const {
    constexpr BodyIndex k_any_wall = -1;
    constexpr double k_corner = 1.415;  // what detect_wall looks at is a rectangle, whose corners are farther away
    const double reach = list_.radius(k) + margin(k, k_any_wall);
    walls_.search().find(now.pose[Grains::at(k)].centre, k_corner * reach, share.near);
}

void GapDetection::detect_wall(Share& share, const PoseSet& before, const PoseSet& now, GrainIndex k,
                               std::int32_t number) const {
    const GapPiece& piece = walls_.geometry(number);
    const Pose& pose = now.pose[Grains::at(k)];
    const BodyIndex wall = wall_body(walls_.wall(number));
    const GapRules rules{margin(k, wall), resting_gap(k, wall)};
    const WallPiece& at = piece.now;
    const Vec2 along = at.b - at.a;
    const Vec2 from = pose.centre - at.a;
    const double reach = list_.radius(k) + rules.margin;
    const double length = std::sqrt(along.squaredNorm());
    if (std::abs(cross(along, from)) >= reach * length) return;
    const double station = from.dot(along) / length;
    if (station <= -reach || station >= length + reach) return;
    share.scratch.clear();
    find_gap_points(scene_.shape_of(k), pose, before.pose[Grains::at(k)], piece, rules, share.scratch);
    store(share, {k, wall, number, 0, 0, overlap(scene_.shape_of(k), pose, at)}, share.scratch);
}

void GapDetection::detect(const PoseSet& before, const PoseSet& now, const std::vector<SolverBody>& bodies,
                          double time_before, double time_now, double dt) {
    gravity_way_ = 2.0 * std::sqrt(scene_.gravity.squaredNorm()) * dt * dt;
    walls_.place(time_before, time_now);
    // First every pair that its own motion may bring together, then every pair that a neighbour's may.
    clearance_.resize(look_ahead_.size());
    each_grain([&](std::size_t k) {
        const double own = std::sqrt(bodies[k].velocity.squaredNorm()) +
                           std::abs(bodies[k].spin) * list_.radius(static_cast<GrainIndex>(k));
        clearance_[k] = dt * own + gravity_way_ + k_resting * diameter_[k];
    });
    list_.update(before.pose, now.pose, clearance_);
    find_agitation(now, bodies, dt);
    each_grain([&](std::size_t k) {
        clearance_[k] = std::max(clearance_[k], look_ahead_[k] + gravity_way_ + k_resting * diameter_[k]);
    });
    list_.update(before.pose, now.pose, clearance_);

    find_moved(before, now);
    detect_all(before, now);
}

/// Who has moved, or looks elsewhere, since the last detection; and how far each has turned.
void GapDetection::find_moved(const PoseSet& before, const PoseSet& now) {
    const auto same = [](const Pose& p, const Pose& q) {
        return p.centre == q.centre && p.cosine == q.cosine && p.sine == q.sine;
    };
    const std::size_t n = now.pose.size();
    const bool elsewhere = seen_.size() != n || seen_gravity_way_ != gravity_way_;
    moved_.assign(n, 1);
    turn_way_.resize(n);
    seen_ahead_.resize(n);
    each_grain([&](std::size_t k) {
        if (!elsewhere) {
            moved_[k] =
                !same(now.pose[k], seen_[k]) || !same(before.pose[k], seen_[k]) || look_ahead_[k] != seen_ahead_[k];
        }
        seen_ahead_[k] = look_ahead_[k];
        find_turn(before, now, k);
    });
    seen_gravity_way_ = gravity_way_;
}

void GapDetection::detect_moved(const PoseSet& before, const PoseSet& now, const std::vector<char>& moved) {
    if (found_.points.size() > 2 * in_order_) put_in_order();
    const std::vector<GrainPair>& pairs = list_.pairs();
    const std::size_t grains = now.pose.size();
    for (std::size_t k = 0; k < grains; ++k) {
        if (!moved[k]) continue;
        seen_[k] = now.pose[k];
        find_turn(before, now, k);
    }
    const std::size_t pair_runs = (pairs.size() + k_run - 1) / k_run;
    const std::size_t grain_runs = (grains + k_run - 1) / k_run;
    shares_.resize(std::max(shares_.size(), pair_runs + grain_runs));
    parallel_.each(pair_runs + grain_runs, [&](std::size_t s) {
        Share& share = shares_[s];
        share.found.clear();
        const bool of_pairs = s < pair_runs;
        const std::size_t first = k_run * (of_pairs ? s : s - pair_runs);
        const std::size_t last = std::min(first + k_run, of_pairs ? pairs.size() : grains);
        for (std::size_t n = first; n < last; ++n) {
            if (of_pairs) {
                const auto [a, b] = pairs[n];
                if (moved[Grains::at(a)] || moved[Grains::at(b)]) detect_pair(share, before, now, a, b);
            } else if (moved[n]) {
                const auto k = static_cast<GrainIndex>(n);
                find_near_walls(share, now, k);
                for (const std::int32_t piece : share.near) detect_wall(share, before, now, k, piece);
            }
        }
    });
    gather(pair_runs + grain_runs, patch_);
    splice(moved);
}

/// What so many shares have found, one after the other. A single one is taken as it is.
void GapDetection::gather(std::size_t shares, Found& all) {
    if (shares == 1) {
        all.swap(shares_.front().found);
        return;
    }
    std::size_t points = 0;
    std::size_t pairs = 0;
    for (std::size_t s = 0; s < shares; ++s) {
        shares_[s].first_point = points;
        shares_[s].first_pair = pairs;
        points += shares_[s].found.points.size();
        pairs += shares_[s].found.pairs.size();
    }
    all.resize(points, pairs);
    parallel_.each(shares,
                   [&](std::size_t s) { all.put(shares_[s].found, shares_[s].first_point, shares_[s].first_pair); });
}

/// Puts the pairs of the patch in place of those of moved grains; pairs that stay keep their points where they are.
void GapDetection::splice(const std::vector<char>& moved) {
    merged_pairs_.clear();
    auto next = patch_.pairs.begin();
    const auto take = [&](const PairContacts* old) {
        replace(*next, old);
        merged_pairs_.push_back(*next++);
    };
    for (const PairContacts& pair : found_.pairs) {
        while (next != patch_.pairs.end() && before_pair(*next, pair)) take(nullptr);
        if (!moved[Grains::at(pair.i)] && (is_wall(pair.j) || !moved[Grains::at(pair.j)])) {
            merged_pairs_.push_back(pair);
        } else if (next != patch_.pairs.end() && !before_pair(pair, *next)) {
            take(&pair);
        }
    }
    while (next != patch_.pairs.end()) take(nullptr);
    found_.pairs.swap(merged_pairs_);
    spliced_ = true;
}

/// Finds a place for the points of a pair of the patch: that of its old ones, or behind all others.
void GapDetection::replace(PairContacts& pair, const PairContacts* old) {
    const auto from = patch_.of(pair);
    if (old != nullptr && pair.count <= old->count) {
        pair.first = old->first;
        std::copy(from.begin(), from.end(), found_.points.begin() + pair.first);
        return;
    }
    pair.first = static_cast<std::int32_t>(found_.points.size());
    found_.points.insert(found_.points.end(), from.begin(), from.end());
}

/// Points in the order of their pairs again, without those that have been replaced.
void GapDetection::put_in_order() {
    if (!spliced_) return;
    spliced_ = false;
    ordered_.pairs = found_.pairs;
    std::int32_t end = 0;
    for (PairContacts& pair : ordered_.pairs) {
        pair.first = end;
        end += pair.count;
    }
    ordered_.points.resize(static_cast<std::size_t>(end));
    parallel_.runs(ordered_.pairs.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const auto points = found_.of(found_.pairs[k]);
            std::copy(points.begin(), points.end(), ordered_.points.begin() + ordered_.pairs[k].first);
        }
    });
    found_.swap(ordered_);
    in_order_ = found_.points.size();
}

/// Threads take runs of the pairs, and of the grains with their walls; one after the other their finds are in order.
void GapDetection::detect_all(const PoseSet& before, const PoseSet& now) {
    constexpr std::size_t k_pairs_a_run = 300;
    constexpr std::size_t k_runs_a_thread = 16;  // so that one that takes longer holds up the others less
    const std::span<const GrainPair> pairs = list_.pairs();
    const auto threads = static_cast<std::size_t>(parallel_.threads());
    const std::size_t runs =
        threads == 1 ? 1 : std::clamp<std::size_t>(pairs.size() / k_pairs_a_run, 1, k_runs_a_thread * threads);
    const std::size_t grains = now.pose.size();
    put_in_order();
    last_.swap(found_);
    shares_.resize(std::max(shares_.size(), 2 * runs));
    const auto find_pairs = [&](Share& share, std::size_t part) {
        const std::size_t first = pairs.size() * part / runs;
        detect_pairs(share, pairs.subspan(first, pairs.size() * (part + 1) / runs - first), before, now);
    };
    const auto find_walls = [&](Share& share, std::size_t part) {
        detect_walls(share, static_cast<GrainIndex>(grains * part / runs),
                     static_cast<GrainIndex>(grains * (part + 1) / runs), before, now);
    };
    if (runs == 1) {
        shares_[0].found.clear();
        find_pairs(shares_[0], 0);
        find_walls(shares_[0], 0);
        gather(1, found_);
    } else {
        parallel_.each(2 * runs, [&](std::size_t n) {
            Share& share = shares_[n];
            share.found.clear();
            n < runs ? find_pairs(share, n) : find_walls(share, n - runs);
        });
        gather(2 * runs, found_);
    }
    in_order_ = found_.points.size();
    seen_ = now.pose;
    seen_pieces_ = walls_.size();
}

void GapDetection::detect_pairs(Share& share, std::span<const GrainPair> pairs, const PoseSet& before,
                                const PoseSet& now) const {
    share.cursor = 0;
    for (const auto& [a, b] : pairs) {
        if (moved_[Grains::at(a)] || moved_[Grains::at(b)]) {
            detect_pair(share, before, now, a, b);
        } else {
            keep(share, {b, a});
        }
    }
}

void GapDetection::detect_walls(Share& share, GrainIndex first, GrainIndex last, const PoseSet& before,
                                const PoseSet& now) const {
    const bool pieces_changed = walls_.size() != seen_pieces_;  // they keep their numbers otherwise
    share.cursor = 0;
    for (GrainIndex k = first; k < last; ++k) {
        find_near_walls(share, now, k);
        for (const std::int32_t piece : share.near) {
            if (moved_[Grains::at(k)] || pieces_changed || walls_.geometry(piece).one_sided) {
                detect_wall(share, before, now, k, piece);
            } else {
                keep(share, {k, wall_body(walls_.wall(piece)), piece});
            }
        }
    }
}

/// What the last detection has found of a pair; pairs are asked for in order.
void GapDetection::keep(Share& share, const PairContacts& key) const {
    const std::vector<PairContacts>& pairs = last_.pairs;
    if (share.cursor == 0) {
        share.cursor =
            static_cast<std::size_t>(std::lower_bound(pairs.begin(), pairs.end(), key, before_pair) - pairs.begin());
    }
    while (share.cursor < pairs.size() && before_pair(pairs[share.cursor], key)) ++share.cursor;
    if (share.cursor == pairs.size() || before_pair(key, pairs[share.cursor])) return;
    store(share, pairs[share.cursor], last_.of(pairs[share.cursor]));
}

int GapDetection::overlapping() const {
    return static_cast<int>(
        std::count_if(found_.pairs.begin(), found_.pairs.end(), [](const PairContacts& p) { return p.overlapping; }));
}

void GapDetection::hand_over(std::vector<PairContacts>& pairs, std::vector<GapContact>& contacts) {
    put_in_order();
    made_.resize(found_.points.size());
    parallel_.runs(found_.pairs.size(), k_run, [&](std::size_t first, std::size_t last) {
        auto old = std::lower_bound(pairs.begin(), pairs.end(), found_.pairs[first], before_pair);
        for (std::size_t k = first; k < last; ++k) {
            const PairContacts& pair = found_.pairs[k];
            const std::span<GapContact> made{made_.data() + pair.first, static_cast<std::size_t>(pair.count)};
            make_contacts(pair, found_.of(pair), resting_gap(pair.i, pair.j), made);
            while (old != pairs.end() && before_pair(*old, pair)) ++old;
            if (old == pairs.end() || before_pair(pair, *old)) continue;
            take_impulses_over(made, {contacts.data() + old->first, static_cast<std::size_t>(old->count)});
        }
    });
    pairs = found_.pairs;
    contacts.swap(made_);
}

}  // namespace polargrain
