#include "allowed_places.hpp"

#include <fmt/core.h>

#include "lekalo/geom/offset.hpp"

namespace lekalo::mill {

using geom::Point;
using geom::Region;

namespace {

Result<void> check(const PocketOptions& o) {
  const auto outside = [](double v, double low, double high) { return !(v >= low && v <= high); };
  const auto wrong = [](const char* what, double v, const char* wanted) {
    return failure(ErrorCode::bad_input, fmt::format("a {} of {:g}: it is to be {}", what, v, wanted));
  };
  if (outside(o.tool_diameter, 0.01, 1e4)) return wrong("tool diameter", o.tool_diameter, "0.01 to 10000 mm");
  if (outside(o.step_over, 0.01, 0.5)) return wrong("step-over", o.step_over, "0.01 to 0.5 of the diameter");
  if (outside(o.stock_to_leave, 0, 1e4)) return wrong("stock to leave", o.stock_to_leave, "0 to 10000 mm");
  if (outside(o.depth, 1e-3, 1e4)) return wrong("depth", o.depth, "0.001 to 10000 mm");
  if (outside(o.floor_stock, 0, o.depth - 1e-3))
    return wrong("stock to leave on the floor", o.floor_stock, "at least 0.001 mm less than the depth");
  if (outside(o.step_down, 0, 1e4)) return wrong("step down", o.step_down, "0 to 10000 mm");
  if (o.step_down > 0 && o.depth / o.step_down > 1000)
    return wrong("step down", o.step_down, "a thousandth of the depth at least");
  if (outside(o.safe_height, 1e-3, 1e4)) return wrong("safe height", o.safe_height, "0.001 to 10000 mm");
  if (outside(o.ramp_angle, 1e-3, 0.8)) return wrong("ramp angle", o.ramp_angle, "0.001 to 0.8 rad");
  if (outside(o.sampling, 1e-3, 1e4)) return wrong("sampling step", o.sampling, "0.001 to 10000 mm");
  if (outside(o.trace_step, 0, 1e4)) return wrong("step of the trace", o.trace_step, "0 to 10000 mm");
  for (const Point p : o.starts)
    for (const double v : {p.x, p.y})
      if (outside(v, -1e9, 1e9)) return wrong("coordinate of a start", v, "-1e9 to 1e9 mm");
  if (outside(o.fit_tolerance, 1e-5, 1)) return wrong("fit tolerance", o.fit_tolerance, "0.00001 to 1 mm");
  return {};
}

}  // namespace

Result<std::vector<Region>> allowed_places(const std::vector<Region>& pockets, const PocketOptions& o) {
  LEKALO_CHECK(check(o));
  LEKALO_TRY(auto allowed, geom::offset(pockets, -(o.tool_diameter / 2 + o.stock_to_leave)));
  if (allowed.regions.empty())
    return failure(
        ErrorCode::bad_input,
        fmt::format("a tool of {:g} mm that leaves {:g} mm on the walls fits nowhere in this pocket",
                    o.tool_diameter, o.stock_to_leave));
  return std::move(allowed.regions);
}

}  // namespace lekalo::mill
