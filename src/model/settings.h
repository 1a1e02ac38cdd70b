#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/model/engine_settings.h"
#include "src/model/observable_spec.h"
#include "src/model/scene.h"

namespace polargrain {

/// The engine that runs where a scenario names none.
inline constexpr const char* k_default_engine = "contact";

struct RunSettings {
    std::string engine = k_default_engine;
    double duration = 1.0;            ///< [s]
    std::optional<double> time_step;  ///< [s]; none: the engine's own suggestion ("critical")
    double time_step_factor = 1.0;    ///< multiplies the suggestion
};

/// Coming to rest before time zero: walls stand still and none is removed meanwhile.
struct SettleSettings {
    double until_energy = 1e-6;  ///< stop at this kinetic energy per grain over m g R_max
    double at_most = 5.0;        ///< [s] simulated
};

struct FrameSettings {
    double every = 0.01;         ///< [s] simulated; 0: none
    std::string format = "png";  ///< png | svg | pdf
    int width = 1280;            ///< [pixel]
    int height = 0;              ///< [pixel]; 0: follows from the view
    std::string colour =
        "speed";  ///< speed | spin | angle | kinetic_energy | size | id | shape | material | contacts | force | none
    bool contacts = false;  ///< draw contact points and impulses
    std::optional<std::pair<Vec2, Vec2>>
        view;  ///< lower left and upper right corner [m]; none: all walls and grains at time zero
    std::optional<double> colour_max;   ///< upper end of the colour scale; none: chosen from the scene
    std::optional<std::string> follow;  ///< name of a wall of the scene that the view goes along with
};

struct OutputSettings {
    FrameSettings frames;
    double trajectory_every = 0.002;  ///< [s]; 0: none
    double series_every = 0.002;      ///< [s]; 0: none
    bool impacts = false;
    double checkpoint_every_wall = 60.0;  ///< [s] of wall clock
    std::vector<ObservableSpec> observe;  ///< further columns of series.csv, each with a label of its own
};

/// What is made of an observable's readings, one at each row of series.csv.
enum class Statistic : std::uint8_t {
    last,
    mean,
    minimum,
    maximum,
    change,  ///< last less first
};

/// What a correct run shows.
struct Expectation {
    ObservableSpec observable;
    Statistic statistic = Statistic::last;
    std::optional<double> from, to;  ///< [s] readings outside are left out; none: the whole run
    std::optional<double> min, max;  ///< in `unit`
    std::string unit;                ///< empty: the one in which the observable is kept
    std::string source;
};

/// Everything a scenario file says, checked and resolved.
struct Scenario {
    std::string title;
    std::string source;
    Scene scene;
    RunSettings run;
    EngineSettings engines;
    std::optional<SettleSettings> settle;
    OutputSettings output;
    std::vector<Expectation> expectations;
    std::string
        resolved_toml;  ///< the file with every default and override written out; running it gives the same bits
};

}  // namespace polargrain
