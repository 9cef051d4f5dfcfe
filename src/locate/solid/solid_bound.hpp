#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lekalo/solid/flat_patches.hpp"
#include "locate/search/cell_program.hpp"
#include "solid_meter.hpp"

namespace lekalo::locate {

struct SolidBall {
  solid::Vector centre;
  double radius = 0;
};

/// A disc that lies on a surface, about the point of contact; the normal points into the part's material, or
/// the blank's. Radius 0 where the contact is on a bend.
struct SolidDisc {
  solid::Vector centre, normal;
  double radius = 0;
};

struct SolidEdge {
  solid::Vector from, to;
};

/// A contact that was met at some pose, and what bounds the clearance by it at every pose: balls in the
/// part's material (part coordinates), and balls and a half-space without material of the blank. The first
/// ball of each kind is the point of contact itself. Any one of the part's with any one of the others makes a
/// bound (docs/design/locate-solid.md); which is best depends on the box of poses.
struct KnownSolid {
  std::vector<SolidBall> part, blank;
  SolidDisc part_disc, blank_disc;
  /// The edges, where both points lie within one.
  std::optional<std::pair<SolidEdge, SolidEdge>> edges;
  /// No vertex of the blank has a smaller product with `normal`, a vector no longer than 1.
  solid::Vector normal;
  double least = 0;
};

/// A box of poses as the bounds need it.
struct CellView {
  CellView(const SolidFrame& frame, const SolidCell& cell);

  solid::Motion motion;  ///< of its middle
  solid::Vector at;      ///< the pivot's place there
  solid::Vector slide;   ///< half widths of the shift
  /// A pose of the box is turned from its middle by a rotation whose y = tan(angle / 2) times the axis has
  /// parts no larger than these.
  solid::Vector turn;
  double slide_norm = 0, turn_norm = 0;
  /// The half widths of the program's unknowns.
  Steps half{};
};

/// A linear bound of the clearance over a box of poses. A sum of bounds with multipliers holds unless it is
/// below -radius for one of them.
struct SolidRow {
  LinearBound<6> bound;
  double radius = std::numeric_limits<double>::infinity();
};

/// Makes contacts known, and bounds boxes by them. Its answers depend on their arguments alone.
class SolidBounds {
 public:
  explicit SolidBounds(const SolidMeter& meter);

  [[nodiscard]] KnownSolid known(const SolidContact& contact, const solid::Motion& motion) const;
  [[nodiscard]] SolidRow row(const KnownSolid& known, const CellView& cell) const;
  /// A bound may be too low by this for rounding, mm.
  [[nodiscard]] double rounding() const noexcept { return rounding_; }

 private:
  [[nodiscard]] SolidRow row(const SolidBall& part, const SolidBall& blank, const CellView& cell) const;
  [[nodiscard]] std::optional<SolidRow> row(const SolidBall& part, const SolidDisc& blank,
                                            const CellView& cell) const;
  [[nodiscard]] std::optional<SolidRow> row(const SolidDisc& part, const SolidBall& blank,
                                            const CellView& cell) const;
  [[nodiscard]] SolidRow row(const SolidBall& part, solid::Vector normal, double least,
                             const CellView& cell) const;

  [[nodiscard]] std::optional<SolidRow> row(const SolidEdge& part, const SolidEdge& blank,
                                            const CellView& cell) const;

  const SolidMeter& meter_;
  solid::FlatPatches of_part_, of_blank_;
  double scale_, rounding_;
};

}  // namespace lekalo::locate
