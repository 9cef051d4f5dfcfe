#include "lekalo/locate/guaranteed_solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/base/limits.hpp"

namespace lekalo::locate {
namespace {

using solid::Vector;

/// Rounding takes less than this part off a width, or off the square of a length.
constexpr double kRounding = 0x1p-45;
/// The square root of 3, rounded up: how far a point is off at most for each of its coordinates.
constexpr double kDiagonal = 1.7321;

using Corners = std::array<Vector, 3>;

Corners corners_of(const solid::Mesh& mesh, const solid::Triangle& triangle) {
  return {mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]};
}

/// The radius of the smallest circle around a triangle, rounded up. The corner across the longest edge has an
/// angle of 60 degrees or more, so that its sine is no small number where it is asked for.
double circle_radius(Corners p) {
  const auto square = [](Vector v) { return dot(v, v); };
  const auto longer = [&](std::size_t k) { return square(p[(k + 2) % 3] - p[(k + 1) % 3]); };
  const std::size_t at = longer(0) >= longer(1) && longer(0) >= longer(2) ? 0
                         : longer(1) >= longer(2)                         ? 1
                                                                          : 2;
  const Vector a = p[(at + 1) % 3] - p[at], b = p[(at + 2) % 3] - p[at];
  const double longest = std::sqrt(longer(at));
  if (!(dot(a, b) > 0)) return 0.5 * longest * (1 + kRounding);
  return norm(a) * norm(b) * longest / (2 * norm(cross(a, b))) * (1 + kRounding);
}

/// Bounds of the width of a triangle.
struct Width {
  double low = 0, high = 0;
};

/// The width by a reach of `radius`, with the circle around the triangle known but for `off`; none where it
/// is too wide for it.
std::optional<Width> reached(double radius, double guard, double circle, double off) {
  const auto left = [&](double by, double rounding) {
    return (radius - guard) * (radius - guard) - by * by + rounding * radius * radius;
  };
  const double least = left(circle + off, -kRounding);
  if (!(least > 0)) return std::nullopt;
  const double most = left(std::max(0.0, circle * (1 - 4 * kRounding) - off), kRounding);
  return Width{std::max(0.0, radius - (1 + kRounding) * std::sqrt(most)),
               std::min(radius, radius - (1 - kRounding) * std::sqrt(least))};
}

Result<void> check(const SolidScan& scan) {
  const auto number = [](double value, double least) {
    return value >= least && value <= limits::kLargestCoordinate;
  };
  if (!number(scan.guard, 0))
    return failure(
        ErrorCode::usage,
        fmt::format("the uncertainty of the scan's points, {} mm, must be a number, 0 or above", scan.guard));
  if (!number(scan.coordinate_error, 0))
    return failure(ErrorCode::usage,
                   fmt::format("coordinates that are off by {} mm must be off by a number, 0 "
                               "or above",
                               scan.coordinate_error));
  if (!scan.min_radius && !scan.max_dip)
    return failure(ErrorCode::usage,
                   "a scan needs a smallest radius or a greatest dip of the surface between its points");
  if (scan.max_dip && !number(*scan.max_dip, 0))
    return failure(ErrorCode::usage,
                   fmt::format("a dip of {} mm must be a number, 0 or above", *scan.max_dip));
  if (scan.min_radius && !(number(*scan.min_radius, 0) && *scan.min_radius > scan.guard))
    return failure(
        ErrorCode::usage,
        fmt::format("a smallest radius of {} mm must be above {} mm, what the points are uncertain by",
                    *scan.min_radius, scan.guard));
  if (!scan.underside) return {};
  if (!(std::abs(scan.underside->z) <= limits::kLargestCoordinate))
    return failure(ErrorCode::usage, "the level of the underside must be a number");
  if (!number(scan.underside->flat, 0) || !(scan.underside->flat > 0))
    return failure(
        ErrorCode::usage,
        fmt::format("an underside flat to {} mm must be flat to a number above 0", scan.underside->flat));
  if (scan.min_radius && !(*scan.min_radius > scan.underside->flat))
    return failure(ErrorCode::usage,
                   fmt::format("an underside flat to {} mm must be flatter than the smallest radius, {} mm",
                               scan.underside->flat, *scan.min_radius));
  return {};
}

/// The widths by one of the assumptions.
struct Widths {
  std::vector<double> of;
  double widest = 0, error = 0;
  std::vector<std::uint32_t> unknown;
};

class Measure {
 public:
  Measure(const solid::Mesh& mesh, const SolidScan& scan) : mesh_(mesh), scan_(scan) {}

