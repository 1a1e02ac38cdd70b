#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/model/materials.h"

namespace polargrain {

/// How the normal force of a soft contact follows from the overlap.
enum class NormalLaw : std::uint8_t {
    linear,        ///< spring and dashpot
    hertz,         ///< force as overlap to the power 3/2
    power,         ///< force as overlap to any power
    walton_braun,  ///< one spring for loading, a stiffer one for unloading
};

/// How the tangential force of a soft contact follows from the sliding.
enum class TangentialLaw : std::uint8_t {
    slider,        ///< viscous up to Coulomb's limit, without memory
    spring,        ///< spring and dashpot with Coulomb's limit (Cundall and Strack)
    walton_braun,  ///< incremental, softening towards Coulomb's limit
};

/// The law of a soft contact, for all pairs of materials or for one.
struct SoftLaw {
    NormalLaw normal = NormalLaw::linear;
    TangentialLaw tangential = TangentialLaw::spring;
    bool tension = false;                    ///< may the dashpot pull at the end of a contact?
    std::optional<double> stiffness;         ///< of the normal law, per metre of depth; none: from the target overlap
    double exponent = 0.0;                   ///< b of force = k overlap^(1 + b), for NormalLaw::power
    std::optional<double> damping_exponent;  ///< of dashpot = D overlap^g, hertz and power; none: b / 2
    double tangential_stiffness = 0.25;      ///< over the normal one
    double tangential_damping = 0.5;         ///< over the normal one
};

/// The law of one pair of materials.
struct SoftPair {
    MaterialIndex a = 0;
    MaterialIndex b = 0;
    SoftLaw law;
};

/// How two polygons push one another.
enum class PolygonContact : std::uint8_t {
    area,       ///< energy k A^q of the overlap area A
    potential,  ///< potential on the sectors of the outlines
};

/// How pairs of grains that may touch are found.
enum class PairSearch : std::uint8_t {
    direct,  ///< every grain against every other, every step
    verlet,  ///< a list with a margin, made anew when a grain has used it up
    nbs,     ///< equal cells without binary search, every step
    cgrid,   ///< boxes entered in every cell that they cover, every step
};

/// How the equations of motion are stepped.
enum class SoftIntegrator : std::uint8_t {
    symplectic_euler,
    taylor,
    position_verlet,
    velocity_verlet,       ///< velocity of the dashpot predicted over the whole step: second order
    velocity_verlet_half,  ///< predicted over half the step, as often published: first order with damping
    gear4,
    numerov_central,
    numerov_forward,
    numerov_backward,
};

/// What the table [dem] of a scenario says; docs/dem.md explains each.
struct DemSettings {
    SoftLaw law;
    std::vector<SoftPair> pairs;   ///< laws of pairs that have their own
    double target_overlap = 0.05;  ///< largest overlap aimed at, over the inner radius, at the fastest impact possible
    PolygonContact polygons = PolygonContact::area;
    double area_exponent = 2.0;  ///< q of the energy k A^q
    PairSearch search = PairSearch::verlet;
    double skin = 0.1;  ///< margin of the Verlet list over a grain's radius
    SoftIntegrator integrator = SoftIntegrator::velocity_verlet;
    double resolution = 25.0;  ///< steps in the shortest contact
};

}  // namespace polargrain
