#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/reproduce/figure.h"

namespace polargrain {

struct ReproduceSettings {
    std::vector<Figure> figures;
    std::filesystem::path folder;
    std::filesystem::path program;  ///< polargrain itself, which runs the simulations
    std::vector<EngineAtHand> engines;
    int jobs = 2;  ///< simulations at a time
};

/// What is going on, for whoever waits.
struct ReproduceEvents {
    std::function<void(const Figure&, const StoreProgress&)> running;
    std::function<void(const Figure&)> drawing;
    std::function<void(const Figure&, const std::string& verdict)> drawn;
};

/// Throws InputError where the folder holds something else than an earlier reproduction. Changes nothing.
void check_reproduce_folder(const std::filesystem::path& folder);

/// Runs what is missing and draws the figures, one after the other; the report is complete after each. Returns false
/// where `stop` ended it early; the same call goes on from there.
bool reproduce(const ReproduceSettings& settings, const std::atomic<bool>& stop, const ReproduceEvents& events);

}  // namespace polargrain
