#include "src/observe/mixing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "src/observe/bed.h"

namespace polargrain {

namespace {

struct CellCount {
    double marked = 0.0, all = 0.0;
};

std::vector<GrainIndex> chosen(const Scene& scene, const Grains& grains, const std::optional<Region>& region) {
    std::vector<GrainIndex> in = grains_in(scene, grains);
    std::erase_if(in, [&](GrainIndex k) { return !in_region(region, grains.position(k)); });
    return in;
}

}  // namespace

double lacey_index(const Scene& scene, const Grains& grains, const GrainMask& mask, double cell,
                   const std::optional<Region>& region) {
    const std::vector<GrainIndex> in = chosen(scene, grains, region);
    Vec2 corner(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
    for (const GrainIndex k : in) corner = corner.cwiseMin(grains.position(k));
    std::map<std::pair<double, double>, CellCount> cells;
    CellCount total;
    for (const GrainIndex k : in) {
        const Vec2 place = (grains.position(k) - corner) / cell;
        CellCount& count = cells[{std::floor(place.x()), std::floor(place.y())}];
        count.marked += mask[Grains::at(k)];
        count.all += 1.0;
        total.marked += mask[Grains::at(k)];
        total.all += 1.0;
    }
    const double p = total.marked / total.all;
    const double apart = p * (1.0 - p);
    double variance = 0.0;
    double mean_number = 0.0;
    for (const auto& [place, count] : cells) {
        const double off = count.marked / count.all - p;
        variance += count.all / total.all * off * off;
        mean_number += count.all / total.all * count.all;
    }
    const double range = apart * (1.0 - 1.0 / mean_number);
    return range > 0.0 ? (apart - variance) / range : std::nan("");
}

double share_in_region(const Grains& grains, const GrainMask& mask, const Region& region) {
    double inside = 0.0;
    double all = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        if (mask[Grains::at(k)] == 0) continue;
        all += 1.0;
        if (region.holds(grains.position(k))) inside += 1.0;
    }
    return all > 0.0 ? inside / all : std::nan("");
}

double purity(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region) {
    double marked = 0.0;
    double all = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        if (!in_region(region, grains.position(k))) continue;
        all += 1.0;
        marked += mask[Grains::at(k)];
    }
    return all > 0.0 ? marked / all : std::nan("");
}

double height_rank(const Scene& scene, const Grains& grains, const GrainMask& mask) {
    const Vec2 up = upwards(scene);
    std::vector<double> others, marked;
    for (const GrainIndex k : grains_in(scene, grains)) {
        (mask[Grains::at(k)] != 0 ? marked : others).push_back(up.dot(grains.position(k)));
    }
    if (others.empty() || marked.empty()) return std::nan("");
    std::sort(others.begin(), others.end());
    double below = 0.0;
    for (const double height : marked) {
        below += static_cast<double>(std::lower_bound(others.begin(), others.end(), height) - others.begin());
    }
    return below / static_cast<double>(others.size() * marked.size());
}

}  // namespace polargrain
