#include "src/engines/contact/gap_solver.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_motion.h"
#include "src/engines/contact/wall_pieces.h"
#include "src/model/contact_law.h"

namespace polargrain {

void GapSolver::advance(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, const PoseSet& start,
                        PoseSet& trial, std::int64_t step, double time, double dt, int sweeps, StepReport& report) {
    start_ = &start;
    halfway_.find(start, bodies, dt);
    prepare(contacts, bodies);
    prepare_laws(contacts, step);
    impacts_.begin(contacts, halfway_, step, time, dt);
    const double h = dt / k_sub_steps;
    for (int s = 0; s < k_sub_steps; ++s) {
        set_wall_velocities(contacts, time + (s + 0.5) * h);
        impacts_.run(contacts, bodies, trial, h, report);
        lasting(contacts, bodies, h, sweeps);
        keep_energy(contacts, bodies, h);
        move(contacts, bodies, trial, h, report);
    }
}

void GapSolver::prepare_at_rest(std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                const PoseSet& poses) {
    start_ = &poses;
    halfway_.find(poses, bodies, 0.0);
    prepare(contacts, bodies);
}

void GapSolver::prepare(std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies) const {
    for (GapContact& c : contacts) {
        c.travel = 0.0;
        c.active = true;
        c.total_impulse = Vec2::Zero();
        halfway_.carry(c);
        prepare_arms(c, bodies);
    }
}

void GapSolver::prepare_arms(GapContact& c, const std::vector<SolverBody>& bodies) const {
    const Vec2 t = c.tangent();
    const SolverBody& i = bodies[at(c.i)];
    const Vec2 arm_i = c.point - halfway_.centre(c.i);
    c.arm_ni = cross(arm_i, c.normal);
    c.arm_ti = cross(arm_i, t);
    double n = i.inverse_mass + i.inverse_inertia * c.arm_ni * c.arm_ni;
    double s = i.inverse_mass + i.inverse_inertia * c.arm_ti * c.arm_ti;
    if (!is_wall(c.j)) {
        const SolverBody& j = bodies[at(c.j)];
        const Vec2 arm_j = c.point - halfway_.centre(c.j);
        c.arm_nj = cross(arm_j, c.normal);
        c.arm_tj = cross(arm_j, t);
        n += j.inverse_mass + j.inverse_inertia * c.arm_nj * c.arm_nj;
        s += j.inverse_mass + j.inverse_inertia * c.arm_tj * c.arm_tj;
    }
    c.mass_n = 1.0 / n;
    c.mass_t = 1.0 / s;
}

void GapSolver::prepare_laws(std::vector<GapContact>& contacts, std::int64_t step) const {
    for (GapContact& c : contacts) {
        c.friction = pair_law(scene_, c.j, c.i).friction;
        c.restitution = drawn_restitution(scene_, step, c.j, c.i);
    }
}

void GapSolver::set_wall_velocities(std::vector<GapContact>& contacts, double time) const {
    for (GapContact& c : contacts) {
        if (!is_wall(c.j)) continue;
        const Wall& wall = scene_.walls[static_cast<std::size_t>(wall_index(c.j))];
        if (wall.moves()) c.wall_velocity = wall_state(wall, time).velocity_at(c.point);
    }
}

// --- lasting contacts ---

void GapSolver::lasting(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, double h, int sweeps) {
    velocity_before_.resize(bodies.size());
    spin_before_.resize(bodies.size());
    pushed_.assign(bodies.size(), 0);
    const Vec2 kick = h * scene_.gravity;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        velocity_before_[k] = bodies[k].velocity;
        spin_before_[k] = bodies[k].spin;
        bodies[k].velocity += kick;
    }
    for (const GapContact& c : contacts) {
        if (c.normal_impulse > 0.0) push(c, bodies, c.normal_impulse, c.tangent_impulse);
    }
    const double settled = k_settled * std::sqrt(kick.squaredNorm());
    for (int s = 0; s < sweeps; ++s) {
        if (!sweep(contacts, bodies, h, settled, s % 2 != 0)) break;
    }
    for (const GapContact& c : contacts) {
        if (c.normal_impulse == 0.0) continue;
        pushed_[at(c.i)] = 1;
        if (!is_wall(c.j)) pushed_[at(c.j)] = 1;
    }
}

