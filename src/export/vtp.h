#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "src/export/poly_data.h"

namespace polargrain {

/// The data as a file of VTK's XML format for PolyData (.vtp), version 1.0, which VTK reads from release 6 on; `time`
/// [s] stands in it as the field TimeValue.
///
/// Numbers follow the XML head as the bytes that they are (appended, raw), every double with all of its bits: as text,
/// those of 8000 disks would be nearly twice as long and take VTK a quarter of a second instead of milliseconds. The
/// head is text, and XML when the bytes are taken out. Equal data give equal bytes.
std::string vtp_text(const PolyData& data, double time);

/// One file of a collection, and when it is shown.
struct TimedFile {
    double time = 0.0;  ///< [s]
    std::string file;   ///< relative to the folder of the collection
};

/// A ParaView collection (.pvd): the files that make an animation.
std::string pvd_text(std::span<const TimedFile> files);

}  // namespace polargrain
