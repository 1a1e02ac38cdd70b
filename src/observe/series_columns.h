#pragma once

#include <string>
#include <vector>

#include "src/model/scene.h"

namespace polargrain {

/// The columns that series.csv has in every run of the scene, in their order; those of output.observe follow them.
std::vector<std::string> series_columns(const Scene& scene);

}  // namespace polargrain
