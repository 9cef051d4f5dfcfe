#include "floz_level.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/base/angle.hpp"
#include "lekalo/field/contour_model.hpp"
#include "lekalo/field/trace.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {
namespace {

using geom::Point;
using Kind = PathMove::Kind;

/// Finds the peak: the best place of a coarse grid, and from there uphill.
Point peak(const field::ContourModel& model, const field::Function& f, const geom::Box& box) {
  constexpr int kNodes = 48;
  const Point size = box.high - box.low;
  Point best = box.low + 0.5 * size;
  double most = -1;
  for (int j = 0; j <= kNodes; ++j)
    for (int i = 0; i <= kNodes; ++i) {
      const Point p = box.low + Point{size.x * i / kNodes, size.y * j / kNodes};
      if (!model.inside(p)) continue;
      const double value = f(p).value;
      if (value > most) most = value, best = p;
    }
  return field::peak_of(f, best, std::max(size.x, size.y) / kNodes, 1e-4);
}

/// Counts the places that lie in the fragment with the lines to them: chords of the model may lie outside the
/// fragment's arcs.
std::size_t inside(const std::vector<Point>& path, const geom::Region& fragment) {
  constexpr double kSlack = 1e-4;  // mm
  constexpr int kPieces = 6;
  const geom::RegionIndex index({fragment});
  for (std::size_t i = 0; i < path.size(); ++i)
    for (int k = 1; k <= kPieces; ++k) {
      const Point before = path[i == 0 ? 0 : i - 1];
      const Point p = before + (static_cast<double>(k) / kPieces) * (path[i] - before);
      if (!index.contains(p) && index.nearest(p).distance > kSlack) return i;
    }
  return path.size();
}

}  // namespace

Result<PocketPath> floz_level(const geom::Region& fragment, const PocketOptions& o,
                              std::optional<Point> start) {
  const double step =
      o.trace_step > 0 ? o.trace_step : o.step_over * o.tool_diameter / kPi;  // pi steps a turn outwards
  const auto logic = o.method == Method::floz_linear ? field::Logic::linear : field::Logic::quadratic;
  LEKALO_TRY(const auto model,
             field::ContourModel::make({fragment}, {o.sampling, logic, field::FlozForm::normalised}));
  const field::Function f = [&](Point p) { return model(p); };
  const Point top = start ? *start : peak(model, f, geom::bounds(fragment.outer));
  // A peak has no way round it: its spiral begins beside it.
  const Point first = start ? top : top + Point{0.25 * step, 0};
  // A spiral that goes round in one place ends after three times the length that would fill the fragment.
  const double most = 3 * geom::area(fragment) / (kPi * step * step) + 1000;
  std::vector<Point> spiral =
      field::gradient_spiral(f, first, step, static_cast<std::size_t>(std::min(most, 1e6)));
  spiral.resize(inside(spiral, fragment));
  if (start && spiral.size() < 2)
    return failure(
        ErrorCode::bad_input,
        fmt::format("the spiral from the start ({:g}, {:g}) has no step of {:g} mm in its place: choose a "
                    "start farther inside",
                    top.x, top.y, step));
  PocketPath path;
  path.fronts = 1;
  const auto go = [&](Kind kind, Point to, double z) { path.moves.push_back({kind, to, z}); };
  go(Kind::rapid, top, o.safe_height);
  go(Kind::plunge, top, 0);
  go(Kind::plunge, top, -o.depth);
  for (const Point p : spiral) go(Kind::cut, p, -o.depth);
  go(Kind::rapid, path.moves.back().to, o.safe_height);
  return path;
}

}  // namespace lekalo::mill
