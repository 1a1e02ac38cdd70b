#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/reproduce/piece.h"
#include "src/theory/domino_row.h"

namespace polargrain {

/// The dominoes of [HN94, Table 1].
struct DominoKind {
    std::string name;
    double height = 0.0, thickness = 0.0;  ///< L and h [m]
    double restitution = 0.0, friction = 0.0;

    /// gap: lambda / h.
    DominoRow row(double gap) const;
    /// Metres per second of V / sqrt(g L) = 1.
    double speed_unit() const;
};

const std::vector<DominoKind>& table_1();

/// Friction of a table on which no foot slides.
inline constexpr double k_rough_table = 1.5;
/// Step of the pinned-foot chain that curves are computed with [sqrt(L / g)].
inline constexpr double k_chain_step = 3e-4;
/// The engines whose dominoes are compared.
const std::vector<std::string>& domino_engines();

/// A row of dominoes of one kind on a table of its own friction.
struct DominoSetup {
    DominoKind kind = {};
    double gap = 0.0;  ///< lambda / h
    double table_friction = 0.0;
    std::string engine = {};
    double recorded = 0.0;  ///< interval between stored frames [s]; 0: none
    int count = 48;
    double lean = 1.0;                                      ///< of the first one, over the usual lean
    std::optional<double> time_step_factor = std::nullopt;  ///< none: as far as that engine is to be trusted
    std::string tables = {};                                ///< further tables of the scenario file
};

/// The row as a piece; the first domino leans, and turns at sqrt(g / L).
///
/// The dominoes stand; the first hangs a four-hundredth of its height above the table, because the literal method never
/// lets go of a grain that rests on something. Restitution against the table is that of the dominoes.
Piece domino_piece(const DominoSetup& setup);
Piece domino_piece(const DominoKind& kind, double gap, double table_friction, const std::string& engine,
                   double recorded = 0.0);

}  // namespace polargrain
