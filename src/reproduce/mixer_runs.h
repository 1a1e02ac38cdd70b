#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "src/reproduce/figure.h"
#include "src/reproduce/mixer_measures.h"

namespace polargrain {

/// A set of parameters of the contact law. [K02, Table 2]
struct MixerSet {
    char name;
    double restitution;
    double friction;       ///< of grains on grains
    double wall_friction;  ///< of grains on the vessel
    double stiffness;      ///< of the normal spring between spheres [N/m]
};

inline constexpr std::array<MixerSet, 8> k_mixer_sets{{{'A', 0.9, 0.3, 0.3, 1000.0},
                                                       {'B', 0.9, 0.3, 0.3, 500.0},
                                                       {'C', 0.7, 0.3, 0.3, 1000.0},
                                                       {'D', 0.9, 0.6, 0.6, 1000.0},
                                                       {'E', 1.0, 0.0, 0.0, 1000.0},
                                                       {'F', 1.0, 0.3, 0.3, 1000.0},
                                                       {'G', 0.9, 0.0, 0.0, 1000.0},
                                                       {'H', 0.9, 0.3, 0.0, 1000.0}}};
inline constexpr const char* k_mixer_engine = "dem";
inline constexpr unsigned k_mixer_seeds = 2;
inline constexpr double k_mixer_rate = 60.0;                          ///< turns a minute of the shipped mixer
inline constexpr std::array k_mixer_rates{30.0, 45.0, k_mixer_rate};  ///< those compared [K02, Figs. 12, 14]
inline constexpr double k_mixer_cell = 7.35e-3;                       ///< [K02, sec. 4.1] [m]
inline constexpr double k_dispersion_time = 0.2;                      ///< [K02, sec. 4.5] [s]

/// The shipped mixer with these parameters, as long as the runs of [K02]: 8 s. rate: turns a minute.
Piece mixer_piece(const MixerSet& set, unsigned seed, double rate = k_mixer_rate);
/// Those of all sets: all seeds at k_mixer_rate, and the first seed at the others.
std::vector<Piece> mixer_pieces();

/// Where grains are and how fast, seen from the vessel, which does not turn; the V has its point in the origin.
struct MixerTrack {
    double period = 1.0;                      ///< of a turn [s]
    std::vector<double> time;                 ///< of the stored frames [s]
    std::vector<std::vector<Vec2>> place;     ///< by grain, then frame [m]
    std::vector<std::vector<Vec2>> velocity;  ///< alike [m/s]
};

/// From the second turn on. rate: turns a minute.
MixerTrack read_mixer_track(const std::filesystem::path& run, double rate);

/// True in the first half of each turn, while grains divide into the arms; in the second half they combine. [K02, Fig.
/// 4]
bool divides(double time, double period);

/// Adds all grains at all times.
void add_to(CellField& field, const MixerTrack& track);

/// What one run shows.
struct MixerRun {
    double speed = 0.0;                 ///< mean over grains and time [m/s]
    double temperature = 0.0;           ///< granular, mean over cells by their visits [m^2/s^2]
    double exchange = 0.0;              ///< grains that go over into the other arm, share per turn [K02, sec. 4.3]
    double exchange_dividing = 0.0;     ///< of these, how large a share goes over while they divide
    double circulation = 0.0;           ///< mean time up an arm and back [s], sec. 4.4
    double dispersion_dividing = 0.0;   ///< coefficient: variance in 0.2 s / (4 x 0.2 s), mean over cells [m^2/s]
    double dispersion_combining = 0.0;  ///< alike
    std::vector<CellField::Cell> cells = {};  ///< over the whole turn
};

MixerRun measure_mixer(const MixerTrack& track);

/// All runs of one set.
struct MixerSetRuns {
    std::vector<MixerRun> runs;          ///< by seed, at k_mixer_rate
    std::vector<CellField::Cell> cells;  ///< of all seeds together
    std::vector<MixerRun> by_rate;       ///< at each of k_mixer_rates, the first seed
};

/// Reads and measures what all sets have left.
std::vector<MixerSetRuns> read_mixer_sets(const FigureDesk& desk);

}  // namespace polargrain
