#include "cost_sums.hpp"

namespace lekalo::nest {

const NodeGrid& CostSums::now(CostGrid& grid, std::uint32_t form, std::uint32_t bin, double x0, double y0,
                              std::uint32_t columns, std::uint32_t rows, std::span<const Spot> spots,
                              const NodeGrid* fixed) {
  Sums& sums = sums_[bin * forms_ + form];
  const auto is_same = [&](const Spot& s, const Spot& t) {
    if (s.bin != bin || t.bin != bin) return s.bin != bin && t.bin != bin;
    return s.form == t.form && s.x == t.x && s.y == t.y;
  };
  NodeGrid& nodes = sums.nodes;
  std::size_t changed = spots.size();
  if (nodes.columns == columns && nodes.rows == rows && nodes.x0 == x0 && nodes.y0 == y0) {
    changed = 0;
    for (std::size_t j = 0; j < spots.size(); ++j) changed += is_same(sums.spots[j], spots[j]) ? 0 : 1;
  }
  if (2 * changed > spots.size()) {
    nodes.begin(x0, y0, columns, rows);
    if (fixed != nullptr) nodes.add(*fixed, 0, 0, 1);
    sums.spots.assign(spots.size(), {0, 0, 0, kNowhere});
  }
  for (std::size_t j = 0; j < spots.size(); ++j) {
    Spot& was = sums.spots[j];
    const Spot& is = spots[j];
    if (is_same(was, is)) continue;
    if (was.bin == bin) grid.add(nodes, was.form, form, was.x, was.y, -1);
    if (is.bin == bin) grid.add(nodes, is.form, form, is.x, is.y, 1);
    was = is;
  }
  return nodes;
}

}  // namespace lekalo::nest
