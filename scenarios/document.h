#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/reader.h"
#include "src/core/error.h"

namespace polargrain {

/// A parsed scenario file with the command line laid over it; knows where each value comes from.
class Document {
public:
    /// Throws InputError where the file cannot be read, is no TOML, or an override does not fit.
    Document(const std::filesystem::path& path, const ScenarioOverrides& overrides);

    const toml::table& root() const { return root_; }

    /// What relative paths in the file start from.
    std::filesystem::path folder() const;

    /// Where a value of that key path stands: the override that set it, or a place in the file.
    SourceLocation where(const std::string& path, const toml::source_region& source) const;

private:
    struct Override {
        std::string path;       ///< normalised: "walls[0].points"
        SourceLocation origin;  ///< a place in a sweep file, or as given: "--set walls.0.points=..."
    };

    void apply(const ScenarioOverrides& overrides);
    /// text: "key.path=value".
    void assign(const SourceLocation& from, const std::string& text);
    void assign(const SourceLocation& from, const std::string& path, const std::string& value);

    std::filesystem::path path_;
    toml::table root_;
    std::vector<Override> overrides_;  ///< the latest first
};

/// A key path as Document::where takes it: "walls.0.points" becomes "walls[0].points". InputError where it is none.
std::string normal_key(const std::string& origin, const std::string& path);

}  // namespace polargrain
