#include "face_mesh.hpp"

#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomLib.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Vec2d.hxx>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

namespace lekalo::step {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Control points of shorter pieces are nearer to the curve.
constexpr int kPieces = 8;

Handle(Geom2d_Curve) untrimmed(Handle(Geom2d_Curve) curve) {
  while (true) {
    const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve);
    if (trimmed.IsNull()) return curve;
    curve = trimmed->BasisCurve();
  }
}

/// The patches of a curve whose parameters they keep: of a spline.
std::shared_ptr<const Patches> patches_of(const Handle(Geom2d_Curve) & any) {
  const Handle(Geom2d_Curve) curve = untrimmed(any);
  if (Handle(Geom2d_BSplineCurve)::DownCast(curve).IsNull()) return nullptr;
  const auto spline = Handle(Geom_BSplineCurve)::DownCast(GeomLib::To3d(gp_Ax2(), curve));
  return spline.IsNull() ? nullptr : std::make_shared<const Patches>(spline);
}

/// Points whose convex hull holds a curve from one parameter to another; the first and the last are its ends.
/// Nothing where a weight is not above 0.
std::vector<gp_Pnt2d> hull_of(const Handle(Geom2d_Curve) & any, double from, double to,
                              const std::shared_ptr<const Patches>& patches) {
  const Handle(Geom2d_Curve) curve = untrimmed(any);
  std::vector<gp_Pnt2d> hull{curve->Value(from)};
  const gp_Pnt2d end = curve->Value(to);
  if (patches != nullptr) {
    for (int k = 0; k < kPieces; ++k) {
      const auto at = [&](int piece) { return from + (to - from) * piece / kPieces; };
      const std::vector<gp_XYZ> points =
          patches->hull({std::min(at(k), at(k + 1)), std::max(at(k), at(k + 1))});
      if (points.empty()) return {};
      for (const gp_XYZ& p : points) hull.emplace_back(p.X(), p.Y());
    }
  } else if (Handle(Geom2d_Line)::DownCast(curve).IsNull()) {
    Handle(Geom2d_BSplineCurve) spline =
        Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(curve, from, to));
    const double first = spline->FirstParameter(), last = spline->LastParameter();
    for (int k = 1; k < kPieces; ++k) spline->InsertKnot(first + (last - first) * k / kPieces);
    for (int k = 1; k <= spline->NbPoles(); ++k) {
      if (!(spline->Weight(k) > 0)) return {};
      hull.push_back(spline->Pole(k));
    }
  }
  hull.push_back(end);
  return hull;
}

std::uint64_t key(const std::pair<int, int>& side) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(side.first)) << 32 |
         static_cast<std::uint32_t>(side.second);
}

gp_Pnt point(const solid::Vector& p) { return {p.x, p.y, p.z}; }

}  // namespace

int FaceMesh::add_node(const gp_Pnt2d& at, std::uint32_t vertex, const Vertices& vertices) {
  const int number = static_cast<int>(nodes_.size());
  Node node{at, vertex, number};
  if (surface_->free_at({point(vertices[vertex]), at}) != SurfaceBound::Free::none)
    node.same = free_nodes_.try_emplace(vertex, number).first->second;
  nodes_.push_back(node);
  return number;
}

void FaceMesh::add_triangle(const std::array<int, 3>& nodes) {
  std::array<int, 3> same{};
  for (std::size_t k = 0; k < 3; ++k) same[k] = nodes_[static_cast<std::size_t>(nodes[k])].same;
  // Between two nodes of one point it stands for nothing.
  if (same[0] != same[1] && same[1] != same[2] && same[2] != same[0])
    triangles_.push_back({nodes, kUnknown, {}});
}

void FaceMesh::add_border(int from, int to, double first, double last, const Handle(Geom2d_Curve) & curve,
                          double tolerance, std::size_t piece) {
  const bool is_known = !borders_.empty() && borders_.back().curve == curve;
  borders_.push_back({from,
                      to,
                      first,
                      last,
                      curve,
                      is_known ? borders_.back().spline : patches_of(curve),
                      tolerance,
                      piece,
                      kUnknown,
                      {}});
}

