#include "scenarios/table_reader.h"

#include <algorithm>

#include "scenarios/toml_text.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

std::string under(const std::string& path, std::string_view key) {
    return path.empty() ? toml_key(key) : path + "." + toml_key(key);
}

std::string hint(std::string_view word, std::span<const std::string> candidates) {
    const std::string nearest = nearest_name(word, candidates);
    return nearest.empty() ? fmt::format("it takes {}", fmt::join(candidates, ", "))
                           : fmt::format("did you mean \"{}\"?", nearest);
}

SourceLocation known_or(const SourceLocation& place, const SourceLocation& parent) {
    const bool from_file = place.line > 0 || place.file.rfind("--", 0) == 0;
    return from_file || parent.file.empty() ? place : parent;
}

}  // namespace

bool is_plain_name(std::string_view name) { return !name.empty() && toml_key(name) == name; }

TableReader::TableReader(const Document& document, const KeyTable& keys)
    : TableReader(document, {"", "", &document.root(), document.where("", document.root().source())}, keys) {}

TableReader::TableReader(const Document& document, const TableItem& item, const KeyTable& keys)
    : TableReader(document, item) {
    refuse_unknown_keys(keys);
}

TableReader::TableReader(const Document& document, const TableItem& item)
    : document_(&document), table_(item.table), path_(item.path), where_(item.where) {}

void TableReader::refuse_unknown_keys(const KeyTable& keys) const {
    for (const auto& [key, value] : *table_) {
        if (std::find(keys.keys.begin(), keys.keys.end(), key.str()) != keys.keys.end()) continue;
        const std::string full = path(key.str());
        const std::string kind = keys.variant.empty() ? "" : fmt::format(" (of type {})", keys.variant);
        throw InputError(document_->where(full, key.source()),
                         fmt::format("unknown key {}{}; {}", full, kind, hint(key.str(), keys.keys)));
    }
}

std::string TableReader::path(std::string_view key) const { return under(path_, key); }

SourceLocation TableReader::where(std::string_view key) const {
    const toml::node* node = table_->get(key);
    return node == nullptr ? where_ : known_or(document_->where(path(key), node->source()), where_);
}

bool TableReader::has(std::string_view key) const { return table_->contains(key); }

void TableReader::fail(std::string_view key, const std::string& message) const {
    throw InputError(where(key), fmt::format("{}: {}", path(key), message));
}

void TableReader::fail_at(const toml::node& node, const std::string& node_path, const std::string& message) const {
    throw InputError(known_or(document_->where(node_path, node.source()), where_),
                     fmt::format("{}: {}", node_path, message));
}

const toml::node* TableReader::find(std::string_view key) {
    read_.emplace_back(key);
    return table_->get(key);
}

const toml::node& TableReader::need(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        throw InputError(where_, fmt::format("{} is missing; add {} = ... to {}", path(key), key,
                                             path_.empty() ? "the file" : path_));
    }
    return *node;
}

double TableReader::checked(std::string_view key, const toml::node& node, const std::string& node_path,
                            const NumberRange& range) const {
    if (!node.is_number()) {
        fail_at(node, node_path,
                fmt::format("is {}, must be a number; write for example {} = 0.5", kind_of(node), key));
    }
    const double value = *node.value<double>();
    if (!(value >= range.low && value <= range.high)) {
        fail_at(node, node_path, fmt::format("is {}, must be {}; change the number", value, range.words));
    }
    return value;
}

double TableReader::number(std::string_view key, const NumberRange& range, std::optional<double> fallback) {
    double value = 0.0;
    if (fallback && !has(key)) {
        read_.emplace_back(key);
        value = *fallback;
    } else {
        value = checked(key, need(key), path(key), range);
    }
    write(key, toml_text(value));
    return value;
}

std::optional<double> TableReader::optional_number(std::string_view key, const NumberRange& range) {
    if (has(key)) return number(key, range);
    read_.emplace_back(key);
    return {};
}

