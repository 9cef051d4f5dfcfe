// From JSON to a tree of shapes: its words, its numbers, and where each node can have points.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/text/decimal.hpp"
#include "node.hpp"

namespace lekalo::io::detail {

using geom::Point;

Result<double> read_number(const Json& json, const std::string& where, const char* key, double scale) {
  if (!json.contains(key)) return refuse(where, fmt::format("\"{}\" is missing", key));
  if (!json[key].is_number())
    return refuse(where, fmt::format("\"{}\" must be a number, not {}", key, json[key].type_name()));
  const double value = scale * json[key].get<double>();
  if (!(std::abs(value) <= kLargestMillimetres)) {
    return refuse(where, fmt::format("\"{}\" is {}; numbers go up to {:g}", key, json[key].get<double>(),
                                     kLargestMillimetres / scale));
  }
  return value;
}

Result<Point> place_of(const Json& json, const std::string& where, double scale) {
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number())
    return refuse(where, "two numbers [x, y] are needed");
  const Point point{scale * json[0].get<double>(), scale * json[1].get<double>()};
  if (!(std::abs(point.x) <= kLargestMillimetres && std::abs(point.y) <= kLargestMillimetres)) {
    return refuse(where, fmt::format("[{}, {}] is too far out; coordinates go up to {:g}", point.x / scale,
                                     point.y / scale, kLargestMillimetres / scale));
  }
  return point;
}

Result<Point> read_place(const Json& json, const std::string& where, const char* key, double scale,
                         std::optional<Point> otherwise) {
  if (json.contains(key)) return place_of(json[key], where + "." + key, scale);
  if (otherwise) return *otherwise;
  return refuse(where, fmt::format("\"{}\" is missing", key));
}

namespace {

/// Factors of "scale"; beyond, either the numbers before or those after are no sizes of parts.
constexpr double kLargestFactor = 1e6;

constexpr std::array<std::pair<std::string_view, ShapeKind>, 3> kBooleans{{
    {"union", ShapeKind::unite},
    {"intersection", ShapeKind::intersect},
    {"difference", ShapeKind::subtract},
}};
constexpr std::array<std::string_view, 4> kMaps{"move", "rotate", "mirror", "scale"};
constexpr const char* kAllWords =
    "circle, rectangle, rounded_rectangle, slot, regular_polygon, polygon, region, half_plane, union, "
    "intersection, difference, move, rotate, mirror, scale";

Result<Similarity> read_move(const Json& json, const std::string& where, double scale) {
  if (const auto known = expect_object(json, where, {"by", "shape"}); !known)
    return tl::unexpected(known.error());
  return read_place(json, where, "by", scale).map(move_by);
}

Result<Similarity> read_rotate(const Json& json, const std::string& where, double scale) {
  if (const auto known = expect_object(json, where, {"by_deg", "about", "shape"}); !known)
    return tl::unexpected(known.error());
  const auto degrees = read_number(json, where, "by_deg", 1);
  if (!degrees) return tl::unexpected(degrees.error());
  const auto about = read_place(json, where, "about", scale, Point{});
  if (!about) return tl::unexpected(about.error());
  return turn_about(*about, *degrees);
}

Result<Similarity> read_scale(const Json& json, const std::string& where, double scale) {
  if (const auto known = expect_object(json, where, {"by", "about", "shape"}); !known)
    return tl::unexpected(known.error());
  const auto factor = read_number(json, where, "by", 1);
  if (!factor) return tl::unexpected(factor.error());
  if (!(*factor >= 1 / kLargestFactor && *factor <= kLargestFactor)) {
    return refuse(where,
                  fmt::format("\"by\" is {}; a factor from {:g} to {:g} is needed (mirror has a word of its "
                              "own)",
                              *factor, 1 / kLargestFactor, kLargestFactor));
  }
  const auto about = read_place(json, where, "about", scale, Point{});
  if (!about) return tl::unexpected(about.error());
  return scale_about(*about, *factor);
}

Result<Similarity> read_mirror(const Json& json, const std::string& where, double scale) {
  if (const auto known = expect_object(json, where, {"flip", "from", "to", "shape"}); !known)
    return tl::unexpected(known.error());
  if (json.contains("flip")) {
    if (json.contains("from") || json.contains("to"))
      return refuse(where, "\"flip\" and a line together; give one");
    if (json["flip"] != "x" && json["flip"] != "y")
      return refuse(where, "\"flip\" must be \"x\" or \"y\", the coordinate that changes its sign");
    return flip(json["flip"] == "x");
  }
  const auto from = read_place(json, where, "from", scale), to = read_place(json, where, "to", scale);
  if (!from || !to) {
    return from ? tl::unexpected(to.error()) : tl::unexpected(from.error());
  }
  if (*from == *to)
    return refuse(where, "\"from\" and \"to\" are one point; two points of the line are needed");
  return mirror_in_line(*from, *to);
}

class TreeReader {
 public:
  explicit TreeReader(double scale) : scale_(scale) {}

