#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "scenarios/sweep_plan.h"
#include "src/cli/commands.h"
#include "src/cli/interrupt.h"
#include "src/cli/messages.h"
#include "src/cli/prepared_run.h"
#include "src/cli/progress_display.h"
#include "src/cli/run_folder.h"
#include "src/cli/shell_words.h"
#include "src/core/child_process.h"
#include "src/core/error.h"
#include "src/record/folder_lock.h"
#include "src/record/summary_reader.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds k_between_looks{20};
constexpr const char* k_table = "table.csv";
constexpr const char* k_log_ending = ".log";

/// Of the run in the folder: beside it.
fs::path log_of(const fs::path& folder) { return folder.string() + k_log_ending; }

/// One run of the sweep and its folder.
struct Job {
    SweepRun run;
    std::string name;  ///< "0007"
    fs::path folder;
    std::string scenario;  ///< resolved text that it runs, or has run
    std::unique_ptr<ChildProcess> child;
    bool done = false;
    bool failed = false;

    fs::path log() const { return log_of(folder); }
    bool begun() const { return content_of(folder / "scenario.toml") == scenario; }
    /// Whether its folder holds a run of another scenario.
    bool of_another() const { return fs::exists(folder / "scenario.toml") && !begun(); }
    /// None where there is none yet, or one that is damaged.
    std::optional<StoredSummary> summary() const {
        try {
            return read_summary(folder);
        } catch (const InputError&) {
            return std::nullopt;
        }
    }
    bool completed() const {
        if (!begun()) return false;
        const std::optional<StoredSummary> found = summary();
        return found && found->completed;
    }
};

/// What sets a run apart from the others: "materials.stone.friction=0.4, run.seed=3".
std::string combination(const SweepPlan& plan, const SweepRun& run) {
    std::string text;
    for (std::size_t k = plan.set.size(); k < run.overrides.laid.size(); ++k) {
        text += (text.empty() ? "" : ", ") + run.overrides.laid[k].text;
    }
    return text;
}

PreparedRun prepare_job(const SweepPlan& plan, const SweepRun& run) {
    try {
        return prepare_run(plan.scenario.string(), run.overrides);
    } catch (const InputError& error) {
        const std::string values = combination(plan, run);
        if (values.empty()) throw;
        throw InputError(fmt::format("{}\nso it is in the run with {}; change or leave out one of these values",
                                     error.what(), values));
    }
}

std::string name_of(std::size_t number) { return fmt::format("{:04}", number); }

std::vector<Job> jobs_of(const SweepPlan& plan, const fs::path& folder) {
    std::vector<Job> jobs;
    for (SweepRun& run : sweep_runs(plan)) {
        Job job;
        // Read here for all of them, so that a mistake in the last one shows before the first one runs.
        job.scenario = prepare_job(plan, run).scenario.resolved_toml;
        job.name = name_of(jobs.size());
        job.folder = folder / "runs" / job.name;
        job.run = std::move(run);
        jobs.push_back(std::move(job));
    }
    return jobs;
}

std::vector<std::string> words_for(const Job& job, const SweepPlan& plan) {
    const std::string program = fs::read_symlink("/proc/self/exe").string();
    if (job.begun()) return {program, "resume", job.folder.string(), "--quiet"};
    const ScenarioOverrides& overrides = job.run.overrides;
    std::vector<std::string> words{program,   "run",    plan.scenario.string(), "-o", job.folder.string(),
                                   "--quiet", "--force"};
    for (const LaidValue& value : overrides.laid) words.insert(words.end(), {"--set", value.text});
    if (overrides.no_frames) words.emplace_back("--no-frames");
    return words;
}

/// The runs on their way, so many at a time.
class Schedule {
public:
    Schedule(std::vector<Job>& jobs, const SweepPlan& plan, int at_a_time)
        : jobs_(jobs), plan_(plan), at_a_time_(at_a_time) {
        for (Job& job : jobs_) job.done = job.completed();
    }

