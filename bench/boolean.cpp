// The union of two drawings: ours, CGAL's exact one of line and circle segments (if it is there), and
// Clipper's of polygons on integers (arcs as chords within 1e-4 mm), in turns on the same shapes in one run.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <polyclipping/clipper.hpp>
#include <vector>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/trig.hpp"
#include "support/boolean_cases.hpp"
#ifdef LEKALO_WITH_CGAL
#include "oracle/cgal_regions.hpp"
#endif

namespace {

using namespace lekalo;
using Regions = std::vector<geom::Region>;

double seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Slots and rounded rectangles spread over a square, on a grid of 1/8 mm, each touching about one other.
Regions drawing(Random& random, std::size_t edges) {
  Regions pieces;
  const double side = std::sqrt(static_cast<double>(edges) / 6 * 20);
  for (std::size_t made = 0; made < edges;) {
    const auto at = [&] { return 0.125 * std::floor(8 * random.uniform(0, side)); };
    const double x = at(), y = at();
    auto contour = random.below(2) == 0
                       ? cases::boolean_slot(x, y, 2 + 0.125 * static_cast<double>(random.below(16)), 1)
                       : cases::boolean_rounded(x, y, 4, 3, 1);
    made += contour.size();
    pieces.push_back(geom::make_region(std::move(contour)).value());
  }
  return pieces;
}

constexpr double kUnit = 1e-6;  // mm, of Clipper's integers
ClipperLib::Paths paths_of(const Regions& regions) {
  ClipperLib::Paths paths;
  for (const geom::Region& r : regions) {
    ClipperLib::Path path;
    const auto add = [&](geom::Point p) {
      path.emplace_back(std::llround(p.x / kUnit), std::llround(p.y / kUnit));
    };
    for (const geom::Edge& e : r.outer) {
      add(e.from);
      if (e.kind == geom::EdgeKind::line) continue;
      const double radius = geom::arc_radius(e), sweep = geom::arc_sweep(e);
      const int chords = static_cast<int>(std::ceil(sweep / (2 * std::sqrt(2 * 1e-4 / radius))));
      for (int i = 1; i < chords; ++i) {
        const auto [s, c] = geom::sincos((e.kind == geom::EdgeKind::arc_ccw ? sweep : -sweep) * i / chords);
        const geom::Point v = e.from - e.centre;
        add(e.centre + geom::Point{c * v.x - s * v.y, s * v.x + c * v.y});
      }
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

/// Without its arcs: each edge a line.
Regions straight(const Regions& regions) {
  Regions made;
  for (const geom::Region& r : regions) {
    geom::Ring ring;
    for (const geom::Edge& e : r.outer) ring.push_back(e.from);
    made.push_back(geom::make_region(cases::boolean_polygon(ring)).value());
  }
  return made;
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return 1e3 * times[times.size() / 2];
}

void row(const char* shapes, std::size_t edges, bool arcs, int repeats) {
  std::vector<double> ours, clipper, cgal;
  double our_area = 0, clipper_area = 0, cgal_area = 0;
  for (int i = 0; i < repeats; ++i) {
    Random random(1, edges + static_cast<std::size_t>(i));
    Regions a = drawing(random, edges / 2), b = drawing(random, edges / 2);
    if (!arcs) a = straight(a), b = straight(b);
    double start = seconds();
    const auto made = geom::combine(a, b, geom::BooleanOperation::unite);
    ours.push_back(seconds() - start);
    our_area = cases::area_of(made.value().regions);

    const ClipperLib::Paths pa = paths_of(a), pb = paths_of(b);
    start = seconds();
    ClipperLib::Clipper engine;
    engine.AddPaths(pa, ClipperLib::ptSubject, true);
    engine.AddPaths(pb, ClipperLib::ptClip, true);
    ClipperLib::PolyTree tree;
    engine.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    clipper.push_back(seconds() - start);
    ClipperLib::Paths found;
    ClipperLib::PolyTreeToPaths(tree, found);
    clipper_area = 0;
    for (const auto& path : found) clipper_area += ClipperLib::Area(path) * kUnit * kUnit;
#ifdef LEKALO_WITH_CGAL
    std::vector<oracle::Polygon> polygons;
    for (const Regions* pieces : {&a, &b})
      for (const geom::Region& r : *pieces) polygons.push_back(oracle::exact_polygon(r.outer));
    start = seconds();
    oracle::PolygonSet set;
    set.join(polygons.begin(), polygons.end());
    const double area = oracle::area_of(set);  // forces the lazy numbers
    cgal.push_back(seconds() - start);
    cgal_area = area;
#endif
  }
  fmt::print("| {} | {} | {:.3g} ms | {:.3g} ms, {:.2f} | ", shapes, edges, median(ours), median(clipper),
             median(clipper) / median(ours));
  if (cgal.empty())
    fmt::print("- | ");
  else
    fmt::print("{:.3g} ms, {:.1f} | ", median(cgal), median(cgal) / median(ours));
  fmt::print("{:.1e}, {:.1e} |\n", std::abs(clipper_area - our_area) / our_area,
             cgal.empty() ? 0.0 : std::abs(cgal_area - our_area) / our_area);
  std::fflush(stdout);
}

}  // namespace

int main() {
  fmt::print(
      "| shapes | edges | ours | Clipper, ratio | CGAL, ratio | areas off ours "
      "|\n|---|---|---|---|---|---|\n");
  for (const std::size_t edges : {100u, 1000u, 10000u})
    for (const bool arcs : {false, true})
      row(arcs ? "lines and arcs" : "lines", edges, arcs, edges > 5000 ? 3 : 9);
}
