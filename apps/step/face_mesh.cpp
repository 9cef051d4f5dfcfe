#include "face_mesh.hpp"

#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <gp_Vec2d.hxx>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "surface_bound.hpp"

namespace lekalo::step {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Points whose convex hull holds a curve from one parameter to another; the first and the last are its ends.
std::vector<gp_Pnt2d> hull_of(Handle(Geom2d_Curve) curve, double from, double to) {
  const gp_Pnt2d begin = curve->Value(from), end = curve->Value(to);
  while (true) {
    const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve);
    if (trimmed.IsNull()) break;
    curve = trimmed->BasisCurve();
  }
  if (!Handle(Geom2d_Line)::DownCast(curve).IsNull()) return {begin, end};
  Handle(Geom2d_BSplineCurve) spline =
      Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(curve, from, to));
  // Control points of shorter pieces are nearer to the curve.
  constexpr int kPieces = 8;
  const double first = spline->FirstParameter(), last = spline->LastParameter();
  for (int k = 1; k < kPieces; ++k) spline->InsertKnot(first + (last - first) * k / kPieces);
  std::vector<gp_Pnt2d> hull{begin};
  for (int k = 1; k <= spline->NbPoles(); ++k) hull.push_back(spline->Pole(k));
  for (int k = 1; k <= spline->NbPoles(); ++k)
    if (!(spline->Weight(k) > 0)) return {};
  hull.push_back(end);
  return hull;
}

/// A side of a triangle on the border of its face, and the edge that it stands for.
struct Border {
  int from = 0, to = 0;
  double first = 0, last = 0;
  Handle(Geom2d_Curve) curve;
  double tolerance = 0;
};

}  // namespace

