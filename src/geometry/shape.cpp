#include "src/geometry/shape.h"

#include <cmath>

#include "src/core/elementary.h"
#include "src/core/error.h"

namespace polargrain {

Disk::Disk(std::string name, double radius) : name_(std::move(name)), radius_(radius) {
    require(std::isfinite(radius) && radius > 0.0, "shape \"{}\": radius is {}: give a finite length above 0 [m]",
            name_, radius);
}

double Disk::area() const { return k_pi * radius_ * radius_; }

double Disk::polar_moment() const { return 0.5 * k_pi * radius_ * radius_ * radius_ * radius_; }

namespace {

struct OuterRadius {
    double operator()(const Disk& disk) const { return disk.radius(); }
    double operator()(const PolarPolygon& polygon) const { return polygon.outer_radius(); }
};

struct InnerRadius {
    double operator()(const Disk& disk) const { return disk.radius(); }
    double operator()(const PolarPolygon& polygon) const { return polygon.inner_radius(); }
};

}  // namespace

const std::string& name(const Shape& shape) {
    return std::visit([](const auto& s) -> const std::string& { return s.name(); }, shape);
}

double area(const Shape& shape) {
    return std::visit([](const auto& s) { return s.area(); }, shape);
}

double polar_moment(const Shape& shape) {
    return std::visit([](const auto& s) { return s.polar_moment(); }, shape);
}

double outer_radius(const Shape& shape) { return std::visit(OuterRadius{}, shape); }

double inner_radius(const Shape& shape) { return std::visit(InnerRadius{}, shape); }

Shape scaled(const Shape& shape, double factor, std::string name) {
    return std::visit([&](const auto& s) -> Shape { return s.scaled(factor, std::move(name)); }, shape);
}

}  // namespace polargrain
