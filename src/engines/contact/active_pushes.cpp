#include "src/engines/contact/active_pushes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

using Numbers = PushSystem::Numbers;

constexpr int k_most_rounds = 8;
constexpr int k_most_passes = 30;
constexpr double k_stiff = 1e8;   ///< weight of a push that is held
constexpr double k_met = 1e-12;   ///< what a held push may miss its opening by, in kicks
constexpr double k_part = 0.5;    ///< of what the pass before has missed: passes do not help any more
constexpr double k_exact = 1e-9;  ///< the same at the end, and of balance in the heaviest grain's weight

class ActivePushes {
public:
    explicit ActivePushes(PushSystem& system) : system_(system) {
        for (std::size_t k = 0; k < system.pushes(); ++k) {
            impulse_.push_back(std::max(0.0, system.guess(k)));
            active_.push_back(impulse_.back() > 0.0);
        }
    }

    std::optional<PushSolution> run() {
        int before = std::numeric_limits<int>::max();
        for (int round = 0; round < k_most_rounds; ++round) {
            if (!hold()) return {};
            const int changed = change();
            if (changed == 0 && exact()) return PushSolution{speed_, impulse_};
            if (changed == 0 || changed >= before) return {};
            before = changed;
        }
        return {};
    }

private:
    /// Speeds at which all active pushes open as little as they may.
    bool hold() {
        Numbers weights;
        for (const char active : active_) weights.push_back(active ? k_stiff : 0.0);
        if (!system_.factorise(weights)) return false;
        double before = std::numeric_limits<double>::infinity();
        for (int pass = 0; pass < k_most_passes; ++pass) {
            const double missed = improve();
            if (missed < k_met || missed > k_part * before) break;
            before = missed;
        }
        return true;
    }

    /// One pass of the method of multipliers. What the active pushes have missed before it, at the most.
    double improve() {
        Numbers right(system_.rows());
        for (std::size_t k = 0; k < right.size(); ++k) right[k] = system_.mass(k) * system_.free(k);
        for (std::size_t k = 0; k < impulse_.size(); ++k) {
            if (active_[k]) system_.give(k, impulse_[k] + k_stiff * system_.least(k), right);
        }
        speed_ = system_.solve(right);
        double most = 0.0;
        for (std::size_t k = 0; k < impulse_.size(); ++k) {
            if (!active_[k]) continue;
            const double missed = system_.least(k) - system_.opening(k, speed_);
            impulse_[k] += k_stiff * missed;
            most = std::max(most, std::abs(missed));
        }
        return most;
    }

    /// Lets go and adds. How many?
    int change() {
        int changed = 0;
        for (std::size_t k = 0; k < impulse_.size(); ++k) {
            const bool pulls = active_[k] && impulse_[k] < 0.0;
            const bool closes = !active_[k] && system_.opening(k, speed_) < system_.least(k) - k_exact;
            if (!pulls && !closes) continue;
            impulse_[k] = 0.0;
            active_[k] = closes;
            ++changed;
        }
        return changed;
    }

    bool exact() {
        system_.find_unbalanced(speed_, impulse_, unbalanced_);
        if (std::any_of(unbalanced_.begin(), unbalanced_.end(), [](double r) { return !(std::abs(r) < k_exact); })) {
            return false;
        }
        for (std::size_t k = 0; k < impulse_.size(); ++k) {
            if (active_[k] && !(std::abs(system_.opening(k, speed_) - system_.least(k)) < k_exact)) return false;
        }
        return true;
    }

    PushSystem& system_;
    Numbers speed_, impulse_, unbalanced_;
    std::vector<char> active_;
};

}  // namespace

std::optional<PushSolution> solve_active(PushSystem& system) { return ActivePushes(system).run(); }

}  // namespace polargrain
