#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/solid/mesh.hpp"

namespace lekalo::locate {

/// The numbers of points as far from each other as can be: each is the farthest from those before. Of very
/// many, only some are looked at.
[[nodiscard]] std::vector<std::size_t> spread(const std::vector<solid::Vector>& points, std::size_t count);

}  // namespace lekalo::locate
