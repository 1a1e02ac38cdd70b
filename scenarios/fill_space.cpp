#include <algorithm>
#include <cmath>

#include "scenarios/fill.h"
#include "src/detect/overlap.h"

namespace polargrain {

namespace {

/// Cells of about a grain's size, but never many more cells than grains.
double cell_size_for(const Vec2& extent, std::size_t count, double radius) {
    const double number = 4.0 * static_cast<double>(count) + 16.0;
    const double size = std::max(2.0 * radius, std::sqrt(extent.x() * extent.y() / number));
    return std::max(size, extent.maxCoeff() / number);
}

int cells_along(double extent, double size) { return std::max(1, static_cast<int>(std::ceil(extent / size))); }

}  // namespace

FillSpace::FillSpace(const Vec2& lower, const Vec2& upper, const StartWalls& walls, std::size_t count, double radius)
    : lower_(lower),
      upper_(upper),
      walls_(&walls),
      cell_size_(cell_size_for(upper - lower, count, radius)),
      columns_(cells_along(upper.x() - lower.x(), cell_size_)),
      rows_(cells_along(upper.y() - lower.y(), cell_size_)),
      grains_in_cell_(cell(0, rows_)) {}

FillSpace::CellRange FillSpace::cells(const Vec2& low, const Vec2& high) const {
    const auto index = [&](double offset, int count) {
        return static_cast<int>(std::clamp(std::floor(offset / cell_size_), 0.0, static_cast<double>(count - 1)));
    };
    return {index(low.x() - lower_.x(), columns_), index(low.y() - lower_.y(), rows_),
            index(high.x() - lower_.x(), columns_), index(high.y() - lower_.y(), rows_)};
}

void FillSpace::add(std::shared_ptr<const Shape> shape, const Pose& pose) {
    const double radius = outer_radius(*shape);
    const Vec2 reach = Vec2::Constant(radius);
    if (((pose.centre + reach).array() < lower_.array()).any()) return;
    if (((pose.centre - reach).array() > upper_.array()).any()) return;
    const int index = static_cast<int>(placed_.size());
    placed_.push_back({std::move(shape), pose, radius});
    const CellRange range = cells(pose.centre - reach, pose.centre + reach);
    for (int y = range.y0; y <= range.y1; ++y) {
        for (int x = range.x0; x <= range.x1; ++x) grains_in_cell_[cell(x, y)].push_back(index);
    }
}

bool FillSpace::fits(const Shape& shape, const Pose& pose) const {
    const double radius = outer_radius(shape);
    const Vec2 reach = Vec2::Constant(radius);
    if (((pose.centre - reach).array() < lower_.array()).any()) return false;
    if (((pose.centre + reach).array() > upper_.array()).any()) return false;
    const CellRange range = cells(pose.centre - reach, pose.centre + reach);
    for (int y = range.y0; y <= range.y1; ++y) {
        for (int x = range.x0; x <= range.x1; ++x) {
            for (const int index : grains_in_cell_[cell(x, y)]) {
                const Placed& other = placed_[static_cast<std::size_t>(index)];
                const double near = radius + other.radius;
                if ((other.pose.centre - pose.centre).squaredNorm() >= near * near) continue;
                if (overlap(shape, pose, *other.shape, other.pose)) return false;
            }
        }
    }
    return !walls_->overlapped(shape, pose) && !walls_->behind(pose.centre, 2.0 * radius);
}

}  // namespace polargrain
