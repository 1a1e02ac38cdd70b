#pragma once

#include <vector>

#include "src/engines/dem/soft_contact.h"
#include "src/model/dem_settings.h"
#include "src/model/scene.h"

namespace polargrain {

/// A soft law with the numbers of one pair of materials in one scene.
struct PairSoftLaw {
    SoftLaw law;
    double stiffness = 0.0;             ///< of the normal law [N/m^(2 + b)]
    double exponent = 0.0;              ///< b
    double reference = 0.0;             ///< overlap at which laws of different kinds are as stiff [m]
    double linear_stiffness = 0.0;      ///< of the normal law at the reference overlap [N/m^2]
    double tangential_stiffness = 0.0;  ///< [N/m^2]
    double friction = 0.0;
};

/// The laws of all pairs of materials of a scene, and how fine time must be cut for them.
class SoftLaws {
public:
    /// InputError where a stiffness is asked for that does not exist (target overlap in a scene without grains is
    /// harmless, a law for disks on polygons is not).
    SoftLaws(const Scene& scene, const DemSettings& settings);

    const PairSoftLaw& of(MaterialIndex a, MaterialIndex b) const {
        return laws_[static_cast<std::size_t>(a) * materials_ + static_cast<std::size_t>(b)];
    }

    /// Longest step that cuts every contact finely enough [s]; infinite without grains.
    ///
    /// The shortest contact that the scene can have over the resolution, but 2.5 times that for two polygons which meet
    /// in the whole of their widest faces; and half the time in which the strongest dashpot above critical damping
    /// stops two bodies.
    double longest_step() const { return longest_step_; }

private:
    PairSoftLaw resolve(const Scene& scene, const DemSettings& settings, MaterialIndex a, MaterialIndex b) const;
    void find_longest_step(const Scene& scene, const DemSettings& settings);
    double fastest_decay(const Scene& scene) const;

    std::size_t materials_;
    double target_ = 0.0;          ///< target overlap of the smallest grain [m]
    double mass_over_area_ = 0.0;  ///< largest mass over squared inner radius [kg/m^3]
    double speed_ = 1.0;           ///< of the fastest impact [m/s]
    double longest_step_ = 0.0;    ///< [s]
    std::vector<PairSoftLaw> laws_;
};

/// Width of the widest face of an outline [m]: how much of it can lie on a straight line at once, up to a depth of a
/// fiftieth of its inner radius.
double flat_width(const PolarPolygon& polygon);

/// Ratio of critical damping that a restitution needs, see normal_law.h; below 0.01 it counts as 0.01. Remembers the
/// last: mostly they are all the same, and each takes a bisection.
class DampingRatio {
public:
    double of(double restitution, bool tension);

private:
    double restitution_ = -1.0;
    bool tension_ = false;
    double ratio_ = 0.0;
};

/// What a law keeps of the restitution e of a new contact of the given reduced mass: for touches by depth the dashpot
/// constant [N s/m^2] of the linear law, D of dashpot = D overlap^g of the Hertz and power laws, the stiffness of
/// unloading of Walton and Braun's [N/m^2]; for others the ratio of critical damping.
double damping_of(const PairSoftLaw& law, double restitution, double mass, bool by_depth, DampingRatio& ratio);

/// Motion of b's material against a's at a contact.
struct TouchRate {
    double closing = 0.0;  ///< against the normal [m/s]
    double sliding = 0.0;  ///< along the tangent [m/s]
    double spin = 0.0;     ///< [rad/s]
};

/// Fills in the forces of a contact whose place and memory stand, the normal force of the last evaluation among it:
/// `way` is the sliding since the memory was made [m].
void respond(const PairSoftLaw& law, const Touch& touch, double mass, const TouchRate& rate, double way,
             SoftContact& contact);

}  // namespace polargrain
