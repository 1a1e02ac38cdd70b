#include "src/reproduce/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain {

std::string outcome(const Finding& f) {
    if (f.agrees()) return "agrees";
    if (!std::isfinite(f.measured)) return "no value";
    const double nearest = f.measured < f.lowest ? f.lowest : f.highest;
    if (nearest == 0.0) return fmt::format("differs by {:+.3g}", f.measured);
    return fmt::format("differs by {:+.3g} %", 100.0 * (f.measured - nearest) / std::abs(nearest));
}

std::string verdict(const std::vector<Finding>& findings) {
    std::vector<std::string> engines;
    for (const Finding& f : findings) {
        if (std::find(engines.begin(), engines.end(), f.engine) == engines.end()) engines.push_back(f.engine);
    }
    std::string text;
    for (const std::string& engine : engines) {
        const auto of_engine = [&](const Finding& f) { return f.engine == engine; };
        const auto all = std::count_if(findings.begin(), findings.end(), of_engine);
        const auto good = std::count_if(findings.begin(), findings.end(),
                                        [&](const Finding& f) { return of_engine(f) && f.agrees(); });
        text += text.empty() ? "" : "; ";
        text += engine.empty() ? "" : engine + ": ";
        text += good == all ? fmt::format("agrees ({} of {})", good, all)
                : good == 0 ? fmt::format("differs (0 of {})", all)
                            : fmt::format("agrees in {} of {}", good, all);
    }
    return text.empty() ? "nothing to hold it to" : text;
}

}  // namespace polargrain
