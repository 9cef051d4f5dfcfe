#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "arrangement.hpp"

namespace lekalo::geom::detail {

using Winding = std::array<std::int32_t, Outlines::kOperands>;
using KeepRule = bool (*)(const Winding&);

/// The faces of an arrangement with their winding numbers. Half-edge 2 e runs along map edge e, 2 e + 1 against
/// it; the face of a half-edge is the one on its left.
class PlanarMap {
 public:
  /// Nothing where the arrangement contradicts itself: edges that cross unseen leave a map that no plane holds
  /// (Euler's formula), or winding numbers that differ with the way around.
  [[nodiscard]] static std::optional<PlanarMap> make(const Arrangement& arrangement);

  /// A closed chain of half-edges around kept material that visits no vertex twice.
  struct Loop {
    std::vector<std::uint32_t> half_edges;
    std::uint32_t group = 0;  ///< loops of one group bound one connected piece of material
  };
  [[nodiscard]] std::vector<Loop> loops(KeepRule keep) const;

  [[nodiscard]] std::uint32_t from(std::uint32_t half_edge) const noexcept;

 private:
  explicit PlanarMap(const Arrangement& arrangement) : a_(arrangement) {}

  bool build();
  void sort_around_vertices();
  void trace_faces();
  [[nodiscard]] bool find_components();
  [[nodiscard]] bool find_windings();
  [[nodiscard]] std::uint32_t before(std::uint32_t half_edge) const noexcept;
  [[nodiscard]] bool is_kept(std::uint32_t half_edge, const std::vector<char>& kept) const noexcept {
    return kept[face_[half_edge]] != 0;
  }

  const Arrangement& a_;
  std::vector<std::uint32_t> around_;         ///< half-edges by the vertex they leave, counter-clockwise
  std::vector<std::uint32_t> around_starts_;  ///< per vertex
  std::vector<std::uint32_t> place_;          ///< of a half-edge in around_
  std::vector<std::uint32_t> face_;           ///< of a half-edge
  std::vector<std::uint32_t> component_;      ///< of a vertex
  struct Component {
    std::uint32_t lowest = 0;   ///< vertex
    std::uint32_t outside = 0;  ///< a half-edge on whose left the component's outside is
  };
  std::vector<Component> components_;
  std::vector<Winding> winding_;  ///< of a face
};

}  // namespace lekalo::geom::detail