/// Slows the grains that lasting contacts push, where the sub-step would otherwise create energy because the sweeps
/// have not converged.
///
/// Slower by the factor f, they have f^2 of their kinetic energy and take f of their way against gravity, so some f
/// always keeps the energy from rising; and as no target asks for parting, gaps among slowed grains and to walls at
/// rest are kept. While a moving wall pushes, nothing is slowed: grains would be overrun.
void GapSolver::keep_energy(const std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, double h) const {
    for (const GapContact& c : contacts) {
        if (is_wall(c.j) && c.normal_impulse > 0.0 && c.wall_velocity != Vec2::Zero()) return;
    }
    double before = 0.0;
    double after = 0.0;
    double fall = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (!pushed_[k]) continue;
        const SolverBody& body = bodies[k];
        before += 0.5 * (velocity_before_[k].squaredNorm() / body.inverse_mass +
                         spin_before_[k] * spin_before_[k] / body.inverse_inertia);
        after += 0.5 * (body.velocity.squaredNorm() / body.inverse_mass + body.spin * body.spin / body.inverse_inertia);
        fall += h * scene_.gravity.dot(body.velocity) / body.inverse_mass;
    }
    if (after - fall <= before) return;
    // The larger root of after f^2 - fall f - before = 0, in the form that loses no digits.
    const double root = std::sqrt(fall * fall + 4.0 * after * before);
    const double f = fall >= 0.0 ? (fall + root) / (2.0 * after) : 2.0 * before / (root - fall);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (!pushed_[k]) continue;
        bodies[k].velocity *= f;
        bodies[k].spin *= f;
    }
}

/// One pass over all contacts; false where no contact's velocity has changed by more than `settled` [m/s].
bool GapSolver::sweep(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, double h, double settled,
                      bool backwards) const {
    bool changed = false;
    const std::size_t n = contacts.size();
    const double per_h = 1.0 / h;
    SolverBody still;  // stands for every wall: its velocity is the contact's wall_velocity, its inertia infinite
    for (std::size_t k = 0; k < n; ++k) {
        GapContact& c = contacts[backwards ? n - 1 - k : k];
        if (!c.active) continue;
        SolverBody& i = bodies[at(c.i)];
        SolverBody& j = is_wall(c.j) ? still : bodies[at(c.j)];
        const double nx = c.normal.x();
        const double ny = c.normal.y();
        double ux = i.velocity.x() - j.velocity.x() - c.wall_velocity.x();
        double uy = i.velocity.y() - j.velocity.y() - c.wall_velocity.y();
        double wi = i.spin;
        double wj = j.spin;
        const double masses = i.inverse_mass + j.inverse_mass;

        const double open = c.gap - c.resting;
        const double target = open > 0.0 ? -open * per_h : 0.0;
        const double u_n = nx * ux + ny * uy + c.arm_ni * wi - c.arm_nj * wj;
        const double normal = std::max(0.0, c.normal_impulse - c.mass_n * (u_n - target));
        const double change_n = normal - c.normal_impulse;
        if (change_n != 0.0) {
            ux += masses * change_n * nx;
            uy += masses * change_n * ny;
            wi += i.inverse_inertia * change_n * c.arm_ni;
            wj -= j.inverse_inertia * change_n * c.arm_nj;
        }
        const double cone = c.friction * normal;
        double change_t = -c.tangent_impulse;
        if (cone > 0.0) {
            const double u_t = ny * ux - nx * uy + c.arm_ti * wi - c.arm_tj * wj;
            change_t += std::clamp(c.tangent_impulse - c.mass_t * u_t, -cone, cone);
        }
        if (change_n == 0.0 && change_t == 0.0) continue;
        const Vec2 p{change_n * nx + change_t * ny, change_n * ny - change_t * nx};
        i.velocity += i.inverse_mass * p;
        i.spin = wi + i.inverse_inertia * change_t * c.arm_ti;
        j.velocity -= j.inverse_mass * p;
        j.spin = wj - j.inverse_inertia * change_t * c.arm_tj;
        c.normal_impulse = normal;
        c.tangent_impulse += change_t;
        changed = changed || std::abs(change_n) > settled * c.mass_n || std::abs(change_t) > settled * c.mass_t;
    }
    return changed;
}

