#include "src/engines/dem/tangential_law.h"

#include <algorithm>
#include <cmath>

#include "src/core/elementary.h"

namespace polargrain {

Tangential viscous_slider(double damping, double sliding, double limit) {
    return {std::clamp(-damping * sliding, -limit, limit), 0.0, 0.0};
}

IncrementalMemory walton_braun_tangential(const IncrementalMemory& before, double way, double k0, double normal,
                                          double friction) {
    const double limit = friction * normal;
    if (!(limit > 0.0)) return {0.0, 0.0, normal};
    IncrementalMemory now = before;
    now.normal = normal;
    if (before.normal > 0.0) now.turning *= normal / before.normal;
    now.force = std::clamp(now.force, -limit, limit);
    if (way == 0.0) return now;
    const double sign = way > 0.0 ? 1.0 : -1.0;
    // As seen along the way T always rises. It has turned where T lies on the far side of T*.
    if (sign * now.force < sign * now.turning) now.turning = now.force;
    const double start = std::clamp(sign * now.turning, -limit, limit);
    const double room = limit - start;
    if (!(room > 0.0)) return {sign * limit, now.turning, normal};
    // With y = 1 - (T - T*) / (limit - T*): dy/ds = -(k0 / room) y^(1/3), so y^(2/3) falls linearly.
    const double y = std::max(0.0, 1.0 - (sign * now.force - start) / room);
    const double before_way = y > 0.0 ? power(y, 2.0 / 3.0) : 0.0;
    const double left = std::max(0.0, before_way - 2.0 * k0 * std::abs(way) / (3.0 * room));
    now.force = sign * (start + room * (1.0 - left * std::sqrt(left)));
    return now;
}

}  // namespace polargrain
