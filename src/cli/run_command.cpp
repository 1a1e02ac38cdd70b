#include <fmt/format.h>

#include "src/cli/commands.h"
#include "src/cli/folder_lock.h"
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
    check_run_folder(folder, request.force);
    warn_of_large_step(run.time_step);
    if (!request.quiet && !request.brief) print_plan(run.scenario, run.time_step, run.notes);

    make_run_folder(folder);
    const FolderLock lock(folder);
    check_run_folder(folder, request.force);  // another run may have begun and ended in it by now
    clear_run_folder(folder);
    const RunSession session{folder, request.program, request.quiet, request.brief};
    try {
        return run_session(session, lock, run);
    } catch (const InputError& error) {
        discard_run_folder(folder);
        throw InputError(SourceLocation{.file = run.file.string(), .line = 0, .column = 0}, error.what());
    } catch (const std::exception& error) {
        throw RunError(
            fmt::format("{}\nwhat was written before is in {}\nto carry the run on from its last checkpoint: {}\n"
                        "to repeat it: {}{}",
                        error.what(), folder.string(), session.resume_line(), request.command_line,
                        request.force ? "" : " --force"));
    }
}

}  // namespace polargrain
