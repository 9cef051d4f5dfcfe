#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/limits.hpp"
#include "same_outline.hpp"
#include "shape_distance.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

struct WrittenPoint {
  Decimal x, y;
  friend bool operator==(const WrittenPoint& a, const WrittenPoint& b) {
    return compare(a.x, b.x) == 0 && compare(a.y, b.y) == 0;
  }
  [[nodiscard]] Vec enclosed() const { return {verify::enclosed(x), verify::enclosed(y)}; }
};

/// Says whether readers that take numbers as doubles take the two points for one.
bool same_as_doubles(const WrittenPoint& a, const WrittenPoint& b) {
  return approximate(a.x) == approximate(b.x) && approximate(a.y) == approximate(b.y);
}

/// Returns the decimals as integers of one unit. Each call chooses its own unit.
Point in_common_units(const WrittenPoint& a, const WrittenPoint& origin) {
  const Decimal x = a.x - origin.x, y = a.y - origin.y;
  const long unit = std::min(x.exponent, y.exponent);
  return {in_units(x, unit), in_units(y, unit)};
}

class ShapeReader {
 public:
  ShapeReader(const std::string& path, std::string& complaint, bool inch)
      : path_(path), complaint_(complaint), inch_(inch) {}

  Shape read(Json value) {
    Fields fields(value, path_, complaint_);
    const Json units = fields.get("units");
    if (!units.text.empty()) {
      const std::string name = fields.text("units");
      if (name != "mm" && name != "inch") complain(fmt::format("the units of {} are not mm or inch", path_));
      inch_ = name == "inch";
    }
    if (fields.get("pieces").text.empty()) {
      read_piece(fields, path_);
    } else {
      fields.each("pieces", [&](Json item, const std::string& path) {
        Fields piece(item, path, complaint_);
        read_piece(piece, path);
      });
    }
    if (shape_.sides.empty()) complain(fmt::format("{} has no edges", path_));
    bound(shape_);
    return std::move(shape_);
  }

  std::vector<Side> read_loose(Json value) {
    read_edges(value, path_, true);
    return std::move(shape_.sides);
  }

 private:
  void read_piece(Fields& piece, const std::string& path) {
    read_contour(piece.get("outer"), path + ".outer");
    // The two words mean the same.
    for (const char* key : {"holes", "islands"}) {
      if (piece.get(key).text.empty()) continue;
      piece.each(key, [&](Json hole, const std::string& at) { read_contour(hole, at); });
    }
    shape_.piece_starts.push_back(shape_.contour_starts.size() - 1);
  }

  /// One edge as it is written.
  struct WrittenEdge {
    bool arc = false;
    Json inner, from, to, centre, ccw, open;
    std::string_view path;
    std::size_t index = 0;
    /// Made for complaints alone, as there are many edges.
    [[nodiscard]] std::string name() const { return fmt::format("{}[{}]", path, index); }
  };

  /// Fills in an edge with the usual members and no others, of which nobody has to be told anything. Returns
  /// false for any other edge.
  static bool take_usual(Json value, WrittenEdge& edge) {
    if (!value.is_object()) return false;
    JsonItems kinds(value);
    const auto inner = kinds.next();
    if (!inner) return false;
    if (kinds.key() == "arc")
      edge.arc = true;
    else if (kinds.key() != "line")
      return false;
    if (kinds.next()) return false;
    edge.inner = *inner;
    if (!inner->is_object()) return false;
    JsonItems members(*inner);
    while (const auto member = members.next()) {
      Json* const to = members.key() == "from"     ? &edge.from
                       : members.key() == "to"     ? &edge.to
                       : members.key() == "centre" ? &edge.centre
                       : members.key() == "ccw"    ? &edge.ccw
                                                   : nullptr;
      if (to == nullptr || !to->text.empty()) return false;
      *to = *member;
    }
    return true;
  }

  void take_any(Json value, WrittenEdge& edge) {
    const std::string name = edge.name();
    Fields fields(value, name, complaint_);
    edge.arc = !fields.get("arc").text.empty();
    if (edge.arc && !fields.get("line").text.empty()) return complain(name + " is a line and an arc");
    edge.inner = fields.get(edge.arc ? "arc" : "line");
    edge.open = fields.get("open");
    Fields inner(edge.inner, name, complaint_);
    edge.from = inner.get("from"), edge.to = inner.get("to");
    edge.centre = inner.get("centre"), edge.ccw = inner.get("ccw");
  }