std::int64_t TableReader::checked_integer(std::string_view key, const toml::node& node, const std::string& node_path,
                                          std::int64_t low, std::int64_t high) const {
    if (!node.is_integer()) {
        fail_at(node, node_path,
                fmt::format("is {}, must be a whole number; write for example {} = {}",
                            node.is_floating_point() ? "a number with a fraction" : kind_of(node), key,
                            std::max<std::int64_t>(low, 1)));
    }
    const std::int64_t value = node.as_integer()->get();
    if (value < low || value > high) {
        fail_at(node, node_path,
                fmt::format("is {}, must be a whole number from {} to {}; change it", value, low, high));
    }
    return value;
}

std::int64_t TableReader::integer(std::string_view key, std::int64_t low, std::int64_t high,
                                  std::optional<std::int64_t> fallback) {
    std::int64_t value = 0;
    if (fallback && !has(key)) {
        read_.emplace_back(key);
        value = *fallback;
    } else {
        value = checked_integer(key, need(key), path(key), low, high);
    }
    write(key, std::to_string(value));
    return value;
}

std::vector<std::int64_t> TableReader::integers(std::string_view key, std::int64_t low, std::int64_t high,
                                                const std::vector<std::int64_t>& fallback) {
    std::vector<std::int64_t> values;
    if (has(key)) {
        const toml::array& array = need_array(key, 1, "[2, 6]");
        for (std::size_t k = 0; k < array.size(); ++k) {
            values.push_back(checked_integer(key, array[k], fmt::format("{}[{}]", path(key), k), low, high));
        }
    } else {
        read_.emplace_back(key);
        values = fallback;
    }
    write(key, fmt::format("[{}]", fmt::join(values, ", ")));
    return values;
}

bool TableReader::flag(std::string_view key, bool fallback) {
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_boolean()) {
        fail(key, fmt::format("is {}, must be true or false, without quotes", kind_of(*node)));
    }
    const bool value = node == nullptr ? fallback : node->as_boolean()->get();
    write(key, value ? "true" : "false");
    return value;
}

std::string TableReader::text(std::string_view key, std::optional<std::string> fallback) {
    std::string value;
    if (fallback && !has(key)) {
        read_.emplace_back(key);
        value = *fallback;
    } else {
        const toml::node& node = need(key);
        if (!node.is_string()) {
            fail(key, fmt::format("is {}, must be a string; write {} = \"...\"", kind_of(node), key));
        }
        value = node.as_string()->get();
    }
    write(key, toml_text(value));
    return value;
}

std::string TableReader::choice(std::string_view key, std::span<const std::string> allowed,
                                std::optional<std::string> fallback) {
    std::string value = variant(key, allowed, std::move(fallback));
    read_.emplace_back(key);
    write(key, toml_text(value));
    return value;
}

Vec2 TableReader::pair_of(std::string_view key, const toml::node& node, const std::string& node_path) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != 2) {
        fail_at(node, node_path,
                fmt::format("must be a pair of numbers such as [0.0, 0.1], but is {}",
                            array == nullptr ? kind_of(node) : fmt::format("an array of {}", array->size())));
    }
    return {checked(key, (*array)[0], node_path + "[0]", k_coordinate),
            checked(key, (*array)[1], node_path + "[1]", k_coordinate)};
}

Vec2 TableReader::point(std::string_view key, std::optional<Vec2> fallback) {
    Vec2 value = Vec2::Zero();
    if (fallback && !has(key)) {
        read_.emplace_back(key);
        value = *fallback;
    } else {
        value = pair_of(key, need(key), path(key));
    }
    write(key, toml_text(value));
    return value;
}

const toml::array& TableReader::need_array(std::string_view key, std::size_t at_least, const char* example) {
    const toml::node& node = need(key);
    const toml::array* array = node.as_array();
    if (array == nullptr) fail(key, fmt::format("is {}, must be an array such as {}", kind_of(node), example));
    if (array->size() < at_least) {
        fail(key, fmt::format("has {} entries, needs {} at least", array->size(), at_least));
    }
    return *array;
}

std::vector<Vec2> TableReader::points(std::string_view key, std::size_t at_least) {
    const toml::array& array = need_array(key, at_least, "[[0.0, 0.0], [1.0, 0.0]]");
    std::vector<Vec2> values;
    for (std::size_t k = 0; k < array.size(); ++k) {
        values.push_back(pair_of(key, array[k], fmt::format("{}[{}]", path(key), k)));
    }
    write(key, toml_text(values));
    return values;
}

