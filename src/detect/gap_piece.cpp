#include "src/detect/gap_piece.h"

namespace polargrain {

namespace {

constexpr int k_most_pieces = 32;

Vec2 way_of(const GapPiece& piece) { return piece.now.b - piece.now.a; }

}  // namespace

bool GapPiece::points_away_from(const Vec2& place) const {
    if (at_a != Joint::left_turn && at_a != Joint::right_turn) return false;
    const double side = at_a == Joint::left_turn ? 1.0 : -1.0;
    return side * cross(way_of(*this), place - now.a) > 0.0 && side * cross(way_of(*previous), place - now.a) > 0.0;
}

bool GapPiece::bounds_past_end(const Vec2& p) const {
    const Vec2 along = way_of(*this);
    const double side = cross(along, p - now.a) > 0.0 ? 1.0 : -1.0;
    const Joint bend = side > 0.0 ? Joint::left_turn : Joint::right_turn;
    const bool past_a = along.dot(p - now.a) < 0.0;
    const GapPiece* last = this;
    for (int n = 0; n < k_most_pieces; ++n) {
        const GapPiece* piece = past_a ? last->previous : last->next;
        if (piece == nullptr || piece == this || (past_a ? last->at_a : last->at_b) != bend) return false;
        const Vec2 way = way_of(*piece);
        if (way.dot(along) <= 0.0 || side * cross(way, p - piece->now.a) <= 0.0) return false;
        const bool over_it = past_a ? way.dot(p - piece->now.a) >= 0.0 : way.dot(p - piece->now.b) <= 0.0;
        if (over_it) return true;
        last = piece;
    }
    return false;
}

}  // namespace polargrain
