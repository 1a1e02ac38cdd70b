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

/// Books of a run closed by what the scheme has made, over the energy at hand.
inline double made_by_the_scheme(const Running& run, double energy_at_hand) {
    return run.ledger.created / energy_at_hand;
}

}  // namespace polargrain::testing
