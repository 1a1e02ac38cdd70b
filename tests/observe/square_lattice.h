#pragma once

#include <memory>
#include <optional>

#include "src/model/scene.h"

namespace polargrain::testing {

/// A box ten diameters wide with `rows` rows of disks of radius 10 mm on a square lattice.
inline Scene square_lattice(int rows) {
    Scene scene;
    scene.materials.add({"stone", 2000.0, {}, 0.0});
    scene.gravity = {0.0, -9.81};
    scene.walls.push_back({"box", 0, {{0.0, 1.0}, {0.0, 0.0}, {0.2, 0.0}, {0.2, 1.0}}, {}, std::nullopt});
    const ShapeIndex disk = scene.add(std::make_shared<const Shape>(Disk("disk", 0.01)));
    for (int row = 0; row < rows; ++row) {
        for (int k = 0; k < 10; ++k) scene.add(Grain{disk, 0, {0.01 + 0.02 * k, 0.01 + 0.02 * row}});
    }
    return scene;
}

}  // namespace polargrain::testing
