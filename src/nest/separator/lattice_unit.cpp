#include "lattice_unit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/layout/check.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {

double lattice_unit(const Problem& problem, const Items& items) {
  if (!items.fixed.empty()) return 0;
  for (const Form& form : problem.forms())
    if (form.rotation.c != 0 && form.rotation.s != 0) return 0;
  const layout::Document& document = problem.document();
  std::int64_t common = 0;
  double area = 0;
  for (const layout::Part& part : document.parts) {
    for (const geom::GridPoint p : part.outline.polygon.points) common = std::gcd(std::gcd(common, p.x), p.y);
    common = std::gcd(common, layout::border_gap_of(document, part));
    for (const layout::Part& other : document.parts)
      common = std::gcd(common, layout::gap_between(document, part, other));
  }
  for (const std::uint32_t part : items.parts) area += problem.area_of(part);
  const double unit = geom::mm_from_grid(common);
  for (const Bin& bin : problem.bins()) {
    const double height = bin.box.y1 - bin.box.y0;
    const double length =
        bin.open ? std::min(bin.box.x1 - bin.box.x0, 1.5 * area / height) : bin.box.x1 - bin.box.x0;
    const double places = height * length / (unit * unit);
    if (!(places >= tuning::kFewestLatticePlaces && places <= tuning::kMostLatticePlaces)) return 0;
  }
  return unit;
}

}  // namespace lekalo::nest
