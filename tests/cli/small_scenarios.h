#pragma once

#include <string>

namespace polargrain {

/// Three disks over a floor: runs in milliseconds, with impacts.
inline const std::string k_three_disks = R"(title = "Three disks"
source = "made up for a test"

[run]
duration = 0.05
time_step = 1e-4
seed = 3

[materials.stone]
density = 2000.0
restitution = { mean = 0.5, stddev = 0.1 }
friction = 0.3

[shapes.disk]
type = "disk"
radius = 0.01

[[walls]]
name = "floor"
material = "stone"
points = [[-1.0, 0.0], [1.0, 0.0]]

[[rows]]
shape = "disk"
material = "stone"
count = 3
start = [0.0, 0.011]
step = [0.025, 0.0]
first = { velocity = [1.0, 0.0] }

[output]
frames = { every = 0.0 }
trajectory = { every = 0.01 }
series = { every = 0.01 }
)";

/// The text with one piece replaced; the piece must be there.
inline std::string replaced(std::string text, const std::string& piece, const std::string& by) {
    return text.replace(text.find(piece), piece.size(), by);
}

}  // namespace polargrain
