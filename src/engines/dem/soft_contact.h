#pragma once

#include "src/model/contact.h"

namespace polargrain {

/// A contact between two bodies with its forces and its memory.
struct SoftContact {
    BodyIndex a = 0, b = 0;       ///< a < b; a may be a wall
    Vec2 point = Vec2::Zero();    ///< where the force acts [m]
    Vec2 normal = Vec2::UnitY();  ///< unit, out of a into b
    double depth = 0.0;           ///< [m] > 0
    double normal_force = 0.0;    ///< on b along the normal [N/m]
    double elastic_normal = 0.0;  ///< the part of it that is not the dashpot's
    double sliding_force = 0.0;   ///< on b along left_normal(normal) [N/m]
    double stored_normal = 0.0;   ///< energy that the normal law gives back [J/m]
    double stored_sliding = 0.0;  ///< energy of the tangential spring [J/m]
    double hysteresis = 0.0;      ///< energy spent by the normal law at the last evaluation [J/m]

    // Memory.
    double damping = 0.0;         ///< what the law makes of the restitution at birth; see soft_law.h
    double stretch = 0.0;         ///< of the tangential spring [m]; walton_braun: its force [N/m]
    double turning = 0.0;         ///< walton_braun: that force when the sliding last turned [N/m]
    double pressed = 0.0;         ///< normal force at the last evaluation, never negative [N/m]
    double largest = 0.0;         ///< overlap so far [m], walton_braun
    double spent = 0.0;           ///< energy lost to hysteresis since birth [J/m]
    Vec2 impulse = Vec2::Zero();  ///< on b since the beginning of the engine's step [N s/m]

    void take_memory(const SoftContact& old) {
        damping = old.damping;
        stretch = old.stretch;
        turning = old.turning;
        pressed = old.pressed;
        largest = old.largest;
        spent = old.spent;
        impulse = old.impulse;
    }

    Vec2 force() const { return normal_force * normal + sliding_force * left_normal(normal); }
};

/// One place where two bodies overlap, as the geometry sees it.
struct Touch {
    Vec2 point = Vec2::Zero();    ///< world [m]
    Vec2 normal = Vec2::UnitY();  ///< unit, out of a into b
    double depth = 0.0;           ///< [m] > 0
    bool by_depth = true;         ///< the normal law gives the force of the depth; else force and energy stand here
    double force = 0.0;           ///< [N/m]
    double energy = 0.0;          ///< [J/m]
};

}  // namespace polargrain
