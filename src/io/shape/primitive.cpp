// Step 1 of docs/design/shape-tree.md for primitives: from their numbers to regions.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/drawing/drawn_shapes.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/geom/region_check.hpp"
#include "node.hpp"

namespace lekalo::io::detail {

using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

namespace {

/// A primitive's outline is off by at most this part of its largest coordinate or length. Reading moves a
/// coordinate by 4 u at most (inches); sums of two or three numbers read, and a product with a unit vector,
/// by 16 u; so a point by 23 u, and the points of an arc by three times as much as its ends and its centre.
constexpr double kPrimitiveError = 0x80p-53;
/// The same for primitives whose corners lie at computed angles, which add 45 u.
constexpr double kAngledError = 0x200p-53;
/// The two points of an edge without end must be at least this part of their coordinates apart.
constexpr double kLeastOfDirection = 1e-6;
constexpr std::int64_t kMostSides = 10'000;

using Made = Result<ShapeNode>;

Contour ring(const std::vector<Point>& points) {
  Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({EdgeKind::line, points[i], points[(i + 1) % points.size()], {}});
  return contour;
}

Contour full_circle(Point centre, double radius) {
  const Point from = centre + Point{radius, 0};
  return {{EdgeKind::arc_ccw, from, from, centre}};
}

/// Makes the node of a primitive, checks its reach, and states its error.
Made finished(Contour outer, std::vector<Contour> holes, const std::string& where, double relative_error) {
  auto region = geom::make_region(std::move(outer), std::move(holes));
  if (!region) return refuse(where, region.error().message);
  ShapeNode node;
  node.where = where;
  node.regions.push_back(*std::move(region));
  double largest = largest_of(node.regions[0]);
  for (const Edge& e : node.regions[0].outer)  // of a small arc far from its centre the centre counts already
    if (e.kind != EdgeKind::line) largest = std::max(largest, geom::arc_radius(e));
  if (!(largest <= kLargestMillimetres)) {
    return refuse(where, fmt::format("it reaches {:.3g} mm; coordinates go up to {:g} mm", largest,
                                     kLargestMillimetres));
  }
  node.error = relative_error * largest;
  return node;
}

Made finished_as_drawn(Contour outer, std::vector<Contour> holes, const std::string& where) {
  LEKALO_TRY(auto node, finished(std::move(outer), std::move(holes), where, kPrimitiveError));
  if (const auto fault = geom::fault_of(node.regions)) return refuse(where, *fault);
  return node;
}

/// Reads a length, which must be above 0.
Result<double> read_length(JsonValue json, const std::string& where, const char* key, double scale) {
  auto length = read_number(json, where, key, scale);
  if (length && !(*length > 0)) {
    return refuse(where, fmt::format("\"{}\" is {}; it must be above 0", key, json.find(key)->number()));
  }
  return length;
}

/// Finds the one that is given of several keys that say the same thing in different ways.
Result<std::string> only_one(JsonValue json, const std::string& where,
                             std::initializer_list<const char*> keys) {
  std::string found;
  for (const char* key : keys) {
    if (!json.find(key)) continue;
    if (!found.empty()) return refuse(where, fmt::format("\"{}\" and \"{}\" together; give one", found, key));
    found = key;
  }
  if (found.empty())
    return refuse(where, fmt::format("one of these is missing: {}", joined_text(keys, ", ")));
  return found;
}

Result<double> read_radius(JsonValue json, const std::string& where, double scale) {
  LEKALO_TRY(const auto key, only_one(json, where, {"radius", "diameter"}));
  LEKALO_TRY(const auto length, read_length(json, where, key.c_str(), scale));
  return key == "diameter" ? 0.5 * length : length;
}

Made read_circle(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"centre", "radius", "diameter"}));
  LEKALO_TRY(const auto centre, read_place(json, where, "centre", scale, Point{}));
  LEKALO_TRY(const auto radius, read_radius(json, where, scale));
  return finished(full_circle(centre, radius), {}, where, kPrimitiveError);
}

