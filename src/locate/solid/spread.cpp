#include "spread.hpp"

#include <algorithm>
#include <limits>

namespace lekalo::locate {
namespace {

using solid::Vector;

/// They are chosen of so many.
constexpr std::size_t kSpreadOver = 4096;

}  // namespace

std::vector<std::size_t> spread(const std::vector<Vector>& points, std::size_t count) {
  const std::size_t step = 1 + points.size() / kSpreadOver;
  std::vector<Vector> some;
  for (std::size_t k = 0; k < points.size(); k += step) some.push_back(points[k]);
  std::vector<std::size_t> chosen;
  std::vector<double> apart(some.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  while (chosen.size() < std::min(count, some.size())) {
    chosen.push_back(step * next);
    for (std::size_t k = 0; k < apart.size(); ++k) {
      const Vector way = some[k] - some[next];
      apart[k] = std::min(apart[k], dot(way, way));
    }
    next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
  }
  return chosen;
}

}  // namespace lekalo::locate
