#include "src/engines/contact/face_blow.h"

#include <cmath>
#include <utility>

namespace polargrain {

namespace {

/// The place of the pressure and the impulse follow from one another: by a twentieth where the ends close alike to
/// that.
constexpr int k_rounds = 30;
constexpr double k_settled = 1e-15;  ///< of the way between the ends

/// Of i relative to j at a contact [m/s].
Vec2 relative_velocity(const GapContact& c, const Footing& i, const Footing& j) {
    return i.velocity_at(c.point) - (is_wall(c.j) ? c.wall_velocity : j.velocity_at(c.point));
}

}  // namespace

SharedImpact::SharedImpact(const GapContact& c, const GapContact& d, const Footing& i, const Footing& j, double share)
    : first_(c.point), second_(d.point), friction_((1.0 - share) * c.friction + share * d.friction) {
    normal_.at_first = (1.0 - share) * c.normal;
    normal_.at_second = share * d.normal;
    tangent_.at_first = (1.0 - share) * c.tangent();
    tangent_.at_second = share * d.tangent();
    pull(normal_, i, j);
    pull(tangent_, i, j);
    if (&c != &d) answer(couple_, i, j, i.after(Vec2::Zero(), 1.0), j.after(Vec2::Zero(), 1.0));
    const Vec2 u_first = relative_velocity(c, i, j);
    const Vec2 u_second = relative_velocity(d, i, j);
    before_.sliding = u_first.dot(tangent_.at_first) + u_second.dot(tangent_.at_second);
    before_.closing = u_first.dot(normal_.at_first) + u_second.dot(normal_.at_second);
}

/// Its moment about the centre of mass of a body.
double SharedImpact::moment(const Lever& lever, const Footing& body) const {
    return body.moment(lever.at_first, first_) + body.moment(lever.at_second, second_);
}

void SharedImpact::pull(Lever& lever, const Footing& i, const Footing& j) const {
    const Vec2 both = lever.at_first + lever.at_second;
    answer(lever, i, j, i.after(both, moment(lever, i)), j.after(both, moment(lever, j)));
}

/// As j answers to the opposite impulse, the two changes add up.
void SharedImpact::answer(Lever& lever, const Footing& i, const Footing& j, const Footing& i_after,
                          const Footing& j_after) const {
    const auto change = [&](const Vec2& point) {
        const Vec2 of_i = i_after.velocity_at(point) - i.velocity_at(point);
        const Vec2 of_j = j_after.velocity_at(point) - j.velocity_at(point);
        return Vec2(of_i + of_j);
    };
    lever.first_after = change(first_);
    lever.second_after = change(second_);
    lever.turn = i_after.spin() - i.spin() + (j_after.spin() - j.spin());
}

ImpactResult SharedImpact::solve(double restitution, bool held) const {
    ContactFrame frame;
    frame.normal = normal_.at_first + normal_.at_second;
    frame.b1 = inverse_mass(tangent_, tangent_, held);
    frame.b2 = inverse_mass(normal_, normal_, held);
    frame.b3 = -inverse_mass(tangent_, normal_, held);
    frame.b4 = -inverse_mass(normal_, tangent_, held);
    return solve_impact(frame, before_, friction_, restitution);
}

double SharedImpact::turn(const ImpactResult& p) const {
    return p.normal * normal_.turn + p.tangential * tangent_.turn;
}

void SharedImpact::push(const ImpactResult& p, Footing& i, Footing& j) const {
    const Lever both{p.normal * normal_.at_first + p.tangential * tangent_.at_first,
                     p.normal * normal_.at_second + p.tangential * tangent_.at_second};
    const Vec2 impulse = both.at_first + both.at_second;
    i.take(impulse, moment(both, i));
    j.take(-impulse, -moment(both, j));
}

/// Speed along p for a unit impulse along q. A face that holds the relative spin adds the couple that it takes.
double SharedImpact::inverse_mass(const Lever& p, const Lever& q, bool held) const {
    const auto along = [&p](const Lever& by) {
        return by.first_after.dot(p.at_first) + by.second_after.dot(p.at_second);
    };
    return held ? along(q) - along(couple_) * q.turn / couple_.turn : along(q);
}

FaceBlow solve_face_blow(const GapContact& first, const GapContact& second, const Footing& i, const Footing& j,
                         double restitution) {
    const SharedImpact at_first(first, second, i, j, 0.0);
    if (&first == &second) return {at_first.solve(restitution, false), 0.0};
    const SharedImpact at_second(first, second, i, j, 1.0);
    double share = 0.5;
    for (int n = 0; n < k_rounds && at_first.yields(); ++n) {
        const ImpactResult held = SharedImpact(first, second, i, j, share).solve(restitution, true);
        // Where between the ends does this impulse turn the bodies by nothing?
        const double turn = at_first.turn(held);
        const double last = std::exchange(share, turn / (turn - at_second.turn(held)));
        if (!(share > 0.0 && share < 1.0)) break;
        if (std::abs(share - last) <= k_settled) return {held, share};
    }
    const bool first_is_nearer = !(share > 0.5);
    const SharedImpact& end = first_is_nearer ? at_first : at_second;
    return {end.solve(restitution, false), first_is_nearer ? 0.0 : 1.0};
}

}  // namespace polargrain
