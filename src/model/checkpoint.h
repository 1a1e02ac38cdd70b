#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace polargrain {

/// Named arrays that hold everything an engine needs to take its next step as if it had never stopped.
///
/// Neutral: how it is stored is not the engine's business. Keys are unique; reading a key that is not there is a
/// RunError that names it.
class Checkpoint {
public:
    void put(const std::string& key, std::vector<double> values);
    void put(const std::string& key, std::vector<std::int64_t> values);
    const std::vector<double>& reals(const std::string& key) const;
    const std::vector<std::int64_t>& integers(const std::string& key) const;

    const std::map<std::string, std::vector<double>>& all_reals() const { return reals_; }
    const std::map<std::string, std::vector<std::int64_t>>& all_integers() const { return integers_; }

private:
    std::map<std::string, std::vector<double>> reals_;
    std::map<std::string, std::vector<std::int64_t>> integers_;
};

}  // namespace polargrain
