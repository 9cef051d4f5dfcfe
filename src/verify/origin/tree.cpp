#include "tree.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "verify/number/interval.hpp"
#include "verify/number/surely.hpp"
#include "verify/read/known_fields.hpp"

namespace lekalo::verify {
namespace {

constexpr std::size_t kMostPrimitives = 10'000;

/// A map that keeps circles: x is mirrored if said, then turned, scaled and shifted.
struct Map {
  Motion motion;
  std::optional<Span> factor;
};

Span directly(const Interval& value) { return {value.low_double(), value.high_double()}; }

Vec unit_vector_at(const Fraction& degrees) {
  const Turn turn = turn_by_degrees(degrees);
  return {directly(turn.cosine), directly(turn.sine)};
}

Vec left_of(const Vec& direction) { return {-direction.y, direction.x}; }

/// Makes the outline of a primitive side by side.
class Outline {
 public:
  void line(const Vec& from, const Vec& to) {
    Side side;
    side.from = side.written_from = from, side.to = side.written_to = to;
    shape_.sides.push_back(side);
  }
  void arc(const Vec& centre, Span radius, const Vec& first, const Vec& last, Sweep sweep) {
    Side side;
    side.arc = true;
    side.centre = centre, side.radius = radius, side.first = first, side.last = last, side.sweep = sweep;
    side.from = side.written_from = centre + first * radius;
    side.to = side.written_to = centre + last * radius;
    shape_.sides.push_back(side);
  }
  void ring(const std::vector<Vec>& points) {
    for (std::size_t k = 0; k < points.size(); ++k) line(points[k], points[(k + 1) % points.size()]);
  }
  Shape done() {
    shape_.contour_starts.push_back(shape_.sides.size());
    shape_.piece_starts.push_back(1);
    bound(shape_);
    return std::move(shape_);
  }

 private:
  Shape shape_;
};

class TreeReader {
 public:
  TreeReader(LengthUnit unit, std::string& complaint) : unit_(unit), complaint_(complaint) {}

  Tree read(Json shape) {
    read_shape_at(shape, "shape", "");
    for (Primitive& primitive : tree_.primitives) bound(primitive.shape);
    return std::move(tree_);
  }

 private:
  void complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
  }

  [[nodiscard]] Decimal scaled(Decimal value) const {
    if (unit_ == LengthUnit::inch) value.digits *= 254, --value.exponent;
    return value;
  }
  Span length(Fields& fields, std::string_view key) {
    const Decimal value = scaled(fields.number(key));
    if (sgn(value.digits) <= 0) fields.complain(fields.name(key) + " is not above 0");
    return enclosed(value);
  }
  Vec point_of(Json value, const std::string& path) {
    std::vector<Span> numbers;
    if (value.is_array()) {
      JsonItems items(value);
      while (const auto item = items.next())
        if (const auto number = item->is_number() ? parse_decimal(item->text) : std::nullopt)
          numbers.push_back(enclosed(scaled(*number)));
        else
          return complain(path + " is not two numbers"), Vec{};
    }
    if (numbers.size() != 2) return complain(path + " is not two numbers"), Vec{};
    return {numbers[0], numbers[1]};
  }
  Vec point(const Fields& fields, std::string_view key) {
    return point_of(fields.get(key), fields.name(key));
  }
  Vec point_or_origin(const Fields& fields, std::string_view key) {
    return has(fields, key) ? point(fields, key) : Vec{just(0), just(0)};
  }
  static bool has(const Fields& fields, std::string_view key) { return !fields.get(key).text.empty(); }
  void only(Json object, const std::string& path, std::initializer_list<std::string_view> known) {
    if (!object.is_object()) return;
    JsonItems members(object);
    while (members.next())
      if (std::find(known.begin(), known.end(), members.key()) == known.end())
        complain(fmt::format("{}: \"{}\" is no word here", path, excerpt(members.key())));
  }

  /// Returns the number of the node. JSON is nested no deeper than a recursion may go.
  std::size_t read_shape_at(Json value, const std::string& path, const std::string& name_around) {
    Fields fields(value, path, complaint_);
    if (!complaint_.empty()) return 0;
    const std::string name = has(fields, "name") ? fields.text("name") : name_around;
    if (has(fields, "name") && name.empty()) return complain(fields.name("name") + " is empty"), 0;
    std::string word;
    Json what;
    JsonItems members(value);
    while (const auto item = members.next()) {
      if (members.key() == "name") continue;
      if (!word.empty()) return complain(fmt::format("{} has two words for its shape", path)), 0;
      word = members.key(), what = *item;
    }
    const std::string at = path + "." + word;
    if (word == "union") return read_list(what, Tree::Kind::unite, at, name);
    if (word == "intersection") return read_list(what, Tree::Kind::intersect, at, name);
    if (word == "difference") return read_list(what, Tree::Kind::subtract, at, name);
    if (word == "move" || word == "rotate" || word == "mirror" || word == "scale")
      return read_mapped(what, word, at, name);
    if (tree_.primitives.size() == kMostPrimitives) return complain("the tree has too many primitives"), 0;
    Primitive made;
    made.name = name;
    read_primitive(what, word, at, made);
    tree_.primitives.push_back(std::move(made));
    tree_.nodes.push_back({Tree::Kind::primitive, tree_.primitives.size() - 1, {}});
    return tree_.nodes.size() - 1;
  }

