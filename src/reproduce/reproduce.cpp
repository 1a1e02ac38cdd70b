#include "src/reproduce/reproduce.h"

#include <algorithm>

#include "src/core/error.h"
#include "src/plot/plot.h"
#include "src/record/text_file.h"
#include "src/reproduce/report.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

bool all_finished(const RunStore& store, const std::vector<Piece>& pieces) {
    return std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return store.finished(piece); });
}

}  // namespace

void check_reproduce_folder(const fs::path& folder) {
    check_place(folder);
    if (!fs::exists(folder)) return;
    require(fs::is_empty(folder) || fs::exists(folder / "runs") || fs::exists(folder / "sections"),
            "{}: holds something else than figures reproduced before; give another folder with -o", folder.string());
}

bool reproduce(const ReproduceSettings& settings, const std::atomic<bool>& stop, const ReproduceEvents& events) {
    require_plotting();
    check_reproduce_folder(settings.folder);
    make_folder(settings.folder / "runs");
    const RunStore store(settings.folder / "runs", settings.program, settings.engines);
    std::vector<std::string> names;
    std::string list;
    for (const EngineAtHand& engine : settings.engines) {
        names.push_back(engine.name);
        list += (list.empty() ? "" : ", ") + engine.name;
    }
    const FigureDesk desk(store, settings.folder, names);
    const Report report(settings.folder);
    for (const Figure& figure : settings.figures) {
        const auto show = [&](const StoreProgress& progress) { events.running(figure, progress); };
        // Anew where a scenario file was edited meanwhile: what is drawn goes by the files as they are then.
        do {
            if (!store.complete(figure.pieces(names), settings.jobs, stop, show)) return false;
        } while (!all_finished(store, figure.pieces(names)));
        events.drawing(figure);
        const FigureResult result = figure.draw(desk);
        report.add(figure, result);
        report.write(list);
        events.drawn(figure, verdict(result.findings));
        if (stop) return false;
    }
    return true;
}

}  // namespace polargrain
