#include "src/observe/kind.h"

namespace polargrain {

std::string declared_name(const Shape& shape) {
    const std::string& full = name(shape);
    return full.substr(0, full.find_first_of("#*"));
}

GrainMask kind_of_grains(const Scene& scene, const ObservableSpec& spec) {
    GrainMask mask;
    mask.reserve(scene.grains.x.size());
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const bool shape = !spec.shape || declared_name(scene.shape_of(k)) == *spec.shape;
        const bool material =
            !spec.material || scene.materials[scene.grains.material[Grains::at(k)]].name == *spec.material;
        mask.push_back(shape && material && in_region(spec.started_in, scene.grains.position(k)) ? 1 : 0);
    }
    return mask;
}

}  // namespace polargrain
