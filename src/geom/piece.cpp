#include "piece.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom::detail {
namespace {

constexpr std::array<Point, 4> kAxes{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Returns the quarter of a direction. Quarter q holds the directions from axis q, included, to axis q + 1.
int quarter(Point direction) noexcept {
  if (direction.x > 0 && direction.y >= 0) return 0;
  if (direction.x <= 0 && direction.y > 0) return 1;
  return direction.x < 0 ? 2 : 3;
}

void append_line(Point from, Point to, std::uint32_t origin, bool step, std::vector<Piece>& pieces) {
  if (!(from == to)) pieces.push_back({EdgeKind::line, from, to, {}, 0, origin, step});
}

bool holds(const Box& box, Point p, double slack) noexcept {
  return p.x >= box.low.x - slack && p.x <= box.high.x + slack && p.y >= box.low.y - slack &&
         p.y <= box.high.y + slack;
}

Crossings of_lines(const Piece& a, const Piece& b) noexcept {
  Crossings found;
  if (segment_relation(a.from, a.to, b.from, b.to) != SegmentRelation::cross) return found;
  const Point da = a.to - a.from, db = b.to - b.from;
  const double turn = cross(da, db);
  // The lines cross at an angle below rounding, so only their ends can be near.
  if (turn == 0) return found;
  const double t = cross(b.from - a.from, db) / turn;
  if (!(t >= 0 && t <= 1)) return found;
  found.points[0] = a.from + t * da;
  found.count = 1;
  return found;
}

Crossings of_line_and_circle(const Piece& line, const Piece& arc) noexcept {
  Crossings found;
  const double length = norm(line.to - line.from);
  const Point unit = (1 / length) * (line.to - line.from);
  const double foot = dot(arc.centre - line.from, unit);
  const double height = norm(line.from + foot * unit - arc.centre);
  if (!(height <= arc.radius)) return found;
  const double half = std::sqrt((arc.radius - height) * (arc.radius + height));
  found.points = {line.from + (foot - half) * unit, line.from + (foot + half) * unit};
  found.count = half > 0 ? 2 : 1;
  return found;
}

Crossings of_circles(const Piece& a, const Piece& b) noexcept {
  Crossings found;
  const Point between = b.centre - a.centre;
  const double apart = norm(between);
  // Equal circles meet at the ends of their pieces.
  if (!(apart > 0)) return found;
  const double foot = 0.5 * (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart);
  if (!(std::abs(foot) <= a.radius)) return found;
  const double half = std::sqrt((a.radius - foot) * (a.radius + foot));
  const Point unit = (1 / apart) * between, middle = a.centre + foot * unit;
  found.points = {middle - half * perpendicular(unit), middle + half * perpendicular(unit)};
  found.count = half > 0 ? 2 : 1;
  return found;
}

}  // namespace

void append_pieces(const Edge& edge, std::uint32_t origin, double slack, std::vector<Piece>& pieces) {
  if (edge.kind == EdgeKind::line) return append_line(edge.from, edge.to, origin, false, pieces);
  const bool forwards = edge.kind == EdgeKind::arc_ccw;
  Point first = forwards ? edge.from : edge.to, last = forwards ? edge.to : edge.from;
  const Point to_first = first - edge.centre, to_last = last - edge.centre;
  const double radius = arc_radius(edge);
  const int begin = quarter(to_first);
  int corners = (quarter(to_last) - begin + 4) % 4;
  if (corners == 0 && (first == last || orientation(edge.centre, first, last) < 0)) corners = 4;

  const auto on_circle = [&](Point end, Point direction) {
    const double length = norm(direction);
    return std::abs(length - radius) > slack ? edge.centre + (radius / length) * direction : end;
  };
  std::vector<Point> stops{on_circle(first, to_first)};
  for (int i = 1; i <= corners; ++i)
    stops.push_back(edge.centre + radius * kAxes[static_cast<std::size_t>((begin + i) % 4)]);
  stops.push_back(on_circle(last, to_last));
  if (!forwards) {
    std::reverse(stops.begin(), stops.end());
    std::swap(first, last);
  }
  append_line(first, stops.front(), origin, true, pieces);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    if (!(stops[i] == stops[i + 1]))
      pieces.push_back({edge.kind, stops[i], stops[i + 1], edge.centre, radius, origin, false});
  append_line(stops.back(), last, origin, true, pieces);
}

Box box_of(const Piece& piece) noexcept { return box_of(piece.from, piece.to); }

double side(const Piece& piece, Point p) noexcept {
  if (is_arc(piece)) {
    const double inside = piece.radius - norm(p - piece.centre);
    return piece.kind == EdgeKind::arc_ccw ? inside : -inside;
  }
  const Point direction = piece.to - piece.from;
  return cross(direction, p - piece.from) / norm(direction);
}

bool crosses_ray(const Piece& piece, Point p) noexcept {
  const Point from = piece.from, to = piece.to;
  if ((from.y <= p.y) == (to.y <= p.y)) return false;
  if (p.x < std::min(from.x, to.x)) return true;
  if (p.x > std::max(from.x, to.x)) return false;
  if (!is_arc(piece)) return orientation(from, to, p) == (from.y < to.y ? 1 : -1);
  const double height = p.y - piece.centre.y;
  const double half = std::sqrt(std::max(0.0, (piece.radius - height) * (piece.radius + height)));
  const bool right_half = from.x + to.x > 2 * piece.centre.x;
  return p.x < piece.centre.x + (right_half ? half : -half);
}

Crossings crossings(const Piece& a, const Piece& b, double slack) noexcept {
  if (!is_arc(a) && !is_arc(b)) return of_lines(a, b);
  Crossings found =
      is_arc(a) ? (is_arc(b) ? of_circles(a, b) : of_line_and_circle(b, a)) : of_line_and_circle(a, b);
  const Box box_a = box_of(a), box_b = box_of(b);
  int kept = 0;
  for (int i = 0; i < found.count; ++i) {
    const Point p = found.points[static_cast<std::size_t>(i)];
    const bool near = holds(box_a, p, slack) && holds(box_b, p, slack) && std::abs(side(a, p)) <= slack &&
                      std::abs(side(b, p)) <= slack;
    if (near) found.points[static_cast<std::size_t>(kept++)] = p;
  }
  found.count = kept;
  return found;
}

}  // namespace lekalo::geom::detail
