#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "drawing.hpp"
#include "verify/number/interval.hpp"
#include "verify/read/text_rows.hpp"

namespace lekalo::verify {
namespace {

constexpr int kDeepestBlock = 32;

struct Pair {
  int code;
  std::string_view value;
};
struct Entity {
  std::string_view type;
  std::vector<Pair> pairs;
  /// The vertices of a polyline of the old kind.
  std::vector<Entity> vertices;
};
struct Block {
  Vec base{just(0), just(0)};
  std::vector<Entity> entities;
};
struct LayerState {
  bool off = false, frozen = false;
};

/// Millimetres in a unit of $INSUNITS.
std::optional<Decimal> unit_of(long code) {
  static const std::array<Decimal, 17> kUnits{{{0, 0},
                                               {254, -1},
                                               {3048, -1},
                                               {1609344, 0},
                                               {1, 0},
                                               {1, 1},
                                               {1, 3},
                                               {1, 6},
                                               {254, -7},
                                               {254, -4},
                                               {9144, -1},
                                               {1, -7},
                                               {1, -6},
                                               {1, -3},
                                               {1, 2},
                                               {1, 4},
                                               {1, 5}}};
  if (code < 1 || code > 16) return std::nullopt;
  return kUnits[static_cast<std::size_t>(code)];
}

class DxfReader {
 public:
  DxfReader(const Document& document, LengthUnit unit, double off)
      : document_(document),
        unit_(unit == LengthUnit::inch ? Decimal{254, -1} : Decimal{1, 0}),
        maker_(drawing_, off) {}

  Result<ReadDrawing> read() {
    read_pairs();
    if (complaint_.empty()) read_sections();
    for (const Entity& entity : entities_)
      if (complaint_.empty()) draw(entity, Affine{}, "", false, 0);
    if (!complaint_.empty())
      return failure(ErrorCode::bad_input, fmt::format("{}: {}", document_.name, complaint_));
    return std::move(drawing_);
  }

 private:
  void complain(std::string sentence) {
    if (complaint_.empty()) complaint_ = std::move(sentence);
  }

  void read_pairs() {
    Lines lines(document_.bytes);
    while (const auto code = lines.next()) {
      if (code->empty() && lines.rest().find_first_not_of(" \t\r\n") == std::string_view::npos) break;
      const auto number = parse_decimal(*code);
      const auto value = lines.next();
      if (!number || !value || !(std::abs(approximate(*number)) < 10000))
        return complain(fmt::format("line {} is no group of a DXF", lines.number()));
      const int group = static_cast<int>(approximate(*number));
      if (group != 999) pairs_.push_back({group, *value});
    }
  }

  [[nodiscard]] bool at_end() const { return at_ >= pairs_.size(); }
  [[nodiscard]] bool is(int code, std::string_view value) const {
    return !at_end() && pairs_[at_].code == code && pairs_[at_].value == value;
  }

  /// Takes an entity and the groups behind it, without those of applications.
  Entity take_entity() {
    Entity entity{pairs_[at_++].value, {}, {}};
    bool application = false;
    for (; !at_end() && pairs_[at_].code != 0; ++at_) {
      const Pair& pair = pairs_[at_];
      if (pair.code == 102)
        application = pair.value.substr(0, 1) == "{";
      else if (!application)
        entity.pairs.push_back(pair);
    }
    return entity;
  }

  std::vector<Entity> take_entities(std::string_view end) {
    std::vector<Entity> entities;
    while (!at_end() && !is(0, end) && !is(0, "EOF")) {
      Entity entity = take_entity();
      if (entity.type == "POLYLINE") {
        while (is(0, "VERTEX")) entity.vertices.push_back(take_entity());
      }
      entities.push_back(std::move(entity));
    }
    return entities;
  }

  /// Other readers show nothing that stands behind EOF, or a second time.
  void read_sections() {
    while (!at_end() && !is(0, "EOF")) {
      if (!is(0, "SECTION")) {
        ++at_;
        continue;
      }
      ++at_;
      const std::string_view name = at_end() ? "" : pairs_[at_].value;
      if (name == "HEADER")
        read_header();
      else if (name == "TABLES")
        read_tables();
      else if (name == "BLOCKS")
        read_blocks();
      else if (name == "ENTITIES")
        read_entities();
    }
  }

