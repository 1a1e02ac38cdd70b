#include "scenarios/shape_book.h"

namespace polargrain {

namespace {

std::string scaled_name(const std::string& name, double factor) {
    return factor == 1.0 ? name : fmt::format("{}*{}", name, factor);
}

}  // namespace

Shape ShapeBook::make(const std::string& name, const Entry& entry, GrainIndex grain) const {
    try {
        return make_shape(name, entry.spec, seed_, static_cast<std::uint64_t>(grain));
    } catch (const InputError& error) {
        throw InputError(entry.where, error.what());
    }
}

void ShapeBook::declare(const std::string& name, const ShapeSpec& spec, const SourceLocation& where) {
    const Entry& entry = entries_.insert_or_assign(name, Entry{spec, where}).first->second;
    names_.push_back(name);
    const Shape shape = make(name, entry, 0);
    if (!(inner_radius(shape) > 1e-10)) {
        throw InputError(where, fmt::format("shape \"{}\": its inner radius is only {} m; make it thicker", name,
                                            inner_radius(shape)));
    }
}

ShapeIndex ShapeBook::use(Scene& scene, const std::string& name, double factor, GrainIndex grain) {
    const Entry& entry = entries_.at(name);
    const bool own_draw = differs_by_grain(entry.spec);
    const std::pair<std::string, double> key{name, factor};
    if (!own_draw) {
        const auto known = shared_.find(key);
        if (known != shared_.end()) return known->second;
    }
    const std::string own_name = own_draw ? fmt::format("{}#{}", name, grain) : name;
    Shape shape = make(own_name, entry, own_draw ? grain : 0);
    if (factor != 1.0) shape = scaled(shape, factor, scaled_name(own_name, factor));
    const ShapeIndex index = scene.add(std::make_shared<const Shape>(std::move(shape)));
    if (!own_draw) shared_.emplace(key, index);
    return index;
}

}  // namespace polargrain
