#pragma once

namespace polargrain::testing {

/// A row of equal dominoes in units of their height and of gravity.
struct DominoRow {
    double thickness = 0.0;    ///< h / L
    double gap = 0.0;          ///< lambda / L, between facing faces
    double restitution = 0.0;  ///< e of the dominoes
    double friction = 0.0;     ///< mu of the dominoes
};

/// Speed of the wave in units of sqrt(g L) over the second half of `count` dominoes, whose feet are pinned.
///
/// Every domino turns about its front bottom corner, th'' = (sin th - h cos th) / (2 I) with I = (1 + h^2) / 3, and the
/// top corner of one strikes the face of the next in pairwise impacts. No rigid-body code: an independent oracle for
/// rows on a floor too rough to slide on. Explicit steps of dt [sqrt(L / g)].
double domino_chain_speed(const DominoRow& row, int count = 70, double dt = 1e-4);

}  // namespace polargrain::testing
