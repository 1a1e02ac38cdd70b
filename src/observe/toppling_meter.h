#pragma once

#include <string>
#include <vector>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"

namespace polargrain {

/// The wave of toppling dominoes. [HN94, sec. 4.1, Figs. 10-11]
///
/// A grain has toppled when it has turned by 0.02 rad from where it stood; those that have are put in the order in
/// which they stood along x, as the wave runs. Nothing has toppled where the grains are no dominoes in a row: where one
/// of them is a disk, or their centres are not at one height at time zero, to a tenth of their mean.
class TopplingMeter {
public:
    enum class Measure { speed, run_in };

    explicit TopplingMeter(const Scene& scene, Measure measure = Measure::speed);

    void step(const World& world, double dt, const StepReport& report);

    /// Natural speed V / sqrt(g L) over the second half, the wave being steady there: distance of the first from the
    /// last, over the time between them. L is the height of the first grain of that half: twice that of its centre of
    /// mass above the lowest point of the scene at time zero. NaN where fewer than four grains have toppled.
    double speed() const;
    /// How many grains topple before the wave is steady: at the first one after them, and at every later one, the mean
    /// speed over the five pitches about it (two behind, three ahead) is within 5 % of that over the second half. NaN
    /// where fewer than twelve have toppled.
    double run_in() const;
    double read(const Sample& /*sample*/) const { return measure_ == Measure::speed ? speed() : run_in(); }

    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    /// Those that have toppled, from where the wave comes to where it goes.
    std::vector<std::size_t> toppled_in_order() const;
    /// Mean speed between two grains [m/s].
    double between(std::size_t first, std::size_t last) const;

    Measure measure_;
    std::vector<double> stood_at_, height_, angle_;
    std::vector<double> toppled_at_;  ///< [s]; negative: stands yet
    double gravity_ = 0.0;
    bool in_a_row_ = false;
};

}  // namespace polargrain
