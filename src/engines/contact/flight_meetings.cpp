#include "src/engines/contact/flight_meetings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/detect/edge_gaps.h"
#include "src/detect/outline_meeting.h"
#include "src/engines/contact/disk_meeting.h"
#include "src/engines/contact/lever_arms.h"

namespace polargrain {

namespace {

/// Of the resting gap, squared: corners on one another are flush to within it, and that far apart. (And round-off.)
constexpr double k_flush = 2.01;

}  // namespace

FlightMeetings::FlightMeetings(const Scene& scene) : scene_(scene) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) radius_.push_back(outer_radius(scene.shape_of(k)));
}

bool FlightMeetings::flies(GrainIndex grain) const {
    const auto contacts = now_.by_grain->of(grain);
    return std::none_of(contacts.begin(), contacts.end(), [this](std::int32_t k) {
        return now_.lanes->normal_impulse(static_cast<std::size_t>(k)) > 0.0;
    });
}

/// Grains near a wall may stand on it, or be about to, and are struck in that stance (Footing).
bool FlightMeetings::is_free(GrainIndex grain) const {
    const auto contacts = now_.by_grain->of(grain);
    return flies(grain) && std::none_of(contacts.begin(), contacts.end(), [this](std::int32_t k) {
               return is_wall((*now_.contacts)[static_cast<std::size_t>(k)].j);
           });
}

void FlightMeetings::foresee(std::size_t contact, double from, double to) const {
    const GapContact& c = (*now_.contacts)[contact];
    if (c.between_disks()) {
        foresee_disks(contact, from, to);
    } else if (!is_wall(c.j) && begins_pair(contact)) {
        foresee_polygons(contact, from, to);
    }
}

void FlightMeetings::foresee_disks(std::size_t contact, double from, double to) const {
    GapContact& c = (*now_.contacts)[contact];
    if (!c.between_disks()) return;
    const SolverBody& i = (*now_.bodies)[at(c.i)];
    const Vec2 velocity = i.velocity - (*now_.bodies)[at(c.j)].velocity;
    const Vec2& centre = now_.trial->centre[at(c.i)];
    const Vec2 apart = centre - now_.trial->centre[at(c.j)];
    const double approach = -apart.dot(velocity);
    const double slow = now_.slow * now_.slow * apart.squaredNorm();
    if (approach <= 0.0 || approach * approach <= slow) return;  // left to the solver; later they close no faster
    const double touching = radius(c.i) + radius(c.j) + c.resting;
    const double too_far = touching + to * std::sqrt(velocity.squaredNorm());
    if (apart.squaredNorm() > too_far * too_far) return;
    ContactLanes& lanes = *now_.lanes;
    if (lanes.normal_impulse(contact) != 0.0 || lanes.tangent_impulse(contact) != 0.0) return;
    const DiskMeeting meeting = find_meeting(apart, velocity, touching, from, to);
    c.total_impulse += lanes.take(contact, c);
    c.normal = meeting.normal;
    c.point = centre + meeting.time * i.velocity - (radius(c.i) + 0.5 * c.resting) * c.normal;
    lanes.turn(c, contact, *now_.bodies, meeting.distance - touching);
}

/// Two polygons at the time at which they meet, or at the end of the time that was looked at.
struct FlightMeetings::Outlines {
    const PolarPolygon& i;
    const PolarPolygon& j;
    Pose pose_i, pose_j;
    double time;
    bool meet;

    Vec2 vertex_of(bool on_i, int vertex) const;
};

void FlightMeetings::foresee_polygons(std::size_t first, double from, double to) const {
    const GapContact& c = (*now_.contacts)[first];
    const std::span<GapContact> pair = pair_of(first);
    // By what is known from the middle of the step; a contact that has met already has forgotten that.
    bool closes = false;
    for (std::size_t k = first; k < first + pair.size() && !closes; ++k) {
        closes = (*now_.contacts)[k].met || closes_fast(k);
    }
    if (!closes) return;
    const auto* outline_i = std::get_if<PolarPolygon>(&scene_.shape_of(c.i));
    const auto* outline_j = std::get_if<PolarPolygon>(&scene_.shape_of(c.j));
    if (outline_i == nullptr || outline_j == nullptr) return;
    const Flight i = flight_of(c.i);
    const Flight j = flight_of(c.j);
    if (!may_meet(c, i, j, to) || !is_free(c.i) || !is_free(c.j)) return;
    const auto meeting = first_meeting(*outline_i, i, *outline_j, j, c.resting, from, to);
    const double time = meeting ? meeting->time : to;
    const Outlines then{*outline_i, *outline_j, i.at(time), j.at(time), time, meeting.has_value()};
    GapContact* const strikes = meeting ? &contact_of(*meeting, then, pair) : nullptr;
    for (std::size_t k = 0; k < pair.size(); ++k) turn(pair[k], first + k, then, &pair[k] == strikes);
}