  std::size_t read_list(Json list, Tree::Kind kind, const std::string& path, const std::string& name) {
    Tree::Node node;
    node.kind = kind;
    if (!list.is_array() || count_items(list) == 0) return complain(path + " is not a list of shapes"), 0;
    JsonItems items(list);
    for (std::size_t k = 0; const auto item = items.next(); ++k)
      node.children.push_back(read_shape_at(*item, fmt::format("{}[{}]", path, k), name));
    tree_.nodes.push_back(std::move(node));
    return tree_.nodes.size() - 1;
  }

  std::size_t read_mapped(Json value, const std::string& word, const std::string& path,
                          const std::string& name) {
    Fields fields(value, path, complaint_);
    const Map map = read_map(fields, value, word, path);
    const std::size_t first = tree_.primitives.size();
    const std::size_t node = read_shape_at(fields.get("shape"), path + ".shape", name);
    if (!complaint_.empty()) return node;
    for (std::size_t k = first; k < tree_.primitives.size(); ++k) apply(map, tree_.primitives[k]);
    return node;
  }

  Map read_map(Fields& fields, Json value, const std::string& word, const std::string& path) {
    Map map;
    Motion& m = map.motion;
    m = {just(1), just(0), false, {just(0), just(0)}};
    if (word == "move") {
      only(value, path, {"by", "shape"});
      m.shift = point(fields, "by");
    } else if (word == "rotate") {
      only(value, path, {"by_deg", "about", "shape"});
      const Vec turn = unit_vector_at(to_fraction(fields.number("by_deg")));
      m.cosine = turn.x, m.sine = turn.y;
      keep(map, point_or_origin(fields, "about"));
    } else if (word == "scale") {
      only(value, path, {"by", "about", "shape"});
      const Decimal by = fields.number("by");
      if (sgn(by.digits) <= 0) fields.complain(fields.name("by") + " is not above 0");
      map.factor = enclosed(by);
      keep(map, point_or_origin(fields, "about"));
    } else if (has(fields, "flip")) {
      only(value, path, {"flip", "shape"});
      const std::string flip = fields.text("flip");
      if (flip != "x" && flip != "y") fields.complain(fields.name("flip") + " is neither x nor y");
      // Mirroring y is mirroring x and half a turn.
      m.mirrored = true, m.cosine = just(flip == "x" ? 1 : -1);
    } else {
      only(value, path, {"from", "to", "shape"});
      const Vec from = point(fields, "from"), along = point(fields, "to") - from;
      if (!complaint_.empty()) return map;
      if (!is_positive(length_of(along))) return complain(path + " is a line through one point twice"), map;
      const Vec u = unit(along);
      m.mirrored = true, m.cosine = squared(u.y) - squared(u.x), m.sine = -(just(2) * u.x * u.y);
      keep(map, from);
    }
    return map;
  }
  static Span length_of(const Vec& v) { return verify::length(v); }

  /// Chooses the shift so that the point stays where it is.
  static void keep(Map& map, const Vec& p) {
    map.motion.shift = p - placed(p, map.motion) * map.factor.value_or(just(1));
  }

  static void apply(const Map& map, Primitive& primitive) {
    Motion linear = map.motion;
    linear.shift = {just(0), just(0)};
    Shape shape = placed(primitive.shape, linear);
    for (Side& side : shape.sides) {
      for (Vec* p : {&side.from, &side.to, &side.centre}) {
        if (map.factor) *p = *p * *map.factor;
        *p = *p + map.motion.shift;
      }
      if (map.factor) side.radius = side.radius * *map.factor, side.off = (just(side.off) * *map.factor).high;
      // The left of a mirrored line was its right.
      if (primitive.half_plane && map.motion.mirrored) std::swap(side.from, side.to);
    }
    bound(shape);
    primitive.shape = std::move(shape);
  }

  struct Rectangle {
    Vec low, high;
  };
  Rectangle rectangle(Fields& fields) {
    const Vec size = point(fields, "size");
    if (!is_positive(size.x) || !is_positive(size.y))
      fields.complain(fields.name("size") + " is not above 0");
    if (has(fields, "corner")) {
      const Vec corner = point(fields, "corner");
      return {corner, corner + size};
    }
    const Vec centre = point_or_origin(fields, "centre"), half = size * just(0.5);
    return {centre - half, centre + half};
  }
  Span radius(Fields& fields) {
    return has(fields, "diameter") ? length(fields, "diameter") * just(0.5) : length(fields, "radius");
  }