FaceMesh::Side FaceMesh::side(int a, int b) const {
  return std::minmax(nodes_[static_cast<std::size_t>(a)].same, nodes_[static_cast<std::size_t>(b)].same);
}

Corner FaceMesh::corner(int node, const Vertices& vertices) const {
  const Node& at = nodes_[static_cast<std::size_t>(node)];
  return {point(vertices[at.vertex]), at.at};
}

std::array<Corner, 3> FaceMesh::corners(const Triangle& triangle, const Vertices& vertices) const {
  return {corner(triangle.nodes[0], vertices), corner(triangle.nodes[1], vertices),
          corner(triangle.nodes[2], vertices)};
}

std::array<std::uint32_t, 3> FaceMesh::vertices_of(std::size_t triangle) const {
  std::array<std::uint32_t, 3> made{};
  for (std::size_t k = 0; k < 3; ++k)
    made[k] = nodes_[static_cast<std::size_t>(triangles_[triangle].nodes[k])].vertex;
  return made;
}

/// A side that is met an odd number of times, by triangles and by borders, would leave a gap.
bool FaceMesh::is_closed() const {
  std::vector<Side> met;
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) met.push_back(side(t.nodes[k], t.nodes[(k + 1) % 3]));
  for (const Border& border : borders_)
    if (const Side one = side(border.from, border.to); one.first != one.second) met.push_back(one);
  std::sort(met.begin(), met.end());
  for (std::size_t k = 0; k < met.size(); k += 2)
    if (k + 1 == met.size() || met[k] != met[k + 1]) return false;
  return true;
}

/// Triangles that are folded over each other in the plane of parameters could reach beyond the border, and
/// back.
bool FaceMesh::is_fold_free(const Vertices& vertices) const {
  bool turns_left = false, turns_right = false;
  for (const Triangle& triangle : triangles_) {
    const std::array<Corner, 3> at = corners(triangle, vertices);
    std::array<gp_Pnt2d, 3> p{at[0].at, at[1].at, at[2].at};
    for (std::size_t k = 0; k < 3; ++k) {
      const gp_Pnt2d &a = at[(k + 1) % 3].at, &b = at[(k + 2) % 3].at;
      const SurfaceBound::Free free = surface_->free_at(at[k]);
      if (free == SurfaceBound::Free::u) p[k].SetX(0.5 * (a.X() + b.X()));
      if (free == SurfaceBound::Free::v) p[k].SetY(0.5 * (a.Y() + b.Y()));
    }
    const gp_Vec2d b(p[0], p[1]), c(p[0], p[2]);
    constexpr double kFlat = 1e-9;
    const double twice_area = b.Crossed(c), flat = kFlat * b.Magnitude() * c.Magnitude();
    turns_left = turns_left || twice_area > flat, turns_right = turns_right || twice_area < -flat;
  }
  return !(turns_left && turns_right);
}

void FaceMesh::bound_borders(const Vertices& vertices) {
  for (Border& border : borders_) {
    if (border.bound != kUnknown) continue;
    const std::vector<gp_Pnt2d> hull = hull_of(border.curve, border.first, border.last, border.spline);
    bad_border_ = bad_border_ || hull.empty();
    border.bound =
        hull.empty() ? kInfinite
                     : surface_->of_border(corner(border.from, vertices), corner(border.to, vertices), hull);
    border.progress.note(border.bound);
  }
}

