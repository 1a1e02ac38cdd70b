#include <fmt/format.h>

#include "src/cli/commands.h"
#include "src/cli/prepared_run.h"
#include "src/cli/run_folder.h"
#include "src/cli/run_report.h"
#include "src/cli/run_session.h"
#include "src/core/error.h"

namespace polargrain {

namespace fs = std::filesystem;

int run_command(const RunRequest& request) {
    PreparedRun run = prepare_run(request.scenario, request.overrides);
    const fs::path folder = request.folder ? *request.folder : fs::path("out") / run.file.stem();
    const auto check = [&] {
        check_scenario_stays(folder, run.file, run.scenario.resolved_toml);
        check_run_folder(folder, request.force);
    };
    check();
    warn_of_large_step(run.time_step);
    if (!request.quiet && !request.brief) print_plan(run.scenario, run.time_step, run.notes);

    const FolderLock lock = claim_folder(folder, check);
    std::error_code absent;
    const bool in_place = fs::equivalent(folder / "scenario.toml", run.file, absent);
    clear_run_folder(folder);
    const RunSession session{.folder = folder,
                             .program = request.program,
                             .quiet = request.quiet,
                             .brief = request.brief,
                             .repeat_line = request.repeat_line};
    try {
        return run_session(session, lock, run);
    } catch (const InputError& error) {
        if (!in_place) discard_run_folder(folder);
        throw InputError(SourceLocation{.file = run.file.string(), .line = 0, .column = 0}, error.what());
    } catch (const std::exception& error) {
        if (!request.repeat_line.empty()) throw RunError(fmt::format("{}\n{}", error.what(), session.way_on()));
        throw RunError(fmt::format("{}\nwhat was written before is in {}\n{}\nto repeat it: {}{}", error.what(),
                                   folder.string(), session.way_on(), request.command_line,
                                   request.force ? "" : " --force"));
    }
}

}  // namespace polargrain
