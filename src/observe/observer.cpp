#include "src/observe/observer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "src/core/error.h"
#include "src/core/nearest_name.h"
#include "src/observe/bridges.h"
#include "src/observe/deepest_overlap.h"
#include "src/observe/flow_meter.h"
#include "src/observe/snapshots.h"
#include "src/observe/stress.h"
#include "src/observe/toppling_meter.h"

namespace polargrain {

namespace {

using AnyMeter = std::variant<Snapshot, TopplingMeter, FlowMeter, BridgeMeter, StressMeter, WallMeter, OverlapMeter>;

int wall_number(const ObservableSpec& spec, const Scene& scene) {
    const auto found = std::ranges::find(scene.walls, *spec.wall, &Wall::name);
    return static_cast<int>(found - scene.walls.begin());
}

AnyMeter make_meter(const ObservableSpec& spec, const Scene& scene) {
    const std::string& q = spec.quantity;
    const auto flow = [&](FlowMeter::Measure measure) {
        return FlowMeter(scene, kind_of_grains(scene, spec), spec.opening, measure);
    };
    const auto bridge = [&](BridgeMeter::Measure measure) { return BridgeMeter(scene, *spec.opening, measure); };
    const auto stress = [&](StressMeter::Component component) { return StressMeter(*spec.region, component); };
    const auto wall = [&](WallMeter::Measure measure) {
        return WallMeter(wall_number(spec, scene), spec.region, measure);
    };
    if (q == "domino_speed") return TopplingMeter(scene);
    if (q == "domino_run_in") return TopplingMeter(scene, TopplingMeter::Measure::run_in);
    if (q == "deepest_overlap") return OverlapMeter(scene);
    if (q == "grains_passed") return flow(FlowMeter::Measure::count);
    if (q == "grain_flow") return flow(FlowMeter::Measure::grain_rate);
    if (q == "flow_rate") return flow(FlowMeter::Measure::area_rate);
    if (q == "bridges") return bridge(BridgeMeter::Measure::count);
    if (q == "bridge_life") return bridge(BridgeMeter::Measure::life);
    if (q == "bridge_time_share") return bridge(BridgeMeter::Measure::time_share);
    if (q == "bridge_grains") return bridge(BridgeMeter::Measure::grains);
    if (q == "stress_xx") return stress(StressMeter::Component::xx);
    if (q == "stress_xy") return stress(StressMeter::Component::xy);
    if (q == "stress_yy") return stress(StressMeter::Component::yy);
    if (q == "stress_pressure") return stress(StressMeter::Component::pressure);
    if (q == "wall_pressure") return wall(WallMeter::Measure::pressure);
    if (q == "wall_weight_share") return wall(WallMeter::Measure::weight_share);
    return Snapshot(spec, kind_of_grains(scene, spec), find_snapshot(q));
}

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::uint8_t given_parameters(const ObservableSpec& spec) {
    std::uint8_t given = 0;
    if (spec.region) given |= k_region;
    if (spec.shape || spec.material || spec.started_in) given |= k_kind;
    if (spec.opening) given |= k_opening;
    if (spec.wall) given |= k_wall;
    if (spec.cell) given |= k_cell;
    return given;
}

void check_parameters(const ObservableEntry& entry, const ObservableSpec& spec) {
    const std::uint8_t given = given_parameters(spec);
    const auto missing = static_cast<std::uint8_t>(entry.needs & ~given);
    require(missing == 0, "{} needs to know more: give {}", entry.name, joined(parameter_keys(missing), " or "));
    const auto taken = static_cast<std::uint8_t>(entry.needs | entry.takes);
    const auto extra = static_cast<std::uint8_t>(given & ~taken);
    require(extra == 0, "{} does not take {}; {}", entry.name, joined(parameter_keys(extra), " or "),
            taken == 0 ? std::string("leave it out") : "it takes " + joined(parameter_keys(taken), ", "));
}

/// Refuses a name that is none of those there are.
void check_name(const char* what, const std::optional<std::string>& name, const std::set<std::string>& known) {
    if (!name || known.contains(*name)) return;
    const std::vector<std::string> names(known.begin(), known.end());
    const std::string nearest = nearest_name(*name, names);
    throw InputError(fmt::format("there is no {} \"{}\" here; {}", what, *name,
                                 !nearest.empty() ? "did you mean \"" + nearest + "\"?"
                                 : names.empty()  ? std::string("there are none at all")
                                                  : "there are: " + joined(names, ", ")));
}

/// What can be told wrong without making the meter.
void check_words(const ObservableSpec& spec, const Scene& scene) {
    const ObservableEntry* entry = find_observable(spec.quantity);
    if (entry == nullptr) {
        const std::string nearest = nearest_name(spec.quantity, observable_names());
        throw InputError(fmt::format("\"{}\" is no observable; {}", spec.quantity,
                                     nearest.empty() ? "polargrain list observables tells which there are"
                                                     : "did you mean \"" + nearest + "\"?"));
    }
    check_parameters(*entry, spec);
    std::set<std::string> walls, shapes, materials;
    for (const Wall& wall : scene.walls) walls.insert(wall.name);
    for (const auto& shape : scene.shapes) shapes.insert(declared_name(*shape));
    for (int m = 0; m < scene.materials.size(); ++m) materials.insert(scene.materials[m].name);
    check_name("wall", spec.wall, walls);
    check_name("shape of grains", spec.shape, shapes);
    check_name("material", spec.material, materials);
}

}  // namespace

void check_observable(const ObservableSpec& spec, const Scene& scene) {
    check_words(spec, scene);
    make_meter(spec, scene);  // refuses what has no meaning in the scene
}

struct Observer::Meter {
    AnyMeter any;
};

Observer::Observer(const ObservableSpec& spec, const Scene& scene) : spec_(spec) {
    check_words(spec, scene);
    entry_ = find_observable(spec.quantity);
    meter_ = std::make_unique<Meter>(Meter{make_meter(spec, scene)});
}

Observer::~Observer() = default;
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;

void Observer::step(const World& world, double dt, const StepReport& report) {
    std::visit([&](auto& meter) { meter.step(world, dt, report); }, meter_->any);
}

double Observer::read(const Sample& sample) {
    return std::visit([&](auto& meter) { return meter.read(sample); }, meter_->any);
}

void Observer::save(Checkpoint& checkpoint, const std::string& prefix) const {
    std::visit([&](const auto& meter) { meter.save(checkpoint, prefix); }, meter_->any);
}

void Observer::load(const Checkpoint& checkpoint, const std::string& prefix) {
    std::visit([&](auto& meter) { meter.load(checkpoint, prefix); }, meter_->any);
}

}  // namespace polargrain
