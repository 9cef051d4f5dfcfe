// A square of 8 mm in a square of 10 mm: the best placement leaves 1 mm all round.
#include <cmath>
#include <iostream>

#include "lekalo/io/contour_file.hpp"
#include "lekalo/locate/convex.hpp"

namespace {

lekalo::geom::ConvexPolygon square(const char* name, const char* points) {
  const auto file = lekalo::io::parse_contour(points, name, lekalo::LengthUnit::millimetre);
  const auto contour = lekalo::io::make_convex(file.value());
  return contour.value().polygon;
}

}  // namespace

int main() {
  const lekalo::locate::ConvexProblem problem{
      .part = square("part.csv", "0 0\n8 0\n8 8\n0 8\n"),
      .blank = square("blank.csv", "100,100\n110,100\n110,110\n100,110\n"),
      .window = {},
  };
  const auto result = lekalo::locate::locate_convex(problem, {});
  if (!result) {
    std::cerr << result.error().message << '\n';
    return 1;
  }
  std::cout << "clearance " << result->best.clearance << " mm, at most " << result->upper_bound << " mm\n";
  const bool right = result->best.clearance <= 1.0 && result->best.clearance > 1.0 - 1e-8 &&
                     result->upper_bound >= 1.0 && result->upper_bound - result->best.clearance < 1e-8;
  return right ? 0 : 1;
}
