#pragma once

// Private to this folder: what must hold of the numbers in a trajectory.h5, which may be damaged, before they are used
// as places and lengths.

#include <span>
#include <string>

#include "src/model/contact.h"
#include "src/model/scene.h"
#include "src/record/h5.h"

namespace polargrain {

/// h5::Failure with the message unless the condition holds.
void expect_whole(bool condition, const std::string& message);

/// Finite, and not so large that a square of one could not be formed.
void expect_numbers(std::span<const double> values, const std::string& what);

/// Shapes, walls and grains of a scene as it is read: every index points to something, every coordinate is a number.
void expect_whole(const Scene& scene);

/// Between bodies of the scene.
void expect_whole(const Contact& contact, const Scene& scene);

}  // namespace polargrain
