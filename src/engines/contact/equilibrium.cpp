#include "src/engines/contact/equilibrium.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "src/engines/contact/gap_motion.h"

namespace polargrain {

namespace {

constexpr int k_most_rounds = 80;
// What is missed: of the kick, of the heaviest grain's weight in the sub-step, and of their product.
constexpr double k_exact = 1e-11;      ///< no round gets nearer
constexpr double k_good = 1e-6;        ///< sweeps do the rest
constexpr double k_worse = 100.0;      ///< times the least miss: round-off has taken over
constexpr double k_far = 100.0;        ///< gaps that close in so many kicks are none
constexpr double k_held = 1e-6;        ///< of the kick: a speed below it is none
constexpr double k_most_force = 1.5;   ///< of the weight of all grains: rows that need more are all but flat
constexpr double k_of_the_way = 0.99;  ///< to where a slack or an impulse would end

using Numbers = std::vector<double>;

/// One direction in which a contact can push. Its factors times velocities (v_x, v_y, reach x spin) of its bodies, of
/// which a wall is none, give the speed at which it opens.
struct Push {
    std::size_t contact = 0;
    double tilt = 0.0;   ///< tangential impulse for each normal one
    double least = 0.0;  ///< speed at which it has to open; negative: may close
    std::size_t factors = 0;
    std::array<double, 6> factor{};
    std::array<std::size_t, 6> row{};
};

double opening(const Push& p, const Numbers& speeds) {
    double sum = 0.0;
    for (std::size_t f = 0; f < p.factors; ++f) sum += p.factor[f] * speeds[p.row[f]];
    return sum;
}

void give(const Push& p, double impulse, Numbers& values) {
    for (std::size_t f = 0; f < p.factors; ++f) values[p.row[f]] += p.factor[f] * impulse;
}

/// Speeds are in units of the kick, masses in those of the heaviest grain.
class InteriorPoint {
public:
    explicit InteriorPoint(const RestingBed& bed);

    /// Goes on until nothing is missed or round-off has taken over. Returns whether the best round is good.
    bool run();
    bool moves() const;
    void give_impulses(std::vector<Vec2>& impulses) const;

private:
    void add_grain(const SolverBody& grain, double reach);
    void add_contact(std::size_t contact);
    void add_push(std::size_t contact, double tilt, double least);
    double find_misses();
    double largest_miss(double product) const;
    bool factorise();
    void advance(double product);
    void find_ways(double product, const Numbers& curved);
    double longest_way() const;

    const RestingBed& bed_;
    double kick_, unit_mass_ = 0.0;
    std::vector<Push> pushes_;
    Numbers mass_, free_, speed_, speed_way_, unbalanced_;  ///< three rows a grain
    Numbers slack_, slack_way_, impulse_, impulse_way_;     ///< of each push
    Numbers unmet_, short_of_, curved_;
    Numbers best_speed_, best_impulse_;
    bool analysed_ = false;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

InteriorPoint::InteriorPoint(const RestingBed& bed) : bed_(bed), kick_(std::sqrt(bed.kick.squaredNorm())) {
    for (const SolverBody& grain : bed.grains) unit_mass_ = std::max(unit_mass_, 1.0 / grain.inverse_mass);
    for (std::size_t k = 0; k < bed.grains.size(); ++k) add_grain(bed.grains[k], bed.reach[k]);
    for (std::size_t k = 0; k < bed.contacts.size(); ++k) add_contact(k);
    speed_.assign(mass_.size(), 0.0);
    unbalanced_.resize(mass_.size());
    for (const Push& p : pushes_) slack_.push_back(std::max(1.0, -p.least));
    impulse_.assign(pushes_.size(), 1.0);
    for (Numbers* values : {&slack_way_, &impulse_way_, &unmet_, &short_of_, &curved_}) values->resize(pushes_.size());
}

void InteriorPoint::add_grain(const SolverBody& grain, double reach) {
    const double mass = 1.0 / (grain.inverse_mass * unit_mass_);
    mass_.insert(mass_.end(), {mass, mass, 1.0 / (grain.inverse_inertia * unit_mass_ * reach * reach)});
    free_.insert(free_.end(), {bed_.kick.x() / kick_, bed_.kick.y() / kick_, 0.0});
}

void InteriorPoint::add_contact(std::size_t contact) {
    const GapContact& c = bed_.contacts[contact];
    const double least = -std::max(0.0, bed_.open[contact]) / (bed_.length * kick_);
    if (least < -k_far) return;
    add_push(contact, c.friction, least);
    if (c.friction > 0.0) add_push(contact, -c.friction, least);
}

void InteriorPoint::add_push(std::size_t contact, double tilt, double least) {
    const GapContact& c = bed_.contacts[contact];
    const Vec2 along = c.normal + tilt * c.tangent();
    Push p{contact, tilt, least};
    const auto acts_on = [&](BodyIndex body, const Vec2& direction, double arm) {
        for (const double factor : {direction.x(), direction.y(), arm / bed_.reach[at(body)]}) {
            p.factor[p.factors] = factor;
            p.row[p.factors] = 3 * at(body) + p.factors % 3;
            ++p.factors;
        }
    };
    acts_on(c.i, along, c.arm_ni + tilt * c.arm_ti);
    if (!is_wall(c.j)) acts_on(c.j, -along, -(c.arm_nj + tilt * c.arm_tj));
    pushes_.push_back(p);
}

bool InteriorPoint::run() {
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < k_most_rounds; ++round) {
        const double product = find_misses();
        const double miss = largest_miss(product);
        if (miss < best) {
            best = miss;
            best_speed_ = speed_;
            best_impulse_ = impulse_;
        }
        if (best < k_exact || (best < k_good && !(miss < k_worse * best))) break;
        if (!factorise()) break;
        advance(product);
    }
    return best < k_good;
}

bool InteriorPoint::moves() const {
    return std::any_of(best_speed_.begin(), best_speed_.end(), [](double v) { return std::abs(v) > k_held; });
}

void InteriorPoint::give_impulses(std::vector<Vec2>& impulses) const {
    impulses.assign(bed_.contacts.size(), Vec2::Zero());
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        impulses[pushes_[k].contact] += unit_mass_ * kick_ * best_impulse_[k] * Vec2(1.0, pushes_[k].tilt);
    }
}

/// Of balance, of gaps, and the mean product of slack and impulse, which is returned.
double InteriorPoint::find_misses() {
    for (std::size_t k = 0; k < mass_.size(); ++k) unbalanced_[k] = mass_[k] * (speed_[k] - free_[k]);
    double product = 0.0;
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        give(pushes_[k], -impulse_[k], unbalanced_);
        unmet_[k] = opening(pushes_[k], speed_) - pushes_[k].least - slack_[k];
        product += slack_[k] * impulse_[k];
    }
    return product / static_cast<double>(std::max<std::size_t>(pushes_.size(), 1));
}

