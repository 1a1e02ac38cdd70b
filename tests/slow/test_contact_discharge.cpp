#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <vector>

#include "src/core/random.h"
#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

/// Grains above a flat bottom with a hole in the middle, closed by a plug until `open_at`.
Scene silo(double width, double opening, double height, double open_at, double restitution, double friction) {
    Scene scene = testing::empty_scene(restitution, friction);
    const double middle = 0.5 * width;
    testing::add_wall(scene, "left", {{0.0, height}, {0.0, 0.0}, {middle - 0.5 * opening, 0.0}});
    testing::add_wall(scene, "right", {{middle + 0.5 * opening, 0.0}, {width, 0.0}, {width, height}});
    testing::add_wall(scene, "plug", {{middle - 0.5 * opening, 0.0}, {middle + 0.5 * opening, 0.0}});
    scene.walls.back().remove_at = open_at;
    return scene;
}

/// Grains per second from the moment `first` of them are below the bottom to the moment `last` are; 0 if that takes
/// more than 8 s.
double discharge_rate(Running& sim, double dt, double open_at, int first, int last) {
    double first_time = 0.0;
    sim.run(open_at, dt);
    while (sim.world.time < open_at + 8.0) {
        sim.step(dt);
        int out = 0;
        for (const double y : sim.world.grains.y) out += y < 0.0 ? 1 : 0;
        if (first_time == 0.0 && out >= first) first_time = sim.world.time;
        if (out >= last) return (last - first) / (sim.world.time - first_time);
    }
    return 0.0;
}

struct SiloCase {
    double opening;  ///< [d]
    double flow;     ///< Q = (area per second) / (sqrt(g) d^1.5) of a soft-sphere program, one run
};

class DiskSilo : public ::testing::TestWithParam<SiloCase> {};

/// Disks of diameter d in a silo `width` of them wide settle before the plug goes; opening in diameters.
Running filled_silo(double opening, double open_at, std::uint64_t seed, double d = 0.01, int width = 40,
                    int disks = 2500) {
    Scene scene = silo(width * d, opening * d, 150.0 * d, open_at, 0.8, 0.3);
    const ShapeIndex disk = testing::add_disk(scene, 0.5 * d);
    RandomStream random(seed, RandomPurpose::test);
    const double pitch = 1.08 * d;
    const int across = width - 4;
    for (int k = 0; k < disks; ++k) {
        const int row = k / across;
        scene.add(Grain{disk,
                        0,
                        {(k % across + 1.0) * pitch, (row + 0.6) * pitch},
                        0.0,
                        {0.3 * random.normal(), 0.3 * random.normal()}});
    }
    return Running(make_contact, std::move(scene));
}

TEST_P(DiskSilo, DischargesAsTheSoftSphereProgramDoes) {
    const double d = 0.01;
    const int seeds = 10;
    double flow = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const double open_at = 1.5;
        Running sim = filled_silo(GetParam().opening, open_at, seed);
        const double rate = discharge_rate(sim, 5e-4, open_at, 125, 1250);
        const double one = rate * 0.25 * k_pi * d * d / (std::sqrt(9.81) * std::pow(d, 1.5));
        fmt::print("seed {} D/d {}: Q {:.3f}, rejected {:.4f} %, rises {:.2g} E0\n", seed, GetParam().opening, one,
                   100.0 * sim.rejected_share(), sim.ledger.rises / sim.start_energy);
        EXPECT_LT(sim.rejected_share(), 1e-3);
        flow += one / seeds;
    }
    fmt::print("D/d {}: mean Q {:.3f}, soft spheres {:.2f} ({:+.2f} %)\n", GetParam().opening, flow, GetParam().flow,
               100.0 * (flow / GetParam().flow - 1.0));
    // Aim 3 %. The reference is one run of one program; ours vary by 2.5 % from seed to seed. Measured: -4.0 +- 0.9 %
    // at D/d 6, +3.8 +- 0.9 % at D/d 10 (ten beds each); the engine dem, which shares no method with this one,
    // -4.2 +- 0.7 % (8) and +1.9 +- 0.7 % (12).
    EXPECT_NEAR(flow / GetParam().flow, 1.0, 0.05);
}

/// Between the two, the law of [BLV61] in the plane, C (D / d - k)^1.5, through both.
double law_of_beverloo(double opening) {
    const double low = std::pow(8.05, 2.0 / 3.0), high = std::pow(20.6, 2.0 / 3.0);
    return std::pow(low + (high - low) * (opening - 6.0) / 4.0, 1.5);
}

INSTANTIATE_TEST_SUITE_P(Openings, DiskSilo,
                         ::testing::Values(SiloCase{6.0, 8.05}, SiloCase{8.0, law_of_beverloo(8.0)},
                                           SiloCase{10.0, 20.6}),
                         [](const auto& c) { return fmt::format("of_{:.0f}_diameters", c.param.opening); });

/// A bed of 600 rough grains of 20 mm in a bin twenty wide, settled once for all time steps.
Scene rough_bed(std::uint64_t seed, double opening) {
    const double d = 0.02;
    const double width = 20.0 * d;
    Scene scene = silo(width, opening, 100.0 * d, 1e9, 0.3, 0.2);
    scene.seed = seed;
    RandomStream random(seed, RandomPurpose::test);
    const double pitch = 1.35 * d;
    const int across = 14;
    for (int k = 0; k < 600; ++k) {
        const int row = k / across;
        scene.add(Grain{testing::add_rough(scene, 0.5 * d, 0.2, static_cast<std::uint64_t>(k)),
                        0,
                        {(k % across + 0.9) * pitch, (row + 0.6) * pitch},
                        random.uniform(-k_pi, k_pi),
                        {0.1 * random.normal(), 0.1 * random.normal()}});
    }
    Running settling(make_contact, scene);
    settling.run(1.8, 1e-3);
    scene.grains = settling.world.grains;
    scene.walls.back().remove_at = 0.0;
    return scene;
}

