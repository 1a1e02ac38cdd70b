#include "src/engines/dem/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

Candidates::Candidates(const Scene& scene, const DemSettings& settings)
    : scene_(scene), finder_(settings.search), skin_(settings.search == PairSearch::verlet ? settings.skin : 0.0) {}

void Candidates::renumber(const Numbering& numbers) {
    built_ = false;
    radii_.clear();
    margin_.clear();
    least_margin_ = std::numeric_limits<double>::infinity();
    for (const GrainIndex k : numbers) {
        radii_.push_back(outer_radius(scene_.shape_of(k)));
        margin_.push_back(skin_ * radii_.back());
        least_margin_ = std::min(least_margin_, margin_.back());
    }
}

void Candidates::update(std::span<const double> x, const SoftWalls& walls) {
    if (!still_good(x, walls)) rebuild(x, walls);
}

// Each grain of a listed pair has its own margin, so each may use up all of it; against a moving wall the grain and the
// wall share the grain's.
bool Candidates::still_good(std::span<const double> x, const SoftWalls& walls) const {
    if (!built_) return false;
    double wall_way = 0.0;
    if (walls.any_moves()) {
        for (std::size_t k = 0; k < walls.pieces().size(); ++k) {
            const SoftPiece& piece = walls.pieces()[k];
            wall_way = std::max(
                {wall_way, (piece.a - walls_at_[2 * k]).squaredNorm(), (piece.b - walls_at_[2 * k + 1]).squaredNorm()});
        }
        wall_way = std::sqrt(wall_way);
        if (wall_way >= least_margin_) return false;
    }
    for (std::size_t k = 0; k < margin_.size(); ++k) {
        const double dx = x[3 * k] - built_at_[2 * k];
        const double dy = x[3 * k + 1] - built_at_[2 * k + 1];
        const double margin = margin_[k] - wall_way;
        if (dx * dx + dy * dy >= margin * margin) return false;
    }
    return true;
}

void Candidates::rebuild(std::span<const double> x, const SoftWalls& walls) {
    built_ = true;
    built_at_.clear();
    circles_.clear();
    for (std::size_t k = 0; k < margin_.size(); ++k) {
        built_at_.insert(built_at_.end(), {x[3 * k], x[3 * k + 1]});
        circles_.push_back({{x[3 * k], x[3 * k + 1]}, radii_[k] + margin_[k]});
    }
    finder_.find_pairs(circles_, pairs_);

    walls_at_.clear();
    for (const SoftPiece& piece : walls.pieces()) walls_at_.insert(walls_at_.end(), {piece.a, piece.b});
    find_at_walls(walls.pieces());
}

void Candidates::find_at_walls(const std::vector<SoftPiece>& pieces) {
    placed_.clear();
    for (const SoftPiece& piece : pieces) placed_.push_back({{piece.a, piece.b}, piece.wall, 0});
    wall_search_.place(placed_);
    at_walls_.clear();
    for (std::size_t k = 0; k < circles_.size(); ++k) {
        wall_search_.find(circles_[k].centre, circles_[k].radius, near_);
        for (const std::int32_t number : near_) {
            const SoftPiece& piece = pieces[static_cast<std::size_t>(number)];
            const Vec2 from = circles_[k].centre - piece.a;
            const double reach = circles_[k].radius;
            const double station = piece.along.dot(from);
            if (std::abs(cross(piece.along, from)) >= reach || station <= -reach || station >= piece.length + reach) {
                continue;
            }
            at_walls_.push_back({number, static_cast<GrainIndex>(k)});
        }
    }
    // Pieces stand in the order of their bodies; within a wall by grain, then by piece.
    std::stable_sort(at_walls_.begin(), at_walls_.end(), [&pieces](const WallCandidate& c, const WallCandidate& d) {
        const int wall_c = pieces[static_cast<std::size_t>(c.piece)].wall;
        const int wall_d = pieces[static_cast<std::size_t>(d.piece)].wall;
        return wall_c != wall_d ? wall_c > wall_d : c.grain < d.grain;
    });
}

}  // namespace polargrain
