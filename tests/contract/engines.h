#pragma once

#include <memory>
#include <ostream>

#include "src/engines/box2d/box2d_engine.h"
#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/contact_engine.h"
#include "src/engines/dem/dem_engine.h"

namespace polargrain::testing {

/// An engine under contract, and how near it is to come to what rigid bodies do.
///
/// The methods differ: soft spheres overlap and take time to collide, Box2D reckons in single precision and keeps
/// skins. Each tolerance is what that method can promise; the laws are the same for all.
struct ContractEngine {
    const char* name;
    std::unique_ptr<Engine> (*make)(const Scene&);
    double dt;           ///< [s] of these tests
    double free_flight;  ///< relative error of a parabola and of conserved sums
    double restitution;  ///< error of speed out over speed in
    double resting_gap;  ///< of a grain at rest on a floor, over its radius; negative for overlap is as good
    double sliding;      ///< relative error of a sliding distance
    bool slides;         ///< are lasting contacts carried on from step to step?
};

inline void PrintTo(const ContractEngine& engine, std::ostream* out) { *out << engine.name; }

// contact-1994 freezes a block that lasts on a floor, as its authors' rule for rejected moves has it.
inline const ContractEngine k_engines[] = {
    {"contact", make_contact, 1e-3, 1e-12, 1e-3, 5e-3, 2e-3, true},
    {"contact_1994", make_contact_1994, 1e-3, 1e-12, 1e-3, 5e-3, 0.0, false},
    {"box2d", [](const Scene& scene) { return make_box2d(scene, {}); }, 1e-3, 2e-3, 2e-2, 2e-2, 2e-2, true},
    {"dem", [](const Scene& scene) { return make_dem(scene, {}); }, 1e-3, 1e-9, 2e-2, 5e-2, 2e-2, true},
};

}  // namespace polargrain::testing
