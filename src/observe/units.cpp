#include "src/observe/units.h"

#include <array>
#include <cmath>

#include "src/core/elementary.h"
#include "src/observe/bed.h"

namespace polargrain {

namespace {

double one(const Scene& /*scene*/) { return 1.0; }
double hundredth(const Scene& /*scene*/) { return 0.01; }
double hundred(const Scene& /*scene*/) { return 100.0; }
double thousandth(const Scene& /*scene*/) { return 1e-3; }
double thousand(const Scene& /*scene*/) { return 1e3; }
double degree(const Scene& /*scene*/) { return k_radians_per_degree; }

double gravity(const Scene& scene) { return std::sqrt(scene.gravity.squaredNorm()); }
double diameter(const Scene& scene) { return 2.0 * mean_outer_radius(scene); }

double mass(const Scene& scene) {
    double sum = 0.0;
    for (const double m : scene.grains.mass) sum += m;
    return sum / scene.grains.size();
}

double density(const Scene& scene) {
    double covered = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) covered += area(scene.shape_of(k));
    return mass(scene) * scene.grains.size() / covered;
}

struct Unit {
    Dimension dimension;
    const char* symbol;
    double (*scale)(const Scene&);
};

constexpr std::array k_units{
    Unit{Dimension::number, "1", one},
    Unit{Dimension::number, "-", one},
    Unit{Dimension::number, "%", hundredth},
    Unit{Dimension::count, "1", one},
    Unit{Dimension::count, "-", one},
    Unit{Dimension::count, "grains", one},
    Unit{Dimension::percent, "%", one},
    Unit{Dimension::percent, "1", hundred},
    Unit{Dimension::percent, "-", hundred},
    Unit{Dimension::length, "m", one},
    Unit{Dimension::length, "mm", thousandth},
    Unit{Dimension::length, "d", diameter},
    Unit{Dimension::time, "s", one},
    Unit{Dimension::time, "ms", thousandth},
    Unit{Dimension::time, "sqrt(d/g)", [](const Scene& s) { return std::sqrt(diameter(s) / gravity(s)); }},
    Unit{Dimension::rate, "1/s", one},
    Unit{Dimension::rate, "sqrt(g/d)", [](const Scene& s) { return std::sqrt(gravity(s) / diameter(s)); }},
    Unit{Dimension::speed, "m/s", one},
    Unit{Dimension::speed, "mm/s", thousandth},
    Unit{Dimension::speed, "sqrt(g d)", [](const Scene& s) { return std::sqrt(gravity(s) * diameter(s)); }},
    Unit{Dimension::speed_squared, "m^2/s^2", one},
    Unit{Dimension::speed_squared, "g d", [](const Scene& s) { return gravity(s) * diameter(s); }},
    Unit{Dimension::energy, "J/m", one},
    Unit{Dimension::energy, "m g d", [](const Scene& s) { return mass(s) * gravity(s) * diameter(s); }},
    Unit{Dimension::pressure, "Pa", one},
    Unit{Dimension::pressure, "kPa", thousand},
    Unit{Dimension::pressure, "rho g d", [](const Scene& s) { return density(s) * gravity(s) * diameter(s); }},
    Unit{Dimension::angle, "rad", one},
    Unit{Dimension::angle, "degrees", degree},
    Unit{Dimension::area_rate, "m^2/s", one},
    Unit{Dimension::area_rate, "sqrt(g) d^1.5",
         [](const Scene& s) { return std::sqrt(gravity(s) * diameter(s)) * diameter(s); }},
    Unit{Dimension::domino_speed, "sqrt(g L)", one},
};

}  // namespace

std::vector<std::string> units_of(Dimension dimension) {
    std::vector<std::string> symbols;
    for (const Unit& unit : k_units) {
        if (unit.dimension == dimension) symbols.emplace_back(unit.symbol);
    }
    return symbols;
}

std::optional<double> unit_scale(Dimension dimension, const std::string& unit, const Scene& scene) {
    if (unit.empty()) return 1.0;
    for (const Unit& entry : k_units) {
        if (entry.dimension == dimension && entry.symbol == unit) return entry.scale(scene);
    }
    return std::nullopt;
}

}  // namespace polargrain
