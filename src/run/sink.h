#pragma once

#include <string>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"

namespace polargrain {

/// What is known before the first step.
struct RunInfo {
    std::string title;
    std::string source;
    std::string engine;
    double dt = 0.0;        ///< [s]
    double duration = 0.0;  ///< [s]
    Energy initial;         ///< at time zero
    double lowest = 0.0;    ///< height from which potential energy is counted in ratios [m], see Drop
};

/// Takes what a run produces: a file writer, a painter of frames, a meter. Called from one thread, in order.
class Sink {
public:
    virtual ~Sink() = default;

    /// Interval between samples [s] of simulated time; 0: none but the first and the last.
    virtual double every() const = 0;

    virtual void begin(const Scene& scene, const RunInfo& info) = 0;

    /// Puts everything that later samples depend on beside the run itself: sums, counts, places in files. What was
    /// handed over before is on the disk when this returns.
    virtual void save(Checkpoint& /*checkpoint*/) {}

    /// Whether resume can take up what save has put there: InputError where what is on the disk is not what the
    /// checkpoint was made of. Changes nothing.
    virtual void check(const Scene& /*scene*/, const Checkpoint& /*saved*/) const {}

    /// In place of begin where a run goes on from a checkpoint: takes up what save has put there, and cuts off what
    /// was written after it. Until the first call of save that follows, the same checkpoint can be gone back to again.
    /// scene: as at time zero. InputError where what is on the disk is not what the checkpoint was made of.
    virtual void resume(const Scene& scene, const RunInfo& info, const Checkpoint& /*saved*/) { begin(scene, info); }

    /// After every step, before a sample of the same instant. Keep it cheap.
    virtual void step(const World& /*world*/, double /*dt*/, const StepReport& /*report*/) {}

    /// At time zero, at the first step at or after each multiple of every(), and at the end.
    virtual void sample(const Sample& sample) = 0;

    /// Once, after the last sample, also when the run was interrupted. All that was handed over is on the disk when
    /// this returns; whatever the system reports late is an error here.
    virtual void end() {}
};

}  // namespace polargrain
