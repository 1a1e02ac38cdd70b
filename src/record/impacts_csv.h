#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/record/text_file.h"
#include "src/run/sink.h"

namespace polargrain {

/// Writes impacts.csv: a row for each processed impact in the order of processing, complete enough to compute the
/// impact again; docs/run-folder.md gives every column. 17 significant digits.
///
/// Takes the records from StepReport::impact_records, which engines fill only while StepReport::record_impacts is set.
/// A wall is named where a grain has its number; its centre is the contact point and its motion that of its
/// material there with no spin, as the engine recorded it. Flushed at each sample. Errors: RunError names the file.
class ImpactsCsv : public Sink {
public:
    /// every: interval between flushes [s].
    ImpactsCsv(std::filesystem::path path, double every);

    double every() const override { return every_; }
    void begin(const Scene& scene, const RunInfo& info) override;
    void save(Checkpoint& checkpoint) override;
    void check(const Scene& scene, const Checkpoint& saved) const override;
    void resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) override;
    void step(const World& world, double dt, const StepReport& report) override;
    void sample(const Sample& sample) override;
    void end() override;

private:
    void name_walls(const Scene& scene);

    std::filesystem::path path_;
    double every_;
    std::optional<TextFile> file_;
    std::vector<std::string> wall_names_;
    std::string text_;  ///< rows of one step; kept for its memory
};

}  // namespace polargrain
