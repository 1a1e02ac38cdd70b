#pragma once

// Private to this folder: names that the writer and the reader of trajectory.h5 share; docs/run-folder.md explains
// them.

namespace polargrain::layout {

inline constexpr int k_version = 1;  ///< of what stands under /polargrain

inline constexpr const char* k_grains = "/particles/grains";
inline constexpr const char* k_ours = "/polargrain";
inline constexpr const char* k_shapes = "/polargrain/shapes";
inline constexpr const char* k_materials = "/polargrain/materials";
inline constexpr const char* k_walls = "/polargrain/walls";
inline constexpr const char* k_contacts = "/polargrain/contacts";
/// How many frames are whole; files of earlier versions have it not.
inline constexpr const char* k_frames = "/polargrain/frames";

/// In a checkpoint: where the chunks of each dataset stand.
inline constexpr const char* k_places = "places";

}  // namespace polargrain::layout
