#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "src/core/vec2.h"

namespace polargrain {

// What [K02] measures in a V-mixer, each made of paths of grains as seen from the vessel, or of many such paths.

/// Samples at which a path changes sides: the first one beyond x = 0 of each passage that goes on to a distance of
/// `depth` from there. A path that turns back before, and then passes again, counts where it passes last.
std::vector<std::size_t> side_changes(std::span<const double> x, double depth);

/// Times that a path takes from one level up to another and back to the first, first < second: from the last passage of
/// the first level before it reaches the second to the next one downwards. Passages lie on straight lines between
/// samples. [K02, sec. 4.4]
std::vector<double> round_trips(std::span<const double> time, std::span<const double> height, double first,
                                double second);

/// Mean squared distance of the displacements from their mean [m^2]; zero for none.
double displacement_variance(std::span<const Vec2> displacements);

/// Grains that pass through the squares of a grid with a corner in the origin.
class CellField {
public:
    /// side: of a square [m].
    explicit CellField(double side) : side_(side) {}

    struct Cell {
        Vec2 middle = Vec2::Zero();
        double count = 0.0;            ///< visits
        Vec2 velocity = Vec2::Zero();  ///< mean over the visits [m/s]
        double speed = 0.0;            ///< mean over the visits [m/s]
        double temperature = 0.0;      ///< granular: half the mean square of the velocity about its mean [m^2/s^2]
    };

    void add(const Vec2& place, const Vec2& velocity);
    /// By column, then row.
    std::vector<Cell> cells() const;

    /// Column and row of the square that holds a place.
    static std::pair<int, int> square(const Vec2& place, double side);

private:
    struct Sum {
        double count = 0.0, speed = 0.0, squares = 0.0;
        Vec2 velocity = Vec2::Zero();
    };
    double side_;
    std::map<std::pair<int, int>, Sum> sums_;
};

/// Mean difference of the speed between two fields over the mean speed of the second, cells weighted by their visits in
/// the second. Only cells that both have.
double speed_difference(const std::vector<CellField::Cell>& cells, const std::vector<CellField::Cell>& from);

}  // namespace polargrain
