#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "src/reproduce/finding.h"
#include "src/reproduce/piece.h"
#include "src/reproduce/run_store.h"

namespace polargrain {

/// What a figure is drawn with: its finished pieces, and where its files go.
class FigureDesk {
public:
    FigureDesk(const RunStore& store, std::filesystem::path folder, std::vector<std::string> engines)
        : store_(store), folder_(std::move(folder)), engines_(std::move(engines)) {}

    std::filesystem::path run(const Piece& piece) const { return store_.folder_of(piece); }
    /// Where a picture or table of that name is put, without extension.
    std::filesystem::path stem(const std::string& name) const { return folder_ / name; }
    const std::vector<std::string>& engines() const { return engines_; }

private:
    const RunStore& store_;
    std::filesystem::path folder_;
    std::vector<std::string> engines_;
};

/// A figure, table or statement of the paper; at the end, what is from another one.
struct Figure {
    std::string id;  ///< as asked for on the command line
    std::string title;
    /// The simulations it needs; engines: those of this build.
    std::vector<Piece> (*pieces)(const std::vector<std::string>& engines);
    /// Draws its pictures and holds its numbers to the published ones. All pieces are finished.
    FigureResult (*draw)(const FigureDesk& desk);
};

/// All of them, in the order of the paper.
std::span<const Figure> figures();

/// Those named, in the order of the paper; all where none is named. InputError names the nearest one.
std::vector<Figure> find_figures(const std::vector<std::string>& ids);

}  // namespace polargrain
