#include "src/engines/contact/contact_checkpoint.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace polargrain {

namespace {

constexpr std::size_t k_contact_integers = 6;
constexpr std::size_t k_contact_reals = 9;
constexpr std::size_t k_pair_integers = 5;

}  // namespace

void save_contacts(const std::vector<GapContact>& contacts, const std::vector<PairContacts>& pairs,
                   Checkpoint& checkpoint) {
    std::vector<std::int64_t> integers;
    std::vector<double> reals;
    std::vector<std::int64_t> of_pairs;
    for (const GapContact& c : contacts) {
        integers.insert(integers.end(), {c.i, c.j, c.vertex, c.edge, c.piece, c.on_i ? 1 : 0});
        reals.insert(reals.end(), {c.point.x(), c.point.y(), c.normal.x(), c.normal.y(), c.gap, c.normal_impulse,
                                   c.tangent_impulse, c.low, c.high});
    }
    for (const PairContacts& p : pairs) of_pairs.insert(of_pairs.end(), {p.i, p.j, p.piece, p.first, p.count});
    checkpoint.put("contact/integers", std::move(integers));
    checkpoint.put("contact/reals", std::move(reals));
    checkpoint.put("contact/pairs", std::move(of_pairs));
}

void load_contacts(const Checkpoint& checkpoint, std::vector<GapContact>& contacts, std::vector<PairContacts>& pairs) {
    const auto& integers = checkpoint.integers("contact/integers");
    const auto& reals = checkpoint.reals("contact/reals");
    const auto& of_pairs = checkpoint.integers("contact/pairs");
    contacts.clear();
    pairs.clear();
    for (std::size_t k = 0; (k + 1) * k_contact_integers <= integers.size(); ++k) {
        const std::int64_t* n = integers.data() + k_contact_integers * k;
        const double* r = reals.data() + k_contact_reals * k;
        GapContact c;
        c.i = static_cast<BodyIndex>(n[0]);
        c.j = static_cast<BodyIndex>(n[1]);
        c.vertex = static_cast<std::int32_t>(n[2]);
        c.edge = static_cast<std::int32_t>(n[3]);
        c.piece = static_cast<std::int32_t>(n[4]);
        c.on_i = n[5] != 0;
        c.point = {r[0], r[1]};
        c.normal = {r[2], r[3]};
        c.gap = r[4];
        c.normal_impulse = r[5];
        c.tangent_impulse = r[6];
        c.low = r[7];
        c.high = r[8];
        contacts.push_back(c);
    }
    for (std::size_t k = 0; (k + 1) * k_pair_integers <= of_pairs.size(); ++k) {
        const std::int64_t* n = of_pairs.data() + k_pair_integers * k;
        pairs.push_back({static_cast<BodyIndex>(n[0]), static_cast<BodyIndex>(n[1]), static_cast<std::int32_t>(n[2]),
                         static_cast<std::int32_t>(n[3]), static_cast<std::int32_t>(n[4]), false});
    }
}

}  // namespace polargrain
