#include "exact_arcs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/arc_ends.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::io {
namespace {

using geom::DoubleDouble;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Covers the rounding of the few sums and products here.
constexpr double kArcsUp = 1 + 0x1p-40;

double largest_coordinate(Point p) { return std::max(std::abs(p.x), std::abs(p.y)); }

bool is_arc(const Edge& edge) { return edge.kind != EdgeKind::line; }
bool is_circle(const Edge& edge) { return is_arc(edge) && edge.from == edge.to; }

double difference_of_radii(const Edge& arc) {
  return std::abs(norm(arc.from - arc.centre) - norm(arc.to - arc.centre));
}

/// Says whether the arc is one that make_region would take.
/// \pre from != to
bool is_sound(const Edge& arc) {
  const double from = norm(arc.from - arc.centre), to = norm(arc.to - arc.centre);
  return from > 0 && to > 0 && std::abs(from - to) <= geom::allowed_radius_difference(arc) &&
         (geom::orientation(arc.centre, arc.from, arc.to) != 0 ||
          dot(arc.from - arc.centre, arc.to - arc.centre) < 0);
}

double size_of(const Edge& arc) {
  return std::max({largest_coordinate(arc.from), largest_coordinate(arc.to), largest_coordinate(arc.centre),
                   geom::arc_radius(arc)});
}

DoubleDouble bulge_of(const Edge& edge) {
  return is_arc(edge) ? bulge_of_level(level_of_centre(edge), edge.kind == EdgeKind::arc_ccw)
                      : DoubleDouble{};
}

/// The distance of two curves with the same ends from each other, both ways. Its first term is that of the
/// level centres, because of all points the bulge moves the middle most (docs/design/drawing.md).
struct Deviation {
  double level = 0, radii = 0;
};
Deviation deviation(const Edge& a, const Edge& b) {
  const double level = std::abs((bulge_of(a) - bulge_of(b)).hi) * norm(a.to - a.from) / 2;
  Deviation found{level + 0x1p-90 * size_of(a), 2 * difference_of_radii(a)};
  if (is_arc(b)) found.radii += 2 * difference_of_radii(b);
  return found;
}

std::optional<BoundedShape> restored_circle(const std::vector<Edge>& pieces, Point start, double error) {
  const Edge& read = pieces.front();
  if (pieces.size() != 1 || !is_circle(read) || start == read.centre) return std::nullopt;
  const Edge circle{read.kind, start, start, read.centre};
  const double apart = std::abs(geom::arc_radius(circle) - geom::arc_radius(read));
  if (!(apart <= kWrittenArcError * size_of(circle))) return std::nullopt;
  return BoundedShape{circle, (error + apart + 4 * kUnitRoundoff * size_of(circle)) * kArcsUp};
}

/// Returns the arc in the place of these curves, with the distance to them added to their error, or nothing
/// if it does not fit.
std::optional<BoundedShape> restored(const ExactArc& exact, const BoundedShape* curves) {
  std::vector<Edge> pieces;
  double error = 0;
  for (std::size_t i = 0; i < exact.count; ++i) {
    const auto* piece = std::get_if<Edge>(&curves[i].shape);
    if (piece == nullptr || (i > 0 && piece->from != pieces.back().to)) return std::nullopt;
    pieces.push_back(*piece);
    error = std::max(error, curves[i].error);
  }
  if (exact.kind == EdgeKind::line) return restored_circle(pieces, exact.point, error);
  const Edge arc{exact.kind, pieces.front().from, pieces.back().to, exact.point};
  if (arc.from == arc.to || !is_sound(arc)) return std::nullopt;
  Deviation apart;
  double sweep = 0;
  for (const Edge& piece : pieces) {
    const Edge part{arc.kind, piece.from, piece.to, arc.centre};
    if (piece.from == piece.to || !is_sound(part) || (is_arc(piece) && piece.kind != arc.kind))
      return std::nullopt;
    // In other arcs the level centre may be anywhere, and two differences of radii would bound nothing.
    const double turned = geom::arc_sweep(part);
    if (turned > kPi &&
        !(turned <= kWidestPiece && norm(part.to - part.from) >= 4 * difference_of_radii(part)))
      return std::nullopt;
    sweep += turned;
    const Deviation one = deviation(part, piece);
    // The step leads from the part's mean radius to that of the arc.
    const double step = pieces.size() > 1 ? std::abs(geom::arc_radius(part) - geom::arc_radius(arc)) : 0;
    apart = {std::max(apart.level, one.level), std::max(apart.radii, one.radii + step)};
  }
  const double sum = (apart.level + apart.radii) * kArcsUp;
  if (!(std::abs(sweep - geom::arc_sweep(arc)) < 1) || !(apart.level <= kWrittenArcError * size_of(arc)) ||
      !(apart.radii <= kWrittenArcError * size_of(arc) + 4 * difference_of_radii(arc)) || !std::isfinite(sum))
    return std::nullopt;
  return BoundedShape{arc, (error + sum) * kArcsUp};
}

std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

template <class Number>
bool read_number(std::string_view& text, Number& number) {
  const std::string_view word = next_word(text);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

DoubleDouble level_of_centre(const Edge& arc) noexcept {
  const DoubleDouble dx = geom::two_sum(arc.to.x, -arc.from.x), dy = geom::two_sum(arc.to.y, -arc.from.y);
  const DoubleDouble half{0.5};
  const DoubleDouble x = DoubleDouble{arc.centre.x} - half * geom::two_sum(arc.from.x, arc.to.x);
  const DoubleDouble y = DoubleDouble{arc.centre.y} - half * geom::two_sum(arc.from.y, arc.to.y);
  return (y * dx - x * dy) / (dx * dx + dy * dy);
}

DoubleDouble bulge_of_level(DoubleDouble level, bool ccw) noexcept {
  // b = sqrt(4 level^2 + 1) - 2 level for a counter-clockwise arc, without cancellation.
  const DoubleDouble ahead = DoubleDouble{2} * (ccw ? level : -level);
  const DoubleDouble root = geom::sqrt(ahead * ahead + DoubleDouble{1}) + (ahead.hi < 0 ? -ahead : ahead);
  const DoubleDouble size = ahead.hi > 0 ? DoubleDouble{1} / root : root;
  return ccw ? size : -size;
}

std::string text_of(const ExactArc& arc) {
  const char* kind = arc.kind == EdgeKind::line ? "start" : arc.kind == EdgeKind::arc_ccw ? "ccw" : "cw";
  return fmt::format("{} {} {} {} {}", arc.first, arc.count, kind, arc.point.x, arc.point.y);
}

std::optional<ExactArc> read_exact_arc(std::string_view text) {
  ExactArc arc;
  if (!read_number(text, arc.first) || !read_number(text, arc.count)) return std::nullopt;
  const std::string_view kind = next_word(text);
  if (kind == "ccw")
    arc.kind = EdgeKind::arc_ccw;
  else if (kind == "cw")
    arc.kind = EdgeKind::arc_cw;
  else if (kind != "start")
    return std::nullopt;
  if (!read_number(text, arc.point.x) || !read_number(text, arc.point.y)) return std::nullopt;
  if (arc.count < 1 || arc.count > kMostPieces || !geom::is_exact(arc.point) || !next_word(text).empty())
    return std::nullopt;
  return arc;
}

std::vector<ExactArc> exact_arcs_of(const geom::Contour& contour, const std::vector<Edge>& curves,
                                    const std::vector<std::size_t>& curves_of_edge) {
  std::vector<ExactArc> arcs;
  std::size_t first = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Edge& edge = contour[i];
    const std::size_t count = curves_of_edge[i];
    if (is_circle(edge)) {
      if (curves[first].from != edge.from) arcs.push_back({first, count, EdgeKind::line, edge.from});
    } else if (is_arc(edge)) {
      const bool given = count == 1 && curves[first] == edge;
      if (!given) arcs.push_back({first, count, edge.kind, edge.centre});
    }
    first += count;
  }
  return arcs;
}

std::size_t restore_exact_arcs(std::vector<BoundedShape>& curves, const std::vector<ExactArc>& arcs) {
  std::vector<BoundedShape> made;
  made.reserve(curves.size());
  std::size_t next = 0, unfit = 0;
  const auto take_until = [&](std::size_t end) {
    for (; next < end; ++next) made.push_back(std::move(curves[next]));
  };
  for (const ExactArc& arc : arcs) {
    const bool there =
        arc.first >= next && arc.first < curves.size() && arc.count <= curves.size() - arc.first;
    auto shape = there ? restored(arc, curves.data() + arc.first) : std::nullopt;
    if (!shape) {
      ++unfit;
      continue;
    }
    take_until(arc.first);
    made.push_back(*std::move(shape));
    next = arc.first + arc.count;
  }
  take_until(curves.size());
  curves = std::move(made);
  return unfit;
}

std::string unfit_arcs_sentence(std::size_t count, const std::string& file) {
  return fmt::format(
      "{}: the exact numbers of {} arcs do not fit their curves, which were changed since; the curves count",
      file, count);
}

}  // namespace lekalo::io
