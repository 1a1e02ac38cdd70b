#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace polargrain {

/// Columns of a CSV file by their names; every field a number, others as NaN. InputError names the file.
std::map<std::string, std::vector<double>> read_columns(const std::filesystem::path& csv);

}  // namespace polargrain