/// Reads a box from "size" and "centre" or "corner" (the one with the least coordinates).
Result<geom::Box> read_box(JsonValue json, const std::string& where, double scale) {
  LEKALO_TRY(const auto size, read_place(json, where, "size", scale));
  if (!(size.x > 0 && size.y > 0)) {
    const Point said = *two_numbers(*json.find("size"));
    return refuse(where,
                  fmt::format("\"size\" is [{}, {}]; width and height must be above 0", said.x, said.y));
  }
  if (json.find("centre") && json.find("corner"))
    return refuse(where, "\"centre\" and \"corner\" together; give one");
  if (json.find("corner")) {
    LEKALO_TRY(const auto corner, read_place(json, where, "corner", scale));
    return geom::Box{corner, corner + size};
  }
  LEKALO_TRY(const auto centre, read_place(json, where, "centre", scale, Point{}));
  const Point half = 0.5 * size;
  return geom::Box{centre - half, centre + half};
}

Made read_rectangle(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"size", "centre", "corner"}));
  LEKALO_TRY(const auto box, read_box(json, where, scale));
  const auto [low, high] = box;
  return finished(ring({low, {high.x, low.y}, high, {low.x, high.y}}), {}, where, kPrimitiveError);
}

/// The box with its corners cut by quarter circles; sides of which these leave nothing are left out.
Contour rounded(const geom::Box& box, double r) {
  const auto [low, high] = box;
  // Two circles that meet share one coordinate, so that no sliver of a side is left.
  const bool no_width = !(high.x - low.x > 2 * r), no_height = !(high.y - low.y > 2 * r);
  const double middle_x = 0.5 * (low.x + high.x), middle_y = 0.5 * (low.y + high.y);
  if (no_width && no_height) return full_circle({middle_x, middle_y}, r);
  const double left = no_width ? middle_x : low.x + r, right = no_width ? middle_x : high.x - r;
  const double bottom = no_height ? middle_y : low.y + r, top = no_height ? middle_y : high.y - r;
  const std::array<Point, 8> on{{{left, low.y},
                                 {right, low.y},
                                 {high.x, bottom},
                                 {high.x, top},
                                 {right, high.y},
                                 {left, high.y},
                                 {low.x, top},
                                 {low.x, bottom}}};
  const std::array<Point, 4> centres{{{right, bottom}, {right, top}, {left, top}, {left, bottom}}};
  Contour contour;
  for (std::size_t side = 0; side < 4; ++side) {
    const Point from = on[2 * side], to = on[2 * side + 1], next = on[(2 * side + 2) % 8];
    if (!(from == to)) contour.push_back({EdgeKind::line, from, to, {}});
    contour.push_back({EdgeKind::arc_ccw, to, next, centres[side]});
  }
  return contour;
}

Made read_rounded_rectangle(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"size", "centre", "corner", "radius"}));
  LEKALO_TRY(const auto box, read_box(json, where, scale));
  LEKALO_TRY(const auto radius, read_length(json, where, "radius", scale));
  const Point size = *two_numbers(*json.find("size"));
  const double shorter = scale * std::min(size.x, size.y);
  if (!(2 * radius <= shorter)) {
    return refuse(where, fmt::format("\"radius\" is {}; half of the shorter side, {}, is the most",
                                     json.find("radius")->number(), 0.5 * shorter / scale));
  }
  return finished(rounded(box, radius), {}, where, kPrimitiveError);
}

Made read_slot(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"from", "to", "width"}));
  LEKALO_TRY(const auto from, read_place(json, where, "from", scale));
  LEKALO_TRY(const auto to, read_place(json, where, "to", scale));
  LEKALO_TRY(const auto width, read_length(json, where, "width", scale));
  const double length = norm(to - from);
  if (!(length > 0)) return refuse(where, "\"from\" and \"to\" are one point; that is a circle");
  const Point aside = (0.5 * width / length) * perpendicular(to - from);
  return finished({{EdgeKind::line, from - aside, to - aside, {}},
                   {EdgeKind::arc_ccw, to - aside, to + aside, to},
                   {EdgeKind::line, to + aside, from + aside, {}},
                   {EdgeKind::arc_ccw, from + aside, from - aside, from}},
                  {}, where, kAngledError);
}