/// The sides whose middles are farthest from the surface; the longest one where none is far.
void FaceMesh::mark_triangle(const Triangle& triangle, double most, const Vertices& vertices) {
  const std::array<Corner, 3> at = corners(triangle, vertices);
  std::array<double, 3> off{}, length{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &a = at[k], &b = at[(k + 1) % 3];
    const gp_Pnt middle(0.5 * (a.place.XYZ() + b.place.XYZ()));
    off[k] = middle.Distance(surface_->value(surface_->middle(a, b)));
    length[k] = a.place.Distance(b.place);
  }
  const double farthest = *std::max_element(off.begin(), off.end());
  constexpr double kFar = 0.5;
  const bool is_far = farthest > kFar * most;
  const auto longest =
      static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  for (std::size_t k = 0; k < 3; ++k)
    if (is_far ? off[k] > std::max(kFar * most, kFar * farthest) : k == longest)
      marks_.push_back(side(triangle.nodes[k], triangle.nodes[(k + 1) % 3]));
}

bool FaceMesh::mark(double asked, const Vertices& vertices, std::vector<Piece>& pieces) {
  marks_.clear();
  bound_borders(vertices);
  double of_borders = 0;
  for (const Border& border : borders_) of_borders = std::max(of_borders, border.bound + border.tolerance);
  // Borders are divided at less cost, so that they leave most of it to the triangles; and all of it where a
  // plane needs none.
  constexpr double kBorders = 0.25;
  const double most = std::max((1 - kBorders) * asked, asked - of_borders);
  double of_triangles = 0;
  for (Triangle& triangle : triangles_) {
    if (triangle.bound == kUnknown) {
      triangle.bound = surface_->of_triangle(corners(triangle, vertices), most);
      triangle.progress.note(triangle.bound);
    }
    of_triangles = std::max(of_triangles, triangle.bound);
  }
  // A triangle is divided by one of its sides at a time, and its bound may need two of them.
  constexpr int kMostInVain = 6, kMostOfBorder = 3;
  for (const Triangle& triangle : triangles_)
    if (triangle.bound > most && triangle.progress.in_vain < kMostInVain)
      mark_triangle(triangle, most, vertices);
  // The tolerance that the file states of an edge is not made less by halves.
  constexpr double kSteep = 3, kLittle = 0.05;
  const double most_of_borders = std::max(kBorders * asked, asked - kSteep * of_triangles);
  for (const Border& border : borders_) {
    const Side one = side(border.from, border.to);
    if (border.bound + border.tolerance > most_of_borders && border.bound > kLittle * asked &&
        border.progress.in_vain < kMostOfBorder && one.first != one.second)
      marks_.push_back(one);
  }
  std::sort(marks_.begin(), marks_.end());
  marks_.erase(std::unique(marks_.begin(), marks_.end()), marks_.end());
  for (const Border& border : borders_)
    if (std::binary_search(marks_.begin(), marks_.end(), side(border.from, border.to)))
      pieces[border.piece].divided = true;
  return !marks_.empty();
}

void FaceMesh::divide(Vertices& vertices, std::vector<Piece>& pieces) {
  std::unordered_map<std::uint64_t, int> middles;
  const std::size_t borders = borders_.size();
  for (std::size_t k = 0; k < borders; ++k) {
    const Border border = borders_[k];
    if (!pieces[border.piece].divided) continue;
    const double middle = 0.5 * (border.first + border.last);
    const gp_Pnt2d at = border.curve->Value(middle);
    if (pieces[border.piece].middle == kNoVertex) {
      const bool is_point = pieces[border.piece].is_point;
      pieces[border.piece].middle = is_point ? nodes_[static_cast<std::size_t>(border.from)].vertex
                                             : static_cast<std::uint32_t>(vertices.size());
      pieces[border.piece].first_half = pieces.size();
      const gp_Pnt place = surface_->value(at);
      if (!is_point) vertices.push_back({place.X(), place.Y(), place.Z()});
      pieces.resize(pieces.size() + 2, Piece{.is_point = is_point});
    }
    const Piece& piece = pieces[border.piece];
    const std::uint64_t at_side = key(side(border.from, border.to));
    const auto known = middles.find(at_side);
    const int node = known != middles.end() ? known->second : add_node(at, piece.middle, vertices);
    middles.emplace(at_side, node);
    const Progress progress = border.progress.of_half(border.bound);
    borders_[k] = {border.from,  node,          border.first,     middle,
                   border.curve, border.spline, border.tolerance, piece.first_half,
                   kUnknown,     progress};
    borders_.push_back({node, border.to, middle, border.last, border.curve, border.spline, border.tolerance,
                        piece.first_half + 1, kUnknown, progress});
  }
  for (const Side& one : marks_) {
    if (middles.contains(key(one))) continue;
    const gp_Pnt2d at = surface_->middle(corner(one.first, vertices), corner(one.second, vertices));
    const gp_Pnt place = surface_->value(at);
    vertices.push_back({place.X(), place.Y(), place.Z()});
    middles.emplace(key(one), add_node(at, static_cast<std::uint32_t>(vertices.size() - 1), vertices));
  }
  marks_.clear();
  if (!middles.empty()) divide_triangles(middles, vertices);
}