  void read_primitive(Json value, const std::string& word, const std::string& path, Primitive& to) {
    if (word == "polygon") return read_polygon(value, path, to);
    Fields fields(value, path, complaint_);
    if (!complaint_.empty()) return;
    Outline outline;
    const Vec right{just(1), just(0)};
    if (word == "circle") {
      only(value, path, {"centre", "radius", "diameter"});
      outline.arc(point_or_origin(fields, "centre"), radius(fields), right, right, Sweep::full);
    } else if (word == "rectangle") {
      only(value, path, {"size", "centre", "corner"});
      const auto [low, high] = rectangle(fields);
      outline.ring({low, {high.x, low.y}, high, {low.x, high.y}});
    } else if (word == "rounded_rectangle") {
      only(value, path, {"size", "centre", "corner", "radius"});
      const auto [low, high] = rectangle(fields);
      add_rounded(outline, low, high, point(fields, "size"), length(fields, "radius"));
    } else if (word == "slot") {
      only(value, path, {"from", "to", "width"});
      const Vec from = point(fields, "from"), end = point(fields, "to");
      const Span half = length(fields, "width") * just(0.5);
      if (!is_positive(length_of(end - from))) return complain(path + " is a slot of no length");
      const Vec aside = left_of(unit(end - from));
      outline.line(from - aside * half, end - aside * half);
      outline.arc(end, half, -aside, aside, Sweep::half);
      outline.line(end + aside * half, from + aside * half);
      outline.arc(from, half, aside, -aside, Sweep::half);
    } else if (word == "regular_polygon") {
      only(value, path, {"sides", "centre", "radius", "across_flats", "corner_deg"});
      read_regular(fields, outline);
    } else if (word == "region") {
      only(value, path, {"outer", "holes", "islands"});
      refuse_unknown_words(value, complaint_);
      to.shape = read_shape(value, path, complaint_, unit_ == LengthUnit::inch);
      return;
    } else if (word == "half_plane") {
      only(value, path, {"from", "to"});
      to.half_plane = true;
      outline.line(point(fields, "from"), point(fields, "to"));
    } else {
      return complain(fmt::format("{}: \"{}\" is no shape", path, excerpt(word)));
    }
    to.shape = outline.done();
  }

  void read_polygon(Json value, const std::string& path, Primitive& to) {
    if (!value.is_array()) return complain(path + " is not a list of points");
    std::vector<Vec> points;
    JsonItems items(value);
    while (const auto item = items.next()) points.push_back(point_of(*item, path));
    if (points.size() < 3) return complain(path + " has fewer than three points");
    Outline outline;
    outline.ring(points);
    to.shape = outline.done();
  }

  void read_regular(Fields& fields, Outline& outline) {
    const std::size_t sides = fields.index("sides");
    if (sides < 3 || sides > kMostPrimitives)
      return fields.complain(fields.name("sides") + " is out of range");
    const Vec centre = point_or_origin(fields, "centre");
    const auto count = static_cast<unsigned long>(sides);
    Span around;
    if (has(fields, "across_flats")) {
      around = length(fields, "across_flats") * just(0.5) / unit_vector_at(Fraction(180) / Fraction(count)).x;
    } else {
      around = length(fields, "radius");
    }
    const Fraction first = has(fields, "corner_deg") ? to_fraction(fields.number("corner_deg")) : Fraction(0);
    std::vector<Vec> corners;
    for (unsigned long k = 0; k < count; ++k)
      corners.push_back(centre + unit_vector_at(first + Fraction(360 * k) / Fraction(count)) * around);
    outline.ring(corners);
  }

  /// Sides of which the quarter circles leave nothing are left out.
  void add_rounded(Outline& outline, const Vec& low, const Vec& high, const Vec& size, Span r) {
    if (!complaint_.empty()) return;
    const Span width = size.x - r - r, height = size.y - r - r;
    const std::array<Vec, 4> axes{
        {{just(0), just(-1)}, {just(1), just(0)}, {just(0), just(1)}, {just(-1), just(0)}}};
    const std::array<Vec, 4> centres{
        {{high.x - r, low.y + r}, {high.x - r, high.y - r}, {low.x + r, high.y - r}, {low.x + r, low.y + r}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t before = (k + 3) % 4;
      // Side k runs from the corner before to this one.
      if (is_positive(k % 2 == 0 ? width : height))
        outline.line(centres[before] + axes[k] * r, centres[k] + axes[k] * r);
      outline.arc(centres[k], r, axes[k], axes[(k + 1) % 4], Sweep::less);
    }
  }

  LengthUnit unit_;
  std::string& complaint_;
  Tree tree_;
};

}  // namespace

Tree read_tree(Json shape, LengthUnit unit, std::string& complaint) {
  return TreeReader(unit, complaint).read(shape);
}

}  // namespace lekalo::verify