  Result<ShapeNode> node(const Json& json, const std::string& where, std::uint32_t name, std::size_t depth) {
    if (depth > kDeepestShapeTree)
      return refuse(where, fmt::format("shapes are nested more than {} deep", kDeepestShapeTree));
    if (!json.is_object())
      return refuse(where, fmt::format("a shape is an object, not {}", json.type_name()));
    std::string word;
    for (const auto& item : json.items()) {
      if (item.key() == "name") continue;
      if (!word.empty())
        return refuse(where, fmt::format("\"{}\" and \"{}\" together; a shape is one word, and \"name\"",
                                         word, item.key()));
      word = item.key();
    }
    if (word.empty()) return refuse(where, fmt::format("no shape here; known: {}", kAllWords));
    if (json.contains("name")) {
      if (!json["name"].is_string() || json["name"].get_ref<const std::string&>().empty())
        return refuse(where, "\"name\" must be a text that is not empty");
      name = index_of(json["name"].get_ref<const std::string&>());
    }
    const Json& value = json[word];
    const std::string place = where + "." + word;
    if (is_primitive(word)) {
      if (++primitives_ > kMostPrimitives)
        return refuse(place, fmt::format("more than {} primitives", kMostPrimitives));
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

  Result<ShapeNode> boolean_of(ShapeKind kind, const Json& json, const std::string& where, std::uint32_t name,
                               std::size_t depth) {
    if (!json.is_array() || json.empty()) return refuse(where, "a list of at least one shape is needed");
    ShapeNode made;
    made.kind = kind;
    made.where = where;
    for (std::size_t i = 0; i < json.size(); ++i) {
      auto child = node(json[i], fmt::format("{}[{}]", where, i), name, depth + 1);
      if (!child) return child;
      made.children.push_back(*std::move(child));
    }
    made.extent = extent_of(made);
    return made;
  }

  Result<ShapeNode> map_of(const std::string& word, const Json& json, const std::string& where,
                           std::uint32_t name, std::size_t depth) {
    const auto map = word == "move"     ? read_move(json, where, scale_)
                     : word == "rotate" ? read_rotate(json, where, scale_)
                     : word == "mirror" ? read_mirror(json, where, scale_)
                                        : read_scale(json, where, scale_);
    if (!map) return tl::unexpected(map.error());
    if (!json.contains("shape")) return refuse(where, "\"shape\", what it does this to, is missing");
    auto child = node(json["shape"], where + ".shape", name, depth + 1);
    if (!child) return child;
    ShapeNode made;
    made.kind = ShapeKind::map;
    made.where = where;
    made.map = *map;
    made.children.push_back(*std::move(child));
    made.extent = extent_of(made);
    if (made.extent.bounded && !(largest_of(made.extent.box) <= kLargestMillimetres)) {
      return refuse(where, fmt::format("this brings the shape to {:.3g} mm; coordinates go up to {:g} mm",
                                       largest_of(made.extent.box), kLargestMillimetres));
    }
    return made;
  }

  double scale_;
  std::size_t primitives_ = 0;
};

}  // namespace

Result<ShapeTree> read_shape_tree(const Json& json, const std::string& where, double scale) {
  TreeReader reader(scale);
  auto root = reader.node(json, where, kNoName, 1);
  if (!root) return tl::unexpected(std::move(root.error()));
  return ShapeTree{*std::move(root), std::move(reader.names)};
}

}  // namespace lekalo::io::detail
