#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/reader.h"
#include "src/plot/series_plot.h"

namespace polargrain {

// The commands of the program. Each returns its exit code, prints results to standard output and throws InputError for
// the user's mistakes and RunError for a run that cannot go on.

inline constexpr int k_exit_done = 0;
inline constexpr int k_exit_failed = 1;
inline constexpr int k_exit_wrong_input = 2;
inline constexpr int k_exit_interrupted = 130;

struct RunRequest {
    std::string scenario;  ///< file, or name of a shipped scenario
    ScenarioOverrides overrides;
    std::optional<std::filesystem::path> folder;  ///< none: out/<scenario name>
    bool force = false;
    bool quiet = false;
    bool brief = false;                  ///< show progress, but neither plan nor summary
    std::string program = "polargrain";  ///< as it was called
    std::string command_line;            ///< for messages that say how to repeat the run
    std::string repeat_line;             ///< where it is part of something: the command that does all of that again
};
int run_command(const RunRequest& request);

struct ResumeRequest {
    std::filesystem::path folder;  ///< of a run
    std::optional<double> until;   ///< [s] new duration of the run; none: the one it has
    std::optional<int> threads;    ///< to go on with; none: run.threads
    std::string program = "polargrain";
    bool quiet = false;
};
int resume_command(const ResumeRequest& request);

/// Which of the stored frames of a run are taken.
struct FrameChoice {
    int every = 1;                                           ///< each N-th
    double from = -std::numeric_limits<double>::infinity();  ///< [s]
    double to = std::numeric_limits<double>::infinity();     ///< [s]
};

struct RenderRequest {
    std::filesystem::path folder;  ///< of a run
    std::optional<std::filesystem::path>
        out;                           ///< folder of frames, or movie; none: named after the colour, in the folder
    std::string format;                ///< png | svg | pdf | mp4; empty: mp4 where out ends so, else png
    std::string colour;                ///< "by=speed" or "speed"; empty: as the run's own frames
    std::optional<double> colour_max;  ///< upper end of the colour scale
    bool contacts = false;             ///< draw contact points and impulses too
    FrameChoice frames;
    std::string size;                 ///< "1280x720"; empty: as the run's own frames
    double frames_per_second = 25.0;  ///< of a movie
    bool force = false;
    bool quiet = false;
};
int render_command(const RenderRequest& request);

// What ExportRequest::formats may hold.
inline constexpr const char* k_vtk = "vtk";
inline constexpr const char* k_csv = "csv";

struct ExportRequest {
    std::filesystem::path folder;                ///< of a run
    std::optional<std::filesystem::path> out;    ///< none: export in the folder
    std::vector<std::string> formats = {k_vtk};  ///< k_vtk, k_csv or both
    FrameChoice frames;
    int disk_sides = 32;  ///< of the polygon that stands for a disk
    bool force = false;
    bool quiet = false;
};
int export_command(const ExportRequest& request);

struct CompareRequest {
    std::string scenario;
    ScenarioOverrides overrides;
    std::vector<std::string> engines;  ///< the others are held against the first
    int seeds = 3;
    std::optional<std::filesystem::path> folder;  ///< none: out/compare-<scenario name>
    bool force = false;
    bool quiet = false;
};
int compare_command(const CompareRequest& request);

struct SweepRequest {
    std::filesystem::path file;
    std::optional<std::filesystem::path> folder;  ///< none: out/<name of the file>
    int jobs = 1;                                 ///< runs at a time
    std::string program = "polargrain";           ///< as it was called
    bool force = false;
    bool quiet = false;
};
int sweep_command(const SweepRequest& request);

struct CheckRequest {
    std::string scenario;
    ScenarioOverrides overrides;
};
int check_command(const CheckRequest& request);

struct ShapeRequest {
    std::string shape;                             ///< outline file, or name of a shipped outline
    std::optional<std::filesystem::path> picture;  ///< where to draw it
    bool force = false;
};
int shape_command(const ShapeRequest& request);

struct VerifyRequest {
    std::vector<std::string> scenarios;  ///< files, or names of shipped ones
    ScenarioOverrides overrides;
    std::optional<std::filesystem::path> folder;  ///< where the run folders go; none: they are not kept
    int seeds = 1;                                ///< runs of each scenario, with its seed and those that follow
    bool force = false;
    bool quiet = false;  ///< no progress, only the tables
    std::string command_line;
};
int verify_command(const VerifyRequest& request);

/// what: "scenarios", "shapes", "engines", "observables", or empty for all four.
int list_command(const std::string& what);

struct SheetRequest {
    std::filesystem::path folder;                ///< of a run
    std::optional<std::filesystem::path> sheet;  ///< none: sheet.png in the folder
    int count = 12;                              ///< frames on the sheet
    bool force = false;
};
int sheet_command(const SheetRequest& request);

struct PlotRequest {
    std::filesystem::path folder;               ///< of a run
    std::optional<std::filesystem::path> stem;  ///< of the files that are written; none: plot in the folder
    SeriesChoice choice;
    bool force = false;
};
int plot_command(const PlotRequest& request);

struct ReproduceRequest {
    std::vector<std::string> figures;             ///< fig2, fig11, ...; none: all
    std::optional<std::filesystem::path> folder;  ///< none: out/reproduce
    int jobs = 2;                                 ///< simulations at a time
    bool quiet = false;
    std::string command_line;
};
int reproduce_command(const ReproduceRequest& request);

}  // namespace polargrain
