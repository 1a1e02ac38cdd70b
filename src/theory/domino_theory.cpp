#include "src/theory/domino_theory.h"

#include <cmath>
#include <utility>
#include <vector>

#include "src/core/error.h"

namespace polargrain {

namespace {

/// Intervals over the fall of the head; doubling them moves no speed by 1e-6.
constexpr int k_intervals = 400;
/// Dominoes that lean on the head: their weights fall off geometrically, and more change nothing.
constexpr int k_leaning = 80;

double inertia(const DominoRow& row) { return (1.0 + row.thickness * row.thickness) / 3.0; }

/// Composite Simpson's rule over an even number of equal intervals.
double simpson(const std::vector<double>& values, double interval) {
    double sum = values.front() + values.back();
    for (std::size_t k = 1; k + 1 < values.size(); ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * values[k];
    return sum * interval / 3.0;
}

/// Sums over the leaning group where its head stands at a given angle: per domino, i from the head backwards, r_i
/// weighs its equation of motion so that the contact forces drop out, and w_i is its rate over that of the head.
struct GroupSums {
    double inertia = 0.0;  ///< sum r_i w_i
    double change = 0.0;   ///< sum r_i dw_i / d(head angle)
    double torque = 0.0;   ///< sum r_i T_i, T = (sin th - h cos th) / 2
};

GroupSums group_sums(const DominoRow& row, double head_angle) {
    const double p = row.pitch();
    const double h = row.thickness;
    GroupSums sums;
    double angle = head_angle;
    double weight = 1.0, rate = 1.0, rate_change = 0.0;
    for (int i = 0; i < k_leaning; ++i) {
        sums.inertia += weight * rate;
        sums.change += weight * rate_change;
        sums.torque += 0.5 * weight * (std::sin(angle) - h * std::cos(angle));
        // The one behind leans on this one: L sin d = p cos th - h, d the difference of their angles.
        const double sine = p * std::cos(angle) - h;
        const double cosine = std::sqrt(1.0 - sine * sine);
        const double slope = p * std::sin(angle);
        const double ratio = 1.0 - slope / cosine;
        const double ratio_change = -p * std::cos(angle) / cosine + slope * slope * sine / (cosine * cosine * cosine);
        weight *= (cosine - slope - row.friction * h) / (cosine + row.friction * sine);
        rate_change = rate_change * ratio + rate * rate * ratio_change;
        rate *= ratio;
        angle += std::asin(sine);
    }
    return sums;
}

/// The square u of the head's rate while it falls: du/dth = 2 (torque / I - change u) / inertia.
class GroupFall {
public:
    explicit GroupFall(const DominoRow& row)
        : inertia_(inertia(row)), interval_(std::asin(row.gap) / static_cast<double>(k_intervals)) {
        for (int k = 0; k <= 2 * k_intervals; ++k) sums_.push_back(group_sums(row, 0.5 * interval_ * k));
    }

    const GroupSums& start() const { return sums_.front(); }
    double interval() const { return interval_; }

    /// u at each interval's end, from u = start at angle zero. Classical Runge-Kutta.
    std::vector<double> squares(double start) const {
        std::vector<double> u{start};
        for (std::size_t k = 0; k + 2 < sums_.size(); k += 2) {
            const double k1 = slope(sums_[k], u.back());
            const double k2 = slope(sums_[k + 1], u.back() + 0.5 * interval_ * k1);
            const double k3 = slope(sums_[k + 1], u.back() + 0.5 * interval_ * k2);
            const double k4 = slope(sums_[k + 2], u.back() + interval_ * k3);
            u.push_back(u.back() + interval_ / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
        }
        return u;
    }

private:
    double slope(const GroupSums& s, double u) const { return 2.0 * (s.torque / inertia_ - s.change * u) / s.inertia; }

    double inertia_, interval_;
    std::vector<GroupSums> sums_;
};

/// pitch / integral of d th / sqrt(u); NaN where the head does not get over.
double wave_speed(const DominoRow& row, std::vector<double> squares, double interval) {
    for (double& u : squares) u = u > 0.0 ? 1.0 / std::sqrt(u) : std::nan("");
    return row.pitch() / simpson(squares, interval);
}

}  // namespace

void check(const DominoRow& row) {
    require(row.gap > 0.0 && row.gap < 1.0,
            "dominoes {} of their height apart never strike one another, or touch: take a gap between 0 and 1",
            row.gap);
    require(row.thickness > 0.0 && row.restitution >= 0.0 && row.restitution <= 1.0 && row.friction >= 0.0,
            "dominoes of thickness {} heights, restitution {} and friction {} are none: thickness > 0, restitution in "
            "[0, 1], friction >= 0",
            row.thickness, row.restitution, row.friction);
}

double group_theory_speed(const DominoRow& row) {
    check(row);
    const GroupFall fall(row);
    // The fall is linear in u, and so is the collision u -> ((J - 1) / J)^2 u: the steady wave in closed form.
    const double offset = fall.squares(0.0).back();
    const double factor = fall.squares(1.0).back() - offset;
    const double kept = (fall.start().inertia - 1.0) / fall.start().inertia;
    const double steady = kept * kept * offset / (1.0 - kept * kept * factor);
    return wave_speed(row, fall.squares(steady), fall.interval());
}

double single_collision_speed(const DominoRow& row) {
    check(row);
    const double psi = std::asin(row.gap);
    const double phi = std::atan(row.thickness);
    const double xi = std::sqrt(1.0 - row.gap * row.gap);
    const double r = 1.0 + (xi + row.friction * row.gap) / (xi - row.friction * row.thickness);
    const double q = (1.0 + row.restitution) / r;
    const double twice_omega2 = 3.0 * std::cos(phi);
    const double drop = std::cos(phi) - std::cos(psi - phi);
    const double start = q * q * twice_omega2 * drop / (1.0 - q * q);
    const double interval = psi / static_cast<double>(k_intervals);
    std::vector<double> squares;
    for (int k = 0; k <= k_intervals; ++k) {
        squares.push_back(start + twice_omega2 * (std::cos(phi) - std::cos(interval * k - phi)));
    }
    return wave_speed(row, std::move(squares), interval);
}

}  // namespace polargrain