  WrittenPoint point(const WrittenEdge& edge, Json value, std::string_view key) {
    if (auto usual = two_numbers(value)) return *std::move(usual);
    Fields fields(edge.inner, edge.name(), complaint_);
    std::vector<Decimal> numbers;
    fields.each(key, [&](Json item, const std::string& path) {
      if (numbers.size() < 3) numbers.push_back(fields.number_of(item, path));
    });
    if (numbers.size() != 2) {
      complain(fmt::format("{} is not two numbers", fields.name(key)));
      return {};
    }
    for (Decimal& number : numbers) {
      if (inch_) number.digits *= 254, --number.exponent;
      if (too_far(number))
        complain(fmt::format("{} is farther than {} mm from the origin", fields.name(key),
                             limits::kLargestCoordinate));
    }
    return {numbers[0], numbers[1]};
  }

  static bool too_far(const Decimal& number) {
    return !(std::abs(approximate(number)) <= limits::kLargestCoordinate);
  }

  /// Returns a point that is written as points are, of which nobody has to be told anything.
  [[nodiscard]] std::optional<WrittenPoint> two_numbers(Json value) const {
    if (inch_ || !value.is_array()) return std::nullopt;
    JsonItems items(value);
    const auto read = [&]() -> std::optional<Decimal> {
      const auto item = items.next();
      auto number = item ? parse_decimal(item->text) : std::nullopt;
      if (!number || too_far(*number)) return std::nullopt;
      return number;
    };
    auto x = read();
    auto y = x ? read() : std::nullopt;
    if (!y || items.next()) return std::nullopt;
    return WrittenPoint{*std::move(x), *std::move(y)};
  }

  void read_contour(Json value, const std::string& path) { read_edges(value, path, false); }

  /// Reads the edges of a contour, or loose ones.
  void read_edges(Json value, const std::string& path, bool loose) {
    if (!value.is_array()) return complain(path + " is not a list of edges");
    std::vector<Json> edges;
    for (JsonItems items(value); const auto item = items.next();) edges.push_back(*item);
    if (shape_.sides.empty()) shape_.sides.reserve(edges.size()), shape_.exact.reserve(edges.size());
    std::optional<WrittenPoint> begin, at;
    // The end of the edge before, as it is written: as a rule the next edge begins in the same words.
    std::string_view end;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      WrittenEdge edge;
      edge.path = path, edge.index = i;
      if (!take_usual(edges[i], edge)) {
        edge = {};
        edge.path = path, edge.index = i;
        take_any(edges[i], edge);
        if (!complaint_.empty()) return;
      }
      if (loose) at = begin = std::nullopt;
      WrittenPoint from = at && edge.from.text == end ? *at : point(edge, edge.from, "from");
      WrittenPoint to = point(edge, edge.to, "to");
      end = edge.to.text;
      if (at && !same_as_doubles(*at, from))
        return complain(edge.name() + " does not begin where the edge before it ends");
      // Decimals of one double may differ; what counts is closed exactly.
      if (at) from = *at;
      if (!begin) begin = from;
      if (!loose && i + 1 == edges.size() && same_as_doubles(to, *begin)) to = *begin;
      at = to;
      if (!edge.open.text.empty() && !edge.open.is_bool())
        complain(edge.name() + ".open is neither true nor false");
      if (!complaint_.empty()) return;
      const std::size_t first = shape_.sides.size();
      WrittenPoint centre = edge.arc ? point(edge, edge.centre, "centre") : WrittenPoint{};
      edge.arc ? add_arc(edge, from, to, centre) : add_line(edge, from, to);
      if (!complaint_.empty()) return;
      for (std::size_t s = first; s < shape_.sides.size(); ++s) shape_.sides[s].open = edge.open.is_true();
      // Lines that join an arc to its ends have the arc's decimals.
      WrittenSide side{edge.arc,        edge.ccw.is_true(), std::move(from.x),   std::move(from.y),
                       std::move(to.x), std::move(to.y),    std::move(centre.x), std::move(centre.y)};
      shape_.exact.resize(shape_.sides.size() - 1, side);
      shape_.exact.push_back(std::move(side));
    }
    if (loose) return;
    if (!begin || !(*begin == *at)) return complain(path + " is not closed");
    shape_.contour_starts.push_back(shape_.sides.size());
  }

  void add_line(const WrittenEdge& edge, const WrittenPoint& from, const WrittenPoint& to) {
    if (from == to) return complain(edge.name() + " has no length");
    add_line(from.enclosed(), to.enclosed(), true);
  }

  void add_line(const Vec& from, const Vec& to, bool written) {
    Side side;
    side.from = side.written_from = from, side.to = side.written_to = to;
    side.written = written;
    shape_.sides.push_back(side);
  }

  void add_arc(const WrittenEdge& edge, const WrittenPoint& from, const WrittenPoint& to,
               const WrittenPoint& centre) {
    if (!edge.ccw.is_bool()) return complain(edge.name() + ".ccw is neither true nor false");
    Side side;
    side.arc = true;
    side.ccw = edge.ccw.is_true();
    side.from = side.written_from = from.enclosed(), side.to = side.written_to = to.enclosed();
    if (!complaint_.empty()) return;
    side.centre = centre.enclosed();
    const auto sweep = sweep_of(side.ccw ? from : to, side.ccw ? to : from, centre);
    if (!sweep) return complain(edge.name() + " is an arc that is a full circle or nothing");
    side.sweep = *sweep;
    const Vec a = side.from - side.centre, b = side.to - side.centre;
    const Span ra = length(a), rb = length(b);
    side.radius = just(0.5) * (ra + rb);
    if (!surely_not_zero(a) || !surely_not_zero(b))
      return complain(edge.name() + " is an arc without a radius");
    const Vec ua = unit(a), ub = unit(b);
    side.first = side.ccw ? ua : ub, side.last = side.ccw ? ub : ua;
    add_joined(side, ua, ub, ra, rb);
  }

  /// Says how far the arc turns counter-clockwise about the centre from `from` to `to`.
  static std::optional<Sweep> sweep_of(const WrittenPoint& from, const WrittenPoint& to,
                                       const WrittenPoint& centre) {
    if (from == to) return Sweep::full;
    const Point a = in_common_units(from, centre), b = in_common_units(to, centre);
    // Each vector has a unit of its own, which does not change the sign.
    const int side = sgn(cross(a, b));
    if (side > 0) return Sweep::less;
    if (side < 0) return Sweep::more;
    if (sgn(dot(a, b)) < 0) return Sweep::half;
    return std::nullopt;
  }

  /// Adds the arc and what joins its ends to its circle: lines, where they are long enough to be told apart
  /// from rounding.
  void add_joined(Side side, const Vec& ua, const Vec& ub, Span ra, Span rb) {
    const double off = absolute(just(0.5) * (ra - rb)).high;
    const double blur = (ra.high - ra.low) + (rb.high - rb.low);
    if (!(off > 64 * blur)) {
      side.off = off;
      shape_.sides.push_back(side);
      return;
    }
    const Vec from = side.from, to = side.to;
    side.from = side.centre + ua * side.radius, side.to = side.centre + ub * side.radius;
    add_line(from, side.from, false);
    shape_.sides.push_back(side);
    add_line(side.to, to, false);
  }

  void complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
  }

  std::string path_;
  std::string& complaint_;
  bool inch_;
  Shape shape_;
};

}  // namespace

