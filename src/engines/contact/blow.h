#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/contact_lanes.h"
#include "src/engines/contact/footing.h"
#include "src/engines/contact/halfway.h"
#include "src/model/scene.h"

namespace polargrain {

/// An impulse on i of a contact, and its reaction [N s/m].
struct BlowPush {
    std::int32_t contact = 0;
    double normal = 0.0, tangential = 0.0;
    double restitution = 0.0;
    SlipMode mode = SlipMode::separating;
};

/// One impact: the impulse at the contact, or at the two ends of a face, and those at the feet of its grains, and what
/// they take [J/m].
struct Blow {
    static constexpr std::size_t k_most_pushes = 4;

    std::array<BlowPush, k_most_pushes> pushes;
    std::size_t count = 0;
    double restitution_loss = 0.0, friction_loss = 0.0;

    void add(const BlowPush& push) { pushes[count++] = push; }
};

/// Finds the impulses of an impact by Stronge's law.
///
/// Grains that stand on a wall turn about their foot while another grain strikes them, where foot and friction can hold
/// them (Footing); both grains of a pair may. A face that lands flat strikes with both of its ends at once (FaceBlow).
class BlowSolver {
public:
    static constexpr double k_foot_gap = 2.0;    ///< feet rest at most this many resting gaps from the wall
    static constexpr double k_foot_speed = 0.1;  ///< of the closing speed: feet that move faster hold nothing
    static constexpr double k_flat =
        0.05;  ///< ends of a face that close so nearly as fast as one another strike at once

    explicit BlowSolver(const Scene& scene) : scene_(scene) {}

    /// What it reads, for as long as a step lasts; `by_grain` are the contacts of each grain.
    void begin(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies, const Halfway& halfway,
               const ContactLanes& lanes, const ByGrain& by_grain, std::int64_t step);

    /// Is the gap of a contact that closes at `speed` [m/s] closed within a sub-step of length h [s]?
    bool meets(std::int32_t contact, double speed, double h) const;

    /// The impact of a contact that closes at `speed` [m/s] in a sub-step of length h [s]. Changes nothing; may run on
    /// several threads.
    Blow solve(std::int32_t contact, double speed, double h) const;

private:
    /// A place where a grain may stand on a wall, and how; none if it is free.
    struct Stance {
        std::int32_t foot = -1;
        Grip grip = Grip::holds;

        bool free() const { return foot < 0; }
    };
    /// The contacts at which an impact acts: the two ends of a face that lands flat, or twice the same one.
    struct Ends {
        std::int32_t first, second;
    };
    struct Answer;

    const GapContact& contact(std::int32_t k) const { return (*contacts_)[static_cast<std::size_t>(k)]; }
    void find_stances(GrainIndex grain, double speed, std::vector<Stance>& stances) const;
    bool lands_with(const GapContact& struck, std::int32_t other, double speed, double h) const;
    Ends face_of(std::int32_t struck, double speed, double h) const;
    Answer answer(const Ends& ends, double restitution, const Stance& stance_i, const Stance& stance_j) const;
    bool presses_another(const Footing& footing, const std::vector<Stance>& stances) const;
    Blow blow(const Ends& ends, const Answer& answer, double restitution, const Stance& stance_i,
              const Stance& stance_j) const;

    const Scene& scene_;
    const std::vector<GapContact>* contacts_ = nullptr;
    const std::vector<SolverBody>* bodies_ = nullptr;
    const Halfway* halfway_ = nullptr;
    const ContactLanes* lanes_ = nullptr;
    const ByGrain* by_grain_ = nullptr;
    std::int64_t step_ = 0;
};

}  // namespace polargrain
