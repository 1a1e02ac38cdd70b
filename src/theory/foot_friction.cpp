#include "src/theory/foot_friction.h"

#include <cmath>
#include <limits>

namespace polargrain {

namespace {

/// How the closing and the sliding speed at the contact change per normal impulse. Mass and height of a domino are 1.
struct BlowRates {
    double closing, sliding;
};

class DominoBlow {
public:
    DominoBlow(const DominoRow& row, StrikerFoot striker)
        : row_(row),
          height_(std::sqrt(1.0 - row.gap * row.gap)),
          about_foot_((1.0 + row.thickness * row.thickness) / 3) {
        // The arm of the striking corner: from the foot, or from the centre of mass.
        arm_x_ = row.gap;
        arm_y_ = height_;
        striker_inertia_ = about_foot_;
        if (striker == StrikerFoot::free) {
            arm_x_ = 0.5 * (row.thickness * height_ + row.gap);
            arm_y_ = 0.5 * (height_ - row.thickness * row.gap);
            striker_inertia_ = 0.25 * about_foot_;
            inverse_mass_ = 1.0;
        }
    }

    /// friction: upwards on the corner, over the normal impulse.
    BlowRates rates(double friction) const {
        const double turn = (arm_x_ * friction + arm_y_) / striker_inertia_;
        const double turn_struck = (row_.thickness * friction - height_) / about_foot_;
        return {-inverse_mass_ - turn * arm_y_ + turn_struck * height_,
                inverse_mass_ * friction + turn * arm_x_ + row_.thickness * turn_struck};
    }

    /// Friction that keeps a corner that has stopped where it is, or else that under which it goes back up.
    double friction_once_stopped() const {
        const double none = rates(0.0).sliding;
        const double sticks = -none / (rates(1.0).sliding - none);
        return std::abs(sticks) <= row_.friction ? sticks : -row_.friction;
    }

    /// Of the floor on the struck foot, along over across, after these impulses on the struck face.
    double asked_of_the_floor(double normal, double friction) const {
        const double turn = (height_ * normal - row_.thickness * friction) / about_foot_;
        const double along = 0.5 * turn - normal;
        const double across = 0.5 * row_.thickness * turn + friction;
        return across > 0.0 ? std::abs(along) / across : std::nan("");
    }

    double height() const { return height_; }

private:
    DominoRow row_;
    double height_;      ///< of the contact
    double about_foot_;  ///< inertia of a domino about its foot
    double arm_x_ = 0.0, arm_y_ = 0.0, striker_inertia_ = 0.0, inverse_mass_ = 0.0;
};

}  // namespace

double foot_friction(const DominoRow& row, StrikerFoot striker) {
    check(row);
    const DominoBlow blow(row, striker);
    // The corner turns about its foot at rate 1: forwards, and down along the face.
    double closing = blow.height(), sliding = -row.gap;
    double slope = row.friction, normal = 0.0, friction = 0.0;
    double taken = 0.0;  // by the normal impulse: what compression takes, what restitution has still to give back
    bool compressing = true;
    for (bool slides = true;;) {
        const BlowRates rate = blow.rates(slope);
        const double to_stop =
            slides && rate.sliding > 0.0 ? -sliding / rate.sliding : std::numeric_limits<double>::infinity();
        const double to_end =
            compressing ? -closing / rate.closing
                        : (-closing - std::sqrt(closing * closing - 2.0 * rate.closing * taken)) / rate.closing;
        const double impulse = std::fmin(to_stop, to_end);
        taken += impulse * (closing + 0.5 * rate.closing * impulse);
        closing += impulse * rate.closing;
        sliding += impulse * rate.sliding;
        normal += impulse;
        friction += slope * impulse;
        if (to_stop < to_end) {
            slides = false;
            slope = blow.friction_once_stopped();
        } else if (compressing) {
            compressing = false;
            closing = 0.0;
            taken *= row.restitution * row.restitution;
        } else {
            return blow.asked_of_the_floor(normal, friction);
        }
    }
}

}  // namespace polargrain
