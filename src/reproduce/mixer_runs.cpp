#include "src/reproduce/mixer_runs.h"

#include <fmt/format.h>

#include <cmath>

#include "scenarios/reader.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/simulation_figures.h"
#include "src/reproduce/statistics.h"

namespace polargrain {

namespace {

constexpr double k_duration = 8.0;     // s, as in [K02, sec. 3]
constexpr double k_gravity = 9.81;     // m/s^2
constexpr double k_frame = 0.02;       // s between stored frames
constexpr double k_side_depth = 3e-3;  // m, a grain: who has gone that far has changed sides
// m, heights of the two levels over the point of the V: a bed at rest ends at 64 mm, or begins at 117 mm.
constexpr double k_first_level = 0.06, k_second_level = 0.11;
// Per metre of depth: a disk has the mass of the sphere where it is 4 R / 3 = 2 mm deep.
constexpr double k_depth = 2e-3;
constexpr double k_fewest_starts = 20.0;  // in a cell, to tell a variance

std::vector<double> column(const std::vector<Vec2>& path, int axis) {
    std::vector<double> values;
    values.reserve(path.size());
    for (const Vec2& p : path) values.push_back(p[axis]);
    return values;
}

void measure_exchange(MixerRun& run, const MixerTrack& track) {
    double all = 0.0, dividing = 0.0;
    for (const std::vector<Vec2>& path : track.place) {
        for (const std::size_t k : side_changes(column(path, 0), k_side_depth)) {
            all += 1.0;
            if (divides(track.time[k], track.period)) dividing += 1.0;
        }
    }
    const double turns = (track.time.back() - track.time.front()) / track.period;
    run.exchange = all / (static_cast<double>(track.place.size()) * turns);
    run.exchange_dividing = all > 0.0 ? dividing / all : std::nan("");
}

double circulation_time(const MixerTrack& track) {
    std::vector<double> trips;
    for (const std::vector<Vec2>& path : track.place) {
        const std::vector<double> of_path = round_trips(track.time, column(path, 1), k_first_level, k_second_level);
        trips.insert(trips.end(), of_path.begin(), of_path.end());
    }
    return mean_and_spread(trips).mean;
}

/// From cell to wherever grains are k_dispersion_time later, within one half of a turn. [K02, sec. 4.5]
double dispersion(const MixerTrack& track, bool dividing) {
    const auto lag = static_cast<std::size_t>(std::lround(k_dispersion_time / k_frame));
    const double half = 0.5 * track.period;
    std::map<std::pair<int, int>, std::vector<Vec2>> from_cell;
    for (std::size_t k = 0; k + lag < track.time.size(); ++k) {
        const double start = track.time[k], end = track.time[k + lag];
        if (divides(start, track.period) != dividing || std::floor(start / half) != std::floor(end / half)) continue;
        for (const std::vector<Vec2>& path : track.place) {
            from_cell[CellField::square(path[k], k_mixer_cell)].push_back(path[k + lag] - path[k]);
        }
    }
    double sum = 0.0, count = 0.0;
    for (const auto& [square, displacements] : from_cell) {
        const auto n = static_cast<double>(displacements.size());
        if (n < k_fewest_starts) continue;
        sum += n * displacement_variance(displacements);
        count += n;
    }
    return sum / count / (4.0 * k_dispersion_time);
}

}  // namespace

Piece mixer_piece(const MixerSet& set, unsigned seed, double rate) {
    std::vector<std::string> values{fmt::format("materials.glass.restitution={}", set.restitution),
                                    fmt::format("materials.glass.friction={}", set.friction),
                                    fmt::format("pairs[0].friction={}", set.wall_friction),
                                    fmt::format("dem.stiffness={}", set.stiffness / k_depth),
                                    fmt::format("run.duration={}", k_duration),
                                    fmt::format("output.trajectory.every={}", k_frame),
                                    "output.series.every=0.0"};
    if (rate != k_mixer_rate) {
        const double turn = 2.0 * k_pi * rate / 60.0;
        const double speed = k_gravity / turn;  // of the vessel at time zero, and so of the grains
        values.insert(values.end(), {fmt::format("walls[0].motion.frequency={}", rate / 60.0),
                                     fmt::format("walls[0].motion.amplitude={}", k_gravity / (turn * turn)),
                                     fmt::format("fill[0].velocity=[0.0, {}]", speed),
                                     fmt::format("fill[1].velocity=[0.0, {}]", speed)});
    }
    Piece piece = shipped_piece("v-mixer", k_mixer_engine, seed, values);
    piece.name += fmt::format("-{}{:.0f}", set.name, rate);
    return piece;
}

std::vector<Piece> mixer_pieces() {
    std::vector<Piece> pieces;
    for (const MixerSet& set : k_mixer_sets) {
        for (unsigned seed = 1; seed <= k_mixer_seeds; ++seed) pieces.push_back(mixer_piece(set, seed));
        for (const double rate : k_mixer_rates) {
            if (rate != k_mixer_rate) pieces.push_back(mixer_piece(set, 1, rate));
        }
    }
    return pieces;
}

bool divides(double time, double period) {
    const double turns = time / period;
    return turns - std::floor(turns) < 0.5;
}

MixerTrack read_mixer_track(const std::filesystem::path& run, double rate) {
    const TrajectoryReader recording(run / "trajectory.h5");
    const Wall vessel = load_scenario(run / "scenario.toml").scene.walls.front();
    MixerTrack track{.period = 60.0 / rate, .time = {}, .place = {}, .velocity = {}};
    for (int f = 0; f < recording.frames(); ++f) {
        const StoredFrame frame = recording.frame(f);
        const Grains& grains = frame.world.grains;
        const WallState state = wall_state(vessel, frame.world.time);
        if (frame.world.time < track.period) continue;  // it starts from a loose heap
        track.time.push_back(frame.world.time);
        track.place.resize(Grains::at(grains.size()));
        track.velocity.resize(Grains::at(grains.size()));
        for (GrainIndex k = 0; k < grains.size(); ++k) {
            track.place[Grains::at(k)].push_back(grains.position(k) - state.point(Vec2::Zero()));
            track.velocity[Grains::at(k)].push_back(grains.velocity(k) - state.velocity);
        }
    }
    return track;
}

void add_to(CellField& field, const MixerTrack& track) {
    for (std::size_t g = 0; g < track.place.size(); ++g) {
        for (std::size_t k = 0; k < track.time.size(); ++k) field.add(track.place[g][k], track.velocity[g][k]);
    }
}

MixerRun measure_mixer(const MixerTrack& track) {
    MixerRun run;
    CellField field(k_mixer_cell);
    add_to(field, track);
    run.cells = field.cells();
    double visits = 0.0;
    for (const CellField::Cell& cell : run.cells) {
        run.speed += cell.count * cell.speed;
        run.temperature += cell.count * cell.temperature;
        visits += cell.count;
    }
    run.speed /= visits;
    run.temperature /= visits;
    measure_exchange(run, track);
    run.circulation = circulation_time(track);
    run.dispersion_dividing = dispersion(track, true);
    run.dispersion_combining = dispersion(track, false);
    return run;
}

std::vector<MixerSetRuns> read_mixer_sets(const FigureDesk& desk) {
    std::vector<MixerSetRuns> all;
    for (const MixerSet& set : k_mixer_sets) {
        MixerSetRuns runs;
        CellField together(k_mixer_cell);
        for (unsigned seed = 1; seed <= k_mixer_seeds; ++seed) {
            const MixerTrack track = read_mixer_track(desk.run(mixer_piece(set, seed)), k_mixer_rate);
            runs.runs.push_back(measure_mixer(track));
            add_to(together, track);
        }
        runs.cells = together.cells();
        for (const double rate : k_mixer_rates) {
            runs.by_rate.push_back(rate == k_mixer_rate
                                       ? runs.runs.front()
                                       : measure_mixer(read_mixer_track(desk.run(mixer_piece(set, 1, rate)), rate)));
        }
        all.push_back(std::move(runs));
    }
    return all;
}

}  // namespace polargrain
