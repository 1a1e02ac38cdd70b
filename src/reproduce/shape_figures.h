#pragma once

#include "src/reproduce/figure.h"

namespace polargrain {

/// A grain in polar form. [HN94, Fig. 2]
FigureResult draw_fig2(const FigureDesk& desk);
/// The test whether a vertex lies in a grain. [HN94, Fig. 5]
FigureResult draw_fig5(const FigureDesk& desk);
/// The four cases of the contact normal. [HN94, Fig. 7]
FigureResult draw_fig7(const FigureDesk& desk);
/// The motion update of four grains, step by step. [HN94, Fig. 9]
FigureResult draw_fig9(const FigureDesk& desk);

}  // namespace polargrain
