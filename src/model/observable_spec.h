#pragma once

#include <optional>
#include <string>

#include "src/core/vec2.h"

namespace polargrain {

/// An upright rectangle [m].
struct Region {
    Vec2 lower = Vec2::Zero(), upper = Vec2::Zero();

    bool holds(const Vec2& p) const {
        return p.x() >= lower.x() && p.x() <= upper.x() && p.y() >= lower.y() && p.y() <= upper.y();
    }
    double area() const { return (upper.x() - lower.x()) * (upper.y() - lower.y()); }
};

/// A straight gap that grains pass, or a line that they are counted at [m].
struct Opening {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
};

/// An observable that is asked for, with what narrows it down; docs/observables.md says which takes what.
struct ObservableSpec {
    std::string quantity;  ///< name in the table of observables
    std::string label;     ///< what it is called in files; the quantity where none is given
    std::optional<Region> region;
    std::optional<Region> started_in;  ///< grains whose centre lies there at time zero
    std::optional<Opening> opening;
    std::optional<std::string> wall;      ///< by its name
    std::optional<std::string> shape;     ///< grains of the shape declared by that name
    std::optional<std::string> material;  ///< grains of that material
    std::optional<double> cell;           ///< width of the cells that are compared [m]
};

}  // namespace polargrain