  /// \param between  the width of a triangle with this circle and guard, or none
  template <class Between>
  [[nodiscard]] Widths widths(const Between& between) const {
    Widths made;
    for (std::uint32_t k = 0; k < mesh_.triangles.size(); ++k) {
      const Corners corners = corners_of(mesh_, mesh_.triangles[k]);
      const std::size_t below = of_underside(corners);
      // Beside the underside corners and edges are as uncertain as that is.
      const double guard = below > 0 ? std::max(scan_.guard, scan_.underside->flat) : scan_.guard;
      const std::optional<Width> found = below == 3 ? Width{scan_.underside->flat, scan_.underside->flat}
                                                    : between(circle_radius(corners), guard);
      if (!found) made.unknown.push_back(k);
      const Width width = found.value_or(Width{guard, guard});
      made.of.push_back(width.high);
      made.widest = std::max(made.widest, width.high);
      made.error = std::max(made.error, width.high - width.low);
    }
    return made;
  }

 private:
  [[nodiscard]] std::size_t of_underside(const Corners& corners) const {
    if (!scan_.underside) return 0;
    const auto there = [&](Vector p) { return std::abs(p.z - scan_.underside->z) <= scan_.underside->flat; };
    return static_cast<std::size_t>(std::count_if(corners.begin(), corners.end(), there));
  }

  const solid::Mesh& mesh_;
  const SolidScan& scan_;
};

std::vector<std::string> assumptions(const SolidScan& scan, bool by_radius) {
  std::vector<std::string> said{
      fmt::format("every corner of the scan's mesh{} lies within {} mm of a true point of the surface",
                  scan.underside ? " off the underside" : "", scan.guard)};
  if (by_radius) {
    said.push_back(fmt::format(
        "a ball of {} mm radius comes from outside to every place of the blank's surface, those of its holes "
        "and slots among them, scanned or not",
        *scan.min_radius));
    said.push_back("the blank has no closed voids");
  } else {
    said.push_back(fmt::format(
        "between its measured points the surface dips at most {} mm below the triangles", *scan.max_dip));
    said.push_back("the scan saw every hole and void of the blank");
  }
  if (scan.underside)
    said.push_back(
        fmt::format("the underside at z = {} mm is solid and flat to {} mm: each point of the mesh "
                    "there lies within that of material, and air inside the mesh no farther from there",
                    scan.underside->z, scan.underside->flat));
  return said;
}

}  // namespace

Result<GuaranteedSolid> guaranteed_solid(const solid::Mesh& mesh, const SolidScan& scan) {
  LEKALO_CHECK(check(scan));
  const Measure measure(mesh, scan);
  std::optional<Widths> by_radius, by_dip;
  if (scan.min_radius)
    by_radius = measure.widths([&](double circle, double guard) {
      return reached(*scan.min_radius, guard, circle, kDiagonal * scan.coordinate_error);
    });
  if (scan.max_dip)
    by_dip = measure.widths([&](double, double guard) -> std::optional<Width> {
      const double width = guard + *scan.max_dip;
      return Width{width * (1 - kRounding), width * (1 + kRounding)};
    });
  const bool radius =
      by_radius && (!by_dip || (by_radius->unknown.empty() && by_radius->widest <= by_dip->widest));
  Widths& chosen = radius ? *by_radius : *by_dip;
  GuaranteedSolid made;
  made.widths = std::move(chosen.of);
  made.widest = chosen.widest;
  made.width_error = chosen.error;
  made.unknown = std::move(chosen.unknown);
  for (const std::uint32_t k : made.unknown) {
    const Corners p = corners_of(mesh, mesh.triangles[k]);
    made.unknown_area += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
  }
  made.assumptions = assumptions(scan, radius);
  return made;
}

}  // namespace lekalo::locate
