#include "src/engines/contact/interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

using Numbers = PushSystem::Numbers;

constexpr int k_most_rounds = 80;
// What is missed: of the kick, of the heaviest grain's weight in the sub-step, and of their product.
constexpr double k_exact = 1e-11;      ///< no round gets nearer
constexpr double k_good = 1e-6;        ///< sweeps do the rest
constexpr double k_worse = 100.0;      ///< times the least miss: round-off has taken over
constexpr double k_of_the_way = 0.99;  ///< to where a slack or an impulse would end

class InteriorPoint {
public:
    explicit InteriorPoint(PushSystem& system);

    /// Goes on until nothing is missed or round-off has taken over. Returns the best round, if it is good.
    std::optional<PushSolution> run();

private:
    double find_misses();
    double largest_miss(double product) const;
    bool factorise();
    void advance(double product);
    void find_ways(double product, const Numbers& curved);
    double longest_way() const;

    PushSystem& system_;
    Numbers speed_, speed_way_, unbalanced_;             ///< of each row
    Numbers slack_, slack_way_, impulse_, impulse_way_;  ///< of each push
    Numbers unmet_, short_of_, curved_;
};

InteriorPoint::InteriorPoint(PushSystem& system) : system_(system) {
    speed_.assign(system.rows(), 0.0);
    for (std::size_t k = 0; k < system.pushes(); ++k) slack_.push_back(std::max(1.0, -system.least(k)));
    impulse_.assign(system.pushes(), 1.0);
    for (Numbers* values : {&slack_way_, &impulse_way_, &unmet_, &short_of_, &curved_}) values->resize(system.pushes());
}

std::optional<PushSolution> InteriorPoint::run() {
    double best = std::numeric_limits<double>::infinity();
    PushSolution of_best;
    for (int round = 0; round < k_most_rounds; ++round) {
        const double product = find_misses();
        const double miss = largest_miss(product);
        if (miss < best) {
            best = miss;
            of_best = {speed_, impulse_};
        }
        if (best < k_exact || (best < k_good && !(miss < k_worse * best))) break;
        if (!factorise()) break;
        advance(product);
    }
    if (best < k_good) return of_best;
    return {};
}

/// Of balance, of gaps, and the mean product of slack and impulse, which is returned.
double InteriorPoint::find_misses() {
    system_.find_unbalanced(speed_, impulse_, unbalanced_);
    double product = 0.0;
    for (std::size_t k = 0; k < system_.pushes(); ++k) {
        unmet_[k] = system_.opening(k, speed_) - system_.least(k) - slack_[k];
        product += slack_[k] * impulse_[k];
    }
    return product / static_cast<double>(std::max<std::size_t>(system_.pushes(), 1));
}

double InteriorPoint::largest_miss(double product) const {
    double most = product;
    for (const double r : unbalanced_) most = std::max(most, std::abs(r));
    for (const double r : unmet_) most = std::max(most, std::abs(r));
    return most;
}

bool InteriorPoint::factorise() {
    Numbers weights(system_.pushes());
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k] = impulse_[k] / slack_[k];
    return system_.factorise(weights);
}

/// Predictor: how far would the way to no product at all lead? Corrector: the more that is, the less product to aim at,
/// and what the ways of the predictor multiply to is taken off.
void InteriorPoint::advance(double product) {
    std::fill(curved_.begin(), curved_.end(), 0.0);
    find_ways(0.0, curved_);
    const double part = longest_way();
    double ahead = 0.0;
    for (std::size_t k = 0; k < slack_.size(); ++k) {
        ahead += (slack_[k] + part * slack_way_[k]) * (impulse_[k] + part * impulse_way_[k]);
        curved_[k] = slack_way_[k] * impulse_way_[k];
    }
    const double left = ahead / (product * static_cast<double>(slack_.size()));
    find_ways(product * left * left * left, curved_);
    const double step = k_of_the_way * longest_way();
    for (std::size_t k = 0; k < speed_.size(); ++k) speed_[k] += step * speed_way_[k];
    for (std::size_t k = 0; k < slack_.size(); ++k) {
        slack_[k] += step * slack_way_[k];
        impulse_[k] += step * impulse_way_[k];
    }
}

/// Newton's ways towards balance, gaps that are met, and slack x impulse = `product` - `curved`.
void InteriorPoint::find_ways(double product, const Numbers& curved) {
    Numbers right(system_.rows());
    for (std::size_t k = 0; k < right.size(); ++k) right[k] = -unbalanced_[k];
    for (std::size_t k = 0; k < slack_.size(); ++k) {
        short_of_[k] = product - curved[k] - slack_[k] * impulse_[k];
        system_.give(k, (short_of_[k] - impulse_[k] * unmet_[k]) / slack_[k], right);
    }
    speed_way_ = system_.solve(right);
    for (std::size_t k = 0; k < slack_.size(); ++k) {
        slack_way_[k] = system_.opening(k, speed_way_) + unmet_[k];
        impulse_way_[k] = (short_of_[k] - impulse_[k] * slack_way_[k]) / slack_[k];
    }
}

/// In parts of the ways, at most 1, until the first slack or impulse ends.
double InteriorPoint::longest_way() const {
    double part = 1.0;
    for (std::size_t k = 0; k < slack_.size(); ++k) {
        if (slack_way_[k] < 0.0) part = std::min(part, -slack_[k] / slack_way_[k]);
        if (impulse_way_[k] < 0.0) part = std::min(part, -impulse_[k] / impulse_way_[k]);
    }
    return part;
}

}  // namespace

std::optional<PushSolution> solve_interior(PushSystem& system) { return InteriorPoint(system).run(); }

}  // namespace polargrain