Made read_regular_polygon(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"sides", "centre", "radius", "across_flats", "corner_deg"}));
  const auto said = json.find("sides");
  const std::int64_t sides = said && said->kind() == JsonKind::integer ? said->integer() : 0;
  if (sides < 3 || sides > kMostSides)
    return refuse(where, fmt::format("\"sides\" must be a whole number from 3 to {}", kMostSides));
  LEKALO_TRY(const auto centre, read_place(json, where, "centre", scale, Point{}));
  LEKALO_TRY(const auto key, only_one(json, where, {"radius", "across_flats"}));
  LEKALO_TRY(const auto length, read_length(json, where, key.c_str(), scale));
  if (key == "across_flats" && sides % 2 != 0) {
    return refuse(where,
                  fmt::format("\"across_flats\" with {} sides: no two sides are parallel; give \"radius\", "
                              "from the centre to a corner",
                              sides));
  }
  double corner_deg = 0;
  if (json.find("corner_deg")) {
    LEKALO_TRY(const auto angle, read_number(json, where, "corner_deg", 1));
    corner_deg = std::fmod(angle, 360.0);
  }
  const auto count = static_cast<double>(sides);
  const double radius = key == "radius" ? length : 0.5 * length / direction_of_degrees(180 / count).unit.x;
  std::vector<Point> corners;
  for (std::int64_t k = 0; k < sides; ++k) {
    const double degrees = corner_deg + 360 * static_cast<double>(k) / count;
    corners.push_back(centre + radius * direction_of_degrees(degrees).unit);
  }
  return finished(ring(corners), {}, where, kAngledError);
}

Made read_polygon(JsonValue json, const std::string& where, double scale) {
  if (json.kind() != JsonKind::list || json.size() < 3)
    return refuse(where, "a list of at least three points is needed");
  std::vector<Point> points;
  for (const JsonValue item : json) {
    LEKALO_TRY(const auto point, place_of(item, fmt::format("{}[{}]", where, points.size()), scale));
    points.push_back(point);
  }
  return finished_as_drawn(ring(points), {}, where);
}

Made read_drawn_region(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"outer", "holes", "islands"}));
  LEKALO_TRY(auto region, read_region(json, where, scale));
  return finished_as_drawn(std::move(region.outer), std::move(region.holes), where);
}

Made read_half_plane(JsonValue json, const std::string& where, double scale) {
  LEKALO_CHECK(expect_object(json, where, {"from", "to"}));
  LEKALO_TRY(const auto from, read_place(json, where, "from", scale));
  LEKALO_TRY(const auto to, read_place(json, where, "to", scale));
  const double largest = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
  if (!(norm(to - from) > kLeastOfDirection * largest))
    return refuse(where, "\"from\" and \"to\" are too near each other to give a direction");
  ShapeNode node;
  node.kind = ShapeKind::half_plane;
  node.where = where;
  node.half_plane = {from, to};
  node.error = kPrimitiveError * largest;
  return node;
}

using ReadPrimitive = Made (*)(JsonValue, const std::string&, double);
constexpr std::array<std::pair<std::string_view, ReadPrimitive>, 8> kPrimitives{{
    {"circle", read_circle},
    {"rectangle", read_rectangle},
    {"rounded_rectangle", read_rounded_rectangle},
    {"slot", read_slot},
    {"regular_polygon", read_regular_polygon},
    {"polygon", read_polygon},
    {"region", read_drawn_region},
    {"half_plane", read_half_plane},
}};

}  // namespace

bool is_primitive(std::string_view word) {
  return std::any_of(kPrimitives.begin(), kPrimitives.end(), [&](const auto& p) { return p.first == word; });
}

Result<ShapeNode> read_primitive(const std::string& word, JsonValue json, const std::string& where,
                                 double scale) {
  const auto found =
      std::find_if(kPrimitives.begin(), kPrimitives.end(), [&](const auto& p) { return p.first == word; });
  LEKALO_TRY(auto node, found->second(json, where, scale));
  node.extent = extent_of(node);
  return node;
}

}  // namespace lekalo::io::detail
