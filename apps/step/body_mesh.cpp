#include "body_mesh.hpp"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <limits>
#include <utility>

namespace lekalo::step {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A face's pieces of edges, in the numbers of its triangulation's nodes.
struct Along {
  int from = 0, to = 0;
  double first = 0, last = 0;
  Handle(Geom2d_Curve) curve;
  double tolerance = 0;
  std::size_t piece = 0;
};

}  // namespace

void BodyMesh::add(const TopoDS_Face& any) {
  const TopoDS_Face face = TopoDS::Face(any.Oriented(TopAbs_FORWARD));
  BoundedSurface surface = bounded(BRep_Tool::Surface(face));
  FaceRecord& record = records_.emplace_back();
  record.kind = surface.kind;
  record.deviation = kInfinite;
  reversed_.push_back(any.Orientation() == TopAbs_REVERSED);
  const bool is_known = surface.bound != nullptr;
  FaceMesh& mesh = meshes_.emplace_back(std::move(surface.bound));
  record.fault = is_known ? fault_of(face, mesh) : "this is an " + surface.kind;
}

/// Fills the mesh of a face.
std::string BodyMesh::fault_of(const TopoDS_Face& face, FaceMesh& mesh) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(face, place);
  if (triangulation.IsNull() || triangulation->NbTriangles() == 0 || !triangulation->HasUVNodes())
    return "OCCT makes no triangles of it";

  const auto count = static_cast<std::size_t>(triangulation->NbNodes());
  std::vector<std::uint32_t> ids(count + 1, kNoVertex);
  const auto number_node = [&](int node, std::uint32_t& shared) {
    if (shared == kNoVertex) {
      shared = ids[static_cast<std::size_t>(node)];
      if (shared == kNoVertex) {
        const gp_Pnt p = triangulation->Node(node).Transformed(place.Transformation());
        shared = static_cast<std::uint32_t>(places_.size());
        places_.push_back({p.X(), p.Y(), p.Z()});
      }
    }
    ids[static_cast<std::size_t>(node)] = shared;
  };

  std::vector<Along> borders;
  for (TopExp_Explorer each(face, TopAbs_EDGE); each.More(); each.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(each.Current());
    if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
    const Handle(Poly_PolygonOnTriangulation) polygon =
        BRep_Tool::PolygonOnTriangulation(edge, triangulation, place);
    double first = 0, last = 0;
    Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (polygon.IsNull() || !polygon->HasParameters() || curve.IsNull())
      return "OCCT does not say which of its triangles are along an edge";
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
      along_edges_.push_back(
          {std::vector<std::uint32_t>(static_cast<std::size_t>(nodes), kNoVertex), pieces_.size()});
      pieces_.resize(pieces_.size() + static_cast<std::size_t>(nodes - 1), Piece{.is_point = is_point});
    }
    Edge& along = along_edges_[static_cast<std::size_t>(edges_.Find(forward))];
    if (along.vertices.size() != static_cast<std::size_t>(nodes)) return "OCCT divides an edge in two ways";
    const auto at_vertex = [&](const TopoDS_Vertex& vertex, int node) {
      std::uint32_t shared =
          vertices_.IsBound(vertex) ? static_cast<std::uint32_t>(vertices_.Find(vertex)) : kNoVertex;
      number_node(node, shared);
      if (!vertices_.IsBound(vertex)) vertices_.Bind(vertex, static_cast<int>(shared));
    };
    const TopoDS_Vertex begin = TopExp::FirstVertex(forward), end = TopExp::LastVertex(forward);
    for (int k = 1; k <= nodes; ++k) {
      const int node = polygon->Node(k);
      if (is_point || (k == 1 && !begin.IsNull())) {
        at_vertex(begin, node);
      } else if (k == nodes && !end.IsNull()) {
        at_vertex(end, node);
      } else {
        number_node(node, along.vertices[static_cast<std::size_t>(k - 1)]);
      }
      if (k > 1)
        borders.push_back({polygon->Node(k - 1), node, polygon->Parameter(k - 1), polygon->Parameter(k),
                           curve, BRep_Tool::Tolerance(edge),
                           along.first_piece + static_cast<std::size_t>(k - 2)});
    }
  }
  std::vector<int> nodes(count + 1, 0);
  for (std::size_t node = 1; node <= count; ++node) {
    std::uint32_t own = kNoVertex;
    if (ids[node] == kNoVertex) number_node(static_cast<int>(node), own);
    nodes[node] = mesh.add_node(triangulation->UVNode(static_cast<int>(node)), ids[node], places_);
  }
  for (int t = 1; t <= triangulation->NbTriangles(); ++t) {
    int a = 0, b = 0, c = 0;
    triangulation->Triangle(t).Get(a, b, c);
    mesh.add_triangle({nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)],
                       nodes[static_cast<std::size_t>(c)]});
  }
  for (const Along& border : borders)
    mesh.add_border(nodes[static_cast<std::size_t>(border.from)], nodes[static_cast<std::size_t>(border.to)],
                    border.first, border.last, border.curve, border.tolerance, border.piece);
  return mesh.is_closed() ? "" : "OCCT's triangles do not reach all of its border";
}

void BodyMesh::refine(double asked, std::size_t most) {
  // Each round halves lengths, and deviations become a quarter.
  constexpr int kMostRounds = 24;
  for (int round = 0; round < kMostRounds && triangle_count() < most; ++round) {
    bool any = false;
    for (std::size_t k = 0; k < meshes_.size(); ++k)
      if (records_[k].fault.empty()) any = meshes_[k].mark(asked, places_, pieces_) || any;
    if (!any) break;
    for (std::size_t k = 0; k < meshes_.size(); ++k)
      if (records_[k].fault.empty()) meshes_[k].divide(places_, pieces_);
  }
}

void BodyMesh::bound() {
  for (std::size_t k = 0; k < meshes_.size(); ++k) {
    if (!records_[k].fault.empty()) continue;
    records_[k].deviation = meshes_[k].deviation(places_);
    if (meshes_[k].has_bad_border())
      records_[k].fault = "an edge of it is a curve with a weight that is not above 0";
  }
}

std::size_t BodyMesh::triangle_count() const {
  std::size_t count = 0;
  for (const FaceMesh& mesh : meshes_) count += mesh.count();
  return count;
}

std::pair<solid::Mesh, std::vector<std::uint32_t>> BodyMesh::mesh() const {
  std::pair<solid::Mesh, std::vector<std::uint32_t>> made;
  made.first.vertices = places_;
  for (std::size_t face = 0; face < meshes_.size(); ++face)
    for (std::size_t t = 0; t < meshes_[face].count(); ++t) {
      auto [a, b, c] = meshes_[face].vertices_of(t);
      if (a == b || b == c || c == a) continue;
      if (reversed_[face]) std::swap(b, c);
      made.first.triangles.push_back({a, b, c});
      made.second.push_back(static_cast<std::uint32_t>(face));
    }
  return made;
}

}  // namespace lekalo::step
