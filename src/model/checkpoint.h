#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace polargrain {

/// Named arrays that hold everything a part of a run (an engine, a sink, the loop) needs to go on as if it had never
/// stopped.
///
/// Neutral: how it is stored is not the part's business. Keys may have levels, divided by slashes. Keys are unique;
/// reading a key that is not there is a RunError that names it.
class Checkpoint {
public:
    void put(const std::string& key, std::vector<double> values);
    void put(const std::string& key, std::vector<std::int64_t> values);
    const std::vector<double>& reals(const std::string& key) const;
    const std::vector<std::int64_t>& integers(const std::string& key) const;

    /// All of another one, each key with "prefix/" in front.
    void put_part(const std::string& prefix, const Checkpoint& part);
    /// What stands under "prefix/", without it; empty where nothing does.
    Checkpoint part(const std::string& prefix) const;

    const std::map<std::string, std::vector<double>>& all_reals() const { return reals_; }
    const std::map<std::string, std::vector<std::int64_t>>& all_integers() const { return integers_; }

private:
    std::map<std::string, std::vector<double>> reals_;
    std::map<std::string, std::vector<std::int64_t>> integers_;
};

}  // namespace polargrain
