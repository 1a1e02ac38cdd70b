#include "src/run/saved_state.h"

#include <array>

#include "src/core/error.h"

namespace polargrain {

namespace {

constexpr std::size_t k_contact_bodies = 2;
constexpr std::size_t k_contact_reals = 7;
constexpr std::size_t k_wall_reals = 3;

/// The arrays of a motion with their keys, for const and for mutable grains.
template <typename GrainsType>
auto motion_arrays(GrainsType& g) {
    return std::array{std::pair{"x", &g.x},   std::pair{"y", &g.y},   std::pair{"angle", &g.angle},
                      std::pair{"vx", &g.vx}, std::pair{"vy", &g.vy}, std::pair{"spin", &g.spin}};
}

std::vector<double> ledger_reals(const EnergyLedger& l) {
    return {l.restitution_loss, l.friction_loss, l.wall_work, l.correction, l.created, l.rises, l.stored};
}

EnergyLedger ledger_from(const std::vector<double>& v) {
    return {v.at(0), v.at(1), v.at(2), v.at(3), v.at(4), v.at(5), v.at(6)};
}

std::vector<std::int64_t> counts_of(const MoveCount& moves) { return {moves.tried, moves.shortened, moves.rejected}; }

MoveCount moves_from(const std::vector<std::int64_t>& v) { return {v.at(0), v.at(1), v.at(2)}; }

void save_contacts(Checkpoint& checkpoint, const std::vector<Contact>& contacts) {
    std::vector<std::int64_t> bodies;
    std::vector<double> reals;
    for (const Contact& c : contacts) {
        bodies.insert(bodies.end(), {c.a, c.b});
        reals.insert(reals.end(),
                     {c.point.x(), c.point.y(), c.normal.x(), c.normal.y(), c.gap, c.impulse.x(), c.impulse.y()});
    }
    checkpoint.put("contact_bodies", std::move(bodies));
    checkpoint.put("contact_reals", std::move(reals));
}

std::vector<Contact> contacts_from(const Checkpoint& checkpoint) {
    const auto& bodies = checkpoint.integers("contact_bodies");
    const auto& reals = checkpoint.reals("contact_reals");
    std::vector<Contact> contacts;
    for (std::size_t k = 0; k < bodies.size() / k_contact_bodies; ++k) {
        const std::int64_t* n = bodies.data() + k_contact_bodies * k;
        const double* r = reals.data() + k_contact_reals * k;
        contacts.push_back({static_cast<BodyIndex>(n[0]),
                            static_cast<BodyIndex>(n[1]),
                            {r[0], r[1]},
                            {r[2], r[3]},
                            r[4],
                            {r[5], r[6]}});
    }
    return contacts;
}

}  // namespace

void save_motion(Checkpoint& checkpoint, const Grains& grains) {
    for (const auto& [key, values] : motion_arrays(grains)) checkpoint.put(key, *values);
}

void load_motion(const Checkpoint& checkpoint, Grains& grains) {
    for (const auto& [key, values] : motion_arrays(grains)) {
        const std::vector<double>& saved = checkpoint.reals(key);
        if (saved.size() != values->size()) {
            throw RunError(
                fmt::format("the checkpoint holds {} grains, the scenario {}", saved.size(), values->size()));
        }
        *values = saved;
    }
}

void save(Checkpoint& checkpoint, const Totals& totals) {
    checkpoint.put("ledger", ledger_reals(totals.ledger));
    checkpoint.put("moves", counts_of(totals.moves));
    checkpoint.put("counts", std::vector<std::int64_t>{totals.impacts, totals.steps, totals.contact_sum});
    checkpoint.put("deepest", std::vector<double>{totals.deepest});
}

void load(const Checkpoint& checkpoint, Totals& totals) {
    const auto& counts = checkpoint.integers("counts");
    totals.ledger = ledger_from(checkpoint.reals("ledger"));
    totals.moves = moves_from(checkpoint.integers("moves"));
    totals.impacts = counts.at(0);
    totals.steps = counts.at(1);
    totals.contact_sum = counts.at(2);
    totals.deepest = checkpoint.reals("deepest").at(0);
}

void save(Checkpoint& checkpoint, const StepReport& report) {
    save_contacts(checkpoint, report.contacts);
    std::vector<double> walls;
    for (const WallImpulse& wall : report.walls) {
        walls.insert(walls.end(), {wall.linear.x(), wall.linear.y(), wall.angular});
    }
    checkpoint.put("walls", std::move(walls));
    checkpoint.put("ledger", ledger_reals(report.ledger));
    checkpoint.put("moves", counts_of(report.moves));
    checkpoint.put("impacts", std::vector<std::int64_t>{report.impacts});
    checkpoint.put("deepest", std::vector<double>{report.deepest});
}

void load(const Checkpoint& checkpoint, StepReport& report) {
    const auto& walls = checkpoint.reals("walls");
    report.clear(walls.size() / k_wall_reals);
    for (std::size_t w = 0; w < report.walls.size(); ++w) {
        const double* r = walls.data() + k_wall_reals * w;
        report.walls[w] = {{r[0], r[1]}, r[2]};
    }
    report.contacts = contacts_from(checkpoint);
    report.ledger = ledger_from(checkpoint.reals("ledger"));
    report.moves = moves_from(checkpoint.integers("moves"));
    report.impacts = checkpoint.integers("impacts").at(0);
    report.deepest = checkpoint.reals("deepest").at(0);
}

}  // namespace polargrain
