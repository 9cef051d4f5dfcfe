#pragma once

#include <Geom2d_Curve.hxx>
#include <array>
#include <cstdint>
#include <gp_Pnt2d.hxx>
#include <limits>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lekalo/solid/mesh.hpp"
#include "patches.hpp"
#include "surface_bound.hpp"

namespace lekalo::step {

inline constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// A piece of an edge between two neighbouring vertices, which all faces at the edge share.
struct Piece {
  bool is_point = false;  ///< as the edge at a pole
  bool divided = false;
  std::uint32_t middle = kNoVertex;  ///< once it is divided, and its halves are `first_half` and the next one
  std::size_t first_half = 0;
};

/// The triangles of a face in its parameters, and how far they are from it at most. Triangles that are too
/// far are divided along the sides that bend most; a side is divided for both of its triangles, and a piece
/// of an edge for all of its faces, so that the mesh stays closed.
class FaceMesh {
 public:
  using Vertices = std::vector<solid::Vector>;

  explicit FaceMesh(std::unique_ptr<SurfaceBound> surface) : surface_(std::move(surface)) {}

  /// Returns the number of the new node.
  int add_node(const gp_Pnt2d& at, std::uint32_t vertex, const Vertices& vertices);
  void add_triangle(const std::array<int, 3>& nodes);
  /// A side that stands for a curve of parameters from `first` to `last`.
  void add_border(int from, int to, double first, double last, const Handle(Geom2d_Curve) & curve,
                  double tolerance, std::size_t piece);

  /// Says whether triangles and borders meet along all sides.
  [[nodiscard]] bool is_closed() const;
  /// Notes which sides have to be divided so that the deviation may become as small as asked for; false where
  /// it is, or where nothing more is to be had.
  [[nodiscard]] bool mark(double asked, const Vertices& vertices, std::vector<Piece>& pieces);
  /// Divides what was marked, and the pieces that other faces have marked.
  void divide(Vertices& vertices, std::vector<Piece>& pieces);

  /// How far triangles and face are apart at most. Infinite where the triangles are folded over each other,
  /// or nothing is proved of one of them.
  [[nodiscard]] double deviation(const Vertices& vertices);
  /// Says whether a border is a curve with a weight that is not above 0, of which nothing is proved.
  [[nodiscard]] bool has_bad_border() const noexcept { return bad_border_; }

  [[nodiscard]] std::size_t count() const noexcept { return triangles_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 3> vertices_of(std::size_t triangle) const;

 private:
  struct Node {
    gp_Pnt2d at;
    std::uint32_t vertex = 0;
    int same = 0;  ///< the first of the nodes that are one point of the surface, as at a pole
  };
  static constexpr double kUnknown = -1;
  /// Dividing helps as long as the bounds of halves are less: corners that are off stay off.
  struct Progress {
    double before = kUnknown;  ///< the bound of the whole
    int in_vain = 0;
    void note(double bound) noexcept {
      constexpr double kLess = 0.75;
      // Infinity is not less than itself.
      in_vain = before == kUnknown || (bound < before && bound <= kLess * before) ? 0 : in_vain + 1;
    }
    [[nodiscard]] Progress of_half(double bound) const noexcept { return {bound, in_vain}; }
  };
  struct Triangle {
    std::array<int, 3> nodes{};
    double bound = kUnknown;
    Progress progress;
  };
  struct Border {
    int from = 0, to = 0;
    double first = 0, last = 0;
    Handle(Geom2d_Curve) curve;
    std::shared_ptr<const Patches> spline;  ///< the curve, if it is one
    double tolerance = 0;
    std::size_t piece = 0;
    double bound = kUnknown;  ///< without the tolerance
    Progress progress;
  };
  using Side = std::pair<int, int>;  ///< of nodes, the lower one first

  [[nodiscard]] Corner corner(int node, const Vertices& vertices) const;
  [[nodiscard]] std::array<Corner, 3> corners(const Triangle& triangle, const Vertices& vertices) const;
  [[nodiscard]] Side side(int a, int b) const;
  [[nodiscard]] bool is_fold_free(const Vertices& vertices) const;
  void bound_borders(const Vertices& vertices);
  void mark_triangle(const Triangle& triangle, double most, const Vertices& vertices);
  void divide_triangles(const std::unordered_map<std::uint64_t, int>& middles, const Vertices& vertices);

  std::unique_ptr<SurfaceBound> surface_;
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<Border> borders_;
  std::map<std::uint32_t, int> free_nodes_;  ///< the first node at each vertex at which a parameter is free
  std::vector<Side> marks_;
  bool bad_border_ = false;
};

}  // namespace lekalo::step
