#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <system_error>
#include <vector>

#include "src/cli/commands.h"
#include "src/cli/prepared_run.h"
#include "src/cli/run_folder.h"
#include "src/cli/verification.h"
#include "src/core/error.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// A new folder in the one that the system has for what need not be kept.
fs::path temporary_folder() {
    std::error_code failed;
    std::string made = (fs::temp_directory_path(failed) / "polargrain-verify-XXXXXX").string();
    if (!failed && mkdtemp(made.data()) == nullptr) failed = {errno, std::generic_category()};
    if (!failed) return made;
    const char* given = std::getenv("TMPDIR");
    throw InputError(fmt::format(
        "cannot make a folder for the runs in the temporary one, {}: {}; set TMPDIR to a folder in which you "
        "may write, or keep the runs with -o DIR",
        given != nullptr ? fmt::format("TMPDIR={}", given) : "/tmp", failed.message()));
}

/// Where the run folders go: the given place, or one that is gone in the end.
class RunPlace {
public:
    explicit RunPlace(const std::optional<fs::path>& given)
        : path_(given ? *given : temporary_folder()), kept_(given.has_value()) {}
    ~RunPlace() {
        std::error_code ignored;
        if (!kept_) fs::remove_all(path_, ignored);
    }
    RunPlace(const RunPlace&) = delete;
    RunPlace& operator=(const RunPlace&) = delete;

    const fs::path& path() const { return path_; }
    bool kept() const { return kept_; }

private:
    fs::path path_;
    bool kept_;
};

/// A scenario to be verified, read and checked.
struct Task {
    std::string given;
    std::string name;
    Scenario scenario;
};

std::vector<Task> read_tasks(const VerifyRequest& request) {
    std::vector<Task> tasks;
    std::set<std::string> names;
    for (const std::string& given : request.scenarios) {
        PreparedRun run = prepare_run(given, request.overrides);
        require_seeds(run.scenario, request.seeds);
        if (run.scenario.expectations.empty()) {
            throw InputError(SourceLocation{.file = run.file.string(), .line = 0, .column = 0},
                             "has no [[expect]] entries, so there is nothing to verify; say what a correct run shows, "
                             "for example\n[[expect]]\nquantity = \"deepest_overlap\"\nmax = 1e-6\n"
                             "(docs/scenario.md, and polargrain list observables)");
        }
        Task task{given, run.file.stem().string(), std::move(run.scenario)};
        require(names.insert(task.name).second, "two scenarios are called {}: verify them one at a time", task.name);
        tasks.push_back(std::move(task));
    }
    return tasks;
}

std::uint64_t seed_of(const Task& task, int k) { return task.scenario.scene.seed + static_cast<std::uint64_t>(k); }

fs::path folder_of(const RunPlace& place, const VerifyRequest& request, const Task& task, int k) {
    return place.path() / (request.seeds == 1 ? task.name : fmt::format("{}-seed{}", task.name, seed_of(task, k)));
}

/// Runs the scenario with the k-th seed; the exit code of the run.
int run_once(const VerifyRequest& request, const Task& task, int k, const RunPlace& place) {
    RunRequest run;
    run.scenario = task.given;
    run.overrides = request.overrides;
    run.overrides.seed = seed_of(task, k);
    if (!place.kept()) {
        run.overrides.no_frames = true;
        run.overrides.set.emplace_back("output.trajectory.every=0");
    }
    run.folder = folder_of(place, request, task, k);
    run.force = request.force;
    run.quiet = request.quiet;
    run.brief = true;
    // Resuming one run would verify nothing.
    run.repeat_line = request.command_line + (place.kept() && !request.force ? " --force" : "");
    return run_command(run);
}

}  // namespace

int verify_command(const VerifyRequest& request) {
    const std::vector<Task> tasks = read_tasks(request);
    const RunPlace place(request.folder);
    const fs::path table = place.path() / "verify.csv";
    require(request.force || !fs::exists(table),
            "{}: is there already; give another folder with -o, or --force to "
            "replace it",
            table.string());
    for (const Task& task : tasks) {
        for (int k = 0; k < request.seeds; ++k) check_run_folder(folder_of(place, request, task, k), request.force);
    }
    std::vector<Verification> verifications;
    bool all_hold = true;
    for (const Task& task : tasks) {
        Verification verification = begin_verification(task.name, task.scenario);
        for (int k = 0; k < request.seeds; ++k) {
            if (!request.quiet) {
                fmt::print("{} ({} of {}), seed {}\n", task.name, verifications.size() + 1, tasks.size(),
                           seed_of(task, k));
            }
            std::fflush(stdout);
            const int ended = run_once(request, task, k, place);
            if (ended != k_exit_done) return ended;
            add_run(verification, task.scenario, folder_of(place, request, task, k));
        }
        fmt::print("{}", verification_table(verification));
        std::fflush(stdout);
        all_hold = all_hold && verification.holds();
        verifications.push_back(std::move(verification));
    }
    if (place.kept()) {
        TextFile file(table);
        file.write(verification_csv(verifications));
        file.close();
        fmt::print("run folders and verify.csv are in {}\n", place.path().string());
    }
    return all_hold ? k_exit_done : k_exit_failed;
}

}  // namespace polargrain
