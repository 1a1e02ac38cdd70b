#pragma once

namespace polargrain {

/// A row of equal dominoes, in units of their height L and of gravity: speeds are in sqrt(g L). [HN94, Fig. 10]
struct DominoRow {
    double thickness = 0.0;    ///< h / L
    double gap = 0.0;          ///< lambda / L, free distance between facing faces; not the pitch
    double restitution = 0.0;  ///< e of the dominoes
    double friction = 0.0;     ///< mu between them

    double pitch() const { return gap + thickness; }
};

/// Throws InputError unless the row can topple: 0 < gap < 1, thickness > 0, 0 <= e <= 1, mu >= 0.
void check(const DominoRow& row);

}  // namespace polargrain
