// Not a header of its own: included once by each source that is compiled for one instruction set, which defines
// POLARGRAIN_LANES, the namespace to put it in. Everything else here has internal linkage, so that no code for a better
// processor can stand in for that of a lesser one.

#include <bit>
#include <cstddef>

#include "src/engines/contact/lane_kernels.h"

// Vectors wider than the registers are passed in memory; nothing outside this source ever sees one.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace polargrain::POLARGRAIN_LANES {

namespace {

// Eight numbers of a kind; the compiler splits the arithmetic to the width of the machine.
using Wide = double __attribute__((vector_size(64), may_alias));
using Mask = std::int64_t __attribute__((vector_size(64), may_alias));
// Four numbers of one body; bodies are not aligned to it.
using Quad = double __attribute__((vector_size(32)));

static_assert(sizeof(Lanes) == sizeof(Wide));

inline Wide& wide(Lanes& lanes) { return *reinterpret_cast<Wide*>(lanes.of); }
inline const Wide& wide(const Lanes& lanes) { return *reinterpret_cast<const Wide*>(lanes.of); }

/// Velocities, spins and inverse masses of eight bodies.
struct Bodies {
    Wide vx, vy, spin, inverse_mass;
};

inline void load_one(const double* body, Quad& four) { __builtin_memcpy(&four, body, sizeof(four)); }

inline void store_one(double* body, const Quad& four) { __builtin_memcpy(body, &four, sizeof(four)); }

inline void load_four(const double* bodies, const std::int32_t* which, Quad& vx, Quad& vy, Quad& spin, Quad& mass) {
    Quad a;
    load_one(bodies + k_body_stride * which[0], a);
    Quad b;
    load_one(bodies + k_body_stride * which[1], b);
    Quad c;
    load_one(bodies + k_body_stride * which[2], c);
    Quad d;
    load_one(bodies + k_body_stride * which[3], d);
    const Quad ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Quad ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Quad cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Quad cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    vx = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
    spin = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
    vy = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
    mass = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

inline void load(const double* bodies, const std::int32_t* which, Bodies& eight) {
    Quad low[4];
    Quad high[4];
    load_four(bodies, which, low[0], low[1], low[2], low[3]);
    load_four(bodies, which + 4, high[0], high[1], high[2], high[3]);
    eight.vx = __builtin_shufflevector(low[0], high[0], 0, 1, 2, 3, 4, 5, 6, 7);
    eight.vy = __builtin_shufflevector(low[1], high[1], 0, 1, 2, 3, 4, 5, 6, 7);
    eight.spin = __builtin_shufflevector(low[2], high[2], 0, 1, 2, 3, 4, 5, 6, 7);
    eight.inverse_mass = __builtin_shufflevector(low[3], high[3], 0, 1, 2, 3, 4, 5, 6, 7);
}

inline void store_four(double* bodies, const std::int32_t* which, const Quad& vx, const Quad& vy, const Quad& spin,
                       const Quad& mass) {
    const Quad ab_even = __builtin_shufflevector(vx, spin, 0, 1, 4, 5);
    const Quad cd_even = __builtin_shufflevector(vx, spin, 2, 3, 6, 7);
    const Quad ab_odd = __builtin_shufflevector(vy, mass, 0, 1, 4, 5);
    const Quad cd_odd = __builtin_shufflevector(vy, mass, 2, 3, 6, 7);
    store_one(bodies + k_body_stride * which[0], __builtin_shufflevector(ab_even, ab_odd, 0, 4, 2, 6));
    store_one(bodies + k_body_stride * which[1], __builtin_shufflevector(ab_even, ab_odd, 1, 5, 3, 7));
    store_one(bodies + k_body_stride * which[2], __builtin_shufflevector(cd_even, cd_odd, 0, 4, 2, 6));
    store_one(bodies + k_body_stride * which[3], __builtin_shufflevector(cd_even, cd_odd, 1, 5, 3, 7));
}

inline void store(double* bodies, const std::int32_t* which, const Bodies& eight) {
    store_four(bodies, which, __builtin_shufflevector(eight.vx, eight.vx, 0, 1, 2, 3),
               __builtin_shufflevector(eight.vy, eight.vy, 0, 1, 2, 3),
               __builtin_shufflevector(eight.spin, eight.spin, 0, 1, 2, 3),
               __builtin_shufflevector(eight.inverse_mass, eight.inverse_mass, 0, 1, 2, 3));
    store_four(bodies, which + 4, __builtin_shufflevector(eight.vx, eight.vx, 4, 5, 6, 7),
               __builtin_shufflevector(eight.vy, eight.vy, 4, 5, 6, 7),
               __builtin_shufflevector(eight.spin, eight.spin, 4, 5, 6, 7),
               __builtin_shufflevector(eight.inverse_mass, eight.inverse_mass, 4, 5, 6, 7));
}

/// Both bodies of eight contacts, and the velocity of i relative to j: of the centres, and along n with the arms'.
struct Encounter {
    Bodies i, j;
    Wide ux, uy, u_n;
};

inline void meet(const LaneBlock& block, const double* bodies, Encounter& e) {
    load(bodies, block.i, e.i);
    load(bodies, block.j, e.j);
    e.ux = e.i.vx - e.j.vx;
    e.uy = e.i.vy - e.j.vy;
    e.u_n = wide(block.normal_x) * e.ux + wide(block.normal_y) * e.uy + wide(block.arm_ni) * e.i.spin -
            wide(block.arm_nj) * e.j.spin;
}

inline bool any(const Mask& mask) {
#ifdef __AVX512F__
    using Bytes = std::int8_t __attribute__((vector_size(k_lanes)));  // one instruction from eight masks to eight bytes
    return std::bit_cast<std::int64_t>(__builtin_convertvector(mask, Bytes)) != 0;
#else
    return ((mask[0] | mask[1]) | (mask[2] | mask[3]) | ((mask[4] | mask[5]) | (mask[6] | mask[7]))) != 0;
#endif
}

inline std::uint8_t bits(const Mask& mask) {
    unsigned all = 0;
    for (int lane = 0; lane < k_lanes; ++lane) all |= (mask[lane] != 0 ? 1U : 0U) << lane;
    return static_cast<std::uint8_t>(all);
}

inline void magnitude(Wide& x) { x = x < 0.0 ? -x : x; }

/// The lasting contacts' law for eight contacts; see GapSolver. Returns whether an impulse has changed much.
inline bool sweep_block(LaneBlock& block, double* bodies, double per_h, double settled) {
    Encounter e;
    meet(block, bodies, e);
    auto& [i, j, ux, uy, u_n] = e;
    const Wide nx = wide(block.normal_x);
    const Wide ny = wide(block.normal_y);
    const Wide masses = i.inverse_mass + j.inverse_mass;

    const Wide open = wide(block.open);
    const Wide target = open > 0.0 ? -open * per_h : Wide{};
    const Wide old_n = wide(block.normal_impulse);
    Wide normal = old_n - wide(block.mass_n) * (u_n - target);
    normal = normal > 0.0 ? normal : Wide{};
    const Wide change_n = normal - old_n;
    ux += masses * change_n * nx;
    uy += masses * change_n * ny;
    i.spin += change_n * wide(block.spin_ni);
    j.spin -= change_n * wide(block.spin_nj);

    const Wide cone = wide(block.friction) * normal;
    const Wide u_t = ny * ux - nx * uy + wide(block.arm_ti) * i.spin - wide(block.arm_tj) * j.spin;
    const Wide old_t = wide(block.tangent_impulse);
    Wide tangent = old_t - wide(block.mass_t) * u_t;
    tangent = tangent > cone ? cone : tangent;
    tangent = tangent < -cone ? -cone : tangent;
    const Wide change_t = tangent - old_t;
    if (!any((change_n != 0.0) | (change_t != 0.0))) return false;

    const Wide px = change_n * nx + change_t * ny;
    const Wide py = change_n * ny - change_t * nx;
    i.vx += i.inverse_mass * px;
    i.vy += i.inverse_mass * py;
    i.spin += change_t * wide(block.spin_ti);
    j.vx -= j.inverse_mass * px;
    j.vy -= j.inverse_mass * py;
    j.spin -= change_t * wide(block.spin_tj);
    store(bodies, block.i, i);
    store(bodies, block.j, j);
    wide(block.normal_impulse) = normal;
    wide(block.tangent_impulse) = tangent;

    Wide much_n = change_n;
    Wide much_t = change_t;
    magnitude(much_n);
    magnitude(much_t);
    return any((much_n > settled * wide(block.mass_n)) | (much_t > settled * wide(block.mass_t)));
}

inline bool sweep(LaneBlock* blocks, std::ptrdiff_t first, std::ptrdiff_t last, bool backwards, double* bodies,
                  double per_h, double settled) {
    bool changed = false;
    if (backwards) {
        for (std::ptrdiff_t b = last; b-- > first;) changed |= sweep_block(blocks[b], bodies, per_h, settled);
    } else {
        for (std::ptrdiff_t b = first; b < last; ++b) changed |= sweep_block(blocks[b], bodies, per_h, settled);
    }
    return changed;
}

inline LaneLosses move(LaneBlock* blocks, TravelBlock* travels, std::ptrdiff_t first, std::ptrdiff_t last,
                       const double* bodies, const LaneMove& move) {
    Wide losses_n{};
    Wide losses_t{};
    for (std::ptrdiff_t b = first; b < last; ++b) {
        LaneBlock& block = blocks[b];
        TravelBlock& travels_on = travels[b];
        Encounter e;
        meet(block, bodies, e);
        const auto& [i, j, ux, uy, u_n] = e;
        const Wide nx = wide(block.normal_x);
        const Wide ny = wide(block.normal_y);
        const Wide u_t = ny * ux - nx * uy + wide(block.arm_ti) * i.spin - wide(block.arm_tj) * j.spin;
        const Wide normal = wide(block.normal_impulse);
        const Wide tangent = wide(block.tangent_impulse);
        losses_n -= normal * u_n;
        losses_t -= tangent * u_t;
        wide(travels_on.sum_normal) += normal;
        wide(travels_on.sum_tangent) += tangent;
        const Wide open = wide(block.open) + u_n * move.h;
        wide(block.open) = open;
        const Wide travel = wide(travels_on.travel) + u_t * move.h;
        wide(travels_on.travel) = travel;
        const Mask left = (travel < wide(travels_on.low)) | (travel > wide(travels_on.high));
        const Mask closes = (-u_n > move.slow) & (open < (move.pull - u_n) * move.h);
        travels_on.left = 0;
        travels_on.closes = 0;
        if (!any(left | closes)) continue;
        travels_on.left = bits(left);
        travels_on.closes = bits(closes);
    }
    LaneLosses losses;
    for (int lane = 0; lane < k_lanes; ++lane) {
        losses.normal += losses_n[lane];
        losses.tangent += losses_t[lane];
    }
    return losses;
}

}  // namespace

}  // namespace polargrain::POLARGRAIN_LANES
