#include "src/cli/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "src/cli/commands.h"
#include "src/cli/messages.h"
#include "src/cli/option_checks.h"
#include "src/cli/shell_words.h"
#include "src/core/build_info.h"
#include "src/core/error.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

std::string version_text() {
    const BuildInfo& build = build_info();
    return fmt::format("polargrain {}\n  compiler   {}\n  flags      {}\n  libraries  {}", build.version,
                       build.compiler, build.flags, build.libraries);
}

std::string command_line(std::span<const char* const> words) {
    std::string line;
    for (const char* word : words) line += (line.empty() ? "" : " ") + shell_quoted(word);
    return line;
}

void add_overrides(CLI::App& command, ScenarioOverrides& overrides) {
    command.add_option("--set", overrides.set, "lay a value over the file, e.g. run.duration=2 (may be repeated)")
        ->type_name("KEY.PATH=VALUE")
        ->allow_extra_args(false);
    command.add_option("--engine", overrides.engine, "engine in place of run.engine")->type_name("NAME");
    command.add_option("--seed", overrides.seed, "random seed in place of run.seed")
        ->type_name("N")
        ->check(whole_number("seed", 0, k_largest_seed), "", "");
    command.add_option("--threads", overrides.threads, "threads in place of run.threads")
        ->type_name("N")
        ->check(whole_number("number of threads", 1, k_most_threads), "", "");
}

void add_frame_choice(CLI::App& command, FrameChoice& choice, const std::string& verb) {
    command.add_option("--every", choice.every, "take each N-th stored frame")
        ->type_name("N")
        ->check(whole_number("number of frames", 1, std::numeric_limits<int>::max()), "", "");
    command.add_option("--from", choice.from, "first time to " + verb + " [s]")
        ->type_name("T")
        ->check(any_number("time"), "", "");
    command.add_option("--to", choice.to, "last time to " + verb + " [s]")
        ->type_name("T")
        ->check(any_number("time"), "", "");
}

using Action = std::function<int()>;

void add_run(CLI::App& app, RunRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("run", "run a scenario and write a run folder");
    command->add_option("SCENARIO", request.scenario, "scenario file, or the name of a shipped one")->required();
    command->add_option("-o,--output", request.folder, "run folder; default out/<scenario name>")->type_name("DIR");
    add_overrides(*command, request.overrides);
    command->add_flag("--no-frames", request.overrides.no_frames, "draw no pictures");
    command->add_flag("--force", request.force,
                      "replace the run that is in the folder, and what was drawn of it there");
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain run domino-opalene\n"
        "  polargrain run scenarios/bin-rough.toml -o out/bin --set run.duration=0.5 --seed 7\n"
        "  polargrain run out/bin/scenario.toml -o out/bin-again     (the same result, bit for bit)\n"
        "Ctrl-C ends a run after the step in progress, with a checkpoint: polargrain resume DIR carries it on. After "
        "a\n"
        "kill it goes on from the last checkpoint, by default written every minute (output.checkpoint.every_wall).");
    command->callback([&] { action = [&] { return run_command(request); }; });
}

void add_resume(CLI::App& app, ResumeRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("resume", "carry a run on from its last checkpoint");
    command->add_option("DIR", request.folder, "run folder")->required();
    command->add_option("--until", request.until, "simulated time to run to [s], in place of run.duration")
        ->type_name("T")
        ->check(number_above_zero("time to run to"), "", "");
    command->add_option("--threads", request.threads, "threads to go on with, in place of run.threads; changes no bit")
        ->type_name("N")
        ->check(whole_number("number of threads", 1, k_most_threads), "", "");
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain resume out/domino-opalene                 (after Ctrl-C, a kill or a full disk)\n"
        "  polargrain resume out/domino-opalene --until 1.2     (a finished run goes on)\n"
        "  polargrain resume out/bin --threads 4                (with other threads than it began with)\n"
        "Every file of the folder becomes what it would have been without the interruption, bit for bit.");
    command->callback([&] { action = [&] { return resume_command(request); }; });
}

