#include "shape.hpp"

#include <array>
#include <limits>

#include "interval.hpp"
#include "shape_distance.hpp"

namespace lekalo::verify {
namespace {

Span enclosed(const Decimal& value) {
  const Interval interval(value, 64);
  return {interval.low_double(), interval.high_double()};
}

class ShapeReader {
 public:
  ShapeReader(const std::string& path, std::string& complaint) : path_(path), complaint_(complaint) {}

  Shape read(Json value) {
    Fields fields(value, path_, complaint_);
    if (fields.text("units") != "mm") fields.complain(fmt::format("the units of {} are not mm", path_));
    if (fields.get("pieces").text.empty()) {
      read_piece(fields, path_);
    } else {
      fields.each("pieces", [&](Json item, const std::string& path) {
        Fields piece(item, path, complaint_);
        read_piece(piece, path);
      });
    }
    if (shape_.sides.empty()) fields.complain(fmt::format("{} has no edges", path_));
    return std::move(shape_);
  }

 private:
  struct WrittenPoint {
    Decimal x, y;
    friend bool operator==(const WrittenPoint& a, const WrittenPoint& b) {
      return compare(a.x, b.x) == 0 && compare(a.y, b.y) == 0;
    }
    [[nodiscard]] Vec enclosed() const { return {verify::enclosed(x), verify::enclosed(y)}; }
  };

  void read_piece(Fields& piece, const std::string& path) {
    read_contour(piece.get("outer"), path + ".outer");
    for (const char* key : {"holes", "islands"}) {  // two words for one thing
      if (piece.get(key).text.empty()) continue;
      piece.each(key, [&](Json hole, const std::string& at) { read_contour(hole, at); });
    }
  }

  WrittenPoint point(Fields& fields, std::string_view key) {
    std::vector<Decimal> numbers;
    fields.each(key, [&](Json item, const std::string& path) {
      if (numbers.size() < 3) numbers.push_back(fields.number_of(item, path));
    });
    if (numbers.size() == 2) return {numbers[0], numbers[1]};
    fields.complain(fmt::format("{} is not two numbers", fields.name(key)));
    return {};
  }

  void read_contour(Json value, const std::string& path) {
    std::string complaint;
    if (!value.is_array()) return complain(path + " is not a list of edges");
    JsonItems items(value);
    std::optional<WrittenPoint> begin, at;
    for (std::size_t i = 0; const auto item = items.next(); ++i) {
      const std::string name = fmt::format("{}[{}]", path, i);
      Fields edge(*item, name, complaint_);
      const bool arc = !edge.get("arc").text.empty();
      Fields inner(edge.get(arc ? "arc" : "line"), name, complaint_);
      const WrittenPoint from = point(inner, "from"), to = point(inner, "to");
      if (at && !(*at == from)) return complain(name + " does not begin where the edge before it ends");
      if (!begin) begin = from;
      at = to;
      arc ? add_arc(inner, from, to, name) : add_line(from, to, name);
    }
    if (!begin || !(*begin == *at)) return complain(path + " is not closed");
    shape_.contour_starts.push_back(shape_.sides.size());
  }

  void add_line(const WrittenPoint& from, const WrittenPoint& to, const std::string& name) {
    if (from == to) return complain(name + " has no length");
    Side side;
    side.from = from.enclosed(), side.to = to.enclosed();
    add(side, std::max(side.from.x.high, side.to.x.high), std::max(side.from.y.high, side.to.y.high),
        std::min(side.from.x.low, side.to.x.low), std::min(side.from.y.low, side.to.y.low));
  }