    std::int64_t done() const {
        return std::count_if(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.done || job.failed; });
    }
    bool over() const { return done() == static_cast<std::int64_t>(jobs_.size()); }

    /// Collects what has ended and starts what there is room for.
    void look() {
        int running = 0;
        for (Job& job : jobs_) {
            if (job.child) collect(job);
            running += job.child ? 1 : 0;
        }
        for (Job& job : jobs_) {
            if (running >= at_a_time_) return;
            // A run of a sweep that was killed may be going on yet: it is left to itself, and looked at again.
            if (job.done || job.failed || job.child || !FolderLock::is_free(job.folder)) continue;
            job.done = job.completed();
            if (job.done) continue;
            job.child = std::make_unique<ChildProcess>(words_for(job, plan_), job.log());
            ++running;
        }
    }

    /// Lets each run in progress write a checkpoint and end.
    void stop() {
        for (const Job& job : jobs_) {
            if (job.child) job.child->interrupt(signal_for_children());
        }
        for (Job& job : jobs_) {
            if (job.child) job.child->wait();
            job.child.reset();
        }
    }

private:
    static void collect(Job& job) {
        const std::optional<int> code = job.child->poll();
        if (!code) return;
        job.child.reset();
        job.done = *code == k_exit_done;
        job.failed = !job.done;
        if (job.done) fs::remove(job.log());
    }

    std::vector<Job>& jobs_;
    const SweepPlan& plan_;
    int at_a_time_;
};

/// False where it was interrupted.
bool run_all(Schedule& schedule, std::int64_t count, bool quiet) {
    ProgressDisplay display("sweeping", display_mode(quiet), "runs");
    const LoopControl control{.stop = &watch_interrupts(),
                              .progress = [&display](const Progress& progress) { display.show(progress); }};
    ProgressMeter meter(control, schedule.done(), count, 1.0);
    while (!schedule.over()) {
        if (control.stop_requested()) {
            schedule.stop();
            return false;
        }
        schedule.look();
        meter.after_step(schedule.done());
        std::this_thread::sleep_for(k_between_looks);
    }
    return true;
}

/// Empty where the grains had not been asked to come to rest.
const char* settled_text(const StoredSummary& summary) {
    if (!summary.at_rest) return "";
    return *summary.at_rest ? "yes" : "no";
}

/// A row for each run; a column for each parameter and each observable that any run has; empty where one has no value.
std::string table_of(const std::vector<Job>& jobs, const SweepPlan& plan) {
    std::vector<std::optional<StoredSummary>> summaries;
    std::set<std::string> observables;
    for (const Job& job : jobs) {
        summaries.push_back(job.done ? job.summary() : std::nullopt);
        if (!summaries.back()) continue;
        for (const auto& [name, value] : summaries.back()->observables) observables.insert(name);
    }
    std::string table = "run";
    for (const SweepPlan::Parameter& parameter : plan.parameters) table += "," + csv_field(parameter.key);
    table += ",engine,seed,status,steps,simulated_seconds,state_hash,settled";
    for (const std::string& name : observables) table += "," + csv_field(name);
    table += "\n";
    for (std::size_t k = 0; k < jobs.size(); ++k) {
        table += jobs[k].name;
        for (const std::string& value : jobs[k].run.values) table += "," + csv_field(value);
        if (const std::optional<StoredSummary>& summary = summaries[k]) {
            table += fmt::format(",{},{},done,{},{},{},{}", summary->engine, summary->seed, summary->steps,
                                 summary->simulated_seconds, summary->state_hash, settled_text(*summary));
            for (const std::string& name : observables) {
                const auto value = summary->observables.find(name);
                table += value != summary->observables.end() ? fmt::format(",{}", value->second) : ",";
            }
        } else {
            table += ",,,failed,,,," + std::string(observables.size(), ',');
        }
        table += "\n";
    }
    return table;
}

/// InputError where the folder holds something else than this sweep, or runs of another scenario. Changes nothing.
void check_folder(const SweepRequest& request, const fs::path& folder, const SweepPlan& plan,
                  const std::vector<Job>& jobs) {
    check_place(folder);
    if (!fs::exists(folder)) return;
    const fs::path copy = folder / "sweep.toml", table = folder / k_table;
    const bool the_same = fs::exists(copy) && content_of(copy) == plan.text;
    if (!fs::exists(folder / "runs")) {
        for (const fs::path& file : {copy, table}) {
            require(!fs::exists(file) || (file == copy && the_same),
                    "{}: there is no sweep in the folder, but {}, which one would replace; give another folder with -o",
                    folder.string(), file.filename().string());
        }
    }
    if (request.force) return;
    require(fs::is_empty(folder) || the_same,
            "{}: holds something else than this sweep; give another folder with -o, or --force to replace the sweep in "
            "it",
            folder.string());
    for (const Job& job : jobs) {
        require(!job.of_another(),
                "{}: has been changed since {} was run with it; bring the old one back, give another folder with -o, "
                "or --force to replace the runs in this one",
                plan.scenario.string(), job.folder.string());
    }
}

