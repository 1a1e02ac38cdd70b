#include "src/engines/contact/step_memory.h"

namespace polargrain {

void StepMemory::keep(const std::vector<SolverBody>& bodies, const std::vector<GapContact>& contacts,
                      const StepReport& report) {
    constexpr std::size_t k_run = 1024;  // contacts that a thread takes at a time
    bodies_ = bodies;
    contacts_.resize(contacts.size());
    parallel_.runs(contacts.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const GapContact& c = contacts[k];
            contacts_[k] = {c.point, c.normal, c.gap, c.normal_impulse, c.tangent_impulse, c.low, c.high};
        }
    });
    ledger_ = report.ledger;
    walls_ = report.walls;
    impacts_ = report.impacts;
    records_ = report.impact_records.size();
}

void StepMemory::take_back(std::vector<SolverBody>& bodies, std::vector<GapContact>& contacts,
                           StepReport& report) const {
    bodies = bodies_;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const OfContact& r = contacts_[k];
        GapContact& c = contacts[k];
        c.point = r.point;
        c.normal = r.normal;
        c.gap = r.gap;
        c.normal_impulse = r.normal_impulse;
        c.tangent_impulse = r.tangent_impulse;
        c.low = r.low;
        c.high = r.high;
    }
    report.ledger = ledger_;
    report.walls = walls_;
    report.impacts = impacts_;
    report.impact_records.resize(records_);
}

}  // namespace polargrain
