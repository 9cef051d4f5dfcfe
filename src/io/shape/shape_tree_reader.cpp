// Step 1 of docs/design/shape-tree.md: from JSON to a tree of shapes, its words and its numbers.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/text/decimal.hpp"
#include "lekalo/base/limits.hpp"
#include "node.hpp"

namespace lekalo::io::detail {

using geom::Point;

Result<double> read_number(JsonValue json, const std::string& where, const char* key, double scale) {
  const auto said = json.find(key);
  if (!said) return refuse(where, fmt::format("\"{}\" is missing", key));
  if (!said->is_number())
    return refuse(where, fmt::format("\"{}\" must be a number, not {}", key, json_word(said->kind())));
  const double value = scale * said->number();
  if (!(std::abs(value) <= kLargestMillimetres)) {
    return refuse(where, fmt::format("\"{}\" is {}; numbers go up to {:g}", key, said->number(),
                                     kLargestMillimetres / scale));
  }
  return value;
}

Result<Point> place_of(JsonValue json, const std::string& where, double scale) {
  const auto said = two_numbers(json);
  if (!said) return refuse(where, "two numbers [x, y] are needed");
  const Point point = scale * *said;
  if (!(std::abs(point.x) <= kLargestMillimetres && std::abs(point.y) <= kLargestMillimetres)) {
    return refuse(where, fmt::format("[{}, {}] is too far out; coordinates go up to {:g}", point.x / scale,
                                     point.y / scale, kLargestMillimetres / scale));
  }
  return point;
}

Result<Point> read_place(JsonValue json, const std::string& where, const char* key, double scale,
                         std::optional<Point> otherwise) {
  if (const auto said = json.find(key)) return place_of(*said, where + "." + key, scale);
  if (otherwise) return *otherwise;
  return refuse(where, fmt::format("\"{}\" is missing", key));
}

namespace {

constexpr std::array<std::pair<std::string_view, ShapeKind>, 3> kBooleans{{
    {"union", ShapeKind::unite},
    {"intersection", ShapeKind::intersect},
    {"difference", ShapeKind::subtract},
}};
constexpr std::array<std::string_view, 4> kMaps{"move", "rotate", "mirror", "scale"};
constexpr const char* kAllWords =
    "circle, rectangle, rounded_rectangle, slot, regular_polygon, polygon, region, half_plane, union, "
    "intersection, difference, move, rotate, mirror, scale";

Result<Similarity> read_move(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"by", "shape"}));
  return read_place(json, where, "by", scale).map(move_by);
}

Result<Similarity> read_rotate(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"by_deg", "about", "shape"}));
  LEKALO_TRY(const auto degrees, read_number(json, where, "by_deg", 1));
  LEKALO_TRY(const auto about, read_place(json, where, "about", scale, Point{}));
  return turn_about(about, degrees);
}

Result<Similarity> read_scale(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"by", "about", "shape"}));
  LEKALO_TRY(const auto factor, read_number(json, where, "by", 1));
  if (!(factor >= 1 / limits::kLargestFactor && factor <= limits::kLargestFactor)) {
    return refuse(where,
                  fmt::format("\"by\" is {}; a factor from {:g} to {:g} is needed (mirror has a word of its "
                              "own)",
                              factor, 1 / limits::kLargestFactor, limits::kLargestFactor));
  }
  LEKALO_TRY(const auto about, read_place(json, where, "about", scale, Point{}));
  return scale_about(about, factor);
}

Result<Similarity> read_mirror(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"flip", "from", "to", "shape"}));
  if (const auto said = json.find("flip")) {
    if (json.find("from") || json.find("to")) return refuse(where, "\"flip\" and a line together; give one");
    if (!said->text_is("x") && !said->text_is("y"))
      return refuse(where, "\"flip\" must be \"x\" or \"y\", the coordinate that changes its sign");
    return flip(said->text_is("x"));
  }
  LEKALO_TRY(const auto from, read_place(json, where, "from", scale));
  LEKALO_TRY(const auto to, read_place(json, where, "to", scale));
  if (from == to)
    return refuse(where, "\"from\" and \"to\" are one point; two points of the line are needed");
  return mirror_in_line(from, to);
}

class TreeReader {
 public:
  explicit TreeReader(double scale) : scale_(scale) {}

