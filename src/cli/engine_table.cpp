#include "src/cli/engine_table.h"

#include <algorithm>
#include <array>

#include "src/core/error.h"
#include "src/engines/box2d/box2d_engine.h"
#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/contact_engine.h"
#include "src/engines/dem/dem_engine.h"

namespace polargrain {

std::span<const EngineEntry> engine_table() {
    static const std::array table{
        EngineEntry{"contact", "the refined contact engine: dense beds that are right, and nothing overlaps",
                    [](const Scene& scene, const EngineSettings&) { return make_contact(scene); }, 2.5e-6},
        EngineEntry{"contact-1994", "the contact model of Hogue & Newland 1994, to the letter",
                    [](const Scene& scene, const EngineSettings&) { return make_contact_1994(scene); }, 2e-6},
        EngineEntry{
            "box2d", "Box2D 2.4, a games engine: outlines cut into convex pieces",
            [](const Scene& scene, const EngineSettings& settings) { return make_box2d(scene, settings.box2d); }, 3e-6},
        EngineEntry{"dem", "soft spheres on real shapes: overlapping, springy contacts in many small steps",
                    [](const Scene& scene, const EngineSettings& settings) { return make_dem(scene, settings.dem); },
                    4e-7},
    };
    return table;
}

const EngineEntry& find_engine(const std::string& name) {
    const std::span<const EngineEntry> table = engine_table();
    const auto found = std::ranges::find(table, name, &EngineEntry::name);
    if (found != table.end()) return *found;
    std::string names;
    for (const EngineEntry& entry : table) names += (names.empty() ? "" : ", ") + entry.name;
    throw InputError(fmt::format(
        "run.engine = \"{}\": this build has no such engine; set run.engine (or --engine) to one it has: {}", name,
        names));
}

}  // namespace polargrain
