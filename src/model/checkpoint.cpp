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

}  // namespace

void Checkpoint::put(const std::string& key, std::vector<double> values) { reals_[key] = std::move(values); }

void Checkpoint::put(const std::string& key, std::vector<std::int64_t> values) { integers_[key] = std::move(values); }

const std::vector<double>& Checkpoint::reals(const std::string& key) const { return entry(reals_, key); }

const std::vector<std::int64_t>& Checkpoint::integers(const std::string& key) const { return entry(integers_, key); }

}  // namespace polargrain
