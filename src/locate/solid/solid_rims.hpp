#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"

namespace lekalo::locate {

/// A part whose triangles are cut where rims end (SolidNear::rim). Pieces that lie in a rim demand nothing;
/// the others have all points that demand something, and reach into the rim by a thousandth of it.
class CutPart {
 public:
  /// None where there are no rims, or nothing that demands something lies in them.
  [[nodiscard]] static std::optional<CutPart> of(const SolidProblem& problem);

  /// The pieces, and their demands; what is not cut is the triangle that it was. Not closed where an edge is
  /// cut and its other triangle is not, but for rounding.
  [[nodiscard]] const solid::Mesh& mesh() const noexcept { return mesh_; }
  [[nodiscard]] const std::vector<std::optional<SolidDemand>>& demands() const noexcept { return demands_; }
  [[nodiscard]] const std::vector<SolidNear>& nears() const noexcept { return nears_; }
  /// Points of the pieces are off the part's triangles by no more than this, mm.
  [[nodiscard]] double error() const noexcept { return error_; }

  /// The triangle of the part in which a piece lies, and the part.
  [[nodiscard]] std::uint32_t number(std::uint32_t piece) const { return numbers_[piece]; }
  [[nodiscard]] const solid::Mesh& part() const noexcept { return *part_; }
  /// Says if a piece is a triangle of the part, no point of which lies in a rim.
  [[nodiscard]] bool is_clear(std::uint32_t piece) const { return clear_[piece]; }
  /// Says if a point surely lies in no rim.
  [[nodiscard]] bool is_clear(solid::Vector point) const;

 private:
  /// A finished face, as the blank of a clearance of its own.
  struct Rim {
    solid::MeshClearance face;
    std::vector<solid::Corners> triangles;
    double width = 0;
    /// Says if all of a triangle is so far from the face.
    [[nodiscard]] bool is_apart(const solid::Corners& triangle, double least) const;
  };
  class Cutter;
  void cut(std::uint32_t triangle, const solid::Corners& corners, std::vector<solid::Corners>& kept,
           std::vector<solid::Corners>& left_out) const;

  const solid::Mesh* part_ = nullptr;
  solid::Mesh mesh_;
  std::vector<std::optional<SolidDemand>> demands_;
  std::vector<SolidNear> nears_;
  std::vector<std::uint32_t> numbers_;
  std::vector<bool> clear_;
  std::vector<Rim> rims_;
  double error_ = 0;
};

}  // namespace lekalo::locate
