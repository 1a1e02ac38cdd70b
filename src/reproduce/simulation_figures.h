#pragma once

#include "src/reproduce/figure.h"

namespace polargrain {

// Figures that rest on simulations: the runs each needs, and what is drawn of them.

using Engines = std::vector<std::string>;

/// Speed of toppling dominoes over their spacing. [HN94, Fig. 11]
std::vector<Piece> fig11_pieces(const Engines& engines);
FigureResult draw_fig11(const FigureDesk& desk);
/// Ten snapshots of toppling dominoes. [HN94, Fig. 12]
std::vector<Piece> fig12_pieces(const Engines& engines);
FigureResult draw_fig12(const FigureDesk& desk);
/// What is said of the wave in words: when it is steady, how it varies, whether feet slide. [HN94, sec. 4.1]
std::vector<Piece> domino_wave_pieces(const Engines& engines);
FigureResult draw_domino_wave(const FigureDesk& desk);
/// The dominoes of the experiments, as the runs carry them. [HN94, Table 1]
std::vector<Piece> table1_pieces(const Engines& engines);
FigureResult draw_table1(const FigureDesk& desk);
/// Snapshots of 500 disks poured into a box. [HN94, Fig. 14]
std::vector<Piece> pouring_pieces(const Engines& engines);
FigureResult draw_fig14(const FigureDesk& desk);
/// Their potential energy over time, and how densely they lie. [HN94, Fig. 15 and sec. 4.2]
FigureResult draw_fig15(const FigureDesk& desk);
/// Rough grains out of a square bin. [HN94, Fig. 16]
std::vector<Piece> fig16_pieces(const Engines& engines);
FigureResult draw_fig16(const FigureDesk& desk);
/// Sticks out of a square bin. [HN94, Fig. 17]
std::vector<Piece> fig17_pieces(const Engines& engines);
FigureResult draw_fig17(const FigureDesk& desk);
/// What a simulated second costs. [HN94, sec. 4.4]
std::vector<Piece> efficiency_pieces(const Engines& engines);
FigureResult draw_efficiency(const FigureDesk& desk);
/// A V-mixer under eight sets of parameters. [K02, Table 2]
std::vector<Piece> mixer_pieces(const Engines& engines);
FigureResult draw_mixer(const FigureDesk& desk);

/// A shipped scenario as a piece, with values laid over it as by --set.
Piece shipped_piece(const std::string& scenario, const std::string& engine, unsigned seed,
                    const std::vector<std::string>& set);

/// Of the engines that a figure compares, those that this build has, in the order asked.
Engines at_hand(const Engines& wanted, const Engines& engines);

}  // namespace polargrain
