#include "src/model/checkpoint.h"

#include "src/core/error.h"

namespace polargrain {

namespace {

template <typename Map>
const typename Map::mapped_type& entry(const Map& map, const std::string& key) {
    const auto found = map.find(key);
    if (found == map.end()) throw RunError(fmt::format("the checkpoint has no entry \"{}\"", key));
    return found->second;
}

/// Calls take(key without "prefix/", values) for each entry under the prefix; they stand together in the map.
template <typename Map, typename Take>
void for_each_below(const Map& map, const std::string& prefix, Take take) {
    const std::string start = prefix + "/";
    for (auto it = map.lower_bound(start); it != map.end() && it->first.starts_with(start); ++it) {
        take(it->first.substr(start.size()), it->second);
    }
}

}  // namespace

void Checkpoint::put(const std::string& key, std::vector<double> values) { reals_[key] = std::move(values); }

void Checkpoint::put(const std::string& key, std::vector<std::int64_t> values) { integers_[key] = std::move(values); }

const std::vector<double>& Checkpoint::reals(const std::string& key) const { return entry(reals_, key); }

const std::vector<std::int64_t>& Checkpoint::integers(const std::string& key) const { return entry(integers_, key); }

namespace {

std::string joined(std::string prefix, const std::string& key) {
    prefix += '/';
    prefix += key;
    return prefix;
}

}  // namespace

void Checkpoint::put_part(const std::string& prefix, const Checkpoint& part) {
    for (const auto& [key, values] : part.reals_) reals_[joined(prefix, key)] = values;
    for (const auto& [key, values] : part.integers_) integers_[joined(prefix, key)] = values;
}

Checkpoint Checkpoint::part(const std::string& prefix) const {
    Checkpoint part;
    const auto put = [&part](const std::string& key, const auto& values) { part.put(key, values); };
    for_each_below(reals_, prefix, put);
    for_each_below(integers_, prefix, put);
    return part;
}

}  // namespace polargrain
