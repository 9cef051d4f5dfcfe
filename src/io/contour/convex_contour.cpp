#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contour_points.hpp"
#include "hulled_contour.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::io {
namespace {

/// A place at which the contour between two corners strays from the straight segment.
struct Stray {
  std::size_t position = 0;
  double distance = 0;  ///< mm, rounded up
};

/// Measures every point between corners against its segment.
class StraightRuns {
 public:
  StraightRuns(const HulledContour& outline, double tolerance) : outline_(outline), tolerance_(tolerance) {
    const std::vector<std::size_t>& corners = outline.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) look_at(corners[k], corners[(k + 1) % corners.size()]);
  }

  [[nodiscard]] const Stray& worst() const { return worst_; }
  /// A point from which the contour runs back by more than the tolerance, or the number of points.
  [[nodiscard]] std::size_t runs_back_at() const { return runs_back_at_; }

 private:
  void look_at(std::size_t from, std::size_t to) {
    const geom::Point a = outline_.point(from), b = outline_.point(to);
    // Reading rounds monotonically, so along the longer axis points of a straight edge keep their order.
    const bool along_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
    const double sign = (along_x ? b.x > a.x : b.y > a.y) ? 1 : -1;
    geom::Point last = a;
    for (std::size_t i = outline_.after(from); i != to; i = outline_.after(i)) {
      const geom::Point p = outline_.point(i);
      const double distance = distance_to_segment_up(p, a, b);
      if (distance > worst_.distance) worst_ = {i, distance};
      see_advance(i, sign * (along_x ? p.x - last.x : p.y - last.y));
      last = p;
    }
    see_advance(to, sign * (along_x ? b.x - last.x : b.y - last.y));
  }

  void see_advance(std::size_t position, double advance) {
    if (advance < -tolerance_ && runs_back_at_ == outline_.ring.size()) runs_back_at_ = position;
  }

  const HulledContour& outline_;
  double tolerance_;
  Stray worst_;
  std::size_t runs_back_at_ = outline_.ring.size();
};

/// The other position with the same coordinates, or the number of points.
std::size_t twin(const HulledContour& outline, std::size_t position) {
  for (std::size_t i = 0; i < outline.ring.size(); ++i) {
    if (i != position && outline.point(i) == outline.point(position)) return i;
  }
  return outline.ring.size();
}

tl::unexpected<Error> refuse_stray(const HulledContour& outline, const Stray& stray) {
  const std::string& name = outline.file->name;
  if (const std::size_t other = twin(outline, stray.position); other != outline.ring.size()) {
    return refuse(name,
                  fmt::format("the contour comes to {} again at {}; it must run once around without touching "
                              "itself",
                              outline.name(std::min(other, stray.position)),
                              outline.name(std::max(other, stray.position))));
  }
  return refuse(
      name, fmt::format("the contour is not convex: {} lies {:.3g} mm inside the straight line between its "
                        "neighbours on the hull; for a probed blank, --trim {:.2g} cuts inwards to a convex "
                        "contour",
                        outline.name(stray.position), stray.distance, 1.05 * stray.distance));
}

std::string list_of(const std::vector<std::size_t>& indices) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(indices.size(), 5); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", indices[i]);
  }
  return indices.size() > 5 ? text + ", ..." : text;
}

std::string drop_notice(const std::string& name, const char* what, const std::vector<std::size_t>& indices) {
  return fmt::format("{}: {} {} point{} dropped (point {}; counted from 0)", name, indices.size(), what,
                     indices.size() == 1 ? "" : "s", list_of(indices));
}

}  // namespace

std::size_t ConvexContour::file_edge(std::size_t polygon_edge) const {
  // A reversed file leaves for this edge from the vertex at which the polygon arrives.
  return file_index_of_vertex[reversed ? polygon.next(polygon_edge) : polygon_edge];
}

Result<ConvexContour> make_convex(const ContourFile& file) {
  const double tolerance = kCollinearErrors * file.coordinate_error;  // docs/design/io.md, step 2
  LEKALO_TRY(const auto outline, find_hull(file, tolerance));
  const std::vector<std::size_t>& corners = outline.corners;
  const StraightRuns runs(outline, tolerance);
  if (runs.worst().distance > tolerance) return refuse_stray(outline, runs.worst());
  if (runs.runs_back_at() != outline.ring.size()) {
    return refuse(file.name, fmt::format("the contour runs back along its own edge to {}",
                                         outline.name(runs.runs_back_at())));
  }

  geom::Ring vertices;
  std::vector<std::size_t> indices;
  for (const std::size_t position : corners) {
    vertices.push_back(outline.point(position));
    indices.push_back(outline.ring[position]);
  }
  auto polygon = geom::ConvexPolygon::make(std::move(vertices));
  if (!polygon) return refuse(file.name, polygon.error().message);

  std::vector<std::size_t> straight;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (std::size_t i = outline.after(corners[k]); i != corners[(k + 1) % corners.size()];
         i = outline.after(i)) {
      straight.push_back(outline.ring[i]);
    }
  }
  std::sort(straight.begin(), straight.end());
  ConvexContour contour{*std::move(polygon), std::move(indices), outline.reversed, {}, 0, {}};
  std::merge(straight.begin(), straight.end(), outline.duplicates.begin(), outline.duplicates.end(),
             std::back_inserter(contour.dropped));
  contour.coordinate_error = file.coordinate_error;
  if (runs.worst().distance > 0) {
    contour.coordinate_error = std::nextafter(file.coordinate_error + runs.worst().distance,
                                              std::numeric_limits<double>::infinity());
  }
  if (!outline.duplicates.empty()) {
    contour.notices.push_back(drop_notice(file.name, "duplicate", outline.duplicates));
  }
  if (!straight.empty()) contour.notices.push_back(drop_notice(file.name, "collinear", straight));
  return contour;
}

}  // namespace lekalo::io
