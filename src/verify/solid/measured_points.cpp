#include "measured_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "placed_solid.hpp"
#include "solid_number.hpp"
#include "solid_text.hpp"
#include "triangle_distance.hpp"
#include "verify/read/text_rows.hpp"

namespace lekalo::verify {
namespace {

using Points = std::vector<std::array<double, 3>>;

std::string place(const std::array<double, 3>& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]); }

/// Says which corner of the mesh nobody measured.
std::optional<std::string> unmeasured(const Points& sorted, const SolidMesh& blank, const WrittenSolidScan& scan) {
  const double level = scan.underside ? approximate(scan.underside->z) : 0,
               flat = scan.underside ? approximate(scan.underside->flat) : -1;
  for (const auto& p : blank.near) {
    ask();
    if (std::abs(p[2] - level) <= flat || std::ranges::binary_search(sorted, p)) continue;
    return fmt::format("the corner {} of the blank's mesh is none of the points", place(p));
  }
  return std::nullopt;
}

/// Tells if a point lies surely deeper in the guaranteed blank than `guard`.
bool contradicts(const std::array<double, 3>& point, const PlacedSolid& blank, double guard) {
  const Vec3 p{just(point[0]), just(point[1]), just(point[2])};
  const Box3 at = box_of(p);
  bool near = false;
  blank.tree().visit(
      [&](const Box3& box) { return !near && !(gap(at, box) > step_up(guard + blank.widest())); },
      [&](std::uint32_t triangle) {
        const double reach = step_up(guard + blank.mesh().width(triangle).high);
        near = near || !(distance({p, p, p}, blank.triangle(triangle), reach).low > reach);
      });
  return !near && blank.holds(p, Exact3{Fraction(point[0]), Fraction(point[1]), Fraction(point[2])});
}

}  // namespace

Result<Points> read_measured_points(const Document& document, SolidUnit unit) {
  SolidMaker made(document, unit);
  if (trimmed(document.bytes.substr(0, 4)) == "ply") {
    LEKALO_CHECK(read_ply(made));
  } else {
    LEKALO_CHECK(read_text_rows(document, [&](TextRow&& row) -> Result<void> {
      if (row.count < 3) return bad_line(document, row.line, "no z on this line");
      if (const auto fault = made.add_vertex(std::move(row.numbers))) return bad_line(document, row.line, *fault);
      return {};
    }));
  }
  return made.take().mesh.near;
}

std::vector<std::string> faults_of_points(const Points& points, const SolidMesh& blank, const WrittenSolidScan& scan) {
  std::vector<std::string> faults;
  std::vector<char> out(points.size(), 0);
  for (const std::size_t number : scan.left_out) {
    if (number < points.size())
      out[number] = 1;
    else
      faults.push_back(fmt::format("scan.left_out names point {} of {}", number, points.size()));
  }
  Points counted;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (out[k] == 0) counted.push_back(points[k]);
  std::ranges::sort(counted);
  counted.erase(std::ranges::unique(counted).begin(), counted.end());
  if (auto fault = unmeasured(counted, blank, scan)) faults.push_back(*std::move(fault));

  // The corners of the mesh are on its surface.
  Points corners = blank.near;
  std::ranges::sort(corners);
  const PlacedSolid body(blank, std::nullopt);
  const double guard = enclosed(scan.guard).high;
  for (const auto& p : counted) {
    ask();
    if (std::ranges::binary_search(corners, p) || !contradicts(p, body, guard)) continue;
    faults.push_back(
        fmt::format("point {} lies deeper in what counts as material than points are uncertain by", place(p)));
    break;
  }
  return faults;
}

}  // namespace lekalo::verify