void bound(Shape& shape) {
  shape.low_x = shape.low_y = kInfinity, shape.high_x = shape.high_y = -kInfinity;
  std::vector<Box> boxes;
  boxes.reserve(shape.sides.size());
  for (const Side& side : shape.sides) {
    const Box box = boxes.emplace_back(box_of(side));
    shape.low_x = std::min(shape.low_x, box.low_x), shape.high_x = std::max(shape.high_x, box.high_x);
    shape.low_y = std::min(shape.low_y, box.low_y), shape.high_y = std::max(shape.high_y, box.high_y);
  }
  shape.tree = std::make_shared<const SideTree>(std::move(boxes));
  shape.contours = std::make_shared<const ContourTree>(*shape.tree, shape.contour_starts);
}

Shape read_shape(Json value, const std::string& path, std::string& complaint, bool inch) {
  return ShapeReader(path, complaint, inch).read(value);
}

std::vector<Side> read_loose_edges(Json value, const std::string& path, std::string& complaint) {
  return ShapeReader(path, complaint, false).read_loose(value);
}

Shape outline_through(const std::vector<Decimal>& x, const std::vector<Decimal>& y) {
  std::vector<WrittenPoint> points;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (points.empty() || !same_as_doubles(points.back(), {x[k], y[k]})) points.push_back({x[k], y[k]});
  while (points.size() > 1 && same_as_doubles(points.back(), points.front())) points.pop_back();
  Shape shape;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const WrittenPoint &from = points[k], &to = points[(k + 1) % points.size()];
    Side side;
    side.from = side.written_from = from.enclosed(), side.to = side.written_to = to.enclosed();
    shape.sides.push_back(side);
    shape.exact.push_back({false, true, from.x, from.y, to.x, to.y, {}, {}});
  }
  shape.contour_starts.push_back(shape.sides.size());
  shape.piece_starts.push_back(1);
  bound(shape);
  return shape;
}