  void add_arc(Fields& fields, const WrittenPoint& from, const WrittenPoint& to, const std::string& name) {
    Side side;
    side.arc = true;
    side.from = from.enclosed(), side.to = to.enclosed();
    side.centre = point(fields, "centre").enclosed();
    side.full = from == to;
    const Json ccw = fields.get("ccw");
    if (!ccw.is_bool()) return complain(name + ".ccw is neither true nor false");
    const Vec a = side.from - side.centre, b = side.to - side.centre;
    side.first = ccw.is_true() ? a : b, side.last = ccw.is_true() ? b : a;
    const Span ra = length(a), rb = length(b);
    side.radius = Span{0.5, 0.5} * (ra + rb);
    side.off = 0.5 * std::max((ra - rb).high, (rb - ra).high);
    if (!(side.radius.low > 0)) return complain(name + " is an arc without a radius");
    double high_x = std::max(side.from.x.high, side.to.x.high),
           high_y = std::max(side.from.y.high, side.to.y.high),
           low_x = std::min(side.from.x.low, side.to.x.low), low_y = std::min(side.from.y.low, side.to.y.low);
    const double r = side.radius.high;
    const Span zero{0, 0}, one{1, 1}, back{-1, -1};
    if (may_face(side, {one, zero})) high_x = std::max(high_x, side.centre.x.high + r);
    if (may_face(side, {zero, one})) high_y = std::max(high_y, side.centre.y.high + r);
    if (may_face(side, {back, zero})) low_x = std::min(low_x, side.centre.x.low - r);
    if (may_face(side, {zero, back})) low_y = std::min(low_y, side.centre.y.low - r);
    add(side, high_x, high_y, low_x, low_y);
  }

  void add(const Side& side, double high_x, double high_y, double low_x, double low_y) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (shape_.sides.empty()) {
      shape_.low_x = shape_.low_y = kInfinity, shape_.high_x = shape_.high_y = -kInfinity;
    }
    shape_.sides.push_back(side);
    shape_.high_x = std::max(shape_.high_x, std::nextafter(high_x, kInfinity));
    shape_.high_y = std::max(shape_.high_y, std::nextafter(high_y, kInfinity));
    shape_.low_x = std::min(shape_.low_x, std::nextafter(low_x, -kInfinity));
    shape_.low_y = std::min(shape_.low_y, std::nextafter(low_y, -kInfinity));
  }

  void complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
  }

  std::string path_;
  std::string& complaint_;
  Shape shape_;
};

}  // namespace

Shape read_shape(Json value, const std::string& path, std::string& complaint) {
  return ShapeReader(path, complaint).read(value);
}

bool same_edges(const Shape& a, const Shape& b, double tolerance) {
  const auto near = [&](const Vec& p, const Vec& q) {
    const Vec d = p - q;
    return std::max({std::abs(d.x.low), std::abs(d.x.high), std::abs(d.y.low), std::abs(d.y.high)}) <=
           tolerance;
  };
  const auto same = [&](const Side& one, const Side& other, bool reversed) {
    if (one.arc != other.arc || one.full != other.full) return false;
    if (!near(one.from, reversed ? other.to : other.from) || !near(one.to, reversed ? other.from : other.to))
      return false;
    // Counter-clockwise ends are the same ends, whichever way the arc is written.
    return !one.arc ||
           (near(one.centre, other.centre) && near(one.first, other.first) && near(one.last, other.last));
  };
  if (a.contour_starts != b.contour_starts) return false;
  for (std::size_t c = 0; c + 1 < a.contour_starts.size(); ++c) {
    const std::size_t begin = a.contour_starts[c], end = a.contour_starts[c + 1];
    bool forwards = true, backwards = true;
    for (std::size_t k = begin; k < end; ++k) {
      forwards = forwards && same(a.sides[k], b.sides[k], false);
      backwards = backwards && same(a.sides[k], b.sides[begin + end - 1 - k], true);
    }
    if (!forwards && !backwards) return false;
  }
  return true;
}

Shape placed(const Shape& shape, Span cosine, Span sine, bool mirrored, const Vec& shift) {
  const auto turned = [&](const Vec& v) {
    const Span x = mirrored ? Span{-v.x.high, -v.x.low} : v.x;
    return Vec{cosine * x - sine * v.y, sine * x + cosine * v.y};
  };
  Shape moved = shape;
  for (Side& side : moved.sides) {
    side.from = turned(side.from) + shift, side.to = turned(side.to) + shift;
    if (!side.arc) continue;
    side.centre = turned(side.centre) + shift;
    side.first = turned(side.first), side.last = turned(side.last);
    if (mirrored) std::swap(side.first, side.last);
  }
  return moved;
}

}  // namespace lekalo::verify
