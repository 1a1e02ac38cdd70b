#pragma once

#include <memory>

#include "src/model/dem_settings.h"
#include "src/model/engine.h"

namespace polargrain {

/// The soft-sphere method on real shapes: overlapping, springy contacts, small steps [CS79].
///
/// A step of any length is cut into equal parts of at most SoftLaws::longest_step, so that scenarios run unchanged;
/// suggested_dt is the critical step of [HN94, eq. 6], as for the other engines. Contact laws: soft_law.h; what
/// overlaps how: contact_geometry.h; schemes: integrators.h. What springs hold is in the report's ledger as `stored`.
/// Impacts are not events here: they are counted, and impact_records stay empty. The scene must outlive the engine.
std::unique_ptr<Engine> make_dem(const Scene& scene, const DemSettings& settings);

}  // namespace polargrain
