#include "src/reproduce/run_store.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <thread>

#include "src/core/child_process.h"
#include "src/core/error.h"
#include "src/record/folder_lock.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds k_look_again{20};
constexpr const char* k_part = ".part";

std::string contents(const fs::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A piece while its program runs. Everything stands in a folder of this process, which holds it as long as it lives:
/// two that reproduce into the same place do not meet, and what one leaves that is killed can be told from work in
/// progress.
class RunningPiece {
public:
    RunningPiece(const Piece& piece, fs::path final_folder, const fs::path& program)
        : name_(piece.name),
          final_(std::move(final_folder)),
          part_(final_.string() + fmt::format("{}{}", k_part, getpid())) {
        fs::remove_all(part_);
        make_folder(part_);
        lock_ = std::make_unique<FolderLock>(part_);
        TextFile scenario(part_ / "piece.toml");
        scenario.write(piece.scenario);
        scenario.close();
        child_ = std::make_unique<ChildProcess>(
            std::vector<std::string>{program.string(), "run", (part_ / "piece.toml").string(), "-o",
                                     (part_ / "run").string(), "--no-frames", "--quiet"},
            part_ / "output.txt");
    }

    const std::string& name() const { return name_; }
    /// True when it has ended; the finished run is in its final place then.
    bool collect() {
        const std::optional<int> exit_code = child_->poll();
        if (!exit_code) return false;
        if (*exit_code != 0) {
            throw RunError(fmt::format("the run {} failed (exit code {}); it said:\n{}\nits scenario: {}", name_,
                                       *exit_code, contents(part_ / "output.txt"), (part_ / "piece.toml").string()));
        }
        fs::remove_all(final_);
        fs::rename(part_ / "run", final_);
        fs::remove_all(part_);
        return true;
    }

    /// Ends it at once: what it has written goes with it.
    void discard() {
        child_.reset();
        fs::remove_all(part_);
    }

private:
    std::string name_;
    fs::path final_, part_;
    std::unique_ptr<FolderLock> lock_;
    std::unique_ptr<ChildProcess> child_;
};

/// Pieces of a process that was killed. Their programs may be going on: without a folder they end, too.
void remove_abandoned(const fs::path& folder) {
    std::vector<fs::path> abandoned;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const bool part = entry.path().extension().string().starts_with(k_part);
        if (part && entry.is_directory() && FolderLock::is_free(entry.path())) abandoned.push_back(entry.path());
    }
    for (const fs::path& part : abandoned) fs::remove_all(part);
}

}  // namespace

RunStore::RunStore(fs::path folder, fs::path program, const std::vector<EngineAtHand>& engines)
    : folder_(std::move(folder)), program_(std::move(program)) {
    for (const EngineAtHand& engine : engines) fingerprints_[engine.name] = engine_fingerprint(engine);
}

fs::path RunStore::folder_of(const Piece& piece) const {
    return folder_ / (piece.name + "-" + piece_key(piece, fingerprints_.at(piece.engine)));
}

bool RunStore::finished(const Piece& piece) const { return fs::exists(folder_of(piece) / "summary.json"); }

bool RunStore::complete(const std::vector<Piece>& pieces, int jobs, const std::atomic<bool>& stop,
                        const std::function<void(const StoreProgress&)>& show) const {
    std::vector<const Piece*> missing;
    std::set<fs::path> asked;
    for (const Piece& piece : pieces) {
        if (!finished(piece) && asked.insert(folder_of(piece)).second) missing.push_back(&piece);
    }
    if (missing.empty()) return true;
    make_folder(folder_);
    remove_abandoned(folder_);
    StoreProgress progress{0, missing.size(), "", 0.0};
    show(progress);
    const auto start = std::chrono::steady_clock::now();
    std::vector<RunningPiece> running;
    std::size_t next = 0;
    while (progress.done < missing.size() && !stop) {
        while (running.size() < static_cast<std::size_t>(std::max(1, jobs)) && next < missing.size()) {
            running.emplace_back(*missing[next], folder_of(*missing[next]), program_);
            ++next;
        }
        for (auto piece = running.begin(); piece != running.end();) {
            if (!piece->collect()) {
                ++piece;
                continue;
            }
            ++progress.done;
            progress.last = piece->name();
            const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
            progress.seconds_left = elapsed.count() / static_cast<double>(progress.done) *
                                    static_cast<double>(missing.size() - progress.done);
            piece = running.erase(piece);
            show(progress);
        }
        std::this_thread::sleep_for(k_look_again);
    }
    for (RunningPiece& piece : running) piece.discard();
    return progress.done == missing.size();
}

}  // namespace polargrain
