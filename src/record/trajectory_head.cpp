#include "src/record/trajectory_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "src/record/trajectory_layout.h"

namespace polargrain {

using h5::Handle;

namespace {

std::vector<double> flat(std::span<const Vec2> points) {
    std::vector<double> numbers;
    numbers.reserve(2 * points.size());
    for (const Vec2& p : points) numbers.insert(numbers.end(), {p.x(), p.y()});
    return numbers;
}

void put_points(hid_t group, const char* name, std::span<const Vec2> points) {
    put_unit(h5::put_data<double>(group, name, flat(points), {points.size(), 2}).id(), "m");
}

void put_outline(hid_t group, const Disk& disk) { h5::put_number<double>(group, "radius", disk.radius()); }

void put_outline(hid_t group, const PolarPolygon& polygon) { put_points(group, "vertices", polygon.vertices()); }

}  // namespace

std::string LinkNames::of(std::string name, std::size_t index) {
    std::replace(name.begin(), name.end(), '/', '_');
    if (name.empty() || name == ".") name.assign(1, '_');
    if (!taken_.insert(name).second) {
        name += fmt::format("#{}", index);
        taken_.insert(name);
    }
    return name;
}

void put_unit(hid_t object, const char* unit) { h5::put_text(object, "unit", unit); }

void put_provenance(hid_t file, const Provenance& provenance) {
    const Handle h5md = h5::create_group(file, "h5md");
    h5::put_numbers<std::int32_t>(h5md.id(), "version", std::vector<std::int32_t>{1, 1});
    const Handle author = h5::create_group(h5md.id(), "author");
    h5::put_text(author.id(), "name", provenance.author);
    const Handle creator = h5::create_group(h5md.id(), "creator");
    h5::put_text(creator.id(), "name", "polargrain");
    h5::put_text(creator.id(), "version", provenance.version);
    h5::put_text(creator.id(), "build", provenance.build);
    const Handle modules = h5::create_group(h5md.id(), "modules");
    const Handle units = h5::create_group(modules.id(), "units");
    h5::put_numbers<std::int32_t>(units.id(), "version", std::vector<std::int32_t>{1, 0});
    h5::put_text(units.id(), "system", "SI");
}

void put_problem(hid_t ours, const Scene& scene, const RunInfo& info) {
    h5::put_number<std::int32_t>(ours, "layout_version", layout::k_version);
    h5::put_text(ours, "title", info.title);
    h5::put_text(ours, "source", info.source);
    h5::put_text(ours, "engine", info.engine);
    h5::put_number<double>(ours, "time_step", info.dt);
    h5::put_number<double>(ours, "duration", info.duration);
    h5::put_number<std::int64_t>(ours, "seed", static_cast<std::int64_t>(scene.seed));
    h5::put_numbers<double>(ours, "gravity", flat(std::span(&scene.gravity, 1)));
}

void put_shapes(hid_t ours, const Scene& scene) {
    const Handle shapes = h5::create_group(ours, layout::k_shapes);
    LinkNames names;
    for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
        const Shape& shape = *scene.shapes[s];
        const Handle group = h5::create_group(shapes.id(), names.of(name(shape), s));
        h5::put_text(group.id(), "name", name(shape));
        h5::put_number<std::int32_t>(group.id(), "index", static_cast<std::int32_t>(s));
        h5::put_number<double>(group.id(), "area", area(shape));
        h5::put_number<double>(group.id(), "polar_moment", polar_moment(shape));
        std::visit([&group](const auto& outline) { put_outline(group.id(), outline); }, shape);
    }
}

void put_materials(hid_t ours, const Materials& materials) {
    const Handle all = h5::create_group(ours, layout::k_materials);
    LinkNames names;
    for (MaterialIndex m = 0; m < materials.size(); ++m) {
        const Material& material = materials[m];
        const Handle group = h5::create_group(all.id(), names.of(material.name, static_cast<std::size_t>(m)));
        h5::put_text(group.id(), "name", material.name);
        h5::put_number<std::int32_t>(group.id(), "index", m);
        h5::put_number<double>(group.id(), "density", material.density);
        h5::put_number<double>(group.id(), "friction", material.friction);
        h5::put_number<double>(group.id(), "restitution_mean", material.restitution.mean);
        h5::put_number<double>(group.id(), "restitution_stddev", material.restitution.stddev);
    }
}

Handle put_wall(hid_t walls, const Wall& wall, const std::string& link, std::size_t index) {
    Handle group = h5::create_group(walls, link);
    h5::put_text(group.id(), "name", wall.name);
    h5::put_number<std::int32_t>(group.id(), "index", static_cast<std::int32_t>(index));
    h5::put_number<std::int32_t>(group.id(), "material", wall.material);
    if (wall.remove_at) h5::put_number<double>(group.id(), "remove_at", *wall.remove_at);
    put_points(group.id(), "points", wall.points);
    return group;
}

void put_per_grain(hid_t group, const Grains& grains) {
    const h5::Size all{grains.x.size()};
    put_unit(h5::put_data<double>(group, "mass", grains.mass, all).id(), "kg m-1");
    put_unit(h5::put_data<double>(group, "inertia", grains.inertia, all).id(), "kg m");
    h5::put_data<std::int32_t>(group, "shape", grains.shape, all);
    h5::put_data<std::int32_t>(group, "material", grains.material, all);
}

void put_box(hid_t group) {
    const Handle box = h5::create_group(group, "box");
    h5::put_number<std::int32_t>(box.id(), "dimension", 2);
    h5::put_texts(box.id(), "boundary", {"none", "none"});
}

}  // namespace polargrain
