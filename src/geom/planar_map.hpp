#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "arrangement.hpp"
#include "lekalo/geom/box_tree.hpp"

namespace lekalo::geom::detail {

using Winding = std::array<std::int32_t, Outlines::kOperands>;
using KeepRule = bool (*)(const Winding&);

/// Step 3 of docs/design/boolean.md: the faces of an arrangement with their winding numbers. Half-edge 2 e
/// runs along map edge e, 2 e + 1 against it; the face of a half-edge is the one on its left.
class PlanarMap {
 public:
  /// Returns nothing where the arrangement contradicts itself: where edges that cross unseen leave a map that
  /// no plane holds (Euler's formula), or winding numbers that differ with the way around.
  [[nodiscard]] static std::optional<PlanarMap> make(const Arrangement& arrangement);
  /// Does the same for edges that are no contours and have no winding numbers: loops() is not for this map.
  [[nodiscard]] static std::optional<PlanarMap> make_of_curves(const Arrangement& arrangement);

  /// A closed chain of half-edges around kept material. It visits no vertex twice.
  struct Loop {
    std::vector<std::uint32_t> half_edges;
    /// The loops of one group bound one connected piece of material.
    std::uint32_t group = 0;
  };
  /// Step 4: returns the loops around the faces that are kept. Thin faces that others enclose are turned
  /// over, because they are left of edges that were drawn apart by less than snapping can tell.
  [[nodiscard]] std::vector<Loop> loops(KeepRule keep) const;

  /// Says whether one face lies on both sides of a map edge, so that it bounds nothing.
  [[nodiscard]] bool is_bridge(std::uint32_t edge) const { return face_[2 * edge] == face_[2 * edge + 1]; }
  /// Returns the outer loop of every face but the outsides, in the order of their first half-edges. It visits
  /// no vertex twice. \pre no edge is a bridge
  [[nodiscard]] std::vector<Loop> face_loops() const;

  /// Says whether all points inside a loop are within kEdgeErrorInSnaps of its edges. A no may be wrong.
  [[nodiscard]] static bool is_thin(const Arrangement& arrangement, const Loop& loop);

 private:
  explicit PlanarMap(const Arrangement& arrangement) : a_(arrangement) {}

  void sort_around_vertices();
  void trace_faces();
  void find_components();
  [[nodiscard]] Loop walk_around(std::uint32_t face) const;
  [[nodiscard]] bool is_planar() const;
  [[nodiscard]] bool has_one_outside() const;
  [[nodiscard]] bool find_windings();
  [[nodiscard]] std::uint32_t next(std::uint32_t half_edge) const noexcept;
  /// Calls visit(edge, upwards) for the edges that a ray to the right from the component's lowest vertex
  /// crosses, of the other components whose boxes hold that vertex.
  template <class Visit>
  void cast_ray(std::uint32_t component, Visit&& visit) const;
  [[nodiscard]] std::vector<Loop> traced_loops(const std::vector<char>& kept) const;
  void turn_thin_faces(std::vector<char>& kept) const;
  void link_components(const std::vector<char>& kept, std::vector<Loop>& loops,
                       std::vector<std::uint32_t>& group_of_face) const;

  const Arrangement& a_;
  /// The half-edges by the vertex they leave, counter-clockwise.
  std::vector<std::uint32_t> around_;
  std::vector<std::uint32_t> around_starts_;  ///< per vertex
  /// By half-edge: its place in around_.
  std::vector<std::uint32_t> place_;
  /// By half-edge: its face.
  std::vector<std::uint32_t> face_;
  /// By face: a half-edge of it.
  std::vector<std::uint32_t> face_starts_;
  /// By vertex: its component.
  std::vector<std::uint32_t> component_;
  struct Component {
    std::uint32_t lowest = 0;  ///< vertex
    /// A half-edge that has the component's outside on its left.
    std::uint32_t outside = 0;
    std::uint32_t vertices = 0, edges = 0, faces = 0;
  };
  std::vector<Component> components_;
  /// A tree of the components, if there are several, and by component its edges with a tree of these. A
  /// component whose box does not hold a point does not wind about it, so that a row of many costs no more
  /// than a grid of them.
  std::optional<BoxTree> wholes_;
  struct Edges {
    std::vector<std::uint32_t> numbers;
    BoxTree tree;
  };
  std::vector<Edges> edges_of_;
  std::vector<Winding> winding_;  ///< by face
};

}  // namespace lekalo::geom::detail