  void read_entities() {
    if (std::exchange(has_entities_, true)) complain("a second section ENTITIES");
    ++at_;
    entities_ = take_entities("ENDSEC");
  }

  void read_header() {
    for (; !at_end() && !is(0, "ENDSEC"); ++at_) {
      if (!is(9, "$INSUNITS")) continue;
      ++at_;
      const auto number = at_end() ? std::nullopt : parse_decimal(pairs_[at_].value);
      const long code = number ? whole(*number) : -1;
      if (!complaint_.empty()) return;
      if (code == 0) continue;
      const auto unit = unit_of(code);
      if (!unit) return complain("its unit is not known here");
      unit_ = *unit, drawing_.says_unit = true;
    }
  }

  void read_tables() {
    while (!at_end() && !is(0, "ENDSEC")) {
      if (!is(0, "LAYER")) {
        ++at_;
        continue;
      }
      const Entity layer = take_entity();
      const auto colour = number(layer, 62), flags = number(layer, 70);
      layers_[key_of(text(layer, 2))] = {colour && sgn(colour->digits) < 0, flags && bit(*flags, 1)};
    }
  }

  void read_blocks() {
    while (!at_end() && !is(0, "ENDSEC")) {
      if (!is(0, "BLOCK")) {
        ++at_;
        continue;
      }
      const Entity head = take_entity();
      Block block;
      block.base = point(head, 10, 20).value_or(Vec{just(0), just(0)});
      block.entities = take_entities("ENDBLK");
      blocks_.emplace(key_of(text(head, 2)), std::move(block));
    }
  }

  static std::string_view text(const Entity& entity, int code) {
    for (const Pair& pair : entity.pairs)
      if (pair.code == code) return pair.value;
    return "";
  }
  std::optional<Decimal> number(const Entity& entity, int code) {
    for (const Pair& pair : entity.pairs)
      if (pair.code == code) return number_of(pair);
    return std::nullopt;
  }
  Decimal number_or(const Entity& entity, int code, long otherwise) {
    return number(entity, code).value_or(Decimal{otherwise, 0});
  }
  std::optional<Decimal> number_of(const Pair& pair) {
    auto value = parse_decimal(pair.value);
    if (!value) complain(fmt::format("\"{}\" is no number", excerpt(pair.value)));
    return value;
  }
  /// A count or a list of bits. 0, and the drawing is not read, where it is no whole number of a usual size.
  long whole(const Decimal& value) {
    const double number = approximate(value);
    if (std::abs(number) <= 1e9 && number == std::floor(number)) return static_cast<long>(number);
    complain(fmt::format("{:g} is no whole number of up to 1e9", number));
    return 0;
  }
  bool bit(const Decimal& flags, long which) { return (whole(flags) & which) != 0; }
  [[nodiscard]] Span in_mm(Decimal length) const {
    length.digits *= unit_.digits, length.exponent += unit_.exponent;
    return enclosed(length);
  }
  std::optional<Vec> point(const Entity& entity, int x, int y) {
    const auto a = number(entity, x), b = number(entity, y);
    if (!a || !b) return std::nullopt;
    return Vec{in_mm(*a), in_mm(*b)};
  }

  struct Plane {
    bool seen = true, mirrored = false;
  };
  /// Planes are seen from above or from below; others count as nothing that is drawn.
  Plane plane_of(const Entity& entity) {
    const double x = approximate(number_or(entity, 210, 0)), y = approximate(number_or(entity, 220, 0)),
                 z = approximate(number_or(entity, 230, 1));
    const double lean = std::max(std::abs(x), std::abs(y));
    const bool upright = lean <= 1e-9 * std::abs(z);
    if (lean > 0 && upright) drawing_.not_read.insert("planes that lean by rounding");
    return {upright && z != 0, std::signbit(z)};
  }

