#include "src/cli/prepared_run.h"

#include "src/core/error.h"

namespace polargrain {

namespace {

constexpr const char* k_no_grains = "the scenario has no grains, so that there is nothing to see";

}  // namespace

PreparedRun prepare_run(const std::string& scenario, const ScenarioOverrides& overrides) {
    std::filesystem::path file = find_scenario(scenario);
    Scenario loaded = load_scenario(file, overrides);
    const bool empty = loaded.scene.grains.empty();
    try {
        require(!empty || loaded.run.time_step, "{}; add some with [[grains]], [[rows]] or [[fill]]", k_no_grains);
        const EngineEntry& engine = find_engine(loaded.run.engine);
        const std::unique_ptr<Engine> asked = engine.make(loaded.scene, loaded.engines);
        TimeStep time_step = choose_time_step(loaded.run, *asked);
        // Asked here for the sake of their own checks, so that nothing is written, nor deleted, for a run that can
        // never begin or end.
        asked->check_dt(time_step.dt);
        step_count(loaded.run.duration, time_step.dt);
        std::vector<std::string> notes = asked->notes();  // while the scene is still where the engine knows it
        if (empty) notes.emplace_back(k_no_grains);
        return {std::move(file), std::move(loaded), engine, std::move(time_step), std::move(notes)};
    } catch (const InputError& error) {
        throw InputError(SourceLocation{.file = file.string(), .line = 0, .column = 0}, error.what());
    }
}

void require_seeds(const Scenario& scenario, int seeds) {
    const auto first = static_cast<std::int64_t>(scenario.scene.seed);
    require(first <= k_largest_seed - (seeds - 1),
            "--seeds {}: there are not so many from run.seed = {} on; begin below {}", seeds, first,
            k_largest_seed - (seeds - 1));
}

}  // namespace polargrain
