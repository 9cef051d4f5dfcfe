// What a stranger writes against the installed library: the lines of the README, and a contour read from
// text.
#undef NDEBUG
#include <cassert>
#include <iostream>

#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/locate/convex.hpp"

namespace {

void as_in_the_readme() {
  const auto part = lekalo::geom::ConvexPolygon::make({{0, 0}, {8, 0}, {8, 8}, {0, 8}});
  const auto blank = lekalo::geom::ConvexPolygon::make({{10, 10}, {20, 10}, {20, 20}, {10, 20}});
  const auto result = lekalo::locate::locate_convex({*part, *blank}, {});
  assert(result->best.clearance <= 1 && result->upper_bound >= 1);  // the optimum is 1 mm
  assert(result->upper_bound - result->best.clearance <= 1e-9);     // and that is proved
}

}  // namespace

int main() {
  as_in_the_readme();
  const auto file =
      lekalo::io::parse_contour("0 0\n8 0\n8 8\n0 8\n", "part.csv", lekalo::LengthUnit::millimetre);
  assert(file.has_value());
  const auto contour = lekalo::io::make_convex(*file);
  assert(contour.has_value() && contour->polygon.size() == 4);
  std::cout << "found, compiled, linked, ran\n";
}
