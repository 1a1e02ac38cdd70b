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
    double moment = 0.0;          ///< on b about the point, of the normal force's spread over a face [N]
    double elastic_normal = 0.0;  ///< the part of it that is not the dashpot's
    double sliding_force = 0.0;   ///< on b along left_normal(normal) [N/m]
    double stored_normal = 0.0;   ///< energy that the normal law gives back [J/m]
    double stored_sliding = 0.0;  ///< energy of the tangential spring [J/m]
    double hysteresis = 0.0;      ///< energy spent by the normal law at the last evaluation [J/m]

    // Memory.
    double damping = 0.0;         ///< what the law makes of the restitution at birth; see soft_law.h
    double stretch = 0.0;         ///< of the tangential spring [m]; walton_braun: its force [N/m]
    double turning = 0.0;         ///< walton_braun: that force when the sliding last turned [N/m]
    double largest = 0.0;         ///< overlap so far [m], walton_braun
    Vec2 impulse = Vec2::Zero();  ///< on b since the beginning of the engine's step, up to the evaluation [N s/m]

    /// `weight`: time for which the old forces have acted [s].
    void take_memory(const SoftContact& old, double weight) {
        normal_force = old.normal_force;
        damping = old.damping;
        stretch = old.stretch;
        turning = old.turning;
        largest = old.largest;
        impulse = old.impulse + weight * old.force();
    }

    Vec2 force() const { return normal_force * normal + sliding_force * left_normal(normal); }
};

/// Energy in springs [J/m].
struct StoredEnergy {
    double normal = 0.0;
    double sliding = 0.0;
    double total() const { return normal + sliding; }
    void add(const SoftContact& contact) {
        normal += contact.stored_normal;
        sliding += contact.stored_sliding;
    }
};

/// One place where two bodies overlap, as the geometry sees it.
struct Touch {
    Vec2 point = Vec2::Zero();    ///< world [m]
    Vec2 normal = Vec2::UnitY();  ///< unit, out of a into b
    double depth = 0.0;           ///< [m] > 0
    double width = 0.0;           ///< of the face that is pressed, with the point in its middle [m]; 0: a point
    bool by_depth = true;         ///< the normal law gives the force of the depth; else force and energy stand here
    double force = 0.0;           ///< [N/m]
    double energy = 0.0;          ///< [J/m]
};

}  // namespace polargrain
