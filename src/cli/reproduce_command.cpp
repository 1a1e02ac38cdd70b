#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "src/cli/commands.h"
#include "src/cli/engine_table.h"
#include "src/cli/interrupt.h"
#include "src/cli/messages.h"
#include "src/cli/progress_display.h"
#include "src/core/error.h"
#include "src/reproduce/report.h"
#include "src/reproduce/reproduce.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// Lines on standard output, each pushed out at once so that a log can be followed.
class ReproduceDisplay {
public:
    explicit ReproduceDisplay(bool quiet) : quiet_(quiet) {}

    void running(const Figure& figure, const StoreProgress& progress) const {
        if (progress.last.empty()) {
            say(fmt::format("{}: {} simulations to run", figure.id, progress.all));
        } else {
            say(fmt::format("{}: {} of {}, {} left: {}", figure.id, progress.done, progress.all,
                            clock_text(progress.seconds_left), progress.last));
        }
    }
    void drawing(const Figure& figure) const { say(fmt::format("{}: drawing", figure.id)); }
    void drawn(const Figure& figure, const std::string& verdict) const {
        say(fmt::format("{}: {} ({} since the start)", figure.id, verdict, clock_text(elapsed())));
    }

private:
    void say(const std::string& line) const {
        if (quiet_) return;
        fmt::print("{}\n", line);
        std::fflush(stdout);
    }
    double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

    bool quiet_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

int reproduce_command(const ReproduceRequest& request) {
    ReproduceSettings settings;
    settings.figures = find_figures(request.figures);
    settings.folder = request.folder.value_or("out/reproduce");
    settings.program = fs::read_symlink("/proc/self/exe");
    settings.jobs = request.jobs;
    for (const EngineEntry& engine : engine_table()) {
        settings.engines.push_back(
            {engine.name, [make = engine.make](const Scene& scene) { return make(scene, EngineSettings{}); }});
    }
    const ReproduceDisplay display(request.quiet);
    const ReproduceEvents events{
        [&](const Figure& figure, const StoreProgress& progress) { display.running(figure, progress); },
        [&](const Figure& figure) { display.drawing(figure); },
        [&](const Figure& figure, const std::string& verdict) { display.drawn(figure, verdict); }};
    if (!reproduce(settings, watch_interrupts(), events)) {
        tell("interrupted; finished simulations are kept in {}\nto go on: {}\n", (settings.folder / "runs").string(),
             request.command_line);
        return k_exit_interrupted;
    }
    if (!request.quiet) fmt::print("report: {}\n", Report(settings.folder).page().string());
    return k_exit_done;
}

}  // namespace polargrain
