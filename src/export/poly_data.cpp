#include "src/export/poly_data.h"

namespace polargrain {

NamedNumbers in_space(std::string name, std::span<const Vec2> vectors) {
    std::vector<double> numbers;
    numbers.reserve(3 * vectors.size());
    for (const Vec2& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), 0.0});
    return {std::move(name), std::move(numbers), 3};
}

}  // namespace polargrain
