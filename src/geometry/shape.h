#pragma once

#include <string>
#include <variant>

#include "src/geometry/polar_polygon.h"

namespace polargrain {

/// A true circle about its centre of mass.
class Disk {
public:
    /// radius [m] > 0, else InputError.
    Disk(std::string name, double radius);
    const std::string& name() const { return name_; }
    double radius() const { return radius_; }
    double area() const;
    double polar_moment() const;
    Disk scaled(double factor, std::string name) const { return {std::move(name), radius_ * factor}; }

private:
    std::string name_;
    double radius_;
};

/// What a grain looks like: the closed set of shapes. Each is given about its centre of mass.
using Shape = std::variant<Disk, PolarPolygon>;

const std::string& name(const Shape& shape);
double area(const Shape& shape);          ///< [m^2]
double polar_moment(const Shape& shape);  ///< [m^4] about the centre of mass
double outer_radius(const Shape& shape);  ///< [m] no point is farther from the centre of mass
double inner_radius(const Shape& shape);  ///< [m] every point nearer to the centre of mass is inside
Shape scaled(const Shape& shape, double factor, std::string name);

}  // namespace polargrain
