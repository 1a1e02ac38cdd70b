#pragma once

#include <Eigen/Core>
#include <cmath>

namespace polargrain {

/// A point or a vector of the plane; SI units, x to the right, y upwards.
using Vec2 = Eigen::Vector2d;

/// a_x b_y - a_y b_x: positive where b lies counter-clockwise of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Velocity that a spin [rad/s, counter-clockwise +] gives to the end of the arm r [m].
inline Vec2 cross(double spin, const Vec2& r) { return {-spin * r.y(), spin * r.x()}; }

/// The vector turned by a quarter, counter-clockwise.
inline Vec2 left_normal(const Vec2& v) { return {-v.y(), v.x()}; }

/// The vector turned by a quarter, clockwise: out of a counter-clockwise outline whose edge is v.
inline Vec2 right_normal(const Vec2& v) { return {v.y(), -v.x()}; }

inline Vec2 unit(const Vec2& v) { return v / std::sqrt(v.squaredNorm()); }

}  // namespace polargrain
