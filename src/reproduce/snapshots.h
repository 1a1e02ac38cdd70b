#pragma once

#include <filesystem>
#include <vector>

#include "render/contact_sheet.h"

namespace polargrain {

/// Chosen moments of a recording side by side: stem.png, stem.pdf, and stem.csv with what they show, a row per moment
/// and grain (label as in the picture, time [s], centre of mass [m], angle [rad], velocity [m/s], spin [rad/s]).
void draw_snapshots(const TrajectoryReader& recording, const std::vector<LabelledFrame>& cells, const FrameStyle& style,
                    const std::filesystem::path& stem, const ContactSheetSettings& settings);

}  // namespace polargrain
