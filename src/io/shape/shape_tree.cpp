#include "lekalo/io/shape/shape_tree.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/drawing/drawn_shapes.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "node.hpp"

namespace lekalo::io {

namespace detail {

using geom::BooleanOperation;
using geom::Box;
using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

namespace {

/// Points of curves move by no more than this many times what ends and centre do: an arc's point by its
/// centre's distance and by the change of the radius, which is at most twice that.
constexpr double kOutlinePerPoint = 3;

Contour rectangle(Point a, Point b, Point c, Point d) {
  return {{EdgeKind::line, a, b, {}},
          {EdgeKind::line, b, c, {}},
          {EdgeKind::line, c, d, {}},
          {EdgeKind::line, d, a, {}}};
}

/// The half-plane as a rectangle that covers its part of the window, one side on its edge; nothing where it
/// has no part of it.
Result<Evaluated> half_plane_in(const ShapeNode& node, const Box& window) {
  // Sides that are not the half-plane's edge must lie where nobody looks.
  const double size = std::max(window.high.x - window.low.x, window.high.y - window.low.y);
  const auto& [from, to] = node.half_plane;
  const double least = 1e-9 * std::max({largest_of(window), std::abs(from.x), std::abs(from.y)});
  const Box wide = grown(window, 0.25 * size + least);
  const Point centre = 0.5 * (wide.low + wide.high);
  const double reach = 0.5 * norm(wide.high - wide.low);
  const double length = norm(to - from);
  const Point along = (1 / length) * (to - from), left = perpendicular(along);
  const double inside = dot(left, centre - from), middle = dot(along, centre - from);
  Evaluated out;
  if (inside <= -reach) return out;
  Contour contour;
  if (inside >= reach) {
    contour = rectangle(wide.low, {wide.high.x, wide.low.y}, wide.high, {wide.low.x, wide.high.y});
  } else {
    const Point a = from + (middle - reach) * along, b = from + (middle + reach) * along;
    const Point width = (inside + reach) * left;
    contour = rectangle(a, b, b + width, a + width);
    out.sources.push_back({contour[0], node.name});
    // The two points' errors, as seen from the far end of the edge, and the rounding of a and b.
    const double far = std::abs(middle) + reach;
    out.edge_error = 2 * node.error * (1 + 2 * far / length) + 16 * kUnitRoundoff * (far + largest_of(wide));
  }
  auto region = geom::make_region(std::move(contour));
  if (!region) return refuse(node.where, region.error().message);
  out.regions.push_back(*std::move(region));
  return out;
}

/// Step 3 of docs/design/shape-tree.md: evaluates the tree bottom up, with one Boolean a node.
class Evaluator {
 public:
  explicit Evaluator(bool named) : named_(named) {}

  /// Regions whose part inside `window` is that of the node's shape; all of it where that is bounded.
  [[nodiscard]] Result<Evaluated> run(const ShapeNode& node, const Box& outer_window) const {
    if (node.extent.empty) return Evaluated{};
    const Box window = node.extent.bounded ? node.extent.box : outer_window;
    switch (node.kind) {
      case ShapeKind::half_plane:
        return half_plane_in(node, window);
      case ShapeKind::map:
        return mapped(node, window);
      case ShapeKind::unite:
        return run_all(node, 0, window).and_then([&](Evaluated all) {
          return combined(std::move(all), {}, BooleanOperation::unite, node);
        });
      case ShapeKind::intersect:
        return intersection(node, 0, node.children.size(), window);
      case ShapeKind::subtract: {
        LEKALO_TRY(auto first, run(node.children[0], window));
        if (node.children.size() == 1) return first;
        LEKALO_TRY(auto rest, run_all(node, 1, window));
        for (NamedEdge& source : rest.sources) source.edge = reversed(source.edge);
        return combined(std::move(first), std::move(rest), BooleanOperation::subtract, node);
      }
      case ShapeKind::primitive:
        break;
    }
    Evaluated out{node.regions, node.error, 1, {}};
    if (named_) {
      const auto add = [&](const Contour& contour) {
        for (const Edge& edge : contour) out.sources.push_back({edge, node.name});
      };
      add(node.regions[0].outer);
      for (const Contour& hole : node.regions[0].holes) add(hole);
    }
    return out;
  }

