#pragma once

#include <memory>

#include "src/model/engine.h"
#include "src/model/engine_settings.h"

namespace polargrain {

/// Box2D 2.4 on a scene: what a games engine makes of real grain shapes.
///
/// Non-convex outlines are cut into convex pieces, lengths measured in units of a fraction of a grain, masses, moments
/// of inertia and pair laws are ours. docs/box2d.md says what Box2D does otherwise than the scene asks; `notes` too.
/// Steps of a size at which Box2D would cut off speeds at once are refused, by check_dt and by the first of them;
/// RunError where that happens later. The scene must outlive the engine.
std::unique_ptr<Engine> make_box2d(const Scene& scene, const Box2dSettings& settings);

/// The same with default settings.
std::unique_ptr<Engine> make_box2d(const Scene& scene);

/// Length [m] of one of Box2D's units: as set, or the power of two metres that makes the largest grain more than 4 and
/// at most 8 units across.
double box2d_unit(const Scene& scene, const Box2dSettings& settings);

/// Distance of outlines [m] that lie at rest on one another, as far as Box2D's position correction brings them; less
/// than zero: they overlap. The skins of both less Box2D's slop.
double box2d_resting_gap(const Scene& scene, const Box2dSettings& settings);

}  // namespace polargrain
