#pragma once

#include <filesystem>
#include <string>

namespace polargrain {

/// Where a part of what is shipped with the program lies, such as "scenarios": below the folder that the environment
/// variable POLARGRAIN_DATA names, else in the tree that the program was built from, else in ../share/polargrain beside
/// the program. InputError where it is in none of them.
std::filesystem::path data_folder(const std::string& part);

}  // namespace polargrain