 private:
  /// The children from `first` on, beside each other; an operand counts as the union of its pieces.
  [[nodiscard]] Result<Evaluated> run_all(const ShapeNode& node, std::size_t first, const Box& window) const {
    Evaluated all;
    for (std::size_t i = first; i < node.children.size(); ++i) {
      LEKALO_TRY(auto one, run(node.children[i], window));
      append(all, std::move(one));
    }
    return all;
  }

  static void append(Evaluated& all, Evaluated&& one) {
    std::move(one.regions.begin(), one.regions.end(), std::back_inserter(all.regions));
    all.sources.insert(all.sources.end(), one.sources.begin(), one.sources.end());
    merge_errors(all, one);
  }

  /// The children of a range have in common what those of its halves have. One after the other, n half-planes
  /// would each cut an outline of up to n edges.
  [[nodiscard]] Result<Evaluated> intersection(const ShapeNode& node, std::size_t begin, std::size_t end,
                                               const Box& window) const {
    if (end - begin == 1) return run(node.children[begin], window);
    const std::size_t middle = end - (end - begin) / 2;
    LEKALO_TRY(auto first, intersection(node, begin, middle, window));
    LEKALO_TRY(auto second, intersection(node, middle, end, window));
    return combined(std::move(first), std::move(second), BooleanOperation::intersect, node);
  }

  [[nodiscard]] static Result<Evaluated> combined(Evaluated a, Evaluated b, BooleanOperation operation,
                                                  const ShapeNode& node) {
    if (operation == BooleanOperation::unite && a.regions.size() == 1) return a;
    merge_errors(b, a);
    auto result = geom::combine(a.regions, b.regions, operation, b.edge_error);
    if (!result) return refuse(node.where, result.error().message);
    Evaluated out{std::move(result->regions), result->edge_error, b.sharpness, {}};
    if (result->edge_error > 0)
      out.sharpness = std::max(out.sharpness, result->corner_error / result->edge_error);
    out.sources = std::move(a.sources);
    out.sources.insert(out.sources.end(), b.sources.begin(), b.sources.end());
    return out;
  }

  static void merge_errors(Evaluated& all, const Evaluated& one) {
    all.edge_error = std::max(all.edge_error, one.edge_error);
    all.sharpness = std::max(all.sharpness, one.sharpness);
  }

  [[nodiscard]] Result<Evaluated> mapped(const ShapeNode& node, const Box& window) const {
    const ShapeNode& child = node.children[0];
    LEKALO_TRY(const auto inner,
               run(child, child.extent.bounded ? child.extent.box : preimage(node.map, window)));
    std::vector<Region> regions;
    double largest = 0;
    double after = 0;
    for (const Region& region : inner.regions) {
      auto moved = image(node.map, region);
      if (!moved) return refuse(node.where, moved.error().message);
      largest = std::max(largest, largest_of(region));
      after = std::max(after, largest_of(*moved));
      regions.push_back(*std::move(moved));
    }
    const double rounding = kOutlinePerPoint * rounding_of(node.map, largest) + kShortest * after;
    Evaluated out{std::move(regions), node.map.factor * inner.edge_error + rounding, inner.sharpness, {}};
    for (const NamedEdge& source : inner.sources) {
      const Edge edge = image(node.map, source.edge);
      out.sources.push_back({node.map.mirrors ? reversed(edge) : edge, source.name});
    }
    return out;
  }