  void draw(const Entity& entity, const Affine& map, const std::string& layer_around, bool frozen_around,
            int depth) {
    if (const auto paper = number(entity, 67); paper && sgn(paper->digits) != 0) return;
    if (const auto invisible = number(entity, 60); invisible && sgn(invisible->digits) != 0) return;
    const Plane plane = plane_of(entity);
    if (!plane.seen) return;
    std::string layer(text(entity, 8));
    if (layer == "0" && depth > 0) layer = layer_around;
    if (frozen_around) layer = layer_around;
    const LayerState& state = layers_[key_of(layer)];
    if (drawing_.too_large()) return complain("it has too many curves");
    Affine seen = map;
    if (plane.mirrored) seen = map * Affine{{just(-1), just(0)}, {just(0), just(1)}, {just(0), just(0)}};
    const std::string_view type = entity.type;
    if (type == "INSERT") return insert(entity, seen, layer, state.frozen, depth);
    // These stand in the coordinates of the drawing, whatever their direction.
    if (type == "LINE")
      draw_line(entity, map);
    else if (type == "CIRCLE" || type == "ARC")
      draw_arc(entity, seen, type == "CIRCLE");
    else if (type == "LWPOLYLINE")
      draw_lwpolyline(entity, seen);
    else if (type == "POLYLINE")
      draw_polyline(entity, map, seen);
    else if (type == "ELLIPSE")
      draw_ellipse(entity, map, plane.mirrored);
    else if (type == "SPLINE")
      draw_spline(entity, map);
    maker_.done(layer, state.off || state.frozen);
  }

  void draw_line(const Entity& entity, const Affine& map) {
    const auto from = point(entity, 10, 20), to = point(entity, 11, 21);
    if (!from || !to) return complain("a LINE lacks an end");
    maker_.line(map, *from, *to);
  }

  void draw_arc(const Entity& entity, const Affine& map, bool full) {
    const auto centre = point(entity, 10, 20);
    const auto radius = number(entity, 40), from = number(entity, 50), to = number(entity, 51);
    if (!centre || !radius || (!full && (!from || !to))) return complain("an arc lacks a number");
    DrawnArc arc;
    arc.centre = *centre, arc.radius = in_mm(*radius);
    arc.from_deg = full ? Fraction(0) : to_fraction(*from);
    const Fraction sweep = full ? Fraction(360) : within_a_turn(to_fraction(*to) - *arc.from_deg);
    arc.to_deg = *arc.from_deg + sweep;
    arc.sweep = sweep_of(sweep);
    arc.first = direction(*arc.from_deg), arc.last = direction(*arc.to_deg);
    maker_.arc(map, arc);
  }
  /// Returns degrees, above 0 and up to 360, that differ by whole turns.
  static Fraction within_a_turn(const Fraction& degrees) {
    const Fraction rest = degrees - Fraction(Integer(degrees / 360) * 360);
    return rest > 0 ? rest : Fraction(rest + 360);
  }
  static Sweep sweep_of(const Fraction& degrees) {
    if (degrees == 360) return Sweep::full;
    return degrees < 180 ? Sweep::less : (degrees == 180 ? Sweep::half : Sweep::more);
  }
  static Vec direction(const Fraction& degrees) {
    const Turn turn = turn_by_degrees(degrees);
    return {{turn.cosine.low_double(), turn.cosine.high_double()},
            {turn.sine.low_double(), turn.sine.high_double()}};
  }

  struct Corner {
    Vec at;
    Decimal bulge;
  };
  void draw_corners(const Affine& map, const std::vector<Corner>& corners, bool closed) {
    const std::size_t n = corners.size();
    for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k)
      maker_.bulge(map, corners[k].at, corners[(k + 1) % n].at, corners[k].bulge);
  }

  void draw_lwpolyline(const Entity& entity, const Affine& map) {
    std::vector<Corner> corners;
    std::optional<Decimal> x;
    bool closed = false;
    for (const Pair& pair : entity.pairs) {
      if (pair.code != 10 && pair.code != 20 && pair.code != 42 && pair.code != 70) continue;
      const auto value = number_of(pair);
      if (!value) return;
      if (pair.code == 70) closed = bit(*value, 1);
      if (pair.code == 10) x = *value;
      if (pair.code == 20 && x) corners.push_back({{in_mm(*x), in_mm(*value)}, {}}), x.reset();
      if (pair.code == 42 && !corners.empty()) corners.back().bulge = *value;
    }
    draw_corners(map, corners, closed);
  }

