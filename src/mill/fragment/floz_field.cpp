#include "lekalo/mill/floz_field.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/field/contour_model.hpp"
#include "lekalo/mill/fragments.hpp"

namespace lekalo::mill {
namespace {

field::GridFrame frame_of(const std::vector<geom::Region>& pockets, std::size_t nodes) {
  geom::Box box = geom::bounds(pockets.front().outer);
  for (const geom::Region& pocket : pockets) {
    const geom::Box b = geom::bounds(pocket.outer);
    box.low = {std::min(box.low.x, b.low.x), std::min(box.low.y, b.low.y)};
    box.high = {std::max(box.high.x, b.high.x), std::max(box.high.y, b.high.y)};
  }
  const geom::Point size = box.high - box.low;
  const double margin = 0.05 * std::max(size.x, size.y);
  const double pitch = (std::max(size.x, size.y) + 2 * margin) / static_cast<double>(nodes - 1);
  const auto count = [&](double length) {
    return static_cast<std::size_t>(std::ceil((length + 2 * margin) / pitch - 1e-9)) + 1;
  };
  return {box.low - geom::Point{margin, margin}, pitch, count(size.x), count(size.y)};
}

field::Jet jet_at(const field::FieldGrid& grid, std::size_t n) {
  return {static_cast<double>(grid.value[n]),
          {static_cast<double>(grid.dx[n]), static_cast<double>(grid.dy[n])}};
}

}  // namespace

Result<field::FieldGrid> floz_field(const std::vector<geom::Region>& pockets, const PocketOptions& o,
                                    std::size_t nodes) {
  const auto logic = o.method == Method::floz_linear ? field::Logic::linear : field::Logic::quadratic;
  std::vector<std::vector<geom::Region>> parts{pockets};
  if (!o.whole) {
    LEKALO_TRY(const auto fragments, convex_fragments(pockets));
    parts.clear();
    for (const geom::Region& fragment : fragments) parts.push_back({fragment});
  }
  const field::GridFrame frame = frame_of(pockets, nodes);
  field::FieldGrid whole;
  for (const std::vector<geom::Region>& part : parts) {
    LEKALO_TRY(const auto model,
               field::ContourModel::make(part, {o.sampling, logic, field::FlozForm::normalised}));
    field::FieldGrid grid = field::sample(model, frame);
    if (whole.value.empty()) {
      whole = std::move(grid);
      continue;
    }
    for (std::size_t n = 0; n < grid.value.size(); ++n) {
      ask();
      const field::Jet both = field::disjunction(jet_at(whole, n), jet_at(grid, n), logic);
      whole.value[n] = static_cast<float>(both.value);
      whole.dx[n] = static_cast<float>(both.gradient.x), whole.dy[n] = static_cast<float>(both.gradient.y);
    }
  }
  return whole;
}

}  // namespace lekalo::mill