/// Removes a run, and what it had to say; what else is in its folder stays.
void remove_run(const fs::path& folder) {
    if (fs::is_directory(folder)) {
        const FolderLock lock(folder);
        clear_run_folder(folder);
        remove_if_empty(folder);
    }
    remove_file(log_of(folder));
}

/// Folders of runs that a sweep of `count` runs does not have.
std::set<fs::path> surplus_runs(const fs::path& runs, std::size_t count) {
    std::set<fs::path> surplus;
    if (!fs::is_directory(runs)) return surplus;
    for (const fs::directory_entry& entry : fs::directory_iterator(runs)) {
        const fs::path& path = entry.path();
        const std::string name = (path.extension() == k_log_ending ? path.stem() : path.filename()).string();
        std::size_t number = 0;
        std::from_chars(name.data(), name.data() + name.size(), number);
        if (number >= count && name == name_of(number)) surplus.insert(runs / name);
    }
    return surplus;
}

/// Takes the folder, which is locked, for this sweep, or takes up the sweep that is in it.
void open_folder(const fs::path& folder, const SweepPlan& plan, const std::vector<Job>& jobs) {
    const fs::path copy = folder / "sweep.toml";
    const bool another = fs::exists(copy) && content_of(copy) != plan.text;
    // First: a table must not outlive what stands in it.
    if (another || std::ranges::any_of(jobs, &Job::of_another)) remove_file(folder / k_table);
    if (another) {
        for (const fs::path& run : surplus_runs(folder / "runs", jobs.size())) remove_run(run);
    }
    // Now, and not when their turn comes: the sweep can be carried on without --force then.
    for (const Job& job : jobs) {
        if (job.of_another()) remove_run(job.folder);
    }
    if (!fs::exists(copy) || content_of(copy) != plan.text) write_whole_file(copy, plan.text);
    make_folder(folder / "runs");
}

int report(const std::vector<Job>& jobs, const fs::path& table, bool quiet) {
    std::int64_t failed = 0;
    for (const Job& job : jobs) {
        if (!job.failed) continue;
        ++failed;
        tell("run {} failed; what it said is in {}\n", job.name, job.log().string());
    }
    const auto restless = std::ranges::count_if(jobs, [](const Job& job) {
        const std::optional<StoredSummary> summary = job.done ? job.summary() : std::nullopt;
        return summary && !summary->at_rest.value_or(true);
    });
    if (restless > 0) {
        tell("note: the grains of {} of {} runs were not yet at rest at time zero: settled = no in the table\n",
             restless, jobs.size());
    }
    if (!quiet) fmt::print("{} runs, {} failed: {}\n", jobs.size(), failed, table.string());
    return failed == 0 ? k_exit_done : k_exit_failed;
}

}  // namespace

int sweep_command(const SweepRequest& request) {
    const SweepPlan plan = load_sweep(request.file);
    const fs::path folder = request.folder.value_or(fs::path("out") / request.file.stem());
    std::vector<Job> jobs = jobs_of(plan, folder);
    check_folder(request, folder, plan, jobs);
    make_folder(folder);
    const FolderLock lock(folder);
    check_folder(request, folder, plan, jobs);  // another sweep may have come into it by now
    open_folder(folder, plan, jobs);
    Schedule schedule(jobs, plan, request.jobs);
    if (!request.quiet) {
        fmt::print("{}: {} runs of {}, {} of them done already\n", plan.title, jobs.size(), plan.scenario.string(),
                   schedule.done());
    }
    if (!run_all(schedule, static_cast<std::int64_t>(jobs.size()), request.quiet)) {
        tell("interrupted; {} of {} runs are done\nto carry the sweep on: {} sweep {} -o {}\n", schedule.done(),
             jobs.size(), shell_quoted(request.program), shell_quoted(request.file.string()),
             shell_quoted(folder.string()));
        return k_exit_interrupted;
    }
    const fs::path table = folder / k_table;
    write_whole_file(table, table_of(jobs, plan));
    return report(jobs, table, request.quiet);
}

}  // namespace polargrain
