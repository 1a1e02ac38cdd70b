#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace polargrain {

/// The columns of a CSV file.
struct CsvColumns {
    std::vector<std::string> names;                     ///< in their order
    std::map<std::string, std::vector<double>> values;  ///< by name; every field a number, others as NaN
};

/// Rows cut short, as a run in progress or a kill leaves one, do not count. InputError names a file that cannot be
/// read.
CsvColumns read_columns(const std::filesystem::path& csv);

}  // namespace polargrain
