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

/// The faces of an arrangement with their winding numbers. Half-edge 2 e runs along map edge e, 2 e + 1
/// against it; the face of a half-edge is the one on its left.
class PlanarMap {
 public:
  /// Nothing where the arrangement contradicts itself: edges that cross unseen leave a map that no plane
  /// holds (Euler's formula), or winding numbers that differ with the way around.
  [[nodiscard]] static std::optional<PlanarMap> make(const Arrangement& arrangement);

  /// A closed chain of half-edges around kept material that visits no vertex twice.
  struct Loop {
    std::vector<std::uint32_t> half_edges;
    std::uint32_t group = 0;  ///< loops of one group bound one connected piece of material
  };
  /// Thin faces that others enclose are turned over, for they are what is left of edges that were drawn apart
  /// by less than snapping tells.
  [[nodiscard]] std::vector<Loop> loops(KeepRule keep) const;

  /// A loop is thin when all points inside it are within kEdgeErrorInSnaps of its edges. A no may be wrong.
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
  /// visit(edge, upwards) for the edges of other components that a ray from the component's lowest vertex to
  /// the right crosses.
  template <class Visit>
  void cast_ray(std::uint32_t component, Visit&& visit) const;
  [[nodiscard]] std::vector<Loop> traced_loops(const std::vector<char>& kept) const;
  void turn_thin_faces(std::vector<char>& kept) const;
  void link_components(const std::vector<char>& kept, std::vector<Loop>& loops,
                       std::vector<std::uint32_t>& group_of_face) const;

  const Arrangement& a_;
  std::vector<std::uint32_t> around_;         ///< half-edges by the vertex they leave, counter-clockwise
  std::vector<std::uint32_t> around_starts_;  ///< per vertex
  std::vector<std::uint32_t> place_;          ///< of a half-edge in around_
  std::vector<std::uint32_t> face_;           ///< of a half-edge
  std::vector<std::uint32_t> face_starts_;    ///< a half-edge of each face
  std::vector<std::uint32_t> component_;      ///< of a vertex
  struct Component {
    std::uint32_t lowest = 0;   ///< vertex
    std::uint32_t outside = 0;  ///< a half-edge that has the component's outside on its left
    std::uint32_t vertices = 0, edges = 0, faces = 0;
  };
  std::vector<Component> components_;
  std::optional<BoxTree> tree_;   ///< of edges, where there are several components
  std::vector<Winding> winding_;  ///< of a face
};

}  // namespace lekalo::geom::detail
