#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/observe/observer.h"
#include "src/record/text_file.h"
#include "src/run/sink.h"

namespace polargrain {

/// Writes series.csv: a row of observables at each sample; docs/run-folder.md gives every column with its unit.
///
/// Energies, masses and forces per metre of depth. Sums (dissipated energies, work, impacts, moves) count from time
/// zero; forces and torques on walls are means over the time since the previous row, zero in the first. Numbers are
/// the shortest that read back to the same bits. Each row is flushed. Errors: RunError names the file.
class SeriesCsv : public Sink {
public:
    /// every: interval between rows [s]. observe: further columns, one each, after those of the walls; their values in
    /// SI units, "nan" where there is none. The file is created in begin().
    SeriesCsv(std::filesystem::path path, double every, std::vector<ObservableSpec> observe = {});

    double every() const override { return every_; }
    void begin(const Scene& scene, const RunInfo& info) override;
    void save(Checkpoint& checkpoint) override;
    void check(const Scene& scene, const Checkpoint& saved) const override;
    void resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) override;
    void step(const World& world, double dt, const StepReport& report) override;
    void sample(const Sample& sample) override;
    void end() override;

private:
    void append_walls(std::string& row);
    void make_observers(const Scene& scene);

    std::filesystem::path path_;
    double every_;
    std::vector<ObservableSpec> observe_;
    std::vector<Observer> observers_;
    std::optional<TextFile> file_;
    std::vector<WallImpulse> wall_sums_;  ///< since the previous row
    double interval_ = 0.0;               ///< [s] since the previous row
};

}  // namespace polargrain
