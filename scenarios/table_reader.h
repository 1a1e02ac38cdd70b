#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/document.h"
#include "scenarios/keys.h"
#include "src/core/error.h"
#include "src/core/vec2.h"

namespace polargrain {

/// What numbers a key takes. Every number must be finite besides, and below k_largest_number in magnitude, so that
/// products of a few of them stay finite.
struct NumberRange {
    double low;
    double high;
    const char* words;  ///< for messages: "must be ..."
};

inline constexpr double k_largest_number = 1e9;
inline constexpr NumberRange k_any_number{-k_largest_number, k_largest_number, "between -1e9 and 1e9"};
inline constexpr NumberRange k_coordinate{-1e6, 1e6, "between -1e6 and 1e6"};
inline constexpr NumberRange k_positive{1e-9, k_largest_number, "positive (from 1e-9 to 1e9)"};
inline constexpr NumberRange k_not_negative{0.0, k_largest_number, "zero or positive (up to 1e9)"};
inline constexpr NumberRange k_fraction{0.0, 1.0, "between 0 and 1"};

/// A table in a scenario file: its own name where it has one, its key path, and where it stands.
struct TableItem {
    std::string name;
    std::string path;
    const toml::table* table;
    SourceLocation where;
};

/// Letters, digits, _ and -: fit for a file name, a column of a table and a dotted key.
bool is_plain_name(std::string_view name);

/// Reads one table of a scenario, checks it, and writes each value, given or default, into the resolved scenario.
///
/// Building one refuses keys that the table does not take, with the nearest one it does. Every accessor throws
/// InputError with file, line, column, key path and remedy. `finish` proves that each key given was read. Refers to
/// the document, which must outlive it.
class TableReader {
public:
    /// The top of the file.
    TableReader(const Document& document, const KeyTable& keys);
    TableReader(const Document& document, const TableItem& item, const KeyTable& keys);
    /// For tables whose keys depend on one of them: only `variant` is to be asked.
    TableReader(const Document& document, const TableItem& item);

    const std::string& path() const { return path_; }
    std::string path(std::string_view key) const;
    SourceLocation where() const { return where_; }
    SourceLocation where(std::string_view key) const;
    bool has(std::string_view key) const;

    /// Refuses the value of a key: "<where>: <path>: <what is wrong and what to do>".
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;

    double number(std::string_view key, const NumberRange& range, std::optional<double> fallback = {});
    std::optional<double> optional_number(std::string_view key, const NumberRange& range);
    std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                         std::optional<std::int64_t> fallback = {});
    bool flag(std::string_view key, bool fallback);
    std::string text(std::string_view key, std::optional<std::string> fallback = {});
    /// One of the given words; another one is refused with the nearest.
    std::string choice(std::string_view key, std::span<const std::string> allowed,
                       std::optional<std::string> fallback = {});
    Vec2 point(std::string_view key, std::optional<Vec2> fallback = {});
    /// [[a, b], ...]
    std::vector<Vec2> points(std::string_view key, std::size_t at_least);
    std::vector<double> numbers(std::string_view key, const NumberRange& range, std::size_t at_least);
    std::vector<std::int64_t> integers(std::string_view key, std::int64_t low, std::int64_t high,
                                       const std::vector<std::int64_t>& fallback);
    std::vector<std::string> words(std::string_view key);

    /// The value as it stands, or null; marks the key as read. The caller checks it and calls `write`.
    const toml::node* raw(std::string_view key);
    /// A table under this one; an empty one where the key is missing. The caller hands it back to `adopt`.
    TableReader table(std::string_view key, const KeyTable& keys);
    /// The same before it is known which keys it takes: only `variant` is to be asked.
    TableReader untyped_table(std::string_view key);
    /// [[key]] tables; none where the key is missing.
    std::vector<TableItem> array_of_tables(std::string_view key);
    /// [key.NAME] tables in the order of their names; none where the key is missing.
    std::vector<TableItem> named_tables(std::string_view key);
    /// One of the given words, not yet marked as read: what decides which keys a table takes.
    std::string variant(std::string_view key, std::span<const std::string> allowed,
                        std::optional<std::string> fallback = {}) const;

    void write(std::string_view key, std::string text);
    /// Leaves what was read so far out of the resolved scenario; something else stands there for it.
    void discard_resolved() { resolved_.clear(); }
    /// Finishes a table that `table` gave, and writes it inline.
    void adopt(std::string_view key, const TableReader& child);
    /// Throws std::logic_error where a key that the table takes was given and yet never read.
    void finish() const;

    /// "key = value" lines of what was read.
    std::string resolved_lines() const;
    /// "{ key = value, ... }"
    std::string resolved_inline() const;

private:
    TableItem item(std::string_view key);
    const toml::node* find(std::string_view key);
    const toml::node& need(std::string_view key);
    double checked(std::string_view key, const toml::node& node, const std::string& node_path,
                   const NumberRange& range) const;
    std::int64_t checked_integer(std::string_view key, const toml::node& node, const std::string& node_path,
                                 std::int64_t low, std::int64_t high) const;
    Vec2 pair_of(std::string_view key, const toml::node& node, const std::string& node_path) const;
    const toml::array& need_array(std::string_view key, std::size_t at_least, const char* example);
    [[noreturn]] void fail_at(const toml::node& node, const std::string& node_path, const std::string& message) const;
    void refuse_unknown_keys(const KeyTable& keys) const;

    const Document* document_;
    const toml::table* table_;
    std::string path_;
    SourceLocation where_;
    std::vector<std::string> read_;
    std::vector<std::pair<std::string, std::string>> resolved_;
};

}  // namespace polargrain
