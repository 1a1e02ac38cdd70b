#pragma once

#include <cstddef>
#include <cstdint>

namespace polargrain {

/// Contacts that the solver works on at a time.
constexpr int k_lanes = 8;

/// The kernels see a SolverBody as so many numbers, of which the first four are velocity (x, y), spin and inverse mass:
/// they are compiled without the headers that the rest of the program shares.
constexpr std::ptrdiff_t k_body_stride = 8;

/// A number of each of eight contacts.
struct alignas(64) Lanes {
    double of[k_lanes] = {};
};

/// Eight contacts of which no two share a grain, as the sweeps see them: in any order, or all at once, they give the
/// same bits. Bodies are indices into an array of bodies that holds the grains and, for every contact with a wall,
/// a body of infinite mass that moves as the wall does.
///
/// Lanes without a contact, or whose contact is over for this step, have no effective mass and stay without impulse.
struct alignas(64) LaneBlock {
    std::int32_t i[k_lanes] = {}, j[k_lanes] = {};
    Lanes normal_x, normal_y;
    Lanes arm_ni, arm_ti, arm_nj, arm_tj;      ///< cross(r, n), cross(r, t) [m]
    Lanes spin_ni, spin_ti, spin_nj, spin_tj;  ///< the same over the inertia: spin per impulse [rad/(N s)]
    Lanes mass_n, mass_t;                      ///< [kg/m]
    Lanes friction;
    Lanes open;                             ///< gap less resting gap [m]
    Lanes normal_impulse, tangent_impulse;  ///< of the last sub-step, on i [N s/m]
};

/// What else belongs to the same contacts, for moving on.
struct alignas(64) TravelBlock {
    Lanes travel, low, high;        ///< of i past j along t, and its bounds [m]
    Lanes sum_normal, sum_tangent;  ///< impulses of this step so far [N s/m]
    std::int32_t contact[k_lanes];  ///< which contact it is; -1: none
    std::uint8_t left, closes;      ///< bit per lane: has travelled past a bound; may strike in the next sub-step
};

/// How a block of contacts moves on in a sub-step.
struct LaneMove {
    double h = 0.0;     ///< [s]
    double slow = 0.0;  ///< closing speeds up to this are no impacts [m/s]
    double pull = 0.0;  ///< what gravity may add to a closing speed within a sub-step [m/s]
};

/// Energy that lasting contacts take, see GapSolver::move [J/m].
struct LaneLosses {
    double normal = 0.0, tangent = 0.0;
};

/// The loops over blocks, compiled for several instruction sets; all give the same bits, as every lane is computed by
/// the same operations in the same order and none is contracted.
struct LaneKernels {
    /// One Gauss-Seidel pass over blocks[first, last), in reverse where `backwards`. Returns whether any impulse has
    /// changed by more than `settled` [m/s] of its effective mass.
    bool (*sweep)(LaneBlock* blocks, std::ptrdiff_t first, std::ptrdiff_t last, bool backwards, double* bodies,
                  double per_h, double settled);

    /// Gaps, travels and sums of impulses of blocks[first, last) at the end of a sub-step.
    LaneLosses (*move)(LaneBlock* blocks, TravelBlock* travels, std::ptrdiff_t first, std::ptrdiff_t last,
                       const double* bodies, const LaneMove& move);

    const char* instruction_set;
};

/// The fastest that this processor can run.
const LaneKernels& lane_kernels();

namespace lanes_baseline {
extern const LaneKernels k_kernels;
}
namespace lanes_avx2 {
extern const LaneKernels k_kernels;
}
namespace lanes_avx512 {
extern const LaneKernels k_kernels;
}

}  // namespace polargrain
