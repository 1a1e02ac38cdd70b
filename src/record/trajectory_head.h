#pragma once

// Private to this folder: what stands in trajectory.h5 beside the frames.

#include <cstddef>
#include <set>
#include <string>

#include "src/model/scene.h"
#include "src/record/h5.h"
#include "src/record/provenance.h"
#include "src/run/sink.h"

namespace polargrain {

/// Names as HDF5 can hold them, each once: a slash would open a group, and equal names would collide.
class LinkNames {
public:
    std::string of(std::string name, std::size_t index);

private:
    std::set<std::string> taken_;
};

void put_unit(hid_t object, const char* unit);
void put_provenance(hid_t file, const Provenance& provenance);
/// Attributes of the group of ours that say which problem it was.
void put_problem(hid_t ours, const Scene& scene, const RunInfo& info);
void put_shapes(hid_t ours, const Scene& scene);
void put_materials(hid_t ours, const Materials& materials);
/// The group of one wall, named `link`.
h5::Handle put_wall(hid_t walls, const Wall& wall, const std::string& link, std::size_t index);
/// What each grain keeps: mass, inertia, shape, material.
void put_per_grain(hid_t group, const Grains& grains);
/// H5MD wants to know how space is bounded: not at all.
void put_box(hid_t group);

}  // namespace polargrain
