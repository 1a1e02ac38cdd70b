#include "src/model/step_report.h"

namespace polargrain {

EnergyLedger& EnergyLedger::operator+=(const EnergyLedger& other) {
    restitution_loss += other.restitution_loss;
    friction_loss += other.friction_loss;
    wall_work += other.wall_work;
    correction += other.correction;
    stored += other.stored;
    created += other.created;
    rises += other.rises;
    return *this;
}

MoveCount& MoveCount::operator+=(const MoveCount& other) {
    tried += other.tried;
    shortened += other.shortened;
    rejected += other.rejected;
    return *this;
}

void StepReport::clear(std::size_t wall_count) {
    contacts.clear();
    impact_records.clear();
    walls.assign(wall_count, WallImpulse{});
    ledger = {};
    moves = {};
    impacts = 0;
    deepest = 0.0;
}

}  // namespace polargrain