void GapSolver::move(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, PoseSet& trial, double h,
                     StepReport& report) {
    for (GapContact& c : contacts) {
        if (!c.active) continue;
        const double u_n = normal_speed(c, bodies);
        const double u_t = tangent_speed(c, bodies);
        if (c.normal_impulse > 0.0) {
            const Vec2 impulse = c.normal_impulse * c.normal + c.tangent_impulse * c.tangent();
            c.total_impulse += impulse;
            take_reaction(c, impulse, report);
            report.ledger.restitution_loss -= c.normal_impulse * u_n;
            report.ledger.friction_loss -= c.tangent_impulse * u_t;
        }
        c.gap += u_n * h;
        c.travel += u_t * h;
        if (c.travel < c.low || c.travel > c.high) leave_edge(c, bodies);
    }
    const Vec2 half_kick = 0.5 * h * scene_.gravity;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        SolverBody& body = bodies[k];
        body.touched = body.touched || pushed_[k];
        if (pushed_[k]) {
            const Vec2 change = body.velocity - velocity_before_[k];
            const double turn = body.spin - spin_before_[k];
            report.ledger.restitution_loss +=
                0.5 * (change.squaredNorm() / body.inverse_mass + turn * turn / body.inverse_inertia);
            trial.centre[k] += h * body.velocity;
        } else {
            trial.centre[k] += h * (body.velocity - half_kick);
        }
        trial.angle[k] += h * body.spin;
    }
}

/// Edge-end rule: the point has passed the end of its edge. The other body's corner now runs along the edge that
/// trails behind the point, with the same gap; where the turn is too sharp the contact is over for this step.
void GapSolver::leave_edge(GapContact& c, const std::vector<SolverBody>& bodies) const {
    c.active = false;
    const bool towards_t = c.travel > c.high;
    const double normal_impulse = c.normal_impulse;
    c.normal_impulse = 0.0;
    c.tangent_impulse = 0.0;
    if (c.vertex < 0 || (!c.on_i && is_wall(c.j))) return;
    const BodyIndex owner = c.on_i ? c.i : c.j;
    const auto* polygon = std::get_if<PolarPolygon>(&scene_.shape_of(owner));
    if (polygon == nullptr) return;
    const auto turned = [&](const Vec2& v) { return halfway_.turned(owner, start_->pose[at(owner)].turned(v)); };
    const Vec2 t = c.tangent();
    const Vec2 v = polygon->vertex(c.vertex);
    // The owner's point moves along +t if it is i's and the pair travels along t, and so on.
    const bool point_along_t = c.on_i == towards_t;
    const Vec2 to_next = turned(polygon->vertex(polygon->next(c.vertex)) - v);
    const Vec2 to_previous = turned(polygon->vertex(polygon->previous(c.vertex)) - v);
    const bool next_trails = point_along_t ? to_next.dot(t) < to_previous.dot(t) : to_next.dot(t) > to_previous.dot(t);
    const int edge = next_trails ? c.vertex : polygon->previous(c.vertex);
    const Vec2 outward = turned(polygon->normal(edge));
    const Vec2 normal = c.on_i ? Vec2(-outward) : outward;
    const double cosine = normal.dot(c.normal);
    if (cosine < 0.2) return;
    c.normal = normal;
    c.normal_impulse = normal_impulse * cosine;
    c.low = -std::numeric_limits<double>::infinity();
    c.high = std::numeric_limits<double>::infinity();
    c.active = true;
    prepare_arms(c, bodies);
}

}  // namespace polargrain