std::vector<double> TableReader::numbers(std::string_view key, const NumberRange& range, std::size_t at_least) {
    const toml::array& array = need_array(key, at_least, "[1.0, 2.0]");
    std::vector<double> values;
    for (std::size_t k = 0; k < array.size(); ++k) {
        values.push_back(checked(key, array[k], fmt::format("{}[{}]", path(key), k), range));
    }
    write(key, toml_text(values));
    return values;
}

std::vector<std::string> TableReader::words(std::string_view key) {
    const toml::array& array = need_array(key, 1, R"(["first", "second"])");
    std::vector<std::string> values;
    for (const toml::node& node : array) {
        if (!node.is_string()) fail_at(node, path(key), fmt::format("holds {}, must hold strings", kind_of(node)));
        values.push_back(node.as_string()->get());
    }
    write(key, toml_text(array));
    return values;
}

const toml::node* TableReader::raw(std::string_view key) { return find(key); }

TableItem TableReader::item(std::string_view key) {
    static const toml::table empty;
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_table()) {
        fail(key, fmt::format("is {}, must be a table; write {} = {{ ... }}", kind_of(*node), key));
    }
    return {std::string{key}, path(key), node == nullptr ? &empty : node->as_table(), where(key)};
}

TableReader TableReader::table(std::string_view key, const KeyTable& keys) { return {*document_, item(key), keys}; }

TableReader TableReader::untyped_table(std::string_view key) { return {*document_, item(key)}; }

std::string TableReader::variant(std::string_view key, std::span<const std::string> allowed,
                                 std::optional<std::string> fallback) const {
    const toml::node* node = table_->get(key);
    if (node == nullptr && fallback) return *fallback;
    if (node == nullptr) {
        throw InputError(where_, fmt::format("{} is missing; choose one of {}", path(key), fmt::join(allowed, ", ")));
    }
    if (!node->is_string()) {
        fail(key, fmt::format("is {}, must be a string: one of {}", kind_of(*node), fmt::join(allowed, ", ")));
    }
    std::string value = node->as_string()->get();
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
        const std::string nearest = nearest_name(value, allowed);
        fail(key, fmt::format("\"{}\" is not known; {}choose one of {}", value,
                              nearest.empty() ? "" : fmt::format("did you mean \"{}\"? ", nearest),
                              fmt::join(allowed, ", ")));
    }
    return value;
}

std::vector<TableItem> TableReader::array_of_tables(std::string_view key) {
    std::vector<TableItem> items;
    const toml::node* node = find(key);
    if (node == nullptr) return items;
    const toml::array* array = node->as_array();
    if (array == nullptr) {
        fail(key, fmt::format("is {}, must be an array of tables; head each with [[{}]]", kind_of(*node), path(key)));
    }
    for (std::size_t k = 0; k < array->size(); ++k) {
        const toml::node& item = (*array)[k];
        const std::string item_path = fmt::format("{}[{}]", path(key), k);
        if (!item.is_table()) {
            fail_at(item, item_path,
                    fmt::format("is {}, must be a table; head it with [[{}]]", kind_of(item), path(key)));
        }
        items.push_back({"", item_path, item.as_table(), known_or(document_->where(item_path, item.source()), where_)});
    }
    return items;
}

std::vector<TableItem> TableReader::named_tables(std::string_view key) {
    std::vector<TableItem> items;
    const toml::node* node = find(key);
    if (node == nullptr) return items;
    const toml::table* table = node->as_table();
    if (table == nullptr)
        fail(key, fmt::format("is {}, must be tables; head each with [{}.NAME]", kind_of(*node), key));
    for (const auto& [name, item] : *table) {
        const std::string item_path = under(path(key), name.str());
        const std::string text{name.str()};
        if (!is_plain_name(text)) {
            throw InputError(document_->where(item_path, name.source()),
                             fmt::format("{}: a name is made of letters, digits, _ and -; rename it", item_path));
        }
        if (!item.is_table()) {
            fail_at(item, item_path,
                    fmt::format("is {}, must be a table; head it with [{}]", kind_of(item), item_path));
        }
        items.push_back(
            {text, item_path, item.as_table(), known_or(document_->where(item_path, item.source()), where_)});
    }
    return items;
}

}  // namespace polargrain
