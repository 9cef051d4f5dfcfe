#include "touching_ends.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lekalo/base/disjoint_sets.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/curve_faces.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "near_edges.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::Point;

/// An end goes this far over the line that it lies on, mm, so that rounding leaves no gap between them.
constexpr double kOver = 1e-5;

/// An end of a line, and the place of another edge on which it lies.
struct Touch {
  std::uint32_t line = 0, host = 0;
  bool last = false;
  Edge over;  ///< from the end across the other edge
  double distance = 0;
};

const Edge& end_edge(const OpenLine& line, bool last) {
  return last ? line.edges.back() : line.edges.front();
}

/// From the end of an edge to the far side of the curve near which it lies.
Edge way_over(const Edge& edge, bool last, const geom::Curve& host, Point nearest) {
  const Point end = last ? edge.to : edge.from;
  const Point radial = nearest - host.edge.centre;
  Point normal =
      host.edge.kind == geom::EdgeKind::line ? Point{-host.unit.y, host.unit.x} : (1 / norm(radial)) * radial;
  if (dot(normal, bisected(edge).middle - nearest) > 0) normal = -1.0 * normal;
  return {geom::EdgeKind::line, end, nearest + kOver * normal, {}};
}

std::vector<Touch> touches_of(const std::vector<OpenLine>& lines, double reach) {
  std::vector<geom::Curve> curves;
  std::vector<geom::Box> boxes;
  std::vector<std::pair<std::uint32_t, std::size_t>> owner;  // line, and edge in it
  for (std::uint32_t i = 0; i < lines.size(); ++i)
    for (std::size_t k = 0; k < lines[i].edges.size(); ++k) {
      curves.push_back(geom::make_curve(lines[i].edges[k]));
      boxes.push_back(curve_box(curves.back()));
      owner.emplace_back(i, k);
    }
  std::size_t left = limits::most_meeting_boxes(boxes.size());
  const geom::BoxTree tree(boxes);
  std::vector<Touch> touches;
  for (std::uint32_t i = 0; i < lines.size(); ++i)
    for (const bool last : {false, true}) {
      const Edge& edge = end_edge(lines[i], last);
      const Point end = last ? edge.to : edge.from;
      const std::size_t own = last ? lines[i].edges.size() - 1 : 0;
      std::optional<std::uint32_t> host;
      double nearest = 0;
      const geom::Box around = geom::grown({end, end}, reach);
      const bool whole = tree.visit_meeting_while(around, [&](std::uint32_t e) {
        if (left-- == 0) return false;
        ask();
        const auto& [line, number] = owner[e];
        if (lines[line].layers[number] != lines[i].layers[own] || (line == i && number == own)) return true;
        const double distance = norm(nearest_on(curves[e], end) - end);
        if (distance <= reach && (!host || distance < nearest || (distance == nearest && e < *host)))
          host = e, nearest = distance;
        return true;
      });
      if (!whole) return {};
      if (!host) continue;
      const geom::Curve& curve = curves[*host];
      touches.push_back(
          {i, owner[*host].first, last, way_over(edge, last, curve, nearest_on(curve, end)), nearest});
    }
  return touches;
}

}  // namespace

std::vector<TouchingLines> touching_lines(const std::vector<OpenLine>& lines, double reach, double smallest) {
  const std::vector<Touch> touches = touches_of(lines, reach);
  DisjointSets sets(lines.size());
  std::vector<char> touching(lines.size(), 0);
  for (const Touch& one : touches) {
    sets.join(one.line, one.host);
    touching[one.line] = touching[one.host] = 1;
  }
  std::vector<TouchingLines> groups;
  std::vector<std::size_t> group_of(lines.size());
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (touching[i] == 0) continue;
    if (sets.of(i) == i) group_of[i] = groups.size(), groups.emplace_back();
    groups[group_of[sets.of(i)]].lines.push_back(i);
  }
  std::vector<std::vector<const Touch*>> of_group(groups.size());
  for (const Touch& one : touches) of_group[group_of[sets.of(one.line)]].push_back(&one);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    TouchingLines& group = groups[g];
    std::vector<Edge> edges;
    std::vector<std::uint32_t> curves;
    for (const std::uint32_t i : group.lines) {
      const OpenLine& line = lines[i];
      for (std::size_t k = 0; k < line.edges.size(); ++k) {
        if (k > 0 && !(line.edges[k - 1].to == line.edges[k].from)) {
          edges.push_back({geom::EdgeKind::line, line.edges[k - 1].to, line.edges[k].from, {}});
          curves.push_back(line.curves[k]);
        }
        edges.push_back(line.edges[k]);
        curves.push_back(line.curves[k]);
      }
    }
    const std::size_t drawn = edges.size();
    for (const Touch* one : of_group[g]) {
      edges.push_back(one->over);
      curves.push_back(one->last ? lines[one->line].curves.back() : lines[one->line].curves.front());
    }
    const auto faces = geom::faces_between(edges);
    if (!faces) continue;
    const bool encloses = std::any_of(faces->contours.begin(), faces->contours.end(), [&](const auto& face) {
      const geom::Box box = geom::bounds(face.contour);
      return norm(box.high - box.low) > smallest;
    });
    if (!encloses || !(faces->corner_error <= smallest / 2)) continue;
    for (const geom::CutContour& face : faces->contours) {
      LooseContour& contour = group.contours.emplace_back(LooseContour{face.contour, {}});
      for (const std::uint32_t origin : face.origins) contour.curves.push_back(curves[origin]);
    }
    for (const Touch* one : of_group[g])
      group.moved.push_back({one->last ? lines[one->line].curves.back() : lines[one->line].curves.front(),
                             std::max(one->distance, faces->corner_error)});
    for (const geom::CutEdge& one : faces->left) {
      // Behind the line there may be a rest of the way over it, and of an end that was drawn past it.
      if (one.origin >= drawn) continue;
      group.left.push_back({one.edge, curves[one.origin]});
    }
  }
  std::erase_if(groups, [](const TouchingLines& group) { return group.contours.empty(); });
  return groups;
}

}  // namespace lekalo::io