void add_render(CLI::App& app, RenderRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("render", "draw a run again in another way, without simulating");
    command->add_option("DIR", request.folder, "run folder")->required();
    command->add_option("-o,--output", request.out, "folder for frames, or movie; default frames-COLOUR in DIR")
        ->type_name("OUT");
    command->add_option("--format", request.format, "png, svg, pdf, or mp4 (needs ffmpeg); default png")
        ->check(CLI::IsMember({"png", "svg", "pdf", "mp4"}));
    command
        ->add_option("--colour", request.colour,
                     "speed, spin, angle, kinetic_energy, size, id, shape, material, contacts, force (chains) or none")
        ->type_name("by=WHAT");
    command->add_option("--colour-max", request.colour_max, "upper end of the colour scale, SI units")
        ->type_name("VALUE")
        ->check(number_between("end of a colour scale", 1e-9, 1e9), "", "");
    command->add_flag("--contacts", request.contacts, "draw contact points and impulses too");
    add_frame_choice(*command, request.frames, "draw");
    command->add_option("--size", request.size, "width and height in pixels, as 1280x720")->type_name("WxH");
    command->add_option("--fps", request.frames_per_second, "frames per second of a movie, default 25")
        ->type_name("N")
        ->check(number_between("number of frames per second", 0.1, 240.0), "", "");
    command->add_flag("--force", request.force, "replace what is there");
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain render out/bin-rough --colour by=force --every 10\n"
        "  polargrain render out/bin-rough -o out/bin.mp4 --colour by=spin --size 1920x1080 --fps 50\n"
        "  polargrain render out/bin-rough --format pdf --from 0.4 --to 0.5 -o out/figure");
    command->callback([&] { action = [&] { return render_command(request); }; });
}

void add_export(CLI::App& app, ExportRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("export", "write a run's frames as files for other programs");
    command->add_option("DIR", request.folder, "run folder")->required();
    command->add_option("-o,--output", request.out, "folder; default export in DIR")->type_name("OUT");
    command->add_option("--format", request.formats, "vtk (for ParaView), csv (grains.csv), or both; default vtk")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember({k_vtk, k_csv}), "", "");
    add_frame_choice(*command, request.frames, "export");
    command->add_option("--sides", request.disk_sides, "sides of the polygon that stands for a disk; default 32")
        ->type_name("N")
        ->check(whole_number("number of sides", 3, 1024), "", "");
    command->add_flag("--force", request.force, "replace the export that is in the folder");
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain export out/bin-rough\n"
        "  polargrain export out/bin-rough -o out/bin-vtk --every 10 --from 0.4\n"
        "  polargrain export out/bin-rough -o out/bin-table --format csv\n"
        "With vtk, the folder gets grains.pvd, contacts.pvd and walls.pvd, to be opened in ParaView, and the files "
        "that "
        "they\n"
        "name; docs/export.md lists what is in them.");
    command->callback([&] { action = [&] { return export_command(request); }; });
}

void add_compare(CLI::App& app, CompareRequest& request, Action& action) {
    CLI::App* command =
        app.add_subcommand("compare", "the same scene through several engines: pictures, plots, verdicts");
    command->add_option("SCENARIO", request.scenario, "scenario file, or the name of a shipped one")->required();
    command
        ->add_option("--engines", request.engines,
                     "engines, the first being what the others are held against; default contact,contact-1994,box2d")
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_option("--seeds", request.seeds, "initial states, from run.seed on; default 3")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
    command->add_option("-o,--output", request.folder, "folder; default out/compare-<scenario name>")->type_name("DIR");
    command
        ->add_option("--set", request.overrides.set, "lay a value over the file, e.g. run.duration=2 (may be repeated)")
        ->type_name("KEY.PATH=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--no-frames", request.overrides.no_frames, "draw no pictures and make no movie");
    command->add_flag("--force", request.force, "replace the comparison that is in the folder");
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain compare domino-opalene --engines contact,box2d\n"
        "  polargrain compare bin-rough --engines contact,contact-1994,box2d --seeds 8 -o out/bins\n"
        "The folder gets report.md, values.csv, series.csv, observables.png and .pdf, frames/ side by side (first "
        "seed),\n"
        "and movie.mp4 where ffmpeg is installed.");
    command->callback([&] { action = [&] { return compare_command(request); }; });
}

void add_sweep(CLI::App& app, SweepRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("sweep", "many runs over parameter values and seeds, one table at the end");
    command->add_option("SWEEP", request.file, "sweep file; docs/sweep.md explains it")->required();
    command->add_option("-o,--output", request.folder, "folder; default out/<sweep name>")->type_name("DIR");
    command->add_option("--jobs", request.jobs, "runs at a time, default 1")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
    command->add_flag("--force", request.force, "replace another sweep that is in the folder");
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain sweep scenarios/sweeps/pour-friction.toml --jobs 2\n"
        "  polargrain sweep my-sweep.toml -o out/mine       (the same again after Ctrl-C or a kill: it goes on)\n"
        "The folder gets a run folder for each run under runs/, and table.csv with a row for each.");
    command->callback([&] { action = [&] { return sweep_command(request); }; });
}

void add_check(CLI::App& app, CheckRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("check", "read a scenario, say what would run, run nothing");
    command->add_option("SCENARIO", request.scenario, "scenario file, or the name of a shipped one")->required();
    add_overrides(*command, request.overrides);
    command->footer(
        "Examples:\n"
        "  polargrain check bin-rough\n"
        "  polargrain check my.toml --set run.time_step=1e-4");
    command->callback([&] { action = [&] { return check_command(request); }; });
}

