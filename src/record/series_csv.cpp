#include "src/record/series_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "src/observe/bed.h"
#include "src/observe/motion.h"
#include "src/observe/series_columns.h"

namespace polargrain {

namespace {

/// Where the memory of an observer stands in a checkpoint: apart from our own, whatever its label.
std::string memory_of(const Observer& observer) { return "observed/" + observer.label(); }

}  // namespace

SeriesCsv::SeriesCsv(std::filesystem::path path, double every, std::vector<ObservableSpec> observe)
    : path_(std::move(path)), every_(every), observe_(std::move(observe)) {}

void SeriesCsv::make_observers(const Scene& scene) {
    observers_.clear();
    for (const ObservableSpec& spec : observe_) observers_.emplace_back(spec, scene);
}

void SeriesCsv::begin(const Scene& scene, const RunInfo& /*info*/) {
    std::string header;
    for (const std::string& column : series_columns(scene)) header += (header.empty() ? "" : ",") + csv_field(column);
    make_observers(scene);
    for (const Observer& observer : observers_) header += ',' + csv_field(observer.label());
    wall_sums_.assign(scene.walls.size(), {});
    interval_ = 0.0;
    file_.emplace(path_);
    file_->write(header + '\n');
    file_->flush();
}

void SeriesCsv::save(Checkpoint& checkpoint) {
    file_->save(checkpoint);
    std::vector<double> sums;
    for (const WallImpulse& sum : wall_sums_) sums.insert(sums.end(), {sum.linear.x(), sum.linear.y(), sum.angular});
    checkpoint.put("wall_sums", std::move(sums));
    checkpoint.put("interval", std::vector{interval_});
    for (const Observer& observer : observers_) observer.save(checkpoint, memory_of(observer));
}

void SeriesCsv::check(const Scene& /*scene*/, const Checkpoint& saved) const { TextFile::check(path_, saved); }

void SeriesCsv::resume(const Scene& scene, const RunInfo& /*info*/, const Checkpoint& saved) {
    const auto& sums = saved.reals("wall_sums");
    wall_sums_.assign(scene.walls.size(), {});
    for (std::size_t w = 0; w < wall_sums_.size(); ++w) {
        wall_sums_[w] = {{sums.at(3 * w), sums.at(3 * w + 1)}, sums.at(3 * w + 2)};
    }
    interval_ = saved.reals("interval").at(0);
    make_observers(scene);
    for (Observer& observer : observers_) observer.load(saved, memory_of(observer));
    file_.emplace(path_, saved);
}

void SeriesCsv::step(const World& world, double dt, const StepReport& report) {
    interval_ += dt;
    for (Observer& observer : observers_) observer.step(world, dt, report);
    for (std::size_t w = 0; w < wall_sums_.size(); ++w) {
        wall_sums_[w].linear += report.walls[w].linear;
        wall_sums_[w].angular += report.walls[w].angular;
    }
}

void SeriesCsv::sample(const Sample& sample) {
    const Energy now = energy(sample.world.grains, sample.scene.gravity);
    const Totals& totals = sample.totals;
    const Vec2 centre = centre_of_mass(sample.world.grains);
    const GrainIndex out = count_out(sample.scene, sample.world.grains);
    std::string row = fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", sample.world.time, sample.world.step,
        now.translational, now.rotational, now.potential, totals.ledger.restitution_loss, totals.ledger.friction_loss,
        totals.ledger.wall_work, sample.report.contacts.size(), totals.impacts, totals.moves.rejected,
        totals.moves.shortened, centre.x(), centre.y(), sample.world.grains.size() - out, out, totals.ledger.correction,
        totals.ledger.created, totals.ledger.rises, totals.moves.tried, totals.ledger.stored);
    append_walls(row);
    for (Observer& observer : observers_) fmt::format_to(std::back_inserter(row), ",{}", observer.read(sample));
    file_->write(row + '\n');
    file_->flush();
}

void SeriesCsv::append_walls(std::string& row) {
    const double per_second = interval_ > 0.0 ? 1.0 / interval_ : 0.0;
    for (WallImpulse& sum : wall_sums_) {
        fmt::format_to(std::back_inserter(row), ",{},{},{}", sum.linear.x() * per_second, sum.linear.y() * per_second,
                       sum.angular * per_second);
        sum = {};
    }
    interval_ = 0.0;
}

void SeriesCsv::end() {
    file_->sync();
    file_->close();
}

}  // namespace polargrain
