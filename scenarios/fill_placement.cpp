#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenarios/fill.h"
#include "src/core/elementary.h"
#include "src/core/random.h"

namespace polargrain {

namespace {

constexpr int k_most_tries = 2000;
// Near the density at which random places run out, every next grain costs more tries than all before it.
constexpr std::size_t k_tries_per_grain = 150;

// Stream numbers above those of the grains and below the largest 32-bit number.
constexpr std::uint32_t k_lattice_stream = 0xffff'ff00;

Vec2 uniform_between(RandomStream& random, const Vec2& low, const Vec2& high) {
    const double x = random.uniform(low.x(), high.x());
    const double y = random.uniform(low.y(), high.y());
    return {x, y};
}

void put_at(FillSpace& space, FillGrain& grain, const Vec2& centre, double angle) {
    grain.angle = angle;
    grain.pose = Pose::at(centre, angle);
    space.add(grain.shape, grain.pose);
}

/// Sites of a hexagonal lattice where a circle of that radius fits.
std::vector<Vec2> free_sites(const FillSpace& space, const Disk& circle, double pitch) {
    const double radius = circle.radius();
    const Shape shape = circle;
    const double row_height = 0.5 * std::sqrt(3.0) * pitch;
    // A little air, so that sites that touch the border or a wall are not lost to round-off.
    const Vec2 first = space.lower() + Vec2::Constant(radius * (1.0 + 1e-9));
    const Vec2 last = space.upper() - Vec2::Constant(radius);
    std::vector<Vec2> sites;
    for (std::int64_t row = 0;; ++row) {
        const double y = first.y() + static_cast<double>(row) * row_height;
        if (y > last.y()) return sites;
        const double start = first.x() + (row % 2 == 0 ? 0.0 : 0.5 * pitch);
        for (std::int64_t column = 0;; ++column) {
            const Vec2 site(start + static_cast<double>(column) * pitch, y);
            if (site.x() > last.x()) break;
            if (space.fits(shape, Pose{site, 1.0, 0.0})) sites.push_back(site);
        }
    }
}

struct Lattice {
    double pitch;
    std::vector<Vec2> sites;
};

/// No lattice has many more sites than grains are to come, however large the rectangle and small the grains.
double closest_pitch(const FillSpace& space, const Disk& circle, std::size_t count) {
    constexpr double k_air = 1.0 + 1e-6;
    const double most_sites = 64.0 * static_cast<double>(count) + 1000.0;
    const Vec2 extent = space.upper() - space.lower();
    const double by_number = std::max(std::sqrt(extent.x() * extent.y() / most_sites), extent.maxCoeff() / most_sites);
    return std::max(2.0 * circle.radius() * k_air, by_number);
}

/// The widest lattice that has a site for each of `count` circles, or the closest one where none has.
Lattice widest_lattice(const FillSpace& space, const Disk& circle, std::size_t count) {
    Lattice best{closest_pitch(space, circle, count), {}};
    best.sites = free_sites(space, circle, best.pitch);
    const Vec2 extent = space.upper() - space.lower();
    double narrow = best.pitch;
    double wide = std::max(best.pitch, 2.0 * std::sqrt(extent.x() * extent.y() / static_cast<double>(count)));
    for (int k = 0; k < 16 && best.sites.size() >= count; ++k) {
        const double pitch = 0.5 * (narrow + wide);
        std::vector<Vec2> sites = free_sites(space, circle, pitch);
        if (sites.size() >= count) {
            narrow = pitch;
            best = {pitch, std::move(sites)};
        } else {
            wide = pitch;
        }
    }
    return best;
}

void shuffle(std::vector<Vec2>& sites, RandomStream& random) {
    for (std::size_t k = sites.size(); k > 1; --k) {
        std::swap(sites[k - 1], sites[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    }
}

/// Large grains first: small ones find room between them, and hardly the other way round.
std::vector<std::size_t> by_falling_size(std::span<const FillGrain> grains) {
    std::vector<std::size_t> order(grains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return outer_radius(*grains[a].shape) > outer_radius(*grains[b].shape);
    });
    return order;
}

double largest_radius(std::span<const FillGrain> grains) {
    double largest = 0.0;
    for (const FillGrain& grain : grains) largest = std::max(largest, outer_radius(*grain.shape));
    return largest;
}

}  // namespace

std::size_t place_at_random(FillSpace& space, std::span<FillGrain> grains, const FillKey& key) {
    std::size_t tries_left = k_tries_per_grain * grains.size() + k_most_tries;
    std::size_t done = 0;
    for (const std::size_t k : by_falling_size(grains)) {
        FillGrain& grain = grains[k];
        RandomStream random(key.seed, RandomPurpose::fill, key.fill, static_cast<std::uint32_t>(2 * k + 1));
        const Vec2 margin = Vec2::Constant(outer_radius(*grain.shape));
        bool placed = false;
        for (int t = 0; t < k_most_tries && tries_left > 0 && !placed; ++t, --tries_left) {
            const Vec2 centre = uniform_between(random, space.lower() + margin, space.upper() - margin);
            const double angle = random.uniform(-k_pi, k_pi);
            placed = space.fits(*grain.shape, Pose::at(centre, angle));
            if (placed) put_at(space, grain, centre, angle);
        }
        if (!placed) break;
        ++done;
    }
    return done;
}

std::size_t place_on_lattice(FillSpace& space, std::span<FillGrain> grains, const FillKey& key) {
    const Disk circle("circle", largest_radius(grains));
    Lattice lattice = widest_lattice(space, circle, grains.size());
    RandomStream random(key.seed, RandomPurpose::fill, key.fill, k_lattice_stream);
    shuffle(lattice.sites, random);
    const std::size_t count = std::min(grains.size(), lattice.sites.size());
    for (std::size_t k = 0; k < count; ++k) {
        FillGrain& grain = grains[k];
        const double room = std::max(0.0, 0.5 * lattice.pitch - outer_radius(*grain.shape)) / std::sqrt(2.0);
        const double angle = random.uniform(-k_pi, k_pi);
        const Vec2 moved = lattice.sites[k] + uniform_between(random, Vec2::Constant(-room), Vec2::Constant(room));
        const bool fits = space.fits(*grain.shape, Pose::at(moved, angle));
        put_at(space, grain, fits ? moved : lattice.sites[k], angle);
    }
    return count;
}

}  // namespace polargrain
