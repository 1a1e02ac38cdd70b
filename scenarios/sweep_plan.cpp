#include "scenarios/sweep_plan.h"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "scenarios/document.h"
#include "scenarios/toml_text.h"
#include "src/core/error.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t k_most_runs = 100'000;

/// A parsed sweep file that knows where everything stands in it.
class SweepFile {
public:
    explicit SweepFile(const fs::path& path) : path_(path) {
        std::error_code status;
        require(!fs::is_directory(path, status), "{}: is a folder; name a sweep file in it", path.string());
        require(fs::is_regular_file(path, status),
                "{}: there is no such sweep file; docs/sweep.md explains how to write one", path.string());
        std::ifstream file(path, std::ios::binary);
        require(file.good(), "{}: cannot be read; check its permissions", path.string());
        text_.assign(std::istreambuf_iterator<char>(file), {});
        try {
            root_ = toml::parse(text_, path.string());
        } catch (const toml::parse_error& error) {
            fail(error.source(), std::string("not valid TOML: ") + std::string(error.description()));
        }
    }

    const std::string& text() const { return text_; }
    const toml::table& root() const { return root_; }
    fs::path folder() const { return path_.parent_path(); }

    SourceLocation place(const toml::source_region& source) const {
        return {path_.string(), static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
    }
    SweepPlan::Value value(const toml::node& node) const { return {toml_text(node), place(node.source())}; }

    [[noreturn]] void fail(const toml::source_region& source, const std::string& message) const {
        throw InputError(place(source), message);
    }
    [[noreturn]] void fail(const std::string& message) const { throw InputError({path_.string(), 0, 0}, message); }

private:
    fs::path path_;
    std::string text_;
    toml::table root_;
};

void check_keys(const SweepFile& file) {
    static const std::vector<std::string> known = {"title", "scenario", "seeds", "engines", "frames", "set", "vary"};
    for (const auto& [key, value] : file.root()) {
        const std::string name(key.str());
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        file.fail(key.source(), fmt::format("{}: unknown key; the nearest is {} (one of {})", name,
                                            nearest_name(name, known), fmt::join(known, ", ")));
    }
}

const toml::table* table_of(const SweepFile& file, const char* key) {
    const toml::node* node = file.root().get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) {
        file.fail(node->source(),
                  fmt::format("{}: is {}, must be a table; head it with [{}]", key, kind_of(*node), key));
    }
    return node->as_table();
}

const toml::array* filled_array(const SweepFile& file, const std::string& key, const toml::node& node) {
    const toml::array* values = node.as_array();
    if (values == nullptr || values->empty()) {
        file.fail(node.source(), fmt::format("{}: must be a list of at least one value; put it in [ ]", key));
    }
    return values;
}

std::string text_of(const SweepFile& file, const char* key, const std::string& fallback) {
    const toml::node* node = file.root().get(key);
    if (node == nullptr) return fallback;
    if (!node->is_string()) file.fail(node->source(), fmt::format("{}: is {}, must be a string", key, kind_of(*node)));
    return node->value_or(fallback);
}

bool flag_of(const SweepFile& file, const char* key, bool fallback) {
    const toml::node* node = file.root().get(key);
    if (node == nullptr) return fallback;
    if (!node->is_boolean()) {
        file.fail(node->source(), fmt::format("{}: is {}, must be true or false, without quotes", key, kind_of(*node)));
    }
    return node->value_or(fallback);
}

fs::path scenario_of(const SweepFile& file) {
    const toml::node* node = file.root().get("scenario");
    if (node == nullptr) file.fail("scenario: is missing; name a scenario file, or a shipped scenario");
    const std::string name = text_of(file, "scenario", "");
    const fs::path beside = file.folder() / name;
    try {
        return find_scenario(fs::is_regular_file(beside) ? beside.string() : name);
    } catch (const InputError& error) {
        file.fail(node->source(), std::string("scenario: ") + error.what());
    }
}

/// A list of values that have runs of their own: a second one of the same would have the same runs.
class DistinctValues {
public:
    DistinctValues(const SweepFile& file, const char* key) : file_(file), key_(key) {}

    void add(const toml::node& node, SweepPlan::Value value) {
        if (!seen_.insert(value.text).second) {
            file_.fail(node.source(),
                       fmt::format("{}: {} stands there twice; leave one of them out", key_, value.text));
        }
        values_.push_back(std::move(value));
    }
    std::vector<SweepPlan::Value> take() { return std::move(values_); }

private:
    const SweepFile& file_;
    const char* key_;
    std::set<std::string> seen_;
    std::vector<SweepPlan::Value> values_;
};

std::vector<SweepPlan::Value> seeds_of(const SweepFile& file) {
    const toml::node* node = file.root().get("seeds");
    std::vector<SweepPlan::Value> seeds;
    if (node == nullptr) return seeds;
    const auto number = [&file](const toml::node& value) {
        const auto seed = value.value<std::int64_t>();
        if (!value.is_integer() || *seed < 0) {
            file.fail(value.source(), "seeds: must be whole numbers from 0 up, as in [1, 2, 3], or how many, as in 3");
        }
        return *seed;
    };
    if (const toml::array* values = node->as_array()) {
        DistinctValues distinct(file, "seeds");
        for (const toml::node& value : *values) {
            distinct.add(value, {std::to_string(number(value)), file.place(value.source())});
        }
        seeds = distinct.take();
    } else {
        const std::int64_t count = number(*node);
        if (count > k_most_runs) {
            file.fail(node->source(),
                      fmt::format("seeds: {} are more than the {} runs that a sweep can have; in [ ] it "
                                  "would be one seed",
                                  count, k_most_runs));
        }
        for (std::int64_t seed = 1; seed <= count; ++seed) {
            seeds.push_back({std::to_string(seed), file.place(node->source())});
        }
    }
    if (seeds.empty()) file.fail(node->source(), "seeds: are none; leave the key out for the scenario's own");
    return seeds;
}

