#pragma once

#include <vector>

#include "src/reproduce/finding.h"
#include "src/reproduce/mixer_runs.h"

namespace polargrain {

// Pictures of a V-mixer, all seen from the vessel.

/// Ten instants of one turn of a set, seed 1, as in [K02, Figs. 5, 6].
FigurePicture draw_mixer_sheet(const FigureDesk& desk, char set);
/// Exchange and circulation time over the speed of the mixer, as in [K02, Figs. 12, 14].
FigurePicture draw_mixer_rates(const FigureDesk& desk, const std::vector<MixerSetRuns>& sets);
/// Mean velocity per cell for each set, as in [K02, Fig. 7].
FigurePicture draw_mixer_velocities(const FigureDesk& desk, const std::vector<MixerSetRuns>& sets);
/// Granular temperature per cell for each set, as in [K02, Fig. 11].
FigurePicture draw_mixer_temperatures(const FigureDesk& desk, const std::vector<MixerSetRuns>& sets);

}  // namespace polargrain
