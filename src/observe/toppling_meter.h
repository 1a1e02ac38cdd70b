#pragma once

#include <string>
#include <vector>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"

namespace polargrain {

/// Speed of a wave of toppling dominoes, V / sqrt(g L). [HN94, sec. 4.1, Figs. 10-11]
///
/// A grain has toppled when it has turned by 0.02 rad from where it stood. Taken over the second half of the grains
/// that have toppled, ordered by where they stood along x, the wave being steady there: distance of the first from the
/// last, over the time between them. L is the height of the first grain of that half: twice that of its centre of mass
/// above the lowest point of the scene at time zero.
class TopplingMeter {
public:
    explicit TopplingMeter(const Scene& scene);

    void step(const World& world, double dt, const StepReport& report);

    /// Dimensionless; NaN where fewer than four grains have toppled.
    double speed() const;
    double read(const Sample& /*sample*/) const { return speed(); }

    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    std::vector<double> stood_at_, height_, angle_;
    std::vector<double> toppled_at_;  ///< [s]; negative: stands yet
    double gravity_ = 0.0;
};

}  // namespace polargrain
