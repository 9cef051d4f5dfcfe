#include "scan_widths.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "placed_solid.hpp"
#include "triangle_distance.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {
namespace {

using Points = std::vector<std::array<double, 3>>;

std::string place(const std::array<double, 3>& p) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]);
}

/// Points by the cells that they are in. Millimetres of inches are rounded, so a corner is taken for a point
/// that is nearer than a cell: 2^-44 of the largest coordinate.
class Cells {
 public:
  explicit Cells(const Points& points) {
    double largest = 0;
    for (const auto& p : points)
      for (const double x : p) largest = std::max(largest, std::abs(x));
    side_ = std::max(0x1p-44 * largest, limits::kSmallestCoordinate);
    cells_.reserve(points.size());
    for (const auto& p : points) cells_.push_back({at(p[0], 0), at(p[1], 0), at(p[2], 0)});
    std::ranges::sort(cells_);
  }

  [[nodiscard]] bool has(const std::array<double, 3>& p) const {
    constexpr double kWays[] = {-0.25, 0.25};
    for (const double x : kWays)
      for (const double y : kWays)
        for (const double z : kWays)
          if (std::ranges::binary_search(cells_, std::array{at(p[0], x), at(p[1], y), at(p[2], z)}))
            return true;
    return false;
  }

 private:
  [[nodiscard]] double at(double coordinate, double aside) const {
    return std::round(coordinate / side_ + aside);
  }

  double side_{};
  Points cells_;
};

/// Says which corner of the mesh nobody measured.
std::optional<std::string> unmeasured(const Points& points, const SolidMesh& blank,
                                      const WrittenSolidScan& scan) {
  const auto is_stated = [&](double z) {
    return scan.underside &&
           std::abs(z - approximate(scan.underside->z)) <= approximate(scan.underside->flat);
  };
  const Cells cells(points);
  for (const auto& p : blank.near) {
    ask();
    if (is_stated(p[2]) || cells.has(p)) continue;
    return fmt::format("the corner {} of the blank's mesh is none of the points", place(p));
  }
  return std::nullopt;
}

/// Tells if a point lies surely deeper in the guaranteed blank than `guard`.
bool contradicts(const std::array<double, 3>& point, const PlacedSolid& blank, double guard) {
  const Vec3 p{just(point[0]), just(point[1]), just(point[2])};
  const Box3 at = box_of(p);
  bool near = false;
  blank.tree().visit([&](const Box3& box) { return !(gap(at, box) > step_up(guard + blank.widest())); },
                     [&](std::uint32_t triangle) {
                       const double reach = step_up(guard + blank.mesh().width(triangle).high);
                       if (!(distance({p, p, p}, blank.triangle(triangle), reach).low > reach)) near = true;
                     });
  return !near && blank.holds(p, Exact3{Fraction(point[0]), Fraction(point[1]), Fraction(point[2])});
}

}  // namespace

std::vector<std::string> faults_of_points(const Points& points, const SolidMesh& blank,
                                          const WrittenSolidScan& scan) {
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
  counted.erase(std::unique(counted.begin(), counted.end()), counted.end());
  if (auto fault = unmeasured(counted, blank, scan)) faults.push_back(*std::move(fault));

  // Nothing is promised where something is unknown.
  if (!scan.proved) return faults;
  const PlacedSolid body(blank, std::nullopt);
  const double guard = enclosed(scan.guard).high;
  for (const auto& p : counted) {
    ask();
    if (!contradicts(p, body, guard)) continue;
    faults.push_back(fmt::format(
        "point {} lies deeper in what counts as material than points are uncertain by", place(p)));
    break;
  }
  return faults;
}

}  // namespace lekalo::verify