void add_verify(CLI::App& app, VerifyRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("verify", "run scenarios and hold them to their own [[expect]] entries");
    command->add_option("SCENARIO", request.scenarios, "scenario files, or names of shipped ones")->required();
    command->add_option("-o,--output", request.folder, "keep the run folders, and verify.csv, in this folder")
        ->type_name("DIR");
    command->add_option("--seeds", request.seeds, "runs of each, with its seed and those that follow; default 1")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    add_overrides(*command, request.overrides);
    command->add_flag("--force", request.force, "replace the runs, and verify.csv, that are in the folder");
    command->add_flag("--quiet", request.quiet, "print the tables and nothing else");
    command->footer(
        "Examples:\n"
        "  polargrain verify domino-opalene\n"
        "  polargrain verify rotating-drum silo-janssen -o out/verified --seeds 4    (mean +- standard deviation of a "
        "run)\n"
        "  polargrain verify my.toml --engine contact-1994\n"
        "The exit code is 1 if anything falls short. polargrain list observables tells what can be expected.");
    command->callback([&] { action = [&] { return verify_command(request); }; });
}

void add_shape(CLI::App& app, ShapeRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("shape", "measure an outline and draw it with its polar sectors");
    command->add_option("SHAPE", request.shape, "outline file, or the name of a shipped one")->required();
    command->add_option("-o,--output", request.picture, "draw it: .png, .svg or .pdf")->type_name("PICTURE");
    command->add_flag("--force", request.force, "replace a picture of that name");
    command->footer(
        "Examples:\n"
        "  polargrain shape gear          (polargrain list shapes tells which there are)\n"
        "  polargrain shape gear -o out/gear.png --force");
    command->callback([&] { action = [&] { return shape_command(request); }; });
}

void add_list(CLI::App& app, std::string& what, Action& action) {
    CLI::App* command = app.add_subcommand("list", "what is at hand, a line each");
    command->add_option("WHAT", what, "scenarios, shapes, engines or observables; all four if left out")
        ->check(CLI::IsMember({"scenarios", "shapes", "engines", "observables"}));
    command->footer(
        "Examples:\n"
        "  polargrain list\n"
        "  polargrain list shapes");
    command->callback([&] { action = [&] { return list_command(what); }; });
}

void add_sheet(CLI::App& app, SheetRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("sheet", "one picture with frames from a run, evenly spread over its time");
    command->add_option("DIR", request.folder, "run folder")->required();
    command->add_option("-o,--output", request.sheet, "PNG file; default sheet.png in the run folder")
        ->type_name("PICTURE");
    command->add_option("--count", request.count, "number of frames on the sheet, default 12")
        ->type_name("N")
        ->check(CLI::Range(1, 100));
    command->add_flag("--force", request.force, "replace a picture of that name");
    command->footer(
        "Examples:\n"
        "  polargrain sheet out/domino-opalene\n"
        "  polargrain sheet out/domino-opalene -o out/dominoes.png --count 6 --force");
    command->callback([&] { action = [&] { return sheet_command(request); }; });
}

void add_plot(CLI::App& app, PlotRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("plot", "the columns of series.csv over time, as PNG, PDF and CSV");
    command->add_option("DIR", request.folder, "run folder")->required();
    command->add_option("-o,--output", request.stem, "name of the files without ending; default plot in the run folder")
        ->type_name("NAME");
    command->add_option("--columns", request.choice.columns, "these alone, a panel each; default all that are not zero")
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_option("--from", request.choice.from, "first time [s]")->type_name("T");
    command->add_option("--to", request.choice.to, "last time [s]")->type_name("T");
    command->add_flag("--force", request.force, "replace files of that name");
    command->footer(
        "Examples:\n"
        "  polargrain plot out/bin-rough\n"
        "  polargrain plot out/bin-rough -o out/energy --columns potential,dissipated_friction --from 0.2\n"
        "A run in progress can be plotted too. docs/run-folder.md explains the columns.");
    command->callback([&] { action = [&] { return plot_command(request); }; });
}

