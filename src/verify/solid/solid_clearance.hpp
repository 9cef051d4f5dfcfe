#pragma once

#include <optional>
#include <string>

#include "lekalo/base/error.hpp"
#include "placed_solid.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {

/// The answer to a claim "the part lies in the blank, and its surface is nowhere nearer to the blank's
/// than so many millimetres". Of a blank with widths the distance from each triangle counts less its width.
/// The claim is shown where there is neither a fault nor something open.
struct SolidAnswer {
  Span least;                        ///< holds the least distance of the two surfaces less the widths, mm
  std::optional<std::string> fault;  ///< why it is not true
  std::optional<std::string> open;   ///< why that is not told
};

/// Two points that are said to be near each other: one of the part, in its own frame, and one of the blank.
struct SolidContact {
  std::array<Decimal, 3> part_point, blank_point;
  Decimal distance;
};

/// A part at its pose in a blank, both closed meshes; what is within them is told by parity.
class SolidPair {
 public:
  /// Fails with bad_input where the quaternion is 0, or where the part goes beyond the sizes that files may
  /// have. \param part, blank  closed; they outlive this
  static Result<SolidPair> make(const SolidMesh& part, const SolidMesh& blank, const SolidPose& pose);

  [[nodiscard]] SolidAnswer check(const Decimal& clearance) const;

  /// The claim about the part's surface alone, which may have a rim: it lies in the blank, and is nowhere
  /// nearer to the blank's surface.
  [[nodiscard]] SolidAnswer check_surface(const Both& clearance) const;
  /// Says why something of the blank's surface that hangs together may lie in the part, or nothing: each has
  /// to have a vertex outside.
  [[nodiscard]] std::optional<std::string> swallowed() const;

  /// Returns a bound above the least distance of the surfaces, mm, which is the clearance of a part in the
  /// blank: the distance of the two points and what they are off the surfaces. Refuted where a point is off
  /// its surface, or their distance less the width of the blank's triangle is not the one that is said, by
  /// more than `slack`.
  [[nodiscard]] Result<double> bound_of(const SolidContact& contact, double slack, Span width = {}) const;

 private:
  SolidPair(const SolidMesh& part, const SolidMesh& blank, const SolidMotion& motion)
      : motion_(motion), part_(part, motion), blank_(blank) {}

  struct Nearest {
    Span least;
    std::uint32_t part{}, blank{};  ///< triangles
  };
  /// Returns a distance from the blank less a width; it is itself where the blank has none.
  [[nodiscard]] Span beyond(Span distance, Span width) const {
    return blank_.mesh().widths.empty() ? distance : distance - width;
  }
  [[nodiscard]] Nearest nearest() const;
  /// Decides exactly what enclosures leave open.
  void check_exactly(const Both& clearance, SolidAnswer& answer) const;

  SolidMotion motion_;
  PlacedSolid part_, blank_;
};

}  // namespace lekalo::verify
