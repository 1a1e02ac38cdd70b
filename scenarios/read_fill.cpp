#include <algorithm>
#include <cmath>

#include "scenarios/grain_groups.h"
#include "scenarios/size_distribution.h"
#include "scenarios/toml_text.h"
#include "src/core/random.h"

namespace polargrain {

namespace {

/// Shapes to choose from, with weights that rise to 1.
struct ShapeChoice {
    std::vector<std::string> names;
    std::vector<double> rising;

    const std::string& pick(double uniform) const {
        const auto at = std::upper_bound(rising.begin(), rising.end(), uniform);
        return names[static_cast<std::size_t>(std::min(at, rising.end() - 1) - rising.begin())];
    }
};

struct FillSpec {
    int count = 0;
    ShapeChoice shapes;
    MaterialIndex material = 0;
    Vec2 lower, upper;
    SizeDistribution size;
    Vec2 velocity;
    double velocity_spread = 0.0, spin_spread = 0.0;
};

/// A list of names, equally likely, or a table of weights.
ShapeChoice read_choice(const ShapeBook& shapes, TableReader& table) {
    ShapeChoice choice;
    std::vector<double> weights;
    const toml::node* node = table.raw("shapes");
    if (node != nullptr && node->is_table()) {
        TableReader weighted = table.table("shapes", {"fill.shapes", "", shapes.names()});
        for (const auto& [name, weight] : *node->as_table()) {
            choice.names.emplace_back(name.str());
            weights.push_back(weighted.number(name.str(), k_not_negative));
        }
        table.adopt("shapes", weighted);
    } else {
        choice.names = table.words("shapes");
        weights.assign(choice.names.size(), 1.0);
    }
    for (const std::string& name : choice.names) require_known_shape(shapes, table, "shapes", name);
    double sum = 0.0;
    for (const double weight : weights) choice.rising.push_back(sum += weight);
    if (!(sum > 0.0)) table.fail("shapes", "no shape has a weight above zero; give at least one");
    for (double& share : choice.rising) share /= sum;
    return choice;
}

FillSpec read_spec(Reading& reading, const ShapeBook& shapes, TableReader& table) {
    FillSpec spec;
    spec.count = static_cast<int>(table.integer("count", 1, k_most_grains));
    spec.shapes = read_choice(shapes, table);
    spec.material = read_grain_material(reading.scenario.scene, table);
    const std::vector<Vec2> region = table.points("region", 2);
    if (region.size() != 2 || !((region[1] - region[0]).minCoeff() > 0.0)) {
        table.fail("region",
                   "must be the lower left and the upper right corner, [[x0, y0], [x1, y1]] with x1 > x0 and y1 > y0");
    }
    spec.lower = region[0];
    spec.upper = region[1];
    spec.size = read_size(table);
    spec.velocity = table.point("velocity", Vec2::Zero());
    spec.velocity_spread = table.number("velocity_spread", k_not_negative, 0.0);
    spec.spin_spread = table.number("spin_spread", k_not_negative, 0.0);
    return spec;
}

/// Everything random about the grains but where they are. Each grain has a stream of its own.
std::vector<Grain> draw_grains(Scene& scene, ShapeBook& shapes, const FillSpec& spec, GrainIndex first,
                               const FillKey& key) {
    std::vector<Grain> grains;
    for (int k = 0; k < spec.count; ++k) {
        RandomStream random(key.seed, RandomPurpose::fill, key.fill, static_cast<std::uint32_t>(2 * k));
        Grain grain;
        grain.material = spec.material;
        const std::string& name = spec.shapes.pick(random.uniform());
        grain.shape = shapes.use(scene, name, draw_size(spec.size, random), first + k);
        grain.velocity = spec.velocity;
        if (spec.velocity_spread > 0.0) {
            const double vx = random.normal();
            const double vy = random.normal();
            grain.velocity += spec.velocity_spread * Vec2(vx, vy);
        }
        if (spec.spin_spread > 0.0) grain.spin = spec.spin_spread * random.normal();
        grains.push_back(grain);
    }
    return grains;
}

/// Area that a grain takes of the rectangle for certain: all of its own where it lies wholly inside.
double area_inside(const FillSpec& spec, const Shape& shape, const Vec2& centre) {
    const Vec2 reach = Vec2::Constant(outer_radius(shape));
    const bool inside = ((centre - reach).array() >= spec.lower.array()).all() &&
                        ((centre + reach).array() <= spec.upper.array()).all();
    return inside ? area(shape) : 0.0;
}

/// Refuses what cannot fit, however it is placed, before trying.
void check_capacity(const Scene& scene, const TableReader& table, const FillSpec& spec,
                    const std::vector<Grain>& grains, const FillSurroundings& surroundings) {
    const Vec2 extent = spec.upper - spec.lower;
    double needed = 0.0;
    for (const Grain& grain : grains) {
        const double width = 2.0 * outer_radius(scene.shape(grain.shape));
        needed += area(scene.shape(grain.shape));
        if (width > extent.minCoeff()) {
            table.fail("region", fmt::format("is {:.4g} m x {:.4g} m, too narrow for a grain {:.4g} m across; widen it",
                                             extent.x(), extent.y(), width));
        }
    }
    double taken = 0.0;
    for (const GrainGroup* group : surroundings.groups) {
        for (const Grain& other : group->grains) taken += area_inside(spec, scene.shape(other.shape), other.position);
    }
    const double room = extent.x() * extent.y() - taken;
    if (needed > room) {
        table.fail("count",
                   fmt::format("the {} grains cover {:.4g} m^2, but the region has only {:.4g} m^2 left; lower "
                               "the count or enlarge the region",
                               spec.count, needed, room));
    }
}

FillSpace make_space(const Scene& scene, const FillSpec& spec, const std::vector<FillGrain>& grains,
                     const FillSurroundings& surroundings) {
    double sum = 0.0;
    for (const FillGrain& grain : grains) sum += outer_radius(*grain.shape);
    FillSpace space(spec.lower, spec.upper, surroundings.walls, grains.size(),
                    sum / static_cast<double>(grains.size()));
    for (const GrainGroup* group : surroundings.groups) {
        for (const Grain& other : group->grains) {
            space.add(scene.shapes[static_cast<std::size_t>(other.shape)], Pose::at(other.position, other.angle));
        }
    }
    return space;
}

}  // namespace

std::vector<Grain> read_fill(Reading& reading, ShapeBook& shapes, TableReader& table, GrainIndex first,
                             const FillSurroundings& surroundings) {
    Scene& scene = reading.scenario.scene;
    const FillSpec spec = read_spec(reading, shapes, table);
    const FillKey key{scene.seed, surroundings.fill};
    std::vector<Grain> grains = draw_grains(scene, shapes, spec, first, key);
    check_capacity(scene, table, spec, grains, surroundings);

    std::vector<FillGrain> places;
    places.reserve(grains.size());
    for (const Grain& grain : grains) places.push_back({scene.shapes[static_cast<std::size_t>(grain.shape)], {}, 0.0});
    FillSpace loose = make_space(scene, spec, places, surroundings);
    std::size_t most = place_at_random(loose, places, key);
    if (most < places.size()) {
        FillSpace dense = make_space(scene, spec, places, surroundings);
        most = std::max(most, place_on_lattice(dense, places, key));
    }
    if (most < places.size()) {
        table.fail("count",
                   fmt::format("only {} of {} grains found a place; lower the count to about {} or enlarge the "
                               "region (walls, and grains already there, take some of it)",
                               most, spec.count, most));
    }
    for (std::size_t k = 0; k < grains.size(); ++k) {
        grains[k].position = places[k].pose.centre;
        grains[k].angle = places[k].angle;
    }
    return grains;
}

}  // namespace polargrain