  void draw_polyline(const Entity& entity, const Affine& flat, const Affine& seen) {
    const Decimal flags = number_or(entity, 70, 0);
    if (bit(flags, 16) || bit(flags, 64)) return;
    const bool in_space = bit(flags, 8);
    std::vector<Corner> corners;
    for (const Entity& vertex : entity.vertices) {
      const auto at = point(vertex, 10, 20);
      if (!at) return complain("a VERTEX lacks a number");
      // Points of a spline's frame are no points of the curve.
      if (const auto kind = number(vertex, 70); kind && bit(*kind, 16)) continue;
      corners.push_back({*at, in_space ? Decimal{} : number_or(vertex, 42, 0)});
    }
    draw_corners(in_space ? flat : seen, corners, bit(flags, 1));
  }

  void draw_ellipse(const Entity& entity, const Affine& map, bool from_below) {
    const auto centre = point(entity, 10, 20), along = point(entity, 11, 21);
    const auto ratio = number(entity, 40), from = number(entity, 41), to = number(entity, 42);
    if (!centre || !along || !ratio || !from || !to) return complain("an ELLIPSE lacks a number");
    // These digits of pi are more than any file has.
    static const Fraction kPi = to_fraction(*parse_decimal("3.14159265358979323846264338327950288"));
    const auto in_degrees = [&](const Decimal& angle) { return Fraction(to_fraction(angle) * 180 / kPi); };
    const Fraction first = in_degrees(*from);
    Fraction sweep = within_a_turn(in_degrees(*to) - first);
    if (360 - sweep < Fraction(1) / 10000) sweep = 360;
    const Vec left{-along->y, along->x};
    if (compare(*ratio, Decimal{1, 0}) == 0) {
      DrawnArc arc;
      arc.centre = *centre, arc.radius = length(*along);
      const Vec u = unit(*along), across = from_below ? -unit(left) : unit(left);
      const auto at = [&](const Fraction& degrees) {
        const Vec d = direction(degrees);
        return u * d.x + across * d.y;
      };
      const Vec begin = at(first), end = at(first + sweep);
      arc.first = from_below ? end : begin, arc.last = from_below ? begin : end;
      arc.sweep = sweep_of(sweep);
      return maker_.arc(map, arc);
    }
    const Span share = enclosed(*ratio);
    maker_.ellipse(map, *centre, *along, left * (from_below ? -share : share), first, first + sweep);
  }

  /// Splines without weights of degree 1 to 3 become the Bezier curves between their knots.
  void draw_spline(const Entity& entity, const Affine& map) {
    std::vector<Fraction> knots;
    std::vector<std::array<Fraction, 2>> poles;
    std::optional<Decimal> x;
    long degree = 0;
    bool weighed = false;
    for (const Pair& pair : entity.pairs) {
      if (pair.code != 71 && pair.code != 40 && pair.code != 41 && pair.code != 10 && pair.code != 20)
        continue;
      const auto value = number_of(pair);
      if (!value) return;
      if (pair.code == 71) degree = whole(*value);
      if (pair.code == 40) knots.push_back(to_fraction(*value));
      if (pair.code == 41) weighed = weighed || compare(*value, Decimal{1, 0}) != 0;
      if (pair.code == 10) x = *value;
      if (pair.code == 20 && x) poles.push_back({to_fraction(*x), to_fraction(*value)}), x.reset();
    }
    const auto p = static_cast<std::size_t>(degree);
    if (weighed || p < 1 || p > 3 || poles.size() <= p || knots.size() != poles.size() + p + 1)
      return void(drawing_.not_read.insert("splines with weights, of a degree above 3, or without knots"));
    if (!std::is_sorted(knots.begin(), knots.end())) return complain("a SPLINE whose knots descend");
    for (std::size_t i = p; i < poles.size(); ++i)
      if (knots[i] < knots[i + 1]) draw_span(map, knots, poles, p, i);
  }

