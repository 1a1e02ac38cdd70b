#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "src/engines/contact/gap_contact.h"

namespace polargrain {

/// A bed at rest or all but, on walls at rest, in a sub-step before any contact has pushed.
struct SlowBed {
    std::span<const GapContact> contacts;  ///< their impulses are the first guess
    std::span<const double> open;          ///< of each contact: gap less resting gap [m]
    std::span<const SolverBody> grains;    ///< their inverse masses and inertias
    std::span<const double> reach;         ///< their outer radii [m]
    std::span<const Vec2> free_velocity;   ///< what they would have without contacts [m/s]
    std::span<const double> free_spin;     ///< the same [rad/s]
    Vec2 kick = Vec2::Zero();              ///< velocity that gravity gives in the sub-step [m/s]
    double length = 0.0;                   ///< of the sub-step [s]
};

/// The pushes of a slow bed's contacts on its grains, M (v - w) = sum of f x impulse with f.v >= least for each push,
/// in units of gravity's kick and of the heaviest grain's mass.
///
/// Three rows a grain: v_x, v_y, reach x spin.
class PushSystem {
public:
    using Numbers = std::vector<double>;

    explicit PushSystem(const SlowBed& bed);

    std::size_t rows() const { return mass_.size(); }
    std::size_t pushes() const { return pushes_.size(); }
    double mass(std::size_t row) const { return mass_[row]; }
    double free(std::size_t row) const { return free_[row]; }  ///< speed without contacts, w
    /// Speed at which the gap of the push has to open; negative: may close.
    double least(std::size_t push) const { return pushes_[push].least; }

    double guess(std::size_t push) const { return pushes_[push].guess; }  ///< of its impulse

    double opening(std::size_t push, const Numbers& speeds) const;  ///< speed at which its gap opens, f.v
    void give(std::size_t push, double impulse, Numbers& values) const;

    /// What balance misses, M (v - w) - sum of f x impulse.
    void find_unbalanced(const Numbers& speeds, const Numbers& impulses, Numbers& unbalanced) const;

    /// Of M + sum of weight x f f^T, for `solve`. False where round-off has taken over.
    bool factorise(const Numbers& weights);
    Numbers solve(const Numbers& right) const;

    std::vector<Vec2> contact_impulses(const Numbers& impulses) const;  ///< [N s/m]

private:
    /// One direction in which a contact can push. Its factors times the speeds of its bodies, of which a wall is none,
    /// give the speed at which it opens.
    struct Push {
        std::size_t contact = 0;
        double tilt = 0.0;  ///< tangential impulse for each normal one
        double least = 0.0;
        double guess = 0.0;
        std::size_t factors = 0;
        std::array<double, 6> factor{};
        std::array<std::size_t, 6> row{};
    };

    void add_grain(std::size_t grain);
    void add_contact(std::size_t contact);
    void add_push(std::size_t contact, double tilt, double least, double guess);
    void lay_out();
    double* entry(std::size_t row, std::size_t column);

    SlowBed bed_;
    double kick_, unit_mass_ = 0.0;
    std::vector<Push> pushes_;
    Numbers mass_, free_;
    Eigen::SparseMatrix<double> matrix_;  ///< its lower triangle
    std::vector<double*> diagonal_;       ///< entries of the matrix: of each row
    std::vector<double*> entries_;        ///< of each pair of factors of each push
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

/// Speeds and impulses that solve a PushSystem, in its units.
struct PushSolution {
    PushSystem::Numbers speeds, impulses;
};

}  // namespace polargrain
