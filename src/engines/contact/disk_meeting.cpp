#include "src/engines/contact/disk_meeting.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

DiskMeeting find_meeting(const Vec2& apart, const Vec2& velocity, double touching, double from, double to) {
    DiskMeeting meeting;
    meeting.time = from;
    const Vec2 first = apart + from * velocity;
    const double approach = -first.dot(velocity);
    if (approach > 0.0) {
        const double speed_squared = velocity.squaredNorm();
        const double open = first.squaredNorm() - touching * touching;
        const double root = approach * approach - speed_squared * open;
        // The smaller root, in the form that loses no digits; disks that overlap have met.
        const double wait = root > 0.0 ? open / (approach + std::sqrt(root)) : approach / speed_squared;
        meeting.time = std::clamp(from + wait, from, to);
    }
    const Vec2 then = apart + meeting.time * velocity;
    meeting.normal = then / std::sqrt(then.squaredNorm());
    meeting.distance = meeting.normal.dot(apart);
    return meeting;
}

}  // namespace polargrain