struct MeanOfMany {
    double mean = 0.0;
    double error = 0.0;  ///< standard error

    explicit MeanOfMany(const std::vector<double>& values) {
        const auto n = static_cast<double>(values.size());
        mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
        double square = 0.0;
        for (const double v : values) square += (v - mean) * (v - mean);
        error = std::sqrt(square / (n - 1.0) / n);
    }
};

/// Emptyings of the same beds at one time step, bed by bed [grains/s]; 0 where the bed jams.
struct Emptyings {
    std::vector<double> rates;
    int rejecting = 0;

    void add(double rate, double rejected_share) {
        rates.push_back(rate);
        if (rejected_share > 1e-3) ++rejecting;
    }
    auto jammed() const { return std::count(rates.begin(), rates.end(), 0.0); }
    MeanOfMany flowing() const {
        std::vector<double> all;
        std::copy_if(rates.begin(), rates.end(), std::back_inserter(all), [](double r) { return r > 0.0; });
        return MeanOfMany(all);
    }
    /// Of the same beds, where neither jams.
    MeanOfMany less(const Emptyings& other) const {
        std::vector<double> differences;
        for (std::size_t bed = 0; bed < rates.size(); ++bed) {
            if (rates[bed] > 0.0 && other.rates[bed] > 0.0) differences.push_back(rates[bed] - other.rates[bed]);
        }
        return MeanOfMany(differences);
    }
};

const std::vector<double> k_steps = {1e-3, 5e-4, 2.5e-4};

/// Empties beds at all time steps. The aim is a discharge that differs by no more than 2 % between two of them, or by
/// the standard error of the difference where that is larger.
void expect_the_same_discharge_at_all_steps(std::uint64_t beds, const std::function<Scene(std::uint64_t)>& bed_of,
                                            int first, int last) {
    std::vector<Emptyings> emptyings(k_steps.size());
    for (std::uint64_t seed = 0; seed < beds; ++seed) {
        const Scene bed = bed_of(seed);
        for (std::size_t k = 0; k < k_steps.size(); ++k) {
            const double dt = k_steps[k];
            Running sim(make_contact, bed);
            const double rate = discharge_rate(sim, dt, 0.0, first, last);
            fmt::print("seed {} dt {:.3g} (suggested {:.3g}): {:.1f} grains/s, rejected {:.4f} %\n", seed, dt,
                       sim.engine->suggested_dt(), rate, 100.0 * sim.rejected_share());
            emptyings[k].add(rate, sim.rejected_share());
        }
    }
    for (std::size_t k = 0; k < k_steps.size(); ++k) {
        const Emptyings& e = emptyings[k];
        const MeanOfMany rate = e.flowing();
        fmt::print("dt {}: {:.1f} +- {:.1f} grains/s; {} jammed, {} rejecting\n", k_steps[k], rate.mean, rate.error,
                   e.jammed(), e.rejecting);
        EXPECT_LE(e.jammed(), static_cast<std::ptrdiff_t>(beds / 12)) << "at most one bed of twelve";
        EXPECT_EQ(e.rejecting, 0);
    }
    for (std::size_t k = 0; k < k_steps.size(); ++k) {
        const std::size_t next = (k + 1) % k_steps.size();
        const MeanOfMany difference = emptyings[k].less(emptyings[next]);
        const double rate = emptyings[k].flowing().mean;
        fmt::print("dt {} less dt {}: {:+.2f} +- {:.2f} %\n", k_steps[k], k_steps[next], 100.0 * difference.mean / rate,
                   100.0 * difference.error / rate);
        EXPECT_LT(std::abs(difference.mean), std::max(0.02 * rate, difference.error));
    }
}

TEST(RoughDischarge, DoesNotDependOnTheTimeStep) {
    // Rates of one bed at two steps differ by 7 %, as each goes its own way after some tenths of a second. Of four sets
    // of 12 beds one differs by 3.5 % between two steps, and of two sets of 48 (standard error 1 %) one by 2.35, the
    // other by 1.27: only with 96 is the standard error, 0.7 %, well below 2 %.
    // Measured 323.9 +- 1.8, 322.1 +- 1.5 and 323.7 +- 1.6 grains/s at 1, 0.5 and 0.25 ms.
    expect_the_same_discharge_at_all_steps(
        96, [](std::uint64_t seed) { return rough_bed(seed, 8.0 * 0.02); }, 30, 330);
}

TEST(DiskDischarge, DoesNotDependOnTheTimeStep) {
    // 800 disks of 20 mm in a silo 24 d wide, opening 6 d. Measured 208.6, 210.0 and 209.0 +- 1.3 disks/s at 1, 0.5 and
    // 0.25 ms.
    const auto bed_of = [](std::uint64_t seed) {
        Running settling = filled_silo(6.0, 1e9, seed, 0.02, 24, 800);
        settling.run(1.5, 1e-3);
        Scene bed = settling.scene;
        bed.grains = settling.world.grains;
        bed.walls.back().remove_at = 0.0;
        return bed;
    };
    expect_the_same_discharge_at_all_steps(24, bed_of, 40, 480);
}

}  // namespace
}  // namespace polargrain
