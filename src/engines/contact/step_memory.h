#pragma once

#include <cstdint>
#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/gap_contact.h"
#include "src/model/step_report.h"

namespace polargrain {

/// What a step, or a part of one, began with, so that it can be taken back.
class StepMemory {
public:
    explicit StepMemory(const Parallel& parallel) : parallel_(parallel) {}

    void keep(const std::vector<SolverBody>& bodies, const std::vector<GapContact>& contacts, const StepReport& report);

    /// Puts back what keep() was given; the contacts are the same ones, whatever has become of them.
    void take_back(std::vector<SolverBody>& bodies, std::vector<GapContact>& contacts, StepReport& report) const;

    /// As it was at the beginning.
    const EnergyLedger& ledger() const { return ledger_; }

private:
    /// What the solver changes of a contact.
    struct OfContact {
        Vec2 point, normal;
        double gap, normal_impulse, tangent_impulse, low, high;
    };

    const Parallel& parallel_;
    std::vector<SolverBody> bodies_;
    std::vector<OfContact> contacts_;
    EnergyLedger ledger_;
    std::vector<WallImpulse> walls_;
    std::int64_t impacts_ = 0;
    std::size_t records_ = 0;
};

}  // namespace polargrain
