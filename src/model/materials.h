#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polargrain {

using MaterialIndex = std::int32_t;

/// Energetic coefficient of restitution, drawn anew at each impact from a normal distribution truncated to [0, 1].
struct Restitution {
    double mean = 0.0;    ///< in [0, 1]
    double stddev = 0.0;  ///< >= 0; 0 draws nothing
};

struct Material {
    std::string name;
    double density = 0.0;  ///< [kg/m^3]; masses are per metre of depth
    Restitution restitution;
    double friction = 0.0;  ///< Coulomb's coefficient, >= 0
};

/// What two materials do to one another.
struct PairLaw {
    double friction = 0.0;
    /// Set where the scenario gives the pair its own restitution; otherwise the two materials' own values are
    /// combined by mass [HN94, eq. 46] (against a wall: the grain's own).
    std::optional<Restitution> restitution;
};

/// Materials and the table of their pairs.
///
/// The friction of a pair without an entry is the geometric mean of the two; the paper is silent on it.
class Materials {
public:
    MaterialIndex add(Material material);
    /// Overrides one pair, in either order. Values left out keep their default.
    void set_pair(MaterialIndex a, MaterialIndex b, std::optional<double> friction,
                  std::optional<Restitution> restitution);

    int size() const { return static_cast<int>(materials_.size()); }
    const Material& operator[](MaterialIndex i) const { return materials_[static_cast<std::size_t>(i)]; }
    const PairLaw& pair(MaterialIndex a, MaterialIndex b) const {
        return pairs_[static_cast<std::size_t>(a) * materials_.size() + static_cast<std::size_t>(b)];
    }
    std::optional<MaterialIndex> find(std::string_view name) const;

private:
    std::vector<Material> materials_;
    std::vector<PairLaw> pairs_;
};

}  // namespace polargrain