  bool named_;
};

/// The middle of an edge, and the direction it is run through there.
struct Middle {
  Point at, direction;
};
Middle middle_of(const Edge& edge) {
  const Point chord = edge.to - edge.from;
  if (edge.kind == EdgeKind::line) return {edge.from + 0.5 * chord, chord};
  const double radius = geom::arc_radius(edge), side = edge.kind == EdgeKind::arc_ccw ? 1 : -1;
  if (edge.from == edge.to)
    return {edge.centre - (edge.from - edge.centre), -side * perpendicular(edge.from - edge.centre)};
  // The ends' directions have two middles; the one on the arc's side of the chord is meant.
  const Point out = (-side / norm(chord)) * perpendicular(chord);
  return {edge.centre + radius * out, chord};
}

/// Distance from the line or the circle that carries the curve.
double off_carrier(const geom::Curve& curve, Point p) {
  if (curve.edge.kind == EdgeKind::line) return std::abs(cross(curve.unit, p - curve.edge.from));
  return std::abs(norm(p - curve.edge.centre) - curve.radius);
}

bool comes_from(const Edge& edge, const Middle& middle, const geom::Curve& source, double reach) {
  if (!(off_carrier(source, middle.at) <= reach && off_carrier(source, edge.from) <= reach &&
        off_carrier(source, edge.to) <= reach))
    return false;
  if (!(norm(nearest_on(source, middle.at) - middle.at) <= reach)) return false;
  Point direction = source.unit;
  if (source.edge.kind != EdgeKind::line) {
    const Point out = middle.at - source.edge.centre;
    direction = source.edge.kind == EdgeKind::arc_ccw ? perpendicular(out) : -perpendicular(out);
  }
  return dot(direction, middle.direction) > 0;
}

}  // namespace

Result<Evaluated> evaluate(const ShapeTree& tree) {
  const ShapeNode& root = tree.root;
  if (!root.extent.bounded) {
    return refuse(root.where,
                  "the shape has no end: half-planes bound only what something else bounds on the other "
                  "sides, within 1e9 mm; intersect it with a rectangle");
  }
  auto result = Evaluator(!tree.names.empty()).run(root, root.extent.box);
  if (result && result->regions.empty())
    return refuse(root.where,
                  "nothing is left of the shape; look for a difference that takes all, or an "
                  "intersection of shapes that do not meet");
  return result;
}

/// Step 4 of docs/design/shape-tree.md.
std::vector<std::uint32_t> names_of_edges(const Evaluated& shape) {
  // A primitive's edge is within its error of the exact one, and so is the result's.
  const double reach = 2 * shape.edge_error;
  std::vector<geom::Curve> sources;
  std::vector<Box> boxes;
  for (const NamedEdge& source : shape.sources) {
    sources.push_back(geom::make_curve(source.edge));
    boxes.push_back(grown(geom::curve_box(sources.back()), reach));
  }
  const geom::BoxTree tree(boxes);
  std::vector<std::uint32_t> names;
  const auto look = [&](const Contour& contour) {
    for (const Edge& edge : contour) {
      const Middle middle = middle_of(edge);
      std::optional<std::uint32_t> first;
      tree.visit_meeting({middle.at, middle.at}, [&](std::uint32_t s) {
        if ((!first || s < *first) && comes_from(edge, middle, sources[s], reach)) first = s;
      });
      names.push_back(first ? shape.sources[*first].name : kNoName);
    }
  };
  for (const Region& region : shape.regions) {
    look(region.outer);
    for (const Contour& hole : region.holes) look(hole);
  }
  return names;
}

}  // namespace detail

Result<ShapeFile> parse_shape_tree(std::string_view bytes, const std::string& name,
                                   std::optional<LengthUnit> unit) {
  using namespace detail;
  LEKALO_TRY(const auto document, JsonTree::parse(bytes, name, kDeepestShapeJson));
  const JsonValue root = document.root();
  LEKALO_CHECK(expect_object(root, name, {"name", "source", "units", "shape"}));
  LEKALO_TRY(const auto file_unit, unit_of(root, name, unit));
  const auto said = root.find("shape");
  if (!said) return refuse(name, "\"shape\", the tree of shapes, is missing");
  LEKALO_TRY(auto tree, read_shape_tree(*said, name + ": shape", millimetres_per(file_unit)));
  LEKALO_TRY(auto shape, evaluate(tree));
  ShapeFile file{name, file_unit, {}, shape.sharpness * shape.edge_error, std::move(tree.names), {}};
  file.name_of_edge = names_of_edges(shape);
  file.regions = std::move(shape.regions);
  return file;
}

}  // namespace lekalo::io
