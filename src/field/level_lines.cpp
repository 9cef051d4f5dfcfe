#include "lekalo/field/level_lines.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

#include "lekalo/base/stop.hpp"

namespace lekalo::field {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr std::size_t kSquare = 16;  // nodes

}  // namespace

LevelLines::LevelLines(const GridFrame& frame, const std::vector<double>& values)
    : frame_(frame), values_(values), squares_across_(frame.columns / kSquare + 1) {
  assert(values.size() == frame.size());
  squares_.assign(squares_across_ * (frame.rows / kSquare + 1), {kNone, -kNone});
  for (std::size_t s = 0; s < squares_.size(); ++s) {
    ask();
    const std::size_t x = s % squares_across_ * kSquare, y = s / squares_across_ * kSquare;
    for (std::size_t j = y; j <= y + kSquare && j < frame.rows; ++j)
      for (std::size_t i = x; i <= x + kSquare && i < frame.columns; ++i) {
        const double value = values[j * frame.columns + i];
        squares_[s].low = std::min(squares_[s].low, value);
        squares_[s].high = std::max(squares_[s].high, value);
      }
  }
}

std::vector<std::vector<LevelLines::Place>> LevelLines::at(double level) const {
  const std::size_t columns = frame_.columns, rows = frame_.rows;
  // A crossing between node n and the next to the right is 2 n, to the next above 2 n + 1.
  std::map<std::size_t, std::size_t> next;
  const auto cell = [&](std::size_t n) {
    const std::size_t corner[4] = {n, n + 1, n + 1 + columns, n + columns};
    bool in[4];
    for (int k = 0; k < 4; ++k) in[k] = values_[corner[k]] < level;
    const int count = in[0] + in[1] + in[2] + in[3];
    if (count == 0 || count == 4) return;
    // Sides counter-clockwise: below, right, above, left. With the low on its left a line enters where they
    // go from low to high.
    const std::size_t side[4] = {2 * n, 2 * (n + 1) + 1, 2 * (n + columns), 2 * n + 1};
    std::size_t enters[2] = {}, leaves[2] = {};
    int e = 0, l = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (in[k] && !in[(k + 1) % 4]) enters[e++] = k;
      if (!in[k] && in[(k + 1) % 4]) leaves[l++] = k;
    }
    if (e == 1) {
      next[side[enters[0]]] = side[leaves[0]];
      return;
    }
    double sum = 0;
    for (const std::size_t c : corner) sum += values_[c];
    const bool joined = sum < 4 * level;  // the two low corners are one
    for (const std::size_t from : enters) next[side[from]] = side[(from + (joined ? 1 : 3)) % 4];
  };
  for (std::size_t s = 0; s < squares_.size(); ++s) {
    if (!(squares_[s].low < level && level <= squares_[s].high)) continue;
    const std::size_t x = s % squares_across_ * kSquare, y = s / squares_across_ * kSquare;
    for (std::size_t j = y; j < y + kSquare && j + 1 < rows; ++j)
      for (std::size_t i = x; i < x + kSquare && i + 1 < columns; ++i) cell(j * columns + i);
  }
  const auto place = [&](std::size_t crossing) {
    const std::size_t n = crossing / 2, m = crossing % 2 == 0 ? n + 1 : n + columns;
    const bool known = values_[n] != kNone && values_[m] != kNone;
    const double share = known ? (level - values_[n]) / (values_[m] - values_[n]) : 0.5;
    const geom::Point a = frame_.node(n % columns, n / columns), b = frame_.node(m % columns, m / columns);
    return Place{a + std::clamp(share, 1e-3, 1 - 1e-3) * (b - a), known};
  };
  std::vector<std::vector<Place>> lines;
  while (!next.empty()) {
    const std::size_t first = next.begin()->first;
    std::size_t last = first;
    std::vector<Place> line;
    for (auto step = next.begin(); step != next.end(); step = next.find(last)) {
      line.push_back(place(step->first));
      last = step->second;
      next.erase(step);
    }
    if (last == first && line.size() > 2) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace lekalo::field