std::vector<SweepPlan::Value> engines_of(const SweepFile& file) {
    const toml::node* node = file.root().get("engines");
    if (node == nullptr) return {};
    DistinctValues engines(file, "engines");
    for (const toml::node& value : *filled_array(file, "engines", *node)) {
        if (!value.is_string()) file.fail(value.source(), R"(engines: must be names, as in ["contact", "dem"])");
        engines.add(value, file.value(value));
    }
    return engines.take();
}

/// Calls take(key path, value) for each value of a table and of the tables in it: run.duration = 1 is the same as
/// "run.duration" = 1.
template <typename Take>
void for_each_setting(const SweepFile& file, const toml::table& table, const std::string& prefix, Take take) {
    for (const auto& [key, value] : table) {
        const std::string path = prefix + std::string(key.str());
        if (const toml::table* inner = value.as_table()) {
            for_each_setting(file, *inner, path + ".", take);
            continue;
        }
        // These have a place of their own.
        for (const auto& [taken, instead] : {std::pair{"run.seed", "seeds"}, std::pair{"run.engine", "engines"}}) {
            if (path == taken) {
                file.fail(key.source(), fmt::format("{}: give it by the key {} at the top of the file", path, instead));
            }
        }
        take(path, value);
    }
}

/// Each run is read and checked before the first one starts, and has a row of the table.
void check_count(const SweepFile& file, const SweepPlan& plan) {
    auto runs = static_cast<double>(std::max<std::size_t>(1, plan.seeds.size()));
    runs *= static_cast<double>(std::max<std::size_t>(1, plan.engines.size()));
    for (const SweepPlan::Parameter& parameter : plan.parameters) runs *= static_cast<double>(parameter.values.size());
    if (runs <= static_cast<double>(k_most_runs)) return;
    file.fail(
        fmt::format("every value with every other makes {} runs, and a sweep can have {}; vary less, or make "
                    "several sweeps of it",
                    runs, k_most_runs));
}

}  // namespace

SweepPlan load_sweep(const fs::path& path) {
    const SweepFile file(path);
    check_keys(file);
    SweepPlan plan;
    plan.title = text_of(file, "title", path.stem().string());
    plan.text = file.text();
    plan.scenario = scenario_of(file);
    plan.engines = engines_of(file);
    plan.seeds = seeds_of(file);
    plan.frames = flag_of(file, "frames", false);
    // However a key is spelt: of two that lay over the same value the last would win, and the table would tell of both.
    std::map<std::string, std::string> tables;
    const auto claim = [&](const std::string& key, const toml::node& value, const std::string& table) {
        const SourceLocation place = file.place(value.source());
        const auto [found, is_new] = tables.emplace(normal_key(to_string(place), key), table);
        if (is_new) return;
        const std::string where = found->second == table ? "in this table already, spelt otherwise" : "in [set] too";
        file.fail(value.source(), fmt::format("{}: stands {}; leave one of them out", key, where));
    };
    if (const toml::table* set = table_of(file, "set")) {
        for_each_setting(file, *set, "", [&](const std::string& key, const toml::node& value) {
            claim(key, value, "set");
            plan.set.push_back({key + "=" + toml_text(value), file.place(value.source())});
        });
    }
    if (const toml::table* vary = table_of(file, "vary")) {
        for_each_setting(file, *vary, "", [&](const std::string& key, const toml::node& values) {
            claim(key, values, "vary");
            SweepPlan::Parameter parameter{key, {}};
            for (const toml::node& value : *filled_array(file, key, values)) {
                parameter.values.push_back(file.value(value));
            }
            plan.parameters.push_back(std::move(parameter));
        });
    }
    check_count(file, plan);
    return plan;
}

std::vector<SweepRun> sweep_runs(const SweepPlan& plan) {
    std::vector<SweepRun> runs(1);
    runs[0].overrides.laid = plan.set;
    runs[0].overrides.no_frames = !plan.frames;
    const auto multiply = [&runs](const std::string& key, const std::vector<SweepPlan::Value>& values) {
        if (values.empty()) return;
        std::vector<SweepRun> more;
        for (const SweepRun& run : runs) {
            for (const SweepPlan::Value& value : values) {
                more.push_back(run);
                more.back().overrides.laid.push_back({key + "=" + value.text, value.from});
                more.back().values.push_back(value.text);
            }
        }
        runs = std::move(more);
    };
    for (const SweepPlan::Parameter& parameter : plan.parameters) multiply(parameter.key, parameter.values);
    multiply("run.engine", plan.engines);
    multiply("run.seed", plan.seeds);
    for (SweepRun& run : runs) run.values.resize(plan.parameters.size());
    return runs;
}

}  // namespace polargrain
