#pragma once

#include <cstdint>
#include <vector>

#include "src/core/vec2.h"
#include "src/model/contact.h"

namespace polargrain {

/// Where energy went during a step, per metre of depth [J/m]. Losses and work count positive as named.
///
/// energy(after) - energy(before) = wall_work + correction + created - restitution_loss - friction_loss - stored
struct EnergyLedger {
    double restitution_loss = 0.0;  ///< taken by the normal impulses
    double friction_loss = 0.0;     ///< taken by the tangential impulses
    double wall_work = 0.0;         ///< done by moving walls on the grains
    double correction = 0.0;        ///< potential energy added by moving grains apart without a force
    /// Energy that the method itself makes (or destroys, if negative), such as gravity work of moves that were
    /// rejected: what closes the ledger. A perfect method has zero here.
    double created = 0.0;
    double rises = 0.0;   ///< energy made without a cause in the step, never negative: the honesty meter
    double stored = 0.0;  ///< put into springs at contacts; negative: given back

    EnergyLedger& operator+=(const EnergyLedger& other);
};

/// Force and torque of one wall's contacts, as impulses over the step, per metre of depth.
struct WallImpulse {
    Vec2 linear = Vec2::Zero();  ///< on the wall, from the grains [N s/m]
    double angular = 0.0;        ///< about the origin, on the wall [N s]
};

/// Trial moves of a step: tried = accepted + shortened + rejected.
struct MoveCount {
    std::int64_t tried = 0;
    std::int64_t shortened = 0;
    std::int64_t rejected = 0;
    std::int64_t accepted() const { return tried - shortened - rejected; }
    MoveCount& operator+=(const MoveCount& other);
};

/// What an engine tells about one step. The engine clears it first.
struct StepReport {
    std::vector<Contact> contacts;             ///< that have pushed in the step or touch at its end, sorted by (a, b)
    std::vector<ImpactRecord> impact_records;  ///< filled only while record_impacts is set, in the order of processing
    std::vector<WallImpulse> walls;            ///< one entry per wall
    EnergyLedger ledger;
    MoveCount moves;
    std::int64_t impacts = 0;  ///< impulses exchanged
    double deepest = 0.0;      ///< deepest overlap of the accepted poses that the engine knows of [m]
    bool record_impacts = false;

    void clear(std::size_t wall_count);
};

}  // namespace polargrain