/// The vertex of a contact point [m].
Vec2 FlightMeetings::Outlines::vertex_of(bool on_i, int vertex) const {
    return on_i ? pose_i.to_world(i.vertex(vertex)) : pose_j.to_world(j.vertex(vertex));
}

/// Of the pair's contacts, the one that strikes. The search for gap points looked where the grains were; what it has
/// not found takes the place of the same place by another name, corner on corner, or else of the point that is farthest
/// from striking.
GapContact& FlightMeetings::contact_of(const OutlineMeeting& meeting, const Outlines& then,
                                       std::span<GapContact> pair) const {
    const auto found = std::ranges::find_if(pair, [&](const GapContact& k) {
        return k.vertex == meeting.vertex && k.edge == meeting.edge && k.on_i == meeting.on_i;
    });
    if (found != pair.end()) return *found;
    const Vec2 place = then.vertex_of(meeting.on_i, meeting.vertex);
    const auto same = std::ranges::find_if(pair, [&](const GapContact& k) {
        return (then.vertex_of(k.on_i, k.vertex) - place).squaredNorm() <= k_flush * k.resting * k.resting;
    });
    GapContact& c = same != pair.end() ? *same : *std::ranges::max_element(pair, {}, &GapContact::gap);
    c.vertex = meeting.vertex;
    c.edge = meeting.edge;
    c.on_i = meeting.on_i;
    return c;
}

bool FlightMeetings::begins_pair(std::size_t contact) const {
    if (contact == 0) return true;
    const GapContact& c = (*now_.contacts)[contact];
    const GapContact& before = (*now_.contacts)[contact - 1];
    return before.i != c.i || before.j != c.j;
}

std::span<GapContact> FlightMeetings::pair_of(std::size_t first) const {
    std::vector<GapContact>& all = *now_.contacts;
    std::size_t last = first + 1;
    while (last < all.size() && !begins_pair(last)) ++last;
    return std::span(all).subspan(first, last - first);
}

bool FlightMeetings::may_meet(const GapContact& c, const Flight& i, const Flight& j, double to) const {
    const double fastest = std::sqrt((i.velocity - j.velocity).squaredNorm()) + std::abs(i.spin) * radius(c.i) +
                           std::abs(j.spin) * radius(c.j);
    const double reach = radius(c.i) + radius(c.j) + c.resting + to * fastest;
    return fastest > now_.slow && (i.centre - j.centre).squaredNorm() < reach * reach;
}

Flight FlightMeetings::flight_of(GrainIndex grain) const {
    const SolverBody& body = (*now_.bodies)[at(grain)];
    return {now_.trial->centre[at(grain)], now_.trial->angle[at(grain)], body.velocity, body.spin};
}

void FlightMeetings::turn(GapContact& c, std::size_t contact, const Outlines& then, bool strikes) const {
    const PolarPolygon& own = c.on_i ? then.i : then.j;
    const PolarPolygon& other = c.on_i ? then.j : then.i;
    const Pose& own_pose = c.on_i ? then.pose_i : then.pose_j;
    const Pose& other_pose = c.on_i ? then.pose_j : then.pose_i;
    c.total_impulse += now_.lanes->take(contact, c);
    c.point = own_pose.to_world(own.vertex(c.vertex));
    const Vec2 outward = other_pose.turned(other.normal(c.edge));
    c.normal = c.on_i ? outward : Vec2(-outward);
    c.low = -k_unbounded;
    c.high = k_unbounded;
    c.met = true;
    set_lever_arms(c, *now_.bodies, c.point - then.pose_i.centre, c.point - then.pose_j.centre);
    const Vec2 start = other_pose.to_world(other.vertex(c.edge));
    const Vec2 along = other_pose.to_world(other.vertex(other.next(c.edge))) - start;
    // Corners that are flush to within the gap at which they rest are each over the other's edge, or a face that they
    // end would lose that end.
    const bool over = is_over_edge(start, along, c.point, c.resting);
    const double gap = std::max(0.0, outward.dot(c.point - start) - c.resting);
    // What would strike later is looked for again after the first; what lands with it, as the other end of a face, is
    // not later.
    const bool lands = strikes || (then.meet && over && gap < c.resting);
    c.active = lands || (over && !then.meet);
    now_.lanes->turn(c, contact, *now_.bodies, (lands ? 0.0 : gap) - then.time * normal_speed(c, *now_.bodies));
}

}  // namespace polargrain