bool same_edges(const Shape& a, const Shape& b, double tolerance, bool walls) {
  const auto equal = [](Span one, Span other) { return one.low == other.low && one.high == other.high; };
  const auto near = [&](const Vec& p, const Vec& q) {
    // A difference is enclosed with rounding, also where there is none.
    if (equal(p.x, q.x) && equal(p.y, q.y)) return true;
    const Vec d = p - q;
    return absolute(d.x).high <= tolerance && absolute(d.y).high <= tolerance;
  };
  const auto same = [&](const Side& one, const Side& other, bool reversed) {
    if (one.arc != other.arc || (one.sweep == Sweep::full) != (other.sweep == Sweep::full)) return false;
    if (walls && one.open != other.open) return false;
    // Contours are closed, so that every point is one where a side begins.
    if (!near(one.written_from, reversed ? other.written_to : other.written_from)) return false;
    if (!one.arc) return true;
    // Two arcs between these ends, or the two that make up the circle, are told apart by their direction.
    return near(one.centre, other.centre) &&
           (one.sweep == Sweep::full || one.ccw == (reversed ? !other.ccw : other.ccw));
  };
  const auto written = [](const Shape& shape, std::size_t contour) {
    std::vector<const Side*> sides;
    for (std::size_t k = shape.contour_starts[contour]; k < shape.contour_starts[contour + 1]; ++k)
      if (shape.sides[k].written) sides.push_back(&shape.sides[k]);
    return sides;
  };
  if (a.piece_starts != b.piece_starts) return false;
  for (std::size_t c = 0; c + 1 < a.contour_starts.size(); ++c) {
    const std::vector<const Side*> one = written(a, c), other = written(b, c);
    if (one.size() != other.size()) return false;
    bool forwards = true, backwards = true;
    for (std::size_t k = 0; k < one.size(); ++k) {
      forwards = forwards && same(*one[k], *other[k], false);
      backwards = backwards && same(*one[k], *other[one.size() - 1 - k], true);
    }
    if (!forwards && !backwards) return false;
  }
  return true;
}

namespace {

/// Returns the numbers of all sides in order: of lines in both directions, of arcs counter-clockwise.
std::vector<std::vector<Fraction>> sorted_numbers(const Shape& shape) {
  std::vector<std::vector<Fraction>> sides;
  for (const WrittenSide& side : shape.exact) {
    const Fraction from_x = to_fraction(side.from_x), from_y = to_fraction(side.from_y),
                   to_x = to_fraction(side.to_x), to_y = to_fraction(side.to_y);
    std::vector<Fraction> forth{from_x, from_y, to_x, to_y}, back{to_x, to_y, from_x, from_y};
    if (side.arc) {
      if (!side.ccw) forth = std::move(back);
      forth.push_back(to_fraction(side.centre_x)), forth.push_back(to_fraction(side.centre_y));
    } else {
      sides.push_back(std::move(back));
    }
    sides.push_back(std::move(forth));
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

bool same_outline(const Shape& a, const Shape& b) { return sorted_numbers(a) == sorted_numbers(b); }

namespace {

Vec turned(const Vec& v, const Motion& motion) {
  const Span x = motion.mirrored ? -v.x : v.x;
  return {motion.cosine * x - motion.sine * v.y, motion.sine * x + motion.cosine * v.y};
}

}  // namespace

Vec placed(const Vec& point, const Motion& motion) { return turned(point, motion) + motion.shift; }

Shape placed(const Shape& shape, const Motion& motion) {
  Shape moved = shape;
  for (Side& side : moved.sides) {
    side.from = placed(side.from, motion), side.to = placed(side.to, motion);
    if (!side.arc) continue;
    side.centre = placed(side.centre, motion);
    side.first = turned(side.first, motion), side.last = turned(side.last, motion);
    if (!motion.mirrored) continue;
    std::swap(side.first, side.last);
    side.ccw = !side.ccw;
  }
  bound(moved);
  return moved;
}

Box box_of(const Side& side) {
  Box box{std::min(side.from.x.low, side.to.x.low), std::min(side.from.y.low, side.to.y.low),
          std::max(side.from.x.high, side.to.x.high), std::max(side.from.y.high, side.to.y.high)};
  if (!side.arc) return box;
  const Span zero = just(0), one = just(1), back = just(-1);
  if (may_face(side, {one, zero})) box.high_x = std::max(box.high_x, (side.centre.x + side.radius).high);
  if (may_face(side, {zero, one})) box.high_y = std::max(box.high_y, (side.centre.y + side.radius).high);
  if (may_face(side, {back, zero})) box.low_x = std::min(box.low_x, (side.centre.x - side.radius).low);
  if (may_face(side, {zero, back})) box.low_y = std::min(box.low_y, (side.centre.y - side.radius).low);
  const Span off{-side.off, side.off};
  return {(just(box.low_x) + off).low, (just(box.low_y) + off).low, (just(box.high_x) + off).high,
          (just(box.high_y) + off).high};
}

}  // namespace lekalo::verify
