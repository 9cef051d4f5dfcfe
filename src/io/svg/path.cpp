#include "path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::io::detail {
namespace {

using Kind = PathSegment::Kind;

class PathReader {
 public:
  explicit PathReader(std::string_view data) : scanner_(data) {}

  Read<std::vector<PathSegment>> run() {
    scanner_.skip_blanks();
    if (scanner_.rest() == "none") return std::vector<PathSegment>{};
    while (!scanner_.at_end()) {
      ask();
      command_ = scanner_.peek();
      constexpr std::string_view kCommands = "MmZzLlHhVvCcSsQqTtAa";
      if (kCommands.find(command_) == std::string_view::npos)
        return tl::unexpected("a path command is needed " + scanner_.here());
      if (!begun_ && command_ != 'M' && command_ != 'm')
        return tl::unexpected(fmt::format("a path begins with M or m, not {}", excerpt({&command_, 1})));
      begun_ = true;
      scanner_.advance(1);
      relative_ = command_ >= 'a';
      if (command_ == 'Z' || command_ == 'z') {
        close();
        scanner_.skip_blanks();
        continue;
      }
      if (const auto fault = arguments()) return tl::unexpected(*fault);
    }
    return std::move(segments_);
  }

 private:
  using Fault = std::optional<std::string>;

  /// Reads as many sets of numbers as there are.
  Fault arguments() {
    do {
      if (const auto fault = one_set()) return fault;
      if (command_ == 'M') command_ = 'L';
      if (command_ == 'm') command_ = 'l';
      if (scanner_.skip_comma() && !scanner_.number_ahead())
        return "a number is needed after the comma, " + scanner_.here();
    } while (scanner_.number_ahead());
    return std::nullopt;
  }

  Fault one_set() {
    switch (command_) {
      case 'M':
      case 'm': {
        BoundedPoint to;
        if (auto fault = read(to)) return fault;
        current_ = start_ = to;
        first_of_subpath_ = segments_.size();
        control_ = Kind::line;
        return std::nullopt;
      }
      case 'L':
      case 'l': {
        PathSegment line;
        if (auto fault = read(line.to)) return fault;
        add(line);
        return std::nullopt;
      }
      case 'H':
      case 'h':
      case 'V':
      case 'v':
        return axis_line();
      case 'A':
      case 'a':
        return arc();
      default:
        return curve();
    }
  }

  Fault axis_line() {
    auto number = scanner_.number();
    if (!number) return number.error();
    const bool along_x = command_ == 'H' || command_ == 'h';
    Bounded x = x_of(current_), y = y_of(current_);
    Bounded& moved = along_x ? x : y;
    moved = relative_ ? plus(moved, *number) : *number;
    PathSegment line;
    line.to = point_of(x, y);
    return in_range(line.to, [&] { add(line); });
  }

  Fault curve() {
    PathSegment segment;
    const char c = relative_ ? static_cast<char>(command_ - 'a' + 'A') : command_;
    segment.kind = c == 'C' || c == 'S' ? Kind::cubic : Kind::quadratic;
    if (c == 'S' || c == 'T') {
      segment.first = control_ == segment.kind ? reflected() : current_;
    } else if (auto fault = read(segment.first)) {
      return fault;
    }
    if (segment.kind == Kind::cubic) {
      scanner_.skip_comma();
      if (auto fault = read(segment.second)) return fault;
    }
    if (c != 'T') scanner_.skip_comma();
    if (auto fault = read(segment.to)) return fault;
    add(segment);
    return std::nullopt;
  }

  Fault arc() {
    PathSegment segment;
    segment.kind = Kind::arc;
    for (Bounded* number : {&segment.rx, &segment.ry, &segment.rotation_deg}) {
      const auto read = scanner_.number();
      if (!read) return read.error();
      *number = *read;
      scanner_.skip_comma();
    }
    segment.rx.value = std::abs(segment.rx.value);
    segment.ry.value = std::abs(segment.ry.value);
    for (bool* flag : {&segment.large, &segment.sweep}) {
      const auto read = scanner_.flag();
      if (!read) return read.error();
      *flag = *read;
      scanner_.skip_comma();
    }
    if (auto fault = read(segment.to)) return fault;
    if (!(segment.rx.value > 0 && segment.ry.value > 0)) segment.kind = Kind::line;
    add(segment);
    return std::nullopt;
  }

  Fault read(BoundedPoint& point) {
    const auto x = scanner_.number();
    if (!x) return x.error();
    scanner_.skip_comma();
    const auto y = scanner_.number();
    if (!y) return y.error();
    point = point_of(*x, *y);
    if (relative_) point = plus(current_, point);
    return in_range(point, [] {});
  }

  template <class Then>
  static Fault in_range(const BoundedPoint& p, const Then& then) {
    if (!(std::abs(p.at.x) <= kLargestMillimetres && std::abs(p.at.y) <= kLargestMillimetres))
      return fmt::format("it goes to ({}, {}); coordinates go up to {:g}", p.at.x, p.at.y,
                         kLargestMillimetres);
    then();
    return std::nullopt;
  }