void add_reproduce(CLI::App& app, ReproduceRequest& request, Action& action) {
    CLI::App* command = app.add_subcommand("reproduce", "published figures and tables again, beside their numbers");
    command->add_option("FIGURE", request.figures,
                        "fig2 fig5 fig7 fig9 table1 fig11 fig12 domino-wave fig14 fig15 fig16 fig17 efficiency "
                        "kuo-mixer; all if left out");
    command->add_option("-o,--output", request.folder, "folder; default out/reproduce")->type_name("DIR");
    command->add_option("--jobs", request.jobs, "simulations at a time, default 2")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    command->add_flag("--quiet", request.quiet, "print nothing but errors");
    command->footer(
        "Examples:\n"
        "  polargrain reproduce fig7 fig9\n"
        "  polargrain reproduce fig11 -o out/paper --jobs 4\n"
        "  polargrain reproduce kuo-mixer           (a V-mixer: 15 minutes of processor time)\n"
        "  polargrain reproduce                     (everything: half an hour of processor time)\n"
        "DIR/report.html shows every figure drawn into DIR so far, with a verdict each; each figure stands beside it "
        "as PNG,\n"
        "PDF and CSV. Finished simulations are kept in DIR/runs: the same command goes on after an interruption.");
    command->callback([&] { action = [&] { return reproduce_command(request); }; });
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

/// No option of any command takes an empty word: it comes from a variable of a script that is not set.
void refuse_empty_words(CLI::App& app) {
    const auto problem = [](const std::string& word) { return word.empty() ? "is empty; give a name or a value" : ""; };
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        for (CLI::Option* option : command->get_options()) {
            if (option->get_type_size() > 0) option->check(problem, "", "");
        }
    }
}

/// "; did you mean X?" for the nearest known command or option, or nothing.
std::string hint_for(const CLI::App& app) {
    std::vector<std::string> known = command_names(app);
    const CLI::App* command = &app;
    if (const auto parsed = app.get_subcommands(); !parsed.empty()) command = parsed.front();
    for (const CLI::Option* option : command->get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    for (const std::string& word : app.remaining(true)) {
        const std::string nearest = nearest_name(word, known);
        if (!nearest.empty() && nearest != word) return "; did you mean " + nearest + "?";
    }
    return "";
}

int explain(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const bool unknown_words = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    const auto parsed = app.get_subcommands();
    const std::string command = parsed.empty() ? "" : " " + parsed.front()->get_name();
    tell("polargrain{}: {}{}\nsee polargrain{} --help\n", command, error.what(), unknown_words ? hint_for(app) : "",
         command);
    return k_exit_wrong_input;
}

int run_action(const Action& action) {
    try {
        return action();
    } catch (const InputError& error) {
        tell("error: {}\n", error.what());
        return k_exit_wrong_input;
    } catch (const std::filesystem::filesystem_error& error) {
        tell("error: {}: {}; see whether it is there, and whether you may use it\n", error.path1().string(),
             error.code().message());
        return k_exit_failed;
    } catch (const std::bad_alloc&) {
        tell("error: there is not enough memory for this; make the scene or the picture smaller\n");
        return k_exit_failed;
    } catch (const std::exception& error) {
        tell("error: {}\n", error.what());
        return k_exit_failed;
    }
}

/// A standard stream that is closed would become the next file that is opened, and what is printed would go into that.
/// For reading only: writing fails as before.
void occupy_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDONLY);
    }
}

/// The exit code of what has been done, unless something that it printed could not be written.
int after_output(int code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    tell("error: what was printed could not all be written to the standard output\n");
    return code == k_exit_done ? k_exit_failed : code;
}

int parse_and_run(int argc, const char* const* argv) {
    // Too large a file is then an error of the write that meets it, as on a full disk, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app{"polargrain: 2D granular flow with real grain shapes", "polargrain"};
    app.set_version_flag("--version", version_text, "version, build flags and library versions");
    app.set_help_flag("-h,--help", "this help");
    app.footer(
        "Examples:\n"
        "  polargrain list\n"
        "  polargrain run domino-opalene          (pictures and numbers go to out/domino-opalene)\n"
        "  polargrain COMMAND --help              (more examples)\n"
        "Exit codes: 0 done, 1 the run failed, 2 wrong input or command line, 130 interrupted.");

    RunRequest run;
    ResumeRequest resume;
    RenderRequest render;
    ExportRequest export_request;
    SweepRequest sweep;
    CheckRequest check;
    CompareRequest compare;
    VerifyRequest verify;
    ShapeRequest shape;
    SheetRequest sheet;
    PlotRequest plot;
    ReproduceRequest reproduce;
    std::string what;
    Action action;
    reproduce.command_line = command_line({argv, static_cast<std::size_t>(argc)});
    run.command_line = verify.command_line = command_line({argv, static_cast<std::size_t>(argc)});
    run.program = resume.program = sweep.program = argv[0];
    add_run(app, run, action);
    add_resume(app, resume, action);
    add_render(app, render, action);
    add_export(app, export_request, action);
    add_sweep(app, sweep, action);
    add_check(app, check, action);
    add_compare(app, compare, action);
    add_verify(app, verify, action);
    add_shape(app, shape, action);
    add_list(app, what, action);
    add_sheet(app, sheet, action);
    add_plot(app, plot, action);
    add_reproduce(app, reproduce, action);
    refuse_empty_words(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return explain(app, error);
    }
    if (action) return run_action(action);
    tell("{}", app.help());
    return k_exit_wrong_input;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
    occupy_standard_streams();
    return after_output(parse_and_run(argc, argv));
}

}  // namespace polargrain