  Result<ShapeNode> node(JsonValue json, const std::string& where, std::uint32_t name, std::size_t depth) {
    if (depth > kDeepestShapeTree)
      return refuse(where, fmt::format("shapes are nested more than {} deep", kDeepestShapeTree));
    if (json.kind() != JsonKind::object)
      return refuse(where, fmt::format("a shape is an object, not {}", json_word(json.kind())));
    std::optional<JsonValue> said;
    for (const JsonValue item : json) {
      if (item.key() == "name") continue;
      if (said)
        return refuse(where, fmt::format("\"{}\" and \"{}\" together; a shape is one word, and \"name\"",
                                         said->key(), item.key()));
      said = item;
    }
    if (!said) return refuse(where, fmt::format("no shape here; known: {}", kAllWords));
    if (const auto given = json.find("name")) {
      if (given->kind() != JsonKind::text || given->text().empty())
        return refuse(where, "\"name\" must be a text that is not empty");
      name = index_of(std::string(given->text()));
    }
    const JsonValue value = *said;
    const std::string word(value.key());
    const std::string place = where + "." + word;
    if (is_primitive(word)) {
      if (++primitives_ > kMostPrimitives)
        return refuse(place, fmt::format("more than {} primitives; give the outline of some as a \"polygon\"",
                                         kMostPrimitives));
      if (word == "half_plane" && ++half_planes_ > kMostHalfPlanes)
        return refuse(place, fmt::format("more than {} half-planes; give what they enclose as a \"polygon\"",
                                         kMostHalfPlanes));
      auto made = read_primitive(word, value, place, scale_);
      if (made) made->name = name;
      return made;
    }
    for (const auto& [boolean, kind] : kBooleans)
      if (word == boolean) return boolean_of(kind, value, place, name, depth);
    if (std::find(kMaps.begin(), kMaps.end(), word) != kMaps.end())
      return map_of(word, value, place, name, depth);
    return refuse(where, fmt::format("unknown word \"{}\"; known here: name, {}", word, kAllWords));
  }

  std::vector<std::string> names;

 private:
  std::uint32_t index_of(const std::string& name) {
    const auto at = static_cast<std::uint32_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (at == names.size()) names.push_back(name);
    return at;
  }

  Result<ShapeNode> boolean_of(ShapeKind kind, JsonValue json, const std::string& where, std::uint32_t name,
                               std::size_t depth) {
    if (json.kind() != JsonKind::list || json.size() == 0)
      return refuse(where, "a list of at least one shape is needed");
    ShapeNode made;
    made.kind = kind;
    made.where = where;
    for (const JsonValue item : json) {
      LEKALO_TRY(auto child, node(item, fmt::format("{}[{}]", where, made.children.size()), name, depth + 1));
      made.children.push_back(std::move(child));
    }
    made.extent = extent_of(made);
    return made;
  }

  Result<ShapeNode> map_of(const std::string& word, JsonValue json, const std::string& where,
                           std::uint32_t name, std::size_t depth) {
    LEKALO_TRY(const auto map, word == "move"     ? read_move(json, where, scale_)
                               : word == "rotate" ? read_rotate(json, where, scale_)
                               : word == "mirror" ? read_mirror(json, where, scale_)
                                                  : read_scale(json, where, scale_));
    const auto inner = json.find("shape");
    if (!inner) return refuse(where, "\"shape\", what it does this to, is missing");
    LEKALO_TRY(auto child, node(*inner, where + ".shape", name, depth + 1));
    ShapeNode made;
    made.kind = ShapeKind::map;
    made.where = where;
    made.map = map;
    made.children.push_back(std::move(child));
    made.extent = extent_of(made);
    if (made.extent.bounded && !(largest_of(made.extent.box) <= kLargestMillimetres)) {
      return refuse(where, fmt::format("this brings the shape to {:.3g} mm; coordinates go up to {:g} mm",
                                       largest_of(made.extent.box), kLargestMillimetres));
    }
    return made;
  }

  double scale_;
  std::size_t primitives_ = 0, half_planes_ = 0;
};

}  // namespace

Result<ShapeTree> read_shape_tree(JsonValue json, const std::string& where, double scale) {
  TreeReader reader(scale);
  LEKALO_TRY(auto root, reader.node(json, where, kNoName, 1));
  return ShapeTree{std::move(root), std::move(reader.names)};
}

}  // namespace lekalo::io::detail