  [[nodiscard]] BoundedPoint reflected() const {
    const auto mirror = [](const Bounded& c, const Bounded& p) { return minus(plus(c, c), p); };
    return point_of(mirror(x_of(current_), x_of(last_control_)), mirror(y_of(current_), y_of(last_control_)));
  }

  void add(PathSegment segment) {
    segment.from = current_;
    control_ = segment.kind;
    last_control_ = segment.kind == Kind::cubic ? segment.second : segment.first;
    current_ = segment.to;
    const bool still = segment.from.at == segment.to.at;
    const bool curve = segment.kind == Kind::cubic || segment.kind == Kind::quadratic;
    const bool looped = curve && !(segment.first.at == segment.from.at &&
                                   (segment.kind == Kind::quadratic || segment.second.at == segment.from.at));
    if (!still || looped) segments_.push_back(segment);
  }

  void close() {
    const double apart =
        std::max(std::abs(current_.at.x - start_.at.x), std::abs(current_.at.y - start_.at.y));
    const bool drawn = segments_.size() > first_of_subpath_;
    // Two ends that may meet within their errors do meet, because relative steps lose that only by rounding.
    if (apart > 0 && drawn && apart <= current_.error + start_.error) {
      PathSegment& last = segments_.back();
      last.to = {start_.at, last.to.error + apart};
      if (last.from.at == last.to.at && last.kind != Kind::cubic && last.kind != Kind::quadratic)
        segments_.pop_back();
    } else if (apart > 0) {
      PathSegment line;
      line.to = start_;
      add(line);
    }
    current_ = start_;
    first_of_subpath_ = segments_.size();
    control_ = Kind::line;
  }

