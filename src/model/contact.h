#pragma once

#include <cstdint>
#include <string>

#include "src/core/vec2.h"
#include "src/model/grains.h"

namespace polargrain {

/// A grain by its index >= 0, or a wall w as -1 - w.
using BodyIndex = std::int32_t;

inline BodyIndex wall_body(int wall) { return -1 - wall; }
inline bool is_wall(BodyIndex body) { return body < 0; }
inline int wall_index(BodyIndex body) { return -1 - body; }

/// Two bodies that touch. a < b, so a wall always comes first.
struct Contact {
    BodyIndex a = 0;
    BodyIndex b = 0;
    Vec2 point = Vec2::Zero();    ///< where the impulse acts [m]
    Vec2 normal = Vec2::UnitY();  ///< unit, out of a into b
    double gap = 0.0;             ///< along the normal [m]; negative: the shapes overlap by that depth
    Vec2 impulse = Vec2::Zero();  ///< on b during this step, per metre of depth [N s/m]
};

/// How the contact slides during an impact. [HN94, sec. 3.6.1; Wang & Mason 1992]
enum class SlipMode : std::uint8_t {
    separating,  ///< not approaching: no impulse
    sliding,     ///< slides one way throughout
    sticks_in_compression,
    reverses_in_compression,
    sticks_in_restitution,
    reverses_in_restitution,
    direct_sticking,  ///< no sliding at first, and friction holds it so
    direct_sliding,   ///< no sliding at first, but friction is too weak
    on_feet,          ///< together with the feet of the grains, whose rows follow; any of the above
    on_face,          ///< shared by two contacts of a face that lands flat, in two rows; any of the above
    foot,             ///< what keeps a foot where it is during the impact on_feet or on_face before it
};

const char* to_string(SlipMode mode);

/// Velocity of a rigid body: of its centre of mass [m/s] and spin [rad/s].
struct Motion {
    Vec2 velocity = Vec2::Zero();
    double spin = 0.0;
};

/// One processed impact, complete enough to be computed again from the record. Body j pushes body i.
struct ImpactRecord {
    double time = 0.0;
    std::int64_t step = 0;
    BodyIndex i = 0, j = 0;  ///< j may be a wall
    Vec2 point = Vec2::Zero();
    Vec2 normal = Vec2::UnitY();  ///< out of j into i
    Vec2 centre_i = Vec2::Zero(), centre_j = Vec2::Zero();
    double restitution = 0.0, friction = 0.0;
    SlipMode mode = SlipMode::separating;
    double impulse_normal = 0.0, impulse_tangential = 0.0;  ///< on i, along n and t = (n_y, -n_x)
    double closing_before = 0.0, closing_after = 0.0;       ///< C: negative while approaching [m/s]
    double sliding_before = 0.0, sliding_after = 0.0;       ///< S along t [m/s]
    Motion i_before, j_before, i_after, j_after;
};

}  // namespace polargrain
