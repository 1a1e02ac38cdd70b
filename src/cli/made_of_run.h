#pragma once

#include <filesystem>
#include <string>

namespace polargrain {

/// Where the commands that draw or tabulate a run put what they make, unless told otherwise: into its folder.
std::filesystem::path sheet_in(const std::filesystem::path& folder);
std::filesystem::path export_in(const std::filesystem::path& folder);
std::filesystem::path frames_in(const std::filesystem::path& folder, const std::string& colour);
std::filesystem::path movie_in(const std::filesystem::path& folder, const std::string& colour);

/// Without the endings, k_plot_endings.
std::filesystem::path plot_in(const std::filesystem::path& folder);
inline constexpr const char* k_plot_endings[] = {".png", ".pdf", ".csv"};

/// Removes all of these, which would show a run that is no longer there: only files with the names that the commands
/// give. Throws std::filesystem::filesystem_error.
void remove_made_of_run(const std::filesystem::path& folder);

/// Removes drawn frames and their index.csv from a folder, nothing else.
void remove_frames(const std::filesystem::path& frames);

/// Are there any?
bool holds_frames(const std::filesystem::path& frames);

}  // namespace polargrain
