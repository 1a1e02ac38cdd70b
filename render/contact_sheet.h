#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/frame_style.h"
#include "src/record/trajectory_reader.h"

namespace polargrain {

struct ContactSheetSettings {
    int count = 12;    ///< frames to show
    int columns = 0;   ///< 0: as many as make the sheet about 3/4 as high as wide
    int width = 1920;  ///< [pixel] of the whole sheet
};

/// One PNG with `count` frames, spread evenly from the first to the last, of a folder that FramesSink filled with PNG
/// files; each with its time. All are shown where there are fewer. InputError where the folder has no index.csv or no
/// PNG frames, RunError where the sheet cannot be written.
void contact_sheet(const std::filesystem::path& frames_folder, const std::filesystem::path& sheet,
                   const ContactSheetSettings& settings = {});

/// The same, drawn anew from a recording; cells are sharp at any size, and share one legend. png, svg or pdf.
void contact_sheet(const TrajectoryReader& recording, const FrameStyle& style, const std::filesystem::path& sheet,
                   const ContactSheetSettings& settings = {});

/// A frame of a recording, and what is written into its corner.
struct LabelledFrame {
    int frame;
    std::string label;
};

/// The same with chosen frames; settings.count does not matter.
void contact_sheet(const TrajectoryReader& recording, const std::vector<LabelledFrame>& cells, const FrameStyle& style,
                   const std::filesystem::path& sheet, const ContactSheetSettings& settings = {});

}  // namespace polargrain