  SvgScanner scanner_;
  std::vector<PathSegment> segments_;
  char command_ = 'M';
  bool relative_ = false, begun_ = false;
  BoundedPoint current_, start_, last_control_;
  /// The kind of the last segment, which says which control point the next one may mirror.
  Kind control_ = Kind::line;
  std::size_t first_of_subpath_ = 0;
};

BoundedShape bezier(std::vector<BoundedPoint> points) {
  Spline spline;
  spline.degree = points.size() - 1;
  spline.knots.assign(points.size(), 0.0);
  spline.knots.resize(2 * points.size(), 1.0);
  double error = 0;
  for (const BoundedPoint& p : points) {
    spline.poles.push_back(p.at);
    error = std::max(error, p.error);
  }
  return {std::move(spline), 1.42 * error};
}

/// Step 5 of docs/design/svg.md: where the centre of an arc's circle lies beside the middle of its chord.
/// Lengths are in a frame in which the radius is `radius`.
struct ChordHeight {
  /// The radius is enlarged where it was too small for the chord.
  Bounded half_chord, radius;
  /// The distance from the chord to the centre, not below 0.
  Bounded height;
};
ChordHeight height_over(const Bounded& dx, const Bounded& dy, const Bounded& radius) {
  using geom::DoubleDouble;
  const DoubleDouble square = geom::two_product(dx.value, dx.value) + geom::two_product(dy.value, dy.value);
  const double chord = std::sqrt(square.hi);
  const double chord_error = (dx.error + dy.error) + 4 * kUnitRoundoff * chord;
  ChordHeight out{{0.5 * chord, 0.5 * chord_error}, radius, {}};
  // (2 r)^2 - chord^2 is computed in twice the digits, so that what is left of it is not lost.
  const DoubleDouble over_chord = geom::two_product(2 * radius.value, 2 * radius.value) - square;
  const double unsure = 2 * (2 * radius.value + chord) * (2 * radius.error + dx.error + dy.error) +
                        0x1p-98 * (square.hi + 4 * radius.value * radius.value);
  // The arc is a half turn wherever the numbers may mean one, and by the standard where the radius is too
  // small.
  if (over_chord.hi <= unsure) {
    out.radius = {out.half_chord.value, out.half_chord.error};
    const bool too_small = over_chord.hi < -unsure;
    out.height = {0, too_small ? 0 : 0.5 * std::sqrt(std::max(0.0, over_chord.hi) + unsure)};
    return out;
  }
  const double height = 0.5 * std::sqrt(over_chord.hi);
  out.height = {height, 0.25 * unsure / height + 4 * kUnitRoundoff * height};
  return out;
}

/// An arc with a larger bulge leaves less than 4e-8 of its radius out, and is taken as a whole circle,
/// because some programs write circles so.
constexpr double kNearlyWhole = 1e8;

BoundedShape nearly_whole_circle(const PathSegment& s, const ChordHeight& chord) {
  const geom::Point along = s.to.at - s.from.at;
  const geom::Point left = (1 / norm(along)) * perpendicular(along);
  const geom::Point centre = s.from.at + (s.sweep ? -chord.height.value : chord.height.value) * left;
  const geom::EdgeKind kind = s.sweep ? geom::EdgeKind::arc_ccw : geom::EdgeKind::arc_cw;
  const double error = chord.half_chord.value + chord.height.error + s.from.error + s.to.error +
                       8 * kUnitRoundoff * (chord.height.value + norm(s.from.at));
  return circle_arc({kind, s.from.at, s.from.at, centre}, 2 * kPi, error);
}

std::optional<BoundedShape> circle_of(const PathSegment& s) {
  const ChordHeight chord =
      height_over(minus(x_of(s.to), x_of(s.from)), minus(y_of(s.to), y_of(s.from)), s.rx);
  // The bulge, tan(sweep / 4), is the arc's own height over half the chord. The two heights over a chord
  // multiply to the square of half the chord, so the one that comes without cancellation gives the other.
  if (!(chord.half_chord.value > 2 * chord.half_chord.error)) return line_between(s.from, s.to);
  const Bounded tall = plus(chord.radius, chord.height);
  const Bounded bulge = s.large ? over(tall, chord.half_chord) : over(chord.half_chord, tall);
  if (bulge.value > kNearlyWhole) return nearly_whole_circle(s, chord);
  const double rounding = 4 * kUnitRoundoff * bulge.value;
  return bulge_arc(s.from, s.to, s.sweep ? bulge.value : -bulge.value, bulge.error + rounding);
}

/// Makes an ellipse's arc as SVG 1.1, appendix F.6, says: in the frame in which the ellipse is the unit
/// circle.
std::optional<BoundedShape> ellipse_of(const PathSegment& s) {
  const Direction axis = direction_of_degrees(s.rotation_deg.value);
  const double turn_error = (axis.exact ? 0 : kDegreesError) + s.rotation_deg.error * kDegree;
  const Bounded cosine{axis.unit.x, turn_error}, sine{axis.unit.y, turn_error};
  const Bounded dx = minus(x_of(s.to), x_of(s.from)), dy = minus(y_of(s.to), y_of(s.from));
  // The chord is taken in the frame of the axes, with y stretched so that both radii are rx.
  const Bounded ratio = over(s.rx, s.ry);
  const Bounded x = plus(times(cosine, dx), times(sine, dy));
  const Bounded y = times(ratio, minus(times(cosine, dy), times(sine, dx)));
  const ChordHeight chord = height_over(x, y, s.rx);
  if (!(chord.half_chord.value > 2 * chord.half_chord.error)) return line_between(s.from, s.to);
  const Bounded rx = chord.radius, ry = over(rx, ratio);
  // The centre lies to the left of the chord, as seen where y is up, if the turn is counter-clockwise and
  // small.
  const double side = s.large == s.sweep ? -1 : 1;
  const Bounded along = over(chord.height, plus(chord.half_chord, chord.half_chord));
  const Bounded cx = times({-side * along.value, along.error}, y),
                cy = times({side * along.value, along.error}, x);
  // This takes the centre back from the middle of the chord.
  const Bounded cy_flat = over(cy, ratio);
  const Bounded middle_x = times({0.5, 0}, plus(x_of(s.from), x_of(s.to))),
                middle_y = times({0.5, 0}, plus(y_of(s.from), y_of(s.to)));
  const BoundedPoint centre = point_of(plus(middle_x, minus(times(cosine, cx), times(sine, cy_flat))),
                                       plus(middle_y, plus(times(sine, cx), times(cosine, cy_flat))));
  EllipseArc arc;
  arc.from = s.from.at;
  arc.to = s.to.at;
  arc.centre = centre.at;
  const BoundedPoint u = point_of(times(cosine, rx), times(sine, rx)),
                     v = point_of(times(negative(sine), ry), times(cosine, ry));
  arc.u = u.at;
  arc.v = s.sweep ? v.at : -v.at;
  // Parameters grow in the direction of the arc.
  const double direction = s.sweep ? 1 : -1;
  const double half_sweep =
      geom::direction_angle(s.large ? -chord.height.value : chord.height.value, chord.half_chord.value);
  arc.begin = geom::direction_angle(-0.5 * x.value - cx.value, direction * (-0.5 * y.value - cy.value));
  arc.end = std::min(arc.begin + 2 * half_sweep, arc.begin + 2 * kPi);
  if (!(arc.end > arc.begin) || geom::cross(arc.u, arc.v) == 0) return line_between(s.from, s.to);
  // The directions of the ends are off by what centre and chord are off; conic() measures the gaps that this
  // leaves.
  const double ends = std::max(s.from.error, s.to.error);
  return conic(arc, centre.error + u.error + v.error + ends);
}

}  // namespace

Read<std::vector<PathSegment>> read_svg_path(std::string_view data) { return PathReader(data).run(); }

std::optional<BoundedShape> shape_of(const PathSegment& s) {
  switch (s.kind) {
    case Kind::line:
      break;
    case Kind::quadratic:
      return bezier({s.from, s.first, s.to});
    case Kind::cubic:
      return bezier({s.from, s.first, s.second, s.to});
    case Kind::arc:
      return s.rx.value == s.ry.value ? circle_of(s) : ellipse_of(s);
  }
  if (s.from.at == s.to.at) return std::nullopt;
  return line_between(s.from, s.to);
}

}  // namespace lekalo::io::detail
