#include "src/compare/track.h"

#include <cmath>
#include <ctime>

namespace polargrain {

namespace {

/// Lets another engine take the steps and measures the time they cost.
class TimedEngine final : public Engine {
public:
    explicit TimedEngine(Engine& engine) : engine_(engine) {}
    std::string_view name() const override { return engine_.name(); }
    double suggested_dt() const override { return engine_.suggested_dt(); }
    void step(World& world, double dt, StepReport& report) override {
        const std::clock_t before = std::clock();
        engine_.step(world, dt, report);
        ticks_ += std::clock() - before;
    }
    void save(Checkpoint& checkpoint) const override { engine_.save(checkpoint); }
    void load(const Checkpoint& checkpoint) override { engine_.load(checkpoint); }
    double cpu_seconds() const { return static_cast<double>(ticks_) / CLOCKS_PER_SEC; }

private:
    Engine& engine_;
    std::clock_t ticks_ = 0;
};

/// True for the first sample at or after each tick; the extra one at the end of a run is none.
class Ticks {
public:
    explicit Ticks(double every) : every_(every) {}
    bool at(double time) {
        const double tick = static_cast<double>(next_) * every_;
        if (time < tick - 1e-6 * every_) return false;
        ++next_;
        return true;
    }

private:
    double every_;
    std::int64_t next_ = 0;
};

class Reader final : public Sink {
public:
    Reader(Meters& meters, double every, Track& track) : meters_(meters), every_(every), ticks_(every), track_(track) {}
    double every() const override { return every_; }
    void begin(const Scene&, const RunInfo&) override {}
    void step(const World& world, double dt, const StepReport& report) override { meters_.step(world, dt, report); }
    void sample(const Sample& sample) override {
        if (ticks_.at(sample.world.time)) track_.readings.push_back(meters_.read(sample));
    }

private:
    Meters& meters_;
    double every_;
    Ticks ticks_;
    Track& track_;
};

class Keeper final : public Sink {
public:
    Keeper(double every, Track& track) : every_(every), ticks_(every), track_(track) {}
    double every() const override { return every_; }
    void begin(const Scene&, const RunInfo&) override {}
    void sample(const Sample& sample) override {
        if (ticks_.at(sample.world.time)) track_.moments.push_back({sample.world, sample.report});
    }

private:
    double every_;
    Ticks ticks_;
    Track& track_;
};

}  // namespace

Track follow(const Scene& scene, Engine& engine, double dt, double duration, Meters& meters, const Clock& clock,
             const LoopControl& control, bool& interrupted) {
    Track track;
    track.engine = engine.name();
    track.seed = scene.seed;
    track.dt = dt;
    track.quantities = meters.quantities();
    TimedEngine timed(engine);
    Simulation simulation(scene, timed, describe_run(scene, timed, dt, duration));
    Reader reader(meters, clock.every, track);
    simulation.add(reader);
    Keeper keeper(clock.moments_every, track);
    if (clock.moments_every > 0.0) simulation.add(keeper);
    interrupted = simulation.run(control) == Ending::interrupted;
    track.steps = simulation.state().world.step;
    track.simulated_seconds = simulation.state().world.time;
    track.cpu_seconds = timed.cpu_seconds();
    track.state_hash = state_hash(simulation.state().world);
    track.values = meters.values();
    return track;
}

}  // namespace polargrain
