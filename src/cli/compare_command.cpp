#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "render/frame_style.h"
#include "render/movie.h"
#include "render/side_by_side.h"
#include "src/cli/commands.h"
#include "src/cli/interrupt.h"
#include "src/cli/made_of_run.h"
#include "src/cli/messages.h"
#include "src/cli/prepared_run.h"
#include "src/cli/progress_display.h"
#include "src/cli/run_folder.h"
#include "src/compare/comparison.h"
#include "src/compare/jitter.h"
#include "src/core/error.h"
#include "src/core/nearest_name.h"
#include "src/plot/plot.h"
#include "src/record/text_file.h"
#include "src/run/settle.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// Readings over a run: enough for a curve, and few enough that measuring costs less than running.
constexpr double k_readings = 200.0;
constexpr int k_most_frames = 400;
constexpr double k_movie_rate = 25.0;  // frames per second
constexpr const char* k_frames = "frames";
/// What a comparison leaves in its folder.
constexpr std::array k_comparison_files{"report.md",       "values.csv",      "series.csv", "observables.csv",
                                        "observables.png", "observables.pdf", "movie.mp4",  k_frames};

/// Raised between two steps when a signal has come.
struct Stopped {};

void require_known(const std::string& engine) {
    std::vector<std::string> names;
    for (const EngineEntry& entry : engine_table()) names.push_back(entry.name);
    if (std::ranges::find(names, engine) != names.end()) return;
    const std::string nearest = nearest_name(engine, names);
    throw InputError(fmt::format("--engines: there is no engine \"{}\"; {}choose among {}", engine,
                                 nearest.empty() ? "" : "did you mean \"" + nearest + "\"? ", fmt::join(names, ", ")));
}

class CompareSession {
public:
    explicit CompareSession(const CompareRequest& request)
        : request_(request), mode_(display_mode(request.quiet)), engines_(request.engines) {
        if (engines_.empty()) engines_ = {"contact", "contact-1994", "box2d"};
        for (const std::string& engine : engines_) require_known(engine);
        require(std::set(engines_.begin(), engines_.end()).size() == engines_.size(),
                "--engines: an engine is named twice; name each once");
        require(engines_.size() >= 2, "--engines: names one engine only; a comparison needs two at least");
        for (const std::string& engine : engines_) first_runs_.push_back(prepare(engine, {}));
        require_seeds(first_runs_.front().scenario, request.seeds + 1);  // one more, to see what a seed changes
        varies_ = !seed_matters();
        plan_clock();
    }

    const fs::path& file() const { return first_runs_.front().file; }
    Comparison run();
    void draw(const Comparison& comparison, const fs::path& folder) const;

private:
    PreparedRun prepare(const std::string& engine, std::optional<std::uint64_t> seed) const;
    bool seed_matters() const;
    void plan_clock();
    std::string initial_states() const;
    Scene initial_scene(std::uint64_t seed);
    Track track(const PreparedRun& run, const Scene& scene, int seed_number);
    LoopControl control(ProgressDisplay& display) const {
        return {.stop = &watch_interrupts(), .progress = [&display](const Progress& p) { display.show(p); }};
    }
    std::string label(const char* what, int seed_number) const {
        return fmt::format("seed {} of {}, {}", seed_number + 1, request_.seeds, what);
    }

    const CompareRequest& request_;
    DisplayMode mode_;
    std::vector<std::string> engines_;
    std::vector<PreparedRun> first_runs_;  ///< by engine, of the scenario's own seed
    bool varies_ = false;                  ///< the seed does not: each initial state is made its own by a jitter
    Clock clock_;
    Scene first_scene_;  ///< of the first seed at time zero, for pictures
};

PreparedRun CompareSession::prepare(const std::string& engine, std::optional<std::uint64_t> seed) const {
    ScenarioOverrides overrides = request_.overrides;
    overrides.engine = engine;
    if (seed) overrides.seed = seed;
    return prepare_run(request_.scenario, overrides);
}

