#include "src/record/csv_columns.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "src/core/error.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t comma = std::min(line.find(',', begin), line.size());
        fields.push_back(line.substr(begin, comma - begin));
        begin = comma + 1;
    }
    return fields;
}

double number(std::string_view field) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    return error == std::errc() && end == field.data() + field.size() ? value : std::nan("");
}

}  // namespace

CsvColumns read_columns(const fs::path& csv) {
    std::ifstream file(csv);
    std::string line;
    require(file.good() && std::getline(file, line), "{}: cannot be read, or is empty", csv.string());
    CsvColumns columns;
    for (const std::string_view name : fields_of(line)) {
        columns.names.emplace_back(name);
        columns.values[columns.names.back()];
    }
    while (std::getline(file, line)) {
        const std::vector<std::string_view> fields = fields_of(line);
        if (fields.size() != columns.names.size()) continue;  // a last row cut short
        for (std::size_t c = 0; c < fields.size(); ++c) columns.values[columns.names[c]].push_back(number(fields[c]));
    }
    return columns;
}

}  // namespace polargrain
