#include "src/theory/domino_chain.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "src/core/error.h"

namespace polargrain {

namespace {

constexpr double k_quarter_turn = 1.5707963267948966;
/// Closing speed below which an impact is plastic, so that leaning dominoes do not chatter for ever.
constexpr double k_plastic_below = 1e-3;
constexpr double k_latest = 200.0;

class Chain {
public:
    Chain(const DominoRow& row, int count)
        : row_(row),
          pitch_(row.gap + row.thickness),
          inertia_((1.0 + row.thickness * row.thickness) / 3.0),
          angle_(static_cast<std::size_t>(count), 0.0),
          rate_(static_cast<std::size_t>(count), 0.0),
          struck_(static_cast<std::size_t>(count), -1.0) {
        rate_[0] = 1.0;
        struck_[0] = 0.0;
    }

    void fall(double dt) {
        for (std::size_t i = 0; i < angle_.size(); ++i) {
            if (angle_[i] <= 0.0 && rate_[i] <= 0.0) continue;
            rate_[i] += dt * (std::sin(angle_[i]) - row_.thickness * std::cos(angle_[i])) / (2.0 * inertia_);
            angle_[i] += dt * rate_[i];
            if (angle_[i] < 0.0) {
                angle_[i] = 0.0;
                rate_[i] = std::fmax(rate_[i], 0.0);
            }
            if (angle_[i] > k_quarter_turn) {
                angle_[i] = k_quarter_turn;
                rate_[i] = 0.0;
            }
        }
    }

    void collide(double time) {
        find_meetings();
        bool any = true;
        for (int pass = 0; any && pass < 50; ++pass) {
            any = false;
            for (const Meeting& m : meetings_) any = strike(m, time) || any;
        }
    }

    bool done() const { return struck_.back() >= 0.0; }

    /// The last pitch is left out: the last domino falls with nothing behind it to be held up by.
    double speed() const {
        const std::size_t first = struck_.size() / 2;
        const std::size_t last = struck_.size() - 2;
        return pitch_ * static_cast<double>(last - first) / (struck_[last] - struck_[first]);
    }

private:
    /// A domino whose top corner is on the face of the next; how far each turns per unit of relative motion there.
    struct Meeting {
        std::size_t i;
        double sine, arm, arm_next;
    };

    /// From the front backwards. Angles stay as they are while impacts are exchanged.
    void find_meetings() {
        meetings_.clear();
        for (std::size_t i = angle_.size() - 1; i-- > 0;) {
            if (angle_[i] <= 0.0) continue;
            const double sine = std::sin(angle_[i] - angle_[i + 1]);
            if (pitch_ * std::cos(angle_[i + 1]) - sine - row_.thickness > 0.0) continue;
            const double cosine = std::cos(angle_[i] - angle_[i + 1]);
            meetings_.push_back({i, sine, cosine, cosine - pitch_ * std::sin(angle_[i + 1])});
        }
    }

    /// False where the two do not close.
    bool strike(const Meeting& m, double time) {
        double& rate = rate_[m.i];
        double& next = rate_[m.i + 1];
        const double closing = m.arm * rate - m.arm_next * next;
        if (closing <= 1e-12) return false;
        const double sliding = -rate * m.sine - row_.thickness * next;
        const double slope = sliding > 0.0 ? -row_.friction : sliding < 0.0 ? row_.friction : 0.0;
        const double turn = m.arm + slope * m.sine;
        const double turn_next = m.arm_next - slope * row_.thickness;
        const double e = closing < k_plastic_below ? 0.0 : row_.restitution;
        const double impulse = (1.0 + e) * closing * inertia_ / (turn * m.arm + turn_next * m.arm_next);
        rate -= impulse * turn / inertia_;
        next += impulse * turn_next / inertia_;
        if (struck_[m.i + 1] < 0.0) struck_[m.i + 1] = time;
        return true;
    }

    DominoRow row_;
    double pitch_, inertia_;
    std::vector<double> angle_, rate_, struck_;
    std::vector<Meeting> meetings_;
};

}  // namespace

double pinned_chain_speed(const DominoRow& row, int count, double dt) {
    check(row);
    require(count >= 4, "a chain of {} dominoes has no steady part; take four at least", count);
    Chain chain(row, count);
    for (std::int64_t step = 0; !chain.done() && static_cast<double>(step) * dt < k_latest; ++step) {
        chain.fall(dt);
        chain.collide(static_cast<double>(step) * dt);
    }
    return chain.done() ? chain.speed() : std::nan("");
}

}  // namespace polargrain
