#pragma once

#include <memory>

#include "src/model/engine.h"

namespace polargrain {

/// The contact model of Hogue & Newland exactly as published [HN94, sec. 3], for comparison and teaching.
///
/// A step: the contacts recorded by the last one are processed by closing speed (contact_stage.h); every grain gets a
/// free-flight trial pose [HN94, eqs. 47-52]; trial poses that overlap are found (trial_check.h), and a partial order
/// with its transitive closure decides who may move (motion_update.h). A rejected grain keeps its pose and its new
/// velocity. Guarantee: no two grains overlap after a step if none did before, and no grain overlaps a wall at rest.
/// What the method does badly is in the report: moves rejected, and energy created by gravity acting on grains that do
/// not move. The scene must outlive the engine.
std::unique_ptr<Engine> make_contact_1994(const Scene& scene);

}  // namespace polargrain