void FaceMesh::divide_triangles(const std::unordered_map<std::uint64_t, int>& middles,
                                const Vertices& vertices) {
  const std::size_t count = triangles_.size();
  for (std::size_t t = 0; t < count; ++t) {
    std::array<int, 3> n = triangles_[t].nodes, m{-1, -1, -1};  // m[k] is in the middle of n[k] and the next
    int divided = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto found = middles.find(key(side(n[k], n[(k + 1) % 3]))); found != middles.end())
        m[k] = found->second, ++divided;
    if (divided == 0) continue;
    const auto turn = [&] {
      std::rotate(n.begin(), n.begin() + 1, n.end()), std::rotate(m.begin(), m.begin() + 1, m.end());
    };
    std::vector<std::array<int, 3>> made;
    if (divided == 1) {
      while (m[0] < 0) turn();
      made = {{n[0], m[0], n[2]}, {m[0], n[1], n[2]}};
    } else if (divided == 2) {
      while (m[2] >= 0) turn();
      // The corner between both, and the rest along its shorter diagonal.
      made = {{m[0], n[1], m[1]}};
      const auto far = [&](int a, int b) {
        return corner(a, vertices).place.SquareDistance(corner(b, vertices).place);
      };
      if (far(n[0], m[1]) <= far(m[0], n[2])) {
        made.insert(made.end(), {{n[0], m[0], m[1]}, {n[0], m[1], n[2]}});
      } else {
        made.insert(made.end(), {{n[0], m[0], n[2]}, {m[0], m[1], n[2]}});
      }
    } else {
      made = {{n[0], m[0], m[2]}, {m[0], n[1], m[1]}, {m[2], m[1], n[2]}, {m[0], m[1], m[2]}};
    }
    const Progress progress = triangles_[t].progress.of_half(triangles_[t].bound);
    triangles_[t] = {made[0], kUnknown, progress};
    for (std::size_t k = 1; k < made.size(); ++k) triangles_.push_back({made[k], kUnknown, progress});
  }
}

/// The farthest triangle is bounded as nearly as can be, and the others only as far as they might be farther.
double FaceMesh::deviation(const Vertices& vertices) {
  bound_borders(vertices);
  if (!is_fold_free(vertices)) return kInfinite;
  double of_borders = 0, of_triangles = 0;
  for (const Border& border : borders_) of_borders = std::max(of_borders, border.bound + border.tolerance);
  for (Triangle& triangle : triangles_)
    if (triangle.bound == kUnknown)
      triangle.bound = surface_->of_triangle(corners(triangle, vertices), kInfinite);
  std::vector<std::size_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return triangles_[a].bound > triangles_[b].bound || (triangles_[a].bound == triangles_[b].bound && a < b);
  });
  for (const std::size_t t : order) {
    Triangle& triangle = triangles_[t];
    if (triangle.bound <= of_triangles) break;
    triangle.bound = surface_->of_triangle(corners(triangle, vertices), of_triangles);
    of_triangles = std::max(of_triangles, triangle.bound);
  }
  return of_triangles + of_borders;
}

}  // namespace lekalo::step