FaceRecord MeshBuilder::add(const TopoDS_Face& any) {
  FaceRecord record;
  const std::uint32_t number = face_++;
  const TopoDS_Face face = TopoDS::Face(any.Oriented(TopAbs_FORWARD));
  const BoundedSurface surface = bounded(BRep_Tool::Surface(face));
  record.kind = surface.kind;
  record.deviation = kInfinite;
  if (!surface.bound) {
    record.fault = "this is an " + surface.kind;
    return record;
  }
  TopLoc_Location place;
  const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(face, place);
  if (triangulation.IsNull() || triangulation->NbTriangles() == 0 || !triangulation->HasUVNodes()) {
    record.fault = "OCCT makes no triangles of it";
    return record;
  }

  const auto count = static_cast<std::size_t>(triangulation->NbNodes());
  std::vector<std::uint32_t> ids(count + 1, kNone);
  const auto number_node = [&](int node, std::uint32_t& shared) {
    if (shared == kNone) {
      shared = ids[static_cast<std::size_t>(node)];
      if (shared == kNone) {
        const gp_Pnt p = triangulation->Node(node).Transformed(place.Transformation());
        shared = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back({p.X(), p.Y(), p.Z()});
      }
    }
    ids[static_cast<std::size_t>(node)] = shared;
  };

  std::vector<Border> borders;
  // Nodes of an edge that is one point, as a pole of a sphere; where there are several they are one of them.
  std::vector<int> at_point(count + 1, 0);
  for (TopExp_Explorer each(face, TopAbs_EDGE); each.More(); each.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(each.Current());
    if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
    const Handle(Poly_PolygonOnTriangulation) polygon =
        BRep_Tool::PolygonOnTriangulation(edge, triangulation, place);
    double first = 0, last = 0;
    Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (polygon.IsNull() || !polygon->HasParameters() || curve.IsNull()) {
      record.fault = "OCCT does not say which of its triangles are along an edge";
      return record;
    }
    // A seam has two curves: the one whose parameters the nodes have.
    const auto off = [&](const Handle(Geom2d_Curve) & one) {
      return one->Value(polygon->Parameter(1)).Distance(triangulation->UVNode(polygon->Node(1)));
    };
    const Handle(Geom2d_Curve) other =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), face, first, last);
    if (!other.IsNull() && off(other) < off(curve)) curve = other;
    const int nodes = polygon->NbNodes();
    const TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
    const bool is_point = BRep_Tool::Degenerated(edge);
    if (!edges_.IsBound(forward)) {
      edges_.Bind(forward, static_cast<int>(along_edges_.size()));
      along_edges_.emplace_back(static_cast<std::size_t>(nodes), kNone);
    }
    std::vector<std::uint32_t>& along = along_edges_[static_cast<std::size_t>(edges_.Find(forward))];
    if (!is_point && along.size() != static_cast<std::size_t>(nodes)) {
      record.fault = "OCCT divides an edge in two ways";
      return record;
    }
    const auto at_vertex = [&](const TopoDS_Vertex& vertex, int node) {
      std::uint32_t shared =
          vertices_.IsBound(vertex) ? static_cast<std::uint32_t>(vertices_.Find(vertex)) : kNone;
      number_node(node, shared);
      if (!vertices_.IsBound(vertex)) vertices_.Bind(vertex, static_cast<int>(shared));
    };
    const TopoDS_Vertex begin = TopExp::FirstVertex(forward), end = TopExp::LastVertex(forward);
    for (int k = 1; k <= nodes; ++k) {
      const int node = polygon->Node(k);
      if (is_point) at_point[static_cast<std::size_t>(node)] = polygon->Node(1);
      if (is_point || (k == 1 && !begin.IsNull())) {
        at_vertex(begin, node);
      } else if (k == nodes && !end.IsNull()) {
        at_vertex(end, node);
      } else {
        number_node(node, along[static_cast<std::size_t>(k - 1)]);
      }
      if (k > 1)
        borders.push_back({polygon->Node(k - 1), node, polygon->Parameter(k - 1), polygon->Parameter(k),
                           curve, BRep_Tool::Tolerance(edge)});
    }
  }
  for (std::size_t node = 1; node <= count; ++node) {
    std::uint32_t own = kNone;
    if (ids[node] == kNone) number_node(static_cast<int>(node), own);
  }

  const auto corner = [&](int node) {
    const solid::Vector p = mesh_.vertices[ids[static_cast<std::size_t>(node)]];
    return Corner{gp_Pnt(p.x, p.y, p.z), triangulation->UVNode(node)};
  };
  // A side that is met an odd number of times, by triangles and by borders, would leave a gap.
  std::set<std::pair<int, int>> odd;
  const auto one_of_point = [&](int node) {
    const int first = at_point[static_cast<std::size_t>(node)];
    return first == 0 ? node : first;
  };
  const auto meet = [&](int a, int b) {
    a = one_of_point(a), b = one_of_point(b);
    if (a == b) return;
    const std::pair<int, int> side = std::minmax(a, b);
    if (!odd.erase(side)) odd.insert(side);
  };
  double of_triangles = 0, of_borders = 0;
  bool turns_left = false, turns_right = false;
  for (int t = 1; t <= triangulation->NbTriangles(); ++t) {
    int a = 0, b = 0, c = 0;
    triangulation->Triangle(t).Get(a, b, c);
    meet(a, b), meet(b, c), meet(c, a);
    const std::uint32_t ia = ids[static_cast<std::size_t>(a)], ib = ids[static_cast<std::size_t>(b)],
                        ic = ids[static_cast<std::size_t>(c)];
    const int pa = one_of_point(a), pb = one_of_point(b), pc = one_of_point(c);
    if (pa == pb || pb == pc || pc == pa) continue;
    const gp_Vec2d side_b(triangulation->UVNode(a), triangulation->UVNode(b)),
        side_c(triangulation->UVNode(a), triangulation->UVNode(c));
    constexpr double kFlat = 1e-9;
    const double twice_area = side_b.Crossed(side_c), flat = kFlat * side_b.Magnitude() * side_c.Magnitude();
    turns_left = turns_left || twice_area > flat, turns_right = turns_right || twice_area < -flat;
    of_triangles = std::max(of_triangles, surface.bound->of_triangle({corner(a), corner(b), corner(c)}));
    if (ia == ib || ib == ic || ic == ia) continue;
    if (any.Orientation() == TopAbs_REVERSED) {
      mesh_.triangles.push_back({ia, ic, ib});
    } else {
      mesh_.triangles.push_back({ia, ib, ic});
    }
    faces_.push_back(number);
  }
  for (const Border& border : borders) {
    meet(border.from, border.to);
    const std::vector<gp_Pnt2d> hull = hull_of(border.curve, border.first, border.last);
    if (hull.empty()) {
      record.fault = "an edge of it is a curve with a weight that is not above 0";
      return record;
    }
    of_borders = std::max(of_borders, surface.bound->of_border(corner(border.from), corner(border.to), hull) +
                                          border.tolerance);
  }
  if (!odd.empty()) {
    record.fault = "OCCT's triangles do not reach all of its border";
    return record;
  }
  // Triangles that are folded over each other could reach beyond the border, and back.
  if (turns_left && turns_right) return record;
  record.deviation = of_triangles + of_borders;
  return record;
}

}  // namespace lekalo::step