bool CompareSession::seed_matters() const {
    const Scene& scene = first_runs_.front().scenario.scene;
    const PreparedRun next = prepare(engines_.front(), scene.seed + 1);
    return state_hash(initial_world(scene)) != state_hash(initial_world(next.scenario.scene));
}

void CompareSession::plan_clock() {
    const Scenario& scenario = first_runs_.front().scenario;
    double largest_step = 0.0;
    for (const PreparedRun& run : first_runs_) largest_step = std::max(largest_step, run.time_step.dt);
    clock_.every = std::max(scenario.run.duration / k_readings, largest_step);
    const double frames = scenario.output.frames.every;
    clock_.moments_every = frames > 0.0 ? std::max({frames, largest_step, scenario.run.duration / k_most_frames}) : 0.0;
}

std::string CompareSession::initial_states() const {
    std::string text;
    if (request_.seeds > 1) {
        text = varies_ ? fmt::format(
                             "The scene does not depend on the seed: from the second on, each grain gets a random "
                             "velocity of {:.0g} sqrt(g R).",
                             k_jitter)
                       : "Each seed draws its own initial state.";
    }
    if (first_runs_.front().scenario.settle) {
        text += fmt::format(" The grains were settled by {}; no engine takes over contacts.", engines_.front());
    }
    return text;
}

/// The state from which all engines start.
Scene CompareSession::initial_scene(std::uint64_t seed) {
    const auto number = static_cast<int>(seed - first_runs_.front().scenario.scene.seed);
    PreparedRun run = prepare(engines_.front(), seed);
    if (run.scenario.settle) {
        ProgressDisplay display(label("settling", number), mode_);
        Settled settled = settle(
            run.scenario.scene, *run.scenario.settle, run.time_step.dt,
            [&run](const Scene& scene) { return run.make_engine(scene); }, control(display));
        if (settled.stopped) throw Stopped{};
        run.scenario.scene.grains = std::move(settled.grains);
    }
    if (varies_ && number > 0) add_jitter(run.scenario.scene);
    return run.scenario.scene;
}

Track CompareSession::track(const PreparedRun& run, const Scene& scene, int seed_number) {
    const std::string& engine = run.scenario.run.engine;
    ProgressDisplay display(label(engine.c_str(), seed_number), mode_);
    const std::unique_ptr<Engine> with = run.make_engine(scene);
    Meters meters(scene, run.scenario.expectations, run.scenario.output.observe, run.scenario.run.duration);
    Clock clock = clock_;
    if (seed_number > 0) clock.moments_every = 0.0;
    bool interrupted = false;
    try {
        Track track = follow(scene, *with, run.time_step.dt, run.scenario.run.duration, meters, clock, control(display),
                             interrupted);
        if (interrupted) throw Stopped{};
        return track;
    } catch (const InputError& error) {
        throw InputError(SourceLocation{.file = run.file.string(), .line = 0, .column = 0}, error.what());
    } catch (const RunError& error) {
        throw RunError(fmt::format("{} (seed {})", error.what(), scene.seed));
    }
}

Comparison CompareSession::run() {
    Comparison comparison;
    comparison.title = first_runs_.front().scenario.title;
    comparison.initial_states = initial_states();
    comparison.clock = clock_;
    comparison.engines = engines_;
    comparison.tracks.resize(engines_.size());
    for (const PreparedRun& run : first_runs_) comparison.notes.push_back(run.notes);
    for (int number = 0; number < request_.seeds; ++number) {
        const Scene scene = initial_scene(first_runs_.front().scenario.scene.seed + static_cast<std::uint64_t>(number));
        if (number == 0) first_scene_ = scene;
        for (std::size_t e = 0; e < engines_.size(); ++e) {
            comparison.tracks[e].push_back(track(first_runs_[e], scene, number));
        }
    }
    return comparison;
}

