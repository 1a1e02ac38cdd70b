#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shapes/shape_spec.h"
#include "src/core/error.h"
#include "src/model/scene.h"

namespace polargrain {

/// The shapes that a scenario declares; makes them when grains ask for them and shares what is equal.
class ShapeBook {
public:
    explicit ShapeBook(std::uint64_t seed) : seed_(seed) {}

    /// Makes the shape once to check it: InputError, with that place, names what is wrong.
    void declare(const std::string& name, const ShapeSpec& spec, const SourceLocation& where);

    const std::vector<std::string>& names() const { return names_; }

    /// The shape of grain number `grain`, larger by `factor`; a new entry of scene.shapes or one it shares.
    ShapeIndex use(Scene& scene, const std::string& name, double factor, GrainIndex grain);

private:
    struct Entry {
        ShapeSpec spec;
        SourceLocation where;
    };

    Shape make(const std::string& name, const Entry& entry, GrainIndex grain) const;

    std::uint64_t seed_;
    std::vector<std::string> names_;
    std::map<std::string, Entry> entries_;
    std::map<std::pair<std::string, double>, ShapeIndex> shared_;
};

}  // namespace polargrain
