#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// How much the sliding or the closing of a contact changes with each of up to six coordinates.
struct ContactRow {
    int index[6];
    double value[6];
    int count = 0;

    void add(BodyIndex grain, const Vec2& direction, double lever) {
        const auto first = static_cast<int>(3 * Grains::at(grain));
        const double values[3] = {direction.x(), direction.y(), lever};
        for (int d = 0; d < 3; ++d) {
            index[count] = first + d;
            value[count++] = values[d];
        }
    }
};

void add_spring(const ContactRow& row, double k, Triplets& matrix) {
    for (int r = 0; r < row.count; ++r) {
        for (int c = 0; c < row.count; ++c)
            matrix.emplace_back(row.index[r], row.index[c], k * row.value[r] * row.value[c]);
    }
}

}  // namespace

// (M + factor K) dx = M residual, with a spring along the normal of each contact and, where it does not slip, along the
// tangent. The stiffness F^2 / (2 W) is exact for the linear law; for others Newton's method takes an iteration more.
void SoftSystem::solve_implicit(double factor, std::span<const double> residual, std::span<double> dx) const {
    std::copy(residual.begin(), residual.end(), dx.begin());
    if (next_.empty()) return;
    const auto n = static_cast<Eigen::Index>(size());
    Triplets entries;
    Eigen::VectorXd right(n);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const double inertia[3] = {1.0 / bodies_[k].inverse_mass, 1.0 / bodies_[k].inverse_mass,
                                   1.0 / bodies_[k].inverse_inertia};
        for (std::size_t d = 0; d < 3; ++d) {
            const auto at = static_cast<int>(3 * k + d);
            entries.emplace_back(at, at, inertia[d]);
            right[at] = inertia[d] * residual[3 * k + d];
        }
    }
    for (const SoftContact& c : next_) {
        if (!(c.stored_normal > 0.0)) continue;
        const auto row = [&](const Vec2& direction) {
            ContactRow made;
            const auto lever = [&](BodyIndex grain) {
                const std::size_t k = 3 * Grains::at(grain);
                return cross(c.point - Vec2(evaluated_x_[k], evaluated_x_[k + 1]), direction);
            };
            made.add(c.b, direction, lever(c.b));
            if (!is_wall(c.a)) made.add(c.a, -direction, -lever(c.a));
            return made;
        };
        const double normal_stiffness = c.elastic_normal * c.elastic_normal / (2.0 * c.stored_normal);
        add_spring(row(c.normal), factor * normal_stiffness, entries);
        const PairSoftLaw& law = law_of(c.a, c.b);
        const bool sticks =
            law.law.tangential == TangentialLaw::spring && std::abs(c.sliding_force) < law.friction * c.normal_force;
        if (sticks) add_spring(row(left_normal(c.normal)), factor * law.tangential_stiffness, entries);
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::VectorXd solution = solver.solve(right);
    std::copy(solution.begin(), solution.end(), dx.begin());
}

}  // namespace polargrain