void CompareSession::draw(const Comparison& comparison, const fs::path& folder) const {
    if (clock_.moments_every == 0.0) return;
    const Scenario& scenario = first_runs_.front().scenario;
    const FrameStyle style = side_by_side_style(make_frame_style(scenario.output.frames, first_scene_, scenario.title),
                                                static_cast<int>(engines_.size()));
    std::size_t count = comparison.tracks[0][0].moments.size();
    for (const auto& tracks : comparison.tracks) count = std::min(count, tracks[0].moments.size());
    make_folder(folder / k_frames);
    std::unique_ptr<Movie> movie;
    if (can_make_movies()) {
        movie = std::make_unique<Movie>(folder / "movie.mp4", style, k_movie_rate);
    } else if (mode_ != DisplayMode::none) {
        fmt::print("no movie: ffmpeg is not installed\n");
    }
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<NamedPicture> pictures;
        for (std::size_t e = 0; e < engines_.size(); ++e) {
            const Moment& moment = comparison.tracks[e][0].moments[k];
            pictures.push_back({engines_[e], picture_of(first_scene_, moment.world, moment.report)});
        }
        draw_side_by_side(pictures, style,
                          folder / k_frames / fmt::format("{:06}.{}", k, scenario.output.frames.format));
        if (movie) movie->add(pictures);
    }
    if (movie) movie->finish();
}

/// Whether an earlier comparison has left its files in the folder.
bool holds_comparison(const fs::path& folder) {
    return fs::exists(folder / "report.md") && fs::exists(folder / "values.csv");
}

void check_comparison_folder(const fs::path& folder, bool force) {
    check_place(folder);
    if (!fs::exists(folder) || fs::is_empty(folder)) return;
    require(force, "{}: the folder is not empty; give another with -o, or --force to replace the comparison in it",
            folder.string());
    if (holds_comparison(folder)) return;
    for (const char* name : k_comparison_files) {
        require(!fs::exists(folder / name),
                "{}: there is no comparison in the folder, but {}, which one would replace; give another with -o",
                folder.string(), name);
    }
}

void clear_comparison(const fs::path& folder) {
    if (!holds_comparison(folder)) return;
    if (fs::is_directory(folder / k_frames)) remove_frames(folder / k_frames);
    for (const char* name : k_comparison_files) {
        if (!fs::is_directory(folder / name)) fs::remove(folder / name);
    }
    remove_if_empty(folder / k_frames);
}

/// The folder of a comparison, kept from before the first run; where nothing comes of it, an empty one goes again.
class ClaimedFolder {
public:
    ClaimedFolder(const fs::path& folder, bool force)
        : folder_(folder), lock_(claim_folder(folder, [&] { check_comparison_folder(folder, force); })) {}
    ~ClaimedFolder() { remove_if_empty(folder_); }
    ClaimedFolder(const ClaimedFolder&) = delete;
    ClaimedFolder& operator=(const ClaimedFolder&) = delete;

private:
    fs::path folder_;
    FolderLock lock_;
};

}  // namespace

int compare_command(const CompareRequest& request) {
    CompareSession session(request);
    const fs::path folder = request.folder.value_or(fs::path("out") / ("compare-" + session.file().stem().string()));
    require_plotting();
    const ClaimedFolder claimed(folder, request.force);
    watch_interrupts();
    try {
        const Comparison comparison = session.run();
        clear_comparison(folder);
        const std::string report = report_text(comparison);
        TextFile file(folder / "report.md");
        file.write(report);
        file.close();
        write_tables(comparison, folder);
        write_plots(comparison, folder);
        session.draw(comparison, folder);
        if (!request.quiet) fmt::print("{}\nfolder: {}\n", report, folder.string());
        return k_exit_done;
    } catch (const Stopped&) {
        tell("interrupted: a comparison is written when all its runs are done, so there is nothing yet\n");
        return k_exit_interrupted;
    }
}

}  // namespace polargrain
