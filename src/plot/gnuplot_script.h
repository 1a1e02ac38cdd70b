#pragma once

// Private to this folder: how a plot is said in gnuplot's language.

#include <filesystem>
#include <string>

#include "src/plot/plot.h"

namespace polargrain {

/// The script that draws the plot into both files. The numbers stand in the script itself.
std::string gnuplot_script(const Plot& plot, const std::filesystem::path& png, const std::filesystem::path& pdf);

}  // namespace polargrain
