#include "src/engines/contact/contact_report.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace polargrain {

namespace {

/// Contacts that a thread takes at a time.
constexpr std::size_t k_run = 1024;

/// Those that have pushed.
void report_run(std::span<const GapContact> contacts, const Parallel& parallel, StepReport& report) {
    const auto each_pushing = [&](std::size_t first, std::size_t last, const auto& visit) {
        for (const GapContact& c : contacts.subspan(first, last - first)) {
            if (c.total_impulse != Vec2::Zero()) visit(c);
        }
    };
    // What each run adds goes behind what those before it add.
    std::vector<std::size_t> next((contacts.size() + k_run - 1) / k_run + 1, 0);
    parallel.runs(contacts.size(), k_run, [&](std::size_t first, std::size_t last) {
        each_pushing(first, last, [&](const GapContact&) { ++next[first / k_run + 1]; });
    });
    next.front() = report.contacts.size();
    for (std::size_t run = 1; run < next.size(); ++run) next[run] += next[run - 1];
    report.contacts.resize(next.back());
    parallel.runs(contacts.size(), k_run, [&](std::size_t first, std::size_t last) {
        each_pushing(first, last, [&](const GapContact& c) {
            report.contacts[next[first / k_run]++] = {c.j, c.i, c.point, c.normal, c.gap, c.total_impulse};
        });
    });
}

}  // namespace

void report_contacts(const std::vector<GapContact>& contacts, const Parallel& parallel, StepReport& report) {
    const std::size_t walls = first_with_wall(contacts);
    report_run({contacts.begin() + static_cast<std::ptrdiff_t>(walls), contacts.end()}, parallel, report);
    report_run({contacts.data(), walls}, parallel, report);
}

// As a rule those of walls come first, and those of grains are in order already.
void sort_reported(StepReport& report) {
    const auto by_bodies = [](const Contact& p, const Contact& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); };
    const auto with_wall = [](const Contact& c) { return is_wall(c.a); };
    auto& all = report.contacts;
    if (!std::is_partitioned(all.begin(), all.end(), with_wall)) {
        std::stable_partition(all.begin(), all.end(), with_wall);
    }
    const auto grains = std::partition_point(all.begin(), all.end(), with_wall);
    std::stable_sort(all.begin(), grains, by_bodies);
    if (!std::is_sorted(grains, all.end(), by_bodies)) std::stable_sort(grains, all.end(), by_bodies);
}

}  // namespace polargrain
