#include "src/engines/contact/gap_contact.h"

#include <algorithm>

namespace polargrain {

namespace {

/// Cosine between the normals of what may be one contact, found twice: they part by less than half a right angle.
constexpr double k_same_way = 0.7;

}  // namespace

std::size_t first_with_wall(const std::vector<GapContact>& contacts) {
    const auto first =
        std::partition_point(contacts.begin(), contacts.end(), [](const GapContact& c) { return !is_wall(c.j); });
    return static_cast<std::size_t>(first - contacts.begin());
}

void make_contacts(const PairContacts& pair, std::span<const GapPoint> points, double resting,
                   std::span<GapContact> contacts) {
    for (std::size_t n = 0; n < points.size(); ++n) {
        const GapPoint& p = points[n];
        GapContact c;
        c.i = pair.i;
        c.j = pair.j;
        c.point = p.point;
        c.normal = p.normal;
        c.gap = p.gap;
        c.low = p.low;
        c.high = p.high;
        c.vertex = p.vertex;
        c.edge = p.edge;
        c.piece = pair.piece;
        c.on_i = p.on_i;
        c.resting = resting;
        contacts[n] = c;
    }
}

namespace {

void take_over(GapContact& now, GapContact& old) {
    now.normal_impulse = old.normal_impulse;
    now.tangent_impulse = old.tangent_impulse;
    old.normal_impulse = 0.0;
    old.tangent_impulse = 0.0;
}

}  // namespace

void scale_impulses(std::vector<GapContact>& contacts, double factor) {
    if (factor == 1.0) return;
    for (GapContact& c : contacts) {
        c.normal_impulse *= factor;
        c.tangent_impulse *= factor;
    }
}

// First by feature; what is left goes to the nearest point with a similar normal that has none yet.
void take_impulses_over(std::span<GapContact> now, std::span<GapContact> old) {
    thread_local std::vector<char> done;
    done.assign(old.size(), 0);
    for (GapContact& c : now) {
        for (std::size_t k = 0; k < old.size(); ++k) {
            if (done[k] || old[k].on_i != c.on_i || old[k].vertex != c.vertex ||
                old[k].normal.dot(c.normal) < k_same_way)
                continue;
            take_over(c, old[k]);
            done[k] = 1;
            break;
        }
    }
    for (std::size_t k = 0; k < old.size(); ++k) {
        if (done[k] || old[k].normal_impulse == 0.0) continue;
        GapContact* nearest = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (GapContact& c : now) {
            if (c.normal_impulse != 0.0 || old[k].normal.dot(c.normal) < k_same_way) continue;
            const double d = (c.point - old[k].point).squaredNorm();
            if (d < least) {
                least = d;
                nearest = &c;
            }
        }
        if (nearest) take_over(*nearest, old[k]);
    }
}

}  // namespace polargrain
