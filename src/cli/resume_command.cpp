#include <fmt/format.h>

#include "src/cli/commands.h"
#include "src/cli/prepared_run.h"
#include "src/cli/run_session.h"
#include "src/cli/shell_words.h"
#include "src/core/error.h"
#include "src/record/folder_lock.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// None where the run was killed before it had written its first.
std::optional<LabelledCheckpoint> last_checkpoint(const RunSession& session) {
    if (!fs::exists(session.checkpoint_file())) {
        const std::string folder = session.folder.string();
        require(!fs::exists(session.folder / "summary.json"),
                "{}: is gone, and without it a run that has come to its end cannot be carried on; bring it back, or "
                "run all of it again: {} run {} -o {} --force",
                session.checkpoint_file().string(), shell_quoted(session.program),
                shell_quoted(session.scenario_file().string()), shell_quoted(folder));
        return std::nullopt;
    }
    return read_checkpoint(session.checkpoint_file());
}

std::string where(const RunSession& session, const std::optional<LabelledCheckpoint>& saved, double duration) {
    const std::string folder = session.folder.string();
    if (!saved) return fmt::format("{}: no checkpoint yet; the run starts from its beginning", folder);
    if (time_reached(*saved) < 0.0) return fmt::format("{}: carried on while the grains settle", folder);
    return fmt::format("{}: carried on from t = {:.6g} of {:.6g} s", folder, time_reached(*saved), duration);
}

}  // namespace

int resume_command(const ResumeRequest& request) {
    RunSession session{.folder = request.folder, .program = request.program, .quiet = request.quiet};
    require(fs::is_regular_file(session.scenario_file()),
            "{}: is no run folder, there is no scenario.toml in it; give a folder that polargrain run has made",
            request.folder.string());
    const FolderLock lock(session.folder);
    const std::optional<LabelledCheckpoint> saved = last_checkpoint(session);
    ScenarioOverrides overrides;
    if (request.until) {
        require(!saved || *request.until >= time_reached(*saved),
                "--until {}: the run is at t = {} s already; give a later time", *request.until,
                saved ? time_reached(*saved) : 0.0);
        overrides.laid.push_back(
            {fmt::format("run.duration={:.17g}", *request.until), {fmt::format("--until {}", *request.until)}});
    }
    PreparedRun run = prepare_run(session.scenario_file().string(), overrides);
    // Not as an override: the scenario of the run stays what it was.
    if (request.threads) run.scenario.scene.threads = *request.threads;
    const double duration = run.scenario.run.duration;
    require(!saved || request.until || time_reached(*saved) < duration + run.time_step.dt,
            "{}: run.duration is {:.6g} s, and the run is at t = {:.6g} s already; give the time that it was, or a "
            "later one",
            session.scenario_file().string(), duration, saved ? time_reached(*saved) : 0.0);
    session.opening_line = where(session, saved, duration);
    try {
        return run_session(session, lock, run, saved ? &*saved : nullptr);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw RunError(fmt::format("{}\n{}", error.what(), session.way_on()));
    }
}

}  // namespace polargrain
