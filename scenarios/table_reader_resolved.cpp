#include <algorithm>

#include "scenarios/table_reader.h"
#include "scenarios/toml_text.h"

namespace polargrain {

void TableReader::write(std::string_view key, std::string text) {
    resolved_.emplace_back(std::string{key}, std::move(text));
}

void TableReader::adopt(std::string_view key, const TableReader& child) {
    child.finish();
    write(key, child.resolved_inline());
}

void TableReader::finish() const {
    for (const auto& [key, value] : *table_) {
        if (std::find(read_.begin(), read_.end(), key.str()) == read_.end()) {
            broken_invariant("every key is read", __FILE__, __LINE__, path(key.str()));
        }
    }
}

std::string TableReader::resolved_lines() const {
    std::string lines;
    for (const auto& [key, text] : resolved_) lines += fmt::format("{} = {}\n", toml_key(key), text);
    return lines;
}

std::string TableReader::resolved_inline() const {
    std::string list;
    for (const auto& [key, text] : resolved_) {
        list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", toml_key(key), text);
    }
    return list.empty() ? "{}" : "{ " + list + " }";
}

}  // namespace polargrain
