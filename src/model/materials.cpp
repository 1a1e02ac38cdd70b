#include "src/model/materials.h"

#include <cmath>

namespace polargrain {

MaterialIndex Materials::add(Material material) {
    const std::size_t old = materials_.size();
    materials_.push_back(std::move(material));
    const std::size_t n = materials_.size();
    std::vector<PairLaw> larger(n * n);
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
            larger[a * n + b] = a < old && b < old
                                    ? pairs_[a * old + b]
                                    : PairLaw{std::sqrt(materials_[a].friction * materials_[b].friction), std::nullopt};
        }
    }
    pairs_ = std::move(larger);
    return static_cast<MaterialIndex>(old);
}

void Materials::set_pair(MaterialIndex a, MaterialIndex b, std::optional<double> friction,
                         std::optional<Restitution> restitution) {
    const std::size_t n = materials_.size();
    const auto first = static_cast<std::size_t>(a);
    const auto second = static_cast<std::size_t>(b);
    for (PairLaw* law : {&pairs_[first * n + second], &pairs_[second * n + first]}) {
        if (friction) law->friction = *friction;
        if (restitution) law->restitution = restitution;
    }
}

std::optional<MaterialIndex> Materials::find(std::string_view name) const {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i].name == name) return static_cast<MaterialIndex>(i);
    }
    return std::nullopt;
}

}  // namespace polargrain
