#pragma once

#include <span>
#include <string>
#include <string_view>

namespace polargrain {

/// The candidate with the least edit distance (insert, delete, replace, swap neighbours) to the word, for "did you
/// mean"; empty where none is near (more than half of the word's letters, and more than three, would have to change).
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

}  // namespace polargrain
