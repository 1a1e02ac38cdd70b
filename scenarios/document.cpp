#include "scenarios/document.h"

#include <charconv>
#include <fstream>
#include <iterator>

#include "scenarios/toml_text.h"

namespace polargrain {

namespace {

/// One stop on the way to a value: a key, or an index into an array.
struct PathStep {
    std::string key;
    std::size_t index = 0;
    bool is_index = false;
};

PathStep step_of(const std::string& origin, const std::string& word, bool bracketed) {
    require(!word.empty(), "{}: there is an empty name in the key; write table.key=value, for example run.duration=2",
            origin);
    PathStep step{word, 0, false};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), step.index);
    step.is_index = error == std::errc{} && end == word.data() + word.size();
    require(step.is_index || !bracketed, R"({}: "{}" is no index; count from 0, for example walls[0].material="steel")",
            origin, word);
    return step;
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Splits "walls[0].points" or "walls.0.points".
std::vector<PathStep> split_path(const std::string& origin, const std::string& path) {
    std::vector<PathStep> steps;
    std::size_t at = 0;
    while (at <= path.size()) {
        const bool bracketed = at > 0 && path[at - 1] == '[';
        const std::size_t end = std::min(path.find_first_of(bracketed ? "]" : ".[", at), path.size());
        steps.push_back(step_of(origin, path.substr(at, end - at), bracketed));
        at = end + 1;
        if (bracketed && at < path.size()) {
            require(path[at] == '.' || path[at] == '[', "{}: after a closing bracket comes . or [ or nothing", origin);
            ++at;
        } else if (bracketed) {
            require(end < path.size(), "{}: a closing bracket is missing", origin);
            break;
        }
    }
    return steps;
}

std::string joined(const std::vector<PathStep>& steps) {
    std::string text;
    for (const PathStep& step : steps) {
        if (step.is_index) {
            text += fmt::format("[{}]", step.index);
        } else {
            text += (text.empty() ? "" : ".") + step.key;
        }
    }
    return text;
}

/// The value as TOML; a word that is none is taken as a string, so that quotes need not pass a shell.
toml::table parse_value(const std::string& origin, const std::string& value) {
    require(value.find('\n') == std::string::npos, "{}: the value must stand on one line", origin);
    try {
        return toml::parse("value = " + value);
    } catch (const toml::parse_error& error) {
        const bool structured = value.find_first_of("[]{}\"'=,") != std::string::npos;
        require(!structured && !value.empty(), "{}: the value is no TOML: {}; quote the whole argument from the shell",
                origin, error.description());
        return toml::table{{"value", value}};
    }
}

toml::node& enter_array(const std::string& origin, toml::node& node, const PathStep& step, const std::string& where) {
    toml::array* array = node.as_array();
    require(array != nullptr, "{}: {} is not an array; leave the index out", origin, where);
    require(step.index < array->size(), "{}: there is no {}[{}]: the scenario has {} of them, counted from 0", origin,
            where, step.index, array->size());
    return (*array)[step.index];
}

toml::node& enter_table(const std::string& origin, toml::node& node, const PathStep& step, const std::string& where) {
    require(!node.is_array(), "{}: {} is an array; say which one, for example {}[0].{}", origin, where, where,
            step.key);
    toml::table* table = node.as_table();
    require(table != nullptr, "{}: {} is a value, not a table, and has no key \"{}\"", origin, where, step.key);
    if (!table->contains(step.key)) table->insert(step.key, toml::table{});
    return *table->get(step.key);
}

std::string read_text(const std::filesystem::path& path) {
    require(std::filesystem::exists(path),
            "{}: there is no such file; `polargrain list scenarios` shows the shipped ones", path.string());
    require(!std::filesystem::is_directory(path), "{}: is a folder; name a scenario file in it", path.string());
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    require(file.good() || file.eof(), "{}: cannot be read; check its permissions", path.string());
    return text;
}

toml::table parse_file(const std::filesystem::path& path) {
    try {
        return toml::parse(read_text(path), path.string());
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        throw InputError({path.string(), static_cast<int>(at.line), static_cast<int>(at.column)},
                         fmt::format("not valid TOML: {}; see https://toml.io for the notation", error.description()));
    }
}

bool lies_under(const std::string& path, const std::string& parent) {
    if (path.size() <= parent.size() || path.compare(0, parent.size(), parent) != 0) return path == parent;
    return parent.empty() || path[parent.size()] == '.' || path[parent.size()] == '[';
}

}  // namespace

Document::Document(const std::filesystem::path& path, const ScenarioOverrides& overrides)
    : path_(path), root_(parse_file(path)) {
    apply(overrides);
}

std::filesystem::path Document::folder() const { return path_.parent_path(); }

void Document::apply(const ScenarioOverrides& overrides) {
    for (const LaidValue& value : overrides.laid) assign(value.from, value.text);
    for (const std::string& text : overrides.set) assign({"--set " + text}, text);
    if (overrides.engine) assign({"--engine " + *overrides.engine}, "run.engine", *overrides.engine);
    if (overrides.seed) {
        assign({fmt::format("--seed {}", *overrides.seed)}, "run.seed", std::to_string(*overrides.seed));
    }
    if (overrides.threads) {
        assign({fmt::format("--threads {}", *overrides.threads)}, "run.threads", std::to_string(*overrides.threads));
    }
    if (overrides.no_frames) assign({"--no-frames"}, "output.frames.every", "0");
}

std::string normal_key(const std::string& origin, const std::string& path) { return joined(split_path(origin, path)); }

void Document::assign(const SourceLocation& from, const std::string& text) {
    const std::string origin = to_string(from);
    require(fits_toml(text), "{}: is not UTF-8", origin);
    const std::size_t equals = text.find('=');
    require(equals != std::string::npos, "{}: has no \"=\"; write key.path=value, for example run.duration=2", origin);
    assign(from, trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1)));
}

void Document::assign(const SourceLocation& from, const std::string& path, const std::string& value) {
    const std::string origin = to_string(from);
    const std::vector<PathStep> steps = split_path(origin, path);
    toml::table parsed = parse_value(origin, value);
    toml::node* node = &root_;
    for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
        const std::string where = joined({steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(k)});
        const bool into_array = steps[k].is_index && node->is_array();
        node = into_array ? &enter_array(origin, *node, steps[k], where) : &enter_table(origin, *node, steps[k], where);
    }
    const PathStep& last = steps.back();
    const std::string where = joined({steps.begin(), steps.end() - 1});
    toml::node& fresh = *parsed.get("value");
    if (last.is_index && node->is_array()) {
        enter_array(origin, *node, last, where);
        toml::array& array = *node->as_array();
        array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(last.index), std::move(fresh));
    } else {
        enter_table(origin, *node, last, where);
        node->as_table()->insert_or_assign(last.key, std::move(fresh));
    }
    overrides_.insert(overrides_.begin(), {joined(steps), from});
}

SourceLocation Document::where(const std::string& path, const toml::source_region& source) const {
    for (const Override& given : overrides_) {
        const bool made_by_override = source.begin.line == 0 && lies_under(given.path, path);
        if (lies_under(path, given.path) || (made_by_override && !path.empty())) return given.origin;
    }
    return {path_.string(), static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

}  // namespace polargrain