  /// Draws the span from knot i to the next by the values of its polar form.
  void draw_span(const Affine& map, const std::vector<Fraction>& knots,
                 const std::vector<std::array<Fraction, 2>>& poles, std::size_t p, std::size_t i) {
    const auto polar = [&](std::size_t later) {
      std::vector<std::array<Fraction, 2>> d(poles.begin() + static_cast<std::ptrdiff_t>(i - p),
                                             poles.begin() + static_cast<std::ptrdiff_t>(i + 1));
      for (std::size_t r = 1; r <= p; ++r) {
        const Fraction& t = r <= p - later ? knots[i] : knots[i + 1];
        for (std::size_t j = p; j >= r; --j) {
          const Fraction &low = knots[i - p + j], &high = knots[i + 1 + j - r];
          const Fraction share = (t - low) / (high - low);
          for (std::size_t axis = 0; axis < 2; ++axis)
            d[j][axis] = Fraction((1 - share) * d[j - 1][axis] + share * d[j][axis]);
        }
      }
      return d[p];
    };
    std::vector<std::array<Fraction, 2>> bezier;
    for (std::size_t later = 0; later <= p; ++later) bezier.push_back(polar(later));
    const auto mix = [&](std::size_t a, long wa, std::size_t b, long wb) {
      std::array<Fraction, 2> out;
      for (std::size_t axis = 0; axis < 2; ++axis)
        out[axis] = Fraction((wa * bezier[a][axis] + wb * bezier[b][axis]) / (wa + wb));
      return place(out);
    };
    if (p == 1) return maker_.line(map, place(bezier[0]), place(bezier[1]));
    if (p == 2)
      return maker_.cubic(map, {place(bezier[0]), mix(0, 1, 1, 2), mix(1, 2, 2, 1), place(bezier[2])});
    maker_.cubic(map, {place(bezier[0]), place(bezier[1]), place(bezier[2]), place(bezier[3])});
  }
  [[nodiscard]] Vec place(const std::array<Fraction, 2>& p) const {
    const auto in = [&](const Fraction& value) {
      const double near = cut_to_double(Fraction(value * to_fraction(unit_)));
      return outwards(near, near);
    };
    return {in(p[0]), in(p[1])};
  }

  void insert(const Entity& entity, const Affine& map, const std::string& layer, bool frozen, int depth) {
    const auto found = blocks_.find(key_of(text(entity, 2)));
    if (found == blocks_.end()) return;
    if (depth == kDeepestBlock) return complain("its blocks are nested too deep");
    const Block& block = found->second;
    const auto at = point(entity, 10, 20);
    if (!at) return complain("an INSERT lacks a number");
    const auto or_else = [&](int code, long otherwise) { return number_or(entity, code, otherwise); };
    const Span sx = enclosed(or_else(41, 1)), sy = enclosed(or_else(42, 1));
    const Vec turn = direction(to_fraction(or_else(50, 0)));
    const Vec along{turn.x, turn.y}, across{-turn.y, turn.x};
    const long columns = std::max(1L, whole(or_else(70, 1))), rows = std::max(1L, whole(or_else(71, 1)));
    if (static_cast<double>(columns) * static_cast<double>(rows) > static_cast<double>(kMostCurves))
      return complain("an INSERT makes too many copies");
    const Span dx = in_mm(or_else(44, 0)), dy = in_mm(or_else(45, 0));
    Affine step{along * sx, across * sy, {}};
    const Vec first = *at - step.direction(block.base);
    for (long copy = 0; copy < rows * columns && complaint_.empty(); ++copy) {
      const Span row = just(static_cast<double>(copy / columns)),
                 column = just(static_cast<double>(copy % columns));
      step.shift = first + along * (dx * column) + across * (dy * row);
      const Affine inner = map * step;
      for (const Entity& each : block.entities) draw(each, inner, layer, frozen, depth + 1);
    }
  }

  const Document& document_;
  Decimal unit_;
  ReadDrawing drawing_;
  CurveMaker maker_;
  std::vector<Pair> pairs_;
  std::size_t at_ = 0;
  std::map<std::string, LayerState> layers_;
  std::map<std::string, Block> blocks_;
  std::vector<Entity> entities_;
  bool has_entities_ = false;
  std::string complaint_;
};

}  // namespace

std::string key_of(std::string_view name) {
  std::string key(name);
  for (char& c : key)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return key;
}

Result<ReadDrawing> read_dxf_drawing(const Document& document, LengthUnit unit, double off) {
  return DxfReader(document, unit, off).read();
}

}  // namespace lekalo::verify
