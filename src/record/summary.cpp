#include "src/record/summary.h"

#include <nlohmann/json.hpp>

#include "src/record/text_file.h"

namespace polargrain {

namespace {

using Json = nlohmann::ordered_json;

Json moves_of(const MoveCount& moves) {
    return {{"tried", moves.tried},
            {"accepted", moves.accepted()},
            {"shortened", moves.shortened},
            {"rejected", moves.rejected}};
}

Json parts_of(const Energy& energy) {
    return {{"kinetic_translational", energy.translational},
            {"kinetic_rotational", energy.rotational},
            {"potential", energy.potential},
            {"total", energy.total()}};
}

Json ledger_of(const Summary& summary) {
    const EnergyLedger& ledger = summary.totals.ledger;
    const double booked = ledger.wall_work + ledger.correction + ledger.created - ledger.restitution_loss -
                          ledger.friction_loss - ledger.stored;
    return {{"initial", parts_of(summary.initial)},
            {"final", parts_of(summary.final_energy)},
            {"dissipated_normal", ledger.restitution_loss},
            {"dissipated_friction", ledger.friction_loss},
            {"wall_work", ledger.wall_work},
            {"correction", ledger.correction},
            {"created", ledger.created},
            {"rises", ledger.rises},
            {"stored", ledger.stored},
            {"unaccounted", summary.final_energy.total() - summary.initial.total() - booked}};
}

double mean_contacts(const Totals& totals) {
    return totals.steps > 0 ? static_cast<double>(totals.contact_sum) / static_cast<double>(totals.steps) : 0.0;
}

Json settling_of(const SettlingSummary& settling) {
    return {{"at_rest", settling.at_rest},
            {"seconds", settling.seconds},
            {"at_most", settling.at_most},
            {"energy", settling.energy},
            {"until_energy", settling.until_energy}};
}

Json to_json(const Summary& summary) {
    Json json{{"title", summary.title},
              {"source", summary.source},
              {"engine", summary.engine},
              {"version", summary.version},
              {"build_flags", summary.build_flags},
              {"notes", summary.notes},
              {"seed", summary.seed},
              {"threads", summary.threads},
              {"interrupted", !summary.completed},
              {"steps", summary.steps},
              {"time_step", summary.time_step},
              {"simulated_seconds", summary.simulated_seconds},
              {"cpu_seconds", summary.cpu_seconds},
              {"wall_seconds", summary.wall_seconds},
              {"grains", summary.grains},
              {"grains_out", summary.grains_out},
              {"mean_contacts", mean_contacts(summary.totals)},
              {"impacts", summary.totals.impacts},
              {"moves", moves_of(summary.totals.moves)},
              {"deepest_overlap", summary.totals.deepest},
              {"energy", ledger_of(summary)},
              {"state_hash", summary.state_hash},
              {"observables", Json(summary.observables)}};
    if (summary.settling) json["settling"] = settling_of(*summary.settling);
    return json;
}

}  // namespace

void write_summary(const std::filesystem::path& path, const Summary& summary) {
    write_whole_file(path, to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace polargrain
