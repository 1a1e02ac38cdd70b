#pragma once

#include "src/engines/dem/dem_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain::testing {

inline std::unique_ptr<Engine> make_default_dem(const Scene& scene) { return make_dem(scene, DemSettings{}); }

/// With fine steps: for closed forms.
inline std::unique_ptr<Engine> make_fine_dem(const Scene& scene) {
    DemSettings settings;
    settings.resolution = 400.0;
    return make_dem(scene, settings);
}

}  // namespace polargrain::testing
