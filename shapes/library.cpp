#include "shapes/library.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "src/core/data_folder.h"
#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_extension = ".toml";

/// An outline file while it is read: knows where each value stands.
class Reader {
public:
    explicit Reader(const fs::path& path) : path_(path.string()) {
        std::error_code status;
        require(fs::is_regular_file(path, status), "cannot read the outline file {}: there is no such file", path_);
        try {
            root_ = toml::parse_file(path_);
        } catch (const toml::parse_error& error) {
            fail(error.source(), error.description());
        }
    }

    OutlineFile read() const {
        refuse_unknown_keys();
        return {.name = fs::path(path_).stem().string(),
                .title = text("title"),
                .source = text("source"),
                .points = points(),
                .file = path_};
    }

private:
    [[noreturn]] void fail(const toml::source_region& where, std::string_view message) const {
        const auto [line, column] = where.begin;
        throw InputError(SourceLocation{path_, static_cast<int>(line), static_cast<int>(column)}, std::string(message));
    }

    [[noreturn]] void fail(const toml::node& where, const std::string& message) const { fail(where.source(), message); }

    void refuse_unknown_keys() const {
        static const std::array<std::string, 6> known = {"title", "source", "unit", "points", "radii", "polar"};
        for (const auto& [key, value] : root_) {
            const std::string word(key.str());
            if (std::find(known.begin(), known.end(), word) != known.end()) continue;
            const std::string near = nearest_name(word, known);
            fail(key.source(), fmt::format("unknown key \"{}\": {}", word,
                                           near.empty() ? "an outline file has title, source, unit and points"
                                                        : fmt::format("did you mean \"{}\"?", near)));
        }
    }

    std::string text(const char* key) const {
        const toml::node* node = root_.get(key);
        if (node == nullptr) throw InputError(SourceLocation{path_}, fmt::format(R"(add a line {} = "...")", key));
        const auto value = node->value_exact<std::string>();
        if (!value || value->empty()) fail(*node, fmt::format("{}: give a text in quotes", key));
        return *value;
    }

    double metres_per_unit() const {
        const toml::node* node = root_.get("unit");
        if (node == nullptr) return 1.0;
        const std::string unit = text("unit");
        if (unit == "m") return 1.0;
        if (unit == "cm") return 1e-2;
        if (unit == "mm") return 1e-3;
        if (unit == "um") return 1e-6;
        fail(*node, fmt::format(R"(unit: "{}" is none of "m", "cm", "mm", "um")", unit));
    }

    double number(const toml::node& node, const char* what) const {
        const auto value = node.value<double>();
        if (!node.is_number() || !value || !std::isfinite(*value)) fail(node, fmt::format("{} must be a number", what));
        return *value;
    }

    std::pair<double, double> pair(const toml::node& node, const char* key, const char* form) const {
        const toml::array* entries = node.as_array();
        if (entries == nullptr || entries->size() != 2) fail(node, fmt::format("{}: give each point as {}", key, form));
        return {number(*entries->get(0), key), number(*entries->get(1), key)};
    }

    double radius(const toml::node& node, double value) const {
        if (!(value > 0.0)) fail(node, fmt::format("the radius {} must be above 0", value));
        return value;
    }

    std::vector<Vec2> points() const {
        const std::array<const char*, 3> keys = {"points", "radii", "polar"};
        const auto given =
            std::count_if(keys.begin(), keys.end(), [&](const char* key) { return root_.contains(key); });
        if (given != 1) {
            throw InputError(SourceLocation{path_},
                             "give the outline once: points = [[x, y], ...], or radii = [...] at equal angles, or "
                             "polar = [[radius, degrees], ...]");
        }
        const char* key = *std::find_if(keys.begin(), keys.end(), [&](const char* k) { return root_.contains(k); });
        const toml::node& node = *root_.get(key);
        const toml::array* entries = node.as_array();
        if (entries == nullptr || entries->size() < 3) fail(node, fmt::format("{}: give at least 3 of them", key));

        std::vector<Vec2> all;
        all.reserve(entries->size());
        for (std::size_t k = 0; k < entries->size(); ++k) {
            all.emplace_back(metres_per_unit() * point(key, *entries->get(k), k, entries->size()));
        }
        return all;
    }

    Vec2 point(std::string_view key, const toml::node& node, std::size_t k, std::size_t count) const {
        if (key == "points") {
            const auto [x, y] = pair(node, "points", "[x, y]");
            return {x, y};
        }
        if (key == "radii") {
            const double turn = static_cast<double>(k) / static_cast<double>(count);
            return on_ray(radius(node, number(node, "radii")), 2.0 * k_pi * turn);
        }
        const auto [r, degrees] = pair(node, "polar", "[radius, degrees]");
        return on_ray(radius(node, r), degrees * k_radians_per_degree);
    }

    static Vec2 on_ray(double radius, double angle) {
        const auto [sine, cosine] = sine_cosine(angle);
        return {radius * cosine, radius * sine};
    }

    std::string path_;
    toml::table root_;
};

std::vector<std::string> library_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(shape_library_folder())) {
        if (entry.path().extension() == k_extension) names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

OutlineFile read_outline_file(const fs::path& path) { return Reader(path).read(); }

fs::path shape_library_folder() { return data_folder("shapes/outlines"); }

std::vector<OutlineFile> shape_library() {
    std::vector<OutlineFile> library;
    const fs::path folder = shape_library_folder();
    for (const std::string& name : library_names()) library.push_back(read_outline_file(folder / (name + k_extension)));
    return library;
}

OutlineFile find_outline(const std::string& path_or_name, const fs::path& base) {
    std::error_code status;
    const fs::path file = base / path_or_name;
    if (fs::is_regular_file(file, status)) return read_outline_file(file);
    const std::vector<std::string> names = library_names();
    if (std::binary_search(names.begin(), names.end(), path_or_name)) {
        return read_outline_file(shape_library_folder() / (path_or_name + k_extension));
    }
    const std::string near = nearest_name(path_or_name, names);
    throw InputError(fmt::format("there is no outline file {} and no shipped outline \"{}\": {}", file.string(),
                                 path_or_name,
                                 near.empty() ? "\"polargrain list shapes\" shows those that are shipped"
                                              : fmt::format("did you mean \"{}\"?", near)));
}

}  // namespace polargrain
