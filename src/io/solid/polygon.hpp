#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lekalo/geom/point.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::io {

/// Most corners of a face with dents, whose triangles cost their square.
inline constexpr std::size_t kMostCorners = 2000;

/// Cuts faces of more than three corners into triangles, in one way whoever asks: seen along the axis nearest
/// to the face's normal, a convex face is a fan from its first corner, and one with dents loses one ear after
/// the other. If the face is flat its surface is the same however it is cut; else the triangles are what
/// counts.
class PolygonCutter {
 public:
  /// Appends the triangles, turned as the face is. One corner twice in a row counts once. A face without area
  /// gives triangles without area. Returns what is wrong with the face, or nothing.
  [[nodiscard]] std::string cut(const std::vector<solid::Vector>& vertices,
                                std::span<const std::uint32_t> corners,
                                std::vector<solid::Triangle>& triangles);

  /// The faces of more than three corners so far, and about how far at most a corner of one lies from the
  /// plane through its middle, mm.
  [[nodiscard]] std::size_t faces() const noexcept { return faces_; }
  [[nodiscard]] double unevenness() const noexcept { return unevenness_; }

 private:
  [[nodiscard]] bool is_convex() const;
  [[nodiscard]] bool is_ear(std::size_t k) const;
  [[nodiscard]] bool cut_ears(std::vector<solid::Triangle>& triangles);

  std::size_t faces_ = 0;
  double unevenness_ = 0;
  // They belong to the face in hand: its corners, as they are seen, and the ring of those that are left.
  std::vector<std::uint32_t> corners_, next_, before_;
  std::vector<geom::Point> seen_;
  std::vector<char> ear_;
};

}  // namespace lekalo::io