double InteriorPoint::largest_miss(double product) const {
    double most = product;
    for (const double r : unbalanced_) most = std::max(most, std::abs(r));
    for (const double r : unmet_) most = std::max(most, std::abs(r));
    return most;
}

bool InteriorPoint::factorise() {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(mass_.size() + 21 * pushes_.size());
    const auto add = [&](std::size_t row, std::size_t column, double value) {
        entries.emplace_back(static_cast<int>(std::max(row, column)), static_cast<int>(std::min(row, column)), value);
    };
    for (std::size_t k = 0; k < mass_.size(); ++k) add(k, k, mass_[k]);
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        const Push& p = pushes_[k];
        for (std::size_t a = 0; a < p.factors; ++a) {
            for (std::size_t b = 0; b <= a; ++b) {
                add(p.row[a], p.row[b], impulse_[k] / slack_[k] * p.factor[a] * p.factor[b]);
            }
        }
    }
    const auto n = static_cast<Eigen::Index>(mass_.size());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!analysed_) factors_.analyzePattern(matrix);
    analysed_ = true;
    factors_.factorize(matrix);
    return factors_.info() == Eigen::Success;
}

/// Predictor: how far would the way to no product at all lead? Corrector: the more that is, the less product to aim at,
/// and what the ways of the predictor multiply to is taken off.
void InteriorPoint::advance(double product) {
    std::fill(curved_.begin(), curved_.end(), 0.0);
    find_ways(0.0, curved_);
    const double part = longest_way();
    double ahead = 0.0;
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        ahead += (slack_[k] + part * slack_way_[k]) * (impulse_[k] + part * impulse_way_[k]);
        curved_[k] = slack_way_[k] * impulse_way_[k];
    }
    const double left = ahead / (product * static_cast<double>(pushes_.size()));
    find_ways(product * left * left * left, curved_);
    const double step = k_of_the_way * longest_way();
    for (std::size_t k = 0; k < speed_.size(); ++k) speed_[k] += step * speed_way_[k];
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        slack_[k] += step * slack_way_[k];
        impulse_[k] += step * impulse_way_[k];
    }
}

/// Newton's ways towards balance, gaps that are met, and slack x impulse = `product` - `curved`.
void InteriorPoint::find_ways(double product, const Numbers& curved) {
    Numbers right(mass_.size());
    for (std::size_t k = 0; k < right.size(); ++k) right[k] = -unbalanced_[k];
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        short_of_[k] = product - curved[k] - slack_[k] * impulse_[k];
        give(pushes_[k], (short_of_[k] - impulse_[k] * unmet_[k]) / slack_[k], right);
    }
    const auto n = static_cast<Eigen::Index>(right.size());
    const Eigen::VectorXd solution = factors_.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), n));
    speed_way_.assign(solution.begin(), solution.end());
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        slack_way_[k] = opening(pushes_[k], speed_way_) + unmet_[k];
        impulse_way_[k] = (short_of_[k] - impulse_[k] * slack_way_[k]) / slack_[k];
    }
}

/// In parts of the ways, at most 1, until the first slack or impulse ends.
double InteriorPoint::longest_way() const {
    double part = 1.0;
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        if (slack_way_[k] < 0.0) part = std::min(part, -slack_[k] / slack_way_[k]);
        if (impulse_way_[k] < 0.0) part = std::min(part, -impulse_[k] / impulse_way_[k]);
    }
    return part;
}

double weight_in_all(const RestingBed& bed) {
    double mass = 0.0;
    for (const SolverBody& grain : bed.grains) mass += 1.0 / grain.inverse_mass;
    return mass * std::sqrt(bed.kick.squaredNorm());
}

}  // namespace

bool find_equilibrium(const RestingBed& bed, std::vector<Vec2>& impulses) {
    InteriorPoint method(bed);
    if (!method.run()) return false;
    const bool rough =
        std::any_of(bed.contacts.begin(), bed.contacts.end(), [](const GapContact& c) { return c.friction > 0.0; });
    if (rough && method.moves()) return false;
    method.give_impulses(impulses);
    const double most = k_most_force * weight_in_all(bed);
    return std::all_of(impulses.begin(), impulses.end(), [&](const Vec2& p) { return p.x() <= most; });
}

}  // namespace polargrain
