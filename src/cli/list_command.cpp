#include <fmt/format.h>

#include "shapes/library.h"
#include "src/cli/commands.h"
#include "src/cli/engine_table.h"
#include "src/observe/observable_table.h"

namespace polargrain {

namespace {

void print_entry(const std::string& name, const std::string& line) { fmt::print("  {:<24}  {}\n", name, line); }

/// What it is, in which units, and what it can be told.
std::string describe(const ObservableEntry& entry) {
    std::string text = fmt::format("{} [{}]", entry.line, fmt::join(units_of(entry.dimension), ", "));
    if (entry.needs != 0) text += fmt::format("; needs {}", fmt::join(parameter_keys(entry.needs), " or "));
    if (entry.takes != 0) text += fmt::format("; takes {}", fmt::join(parameter_keys(entry.takes), ", "));
    return text;
}

}  // namespace

int list_command(const std::string& what) {
    if (what.empty() || what == "scenarios") {
        fmt::print("scenarios (polargrain run NAME)\n");
        for (const ScenarioEntry& entry : shipped_scenarios()) print_entry(entry.name, entry.title);
    }
    if (what.empty() || what == "shapes") {
        fmt::print("shapes (polargrain shape NAME; in a scenario: type = \"file\", path = \"NAME\")\n");
        for (const OutlineFile& outline : shape_library()) print_entry(outline.name, outline.title);
    }
    if (what.empty() || what == "engines") {
        fmt::print("engines (run.engine, or --engine NAME)\n");
        for (const EngineEntry& entry : engine_table()) print_entry(entry.name, entry.line);
    }
    if (what.empty() || what == "observables") {
        fmt::print("observables (quantity in [[expect]] and in output.observe; docs/observables.md)\n");
        for (const ObservableEntry& entry : observable_table()) print_entry(entry.name, describe(entry));
    }
    return k_exit_done;
}

}  // namespace polargrain
