#include <fmt/format.h>

#include "shapes/library.h"
#include "src/cli/commands.h"
#include "src/cli/engine_table.h"

namespace polargrain {

namespace {

void print_entry(const std::string& name, const std::string& line) { fmt::print("  {:<20}  {}\n", name, line); }

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
    return k_exit_done;
}

}  // namespace polargrain
