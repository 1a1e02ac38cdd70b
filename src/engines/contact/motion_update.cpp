#include "src/engines/contact/motion_update.h"

namespace polargrain {

const std::vector<char>& MotionUpdate::decide(const TrialOverlaps& found) {
    const auto grains = static_cast<GrainIndex>(found.blocked.size());
    reach_.build(grains, found.order);
    rejected_.assign(found.blocked.size(), 0);
    for (GrainIndex k = 0; k < grains; ++k) {
        if (found.blocked[Grains::at(k)]) reject_with_dependants(k);
    }
    for (const auto& [a, b] : found.conflicts) {
        if (rejected_[Grains::at(a)] || rejected_[Grains::at(b)]) continue;
        reject_with_dependants(reach_.dependants(b) < reach_.dependants(a) ? b : a);
    }
    return rejected_;
}

void MotionUpdate::reject_with_dependants(GrainIndex a) {
    if (rejected_[Grains::at(a)]) return;
    rejected_[Grains::at(a)] = 1;
    queue_.assign(1, a);
    for (std::size_t head = 0; head < queue_.size(); ++head) {
        reach_.for_each_direct(queue_[head], [this](GrainIndex b) {
            if (rejected_[Grains::at(b)]) return;
            rejected_[Grains::at(b)] = 1;
            queue_.push_back(b);
        });
    }
}

}  // namespace polargrain
