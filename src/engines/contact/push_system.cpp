#include "src/engines/contact/push_system.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_motion.h"

namespace polargrain {

namespace {

constexpr double k_far = 100.0;  ///< gaps that close in so many kicks are none

}  // namespace

PushSystem::PushSystem(const SlowBed& bed) : bed_(bed), kick_(std::sqrt(bed.kick.squaredNorm())) {
    for (const SolverBody& grain : bed.grains) unit_mass_ = std::max(unit_mass_, 1.0 / grain.inverse_mass);
    for (std::size_t k = 0; k < bed.grains.size(); ++k) add_grain(k);
    for (std::size_t k = 0; k < bed.contacts.size(); ++k) add_contact(k);
    lay_out();
}

void PushSystem::add_grain(std::size_t grain) {
    const SolverBody& body = bed_.grains[grain];
    const double reach = bed_.reach[grain];
    const double mass = 1.0 / (body.inverse_mass * unit_mass_);
    mass_.insert(mass_.end(), {mass, mass, 1.0 / (body.inverse_inertia * unit_mass_ * reach * reach)});
    const Vec2 velocity = bed_.free_velocity[grain] / kick_;
    free_.insert(free_.end(), {velocity.x(), velocity.y(), bed_.free_spin[grain] * reach / kick_});
}

void PushSystem::add_contact(std::size_t contact) {
    const GapContact& c = bed_.contacts[contact];
    const double least = -std::max(0.0, bed_.open[contact]) / (bed_.length * kick_);
    if (least < -k_far) return;
    const double unit = unit_mass_ * kick_;
    if (c.friction <= 0.0) {
        add_push(contact, 0.0, least, c.normal_impulse / unit);
        return;
    }
    for (const double tilt : {c.friction, -c.friction}) {
        add_push(contact, tilt, least, 0.5 * (c.normal_impulse + c.tangent_impulse / tilt) / unit);
    }
}

void PushSystem::add_push(std::size_t contact, double tilt, double least, double guess) {
    const GapContact& c = bed_.contacts[contact];
    const Vec2 along = c.normal + tilt * c.tangent();
    Push p{contact, tilt, least, guess};
    const auto acts_on = [&](BodyIndex body, const Vec2& direction, double arm) {
        for (const double factor : {direction.x(), direction.y(), arm / bed_.reach[at(body)]}) {
            p.factor[p.factors] = factor;
            p.row[p.factors] = 3 * at(body) + p.factors % 3;
            ++p.factors;
        }
    };
    acts_on(c.i, along, c.arm_ni + tilt * c.arm_ti);
    if (!is_wall(c.j)) acts_on(c.j, -along, -(c.arm_nj + tilt * c.arm_tj));
    pushes_.push_back(p);
}

double* PushSystem::entry(std::size_t row, std::size_t column) {
    return &matrix_.coeffRef(static_cast<Eigen::Index>(std::max(row, column)),
                             static_cast<Eigen::Index>(std::min(row, column)));
}

/// Which entries the matrix has, and where each push has its own.
void PushSystem::lay_out() {
    std::vector<Eigen::Triplet<double>> pattern;
    pattern.reserve(mass_.size() + 21 * pushes_.size());
    const auto add = [&](std::size_t row, std::size_t column) {
        pattern.emplace_back(static_cast<int>(std::max(row, column)), static_cast<int>(std::min(row, column)), 0.0);
    };
    for (std::size_t k = 0; k < mass_.size(); ++k) add(k, k);
    for (const Push& p : pushes_) {
        for (std::size_t a = 0; a < p.factors; ++a) {
            for (std::size_t b = 0; b <= a; ++b) add(p.row[a], p.row[b]);
        }
    }
    const auto n = static_cast<Eigen::Index>(mass_.size());
    matrix_.resize(n, n);
    matrix_.setFromTriplets(pattern.begin(), pattern.end());
    for (std::size_t k = 0; k < mass_.size(); ++k) diagonal_.push_back(entry(k, k));
    for (const Push& p : pushes_) {
        for (std::size_t a = 0; a < p.factors; ++a) {
            for (std::size_t b = 0; b <= a; ++b) entries_.push_back(entry(p.row[a], p.row[b]));
        }
    }
    factors_.analyzePattern(matrix_);
}

double PushSystem::opening(std::size_t push, const Numbers& speeds) const {
    const Push& p = pushes_[push];
    double sum = 0.0;
    for (std::size_t f = 0; f < p.factors; ++f) sum += p.factor[f] * speeds[p.row[f]];
    return sum;
}

void PushSystem::give(std::size_t push, double impulse, Numbers& values) const {
    const Push& p = pushes_[push];
    for (std::size_t f = 0; f < p.factors; ++f) values[p.row[f]] += p.factor[f] * impulse;
}

void PushSystem::find_unbalanced(const Numbers& speeds, const Numbers& impulses, Numbers& unbalanced) const {
    unbalanced.resize(rows());
    for (std::size_t k = 0; k < rows(); ++k) unbalanced[k] = mass_[k] * (speeds[k] - free_[k]);
    for (std::size_t k = 0; k < pushes(); ++k) give(k, -impulses[k], unbalanced);
}

bool PushSystem::factorise(const Numbers& weights) {
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
    for (std::size_t k = 0; k < rows(); ++k) *diagonal_[k] = mass_[k];
    auto next = entries_.begin();
    for (std::size_t k = 0; k < pushes(); ++k) {
        const Push& p = pushes_[k];
        for (std::size_t a = 0; a < p.factors; ++a) {
            for (std::size_t b = 0; b <= a; ++b) **next++ += weights[k] * p.factor[a] * p.factor[b];
        }
    }
    factors_.factorize(matrix_);
    return factors_.info() == Eigen::Success;
}

PushSystem::Numbers PushSystem::solve(const Numbers& right) const {
    const auto n = static_cast<Eigen::Index>(right.size());
    const Eigen::VectorXd solution = factors_.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), n));
    return {solution.begin(), solution.end()};
}

std::vector<Vec2> PushSystem::contact_impulses(const Numbers& impulses) const {
    std::vector<Vec2> sums(bed_.contacts.size(), Vec2::Zero());
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
        sums[pushes_[k].contact] += unit_mass_ * kick_ * impulses[k] * Vec2(1.0, pushes_[k].tilt);
    }
    return sums;
}

}  // namespace polargrain
