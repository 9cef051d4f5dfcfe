#pragma once

#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::nc {

/// Paths of knives, which cut on the outline itself, since they have no kerf. docs/design/knives.md says why
/// they are as they are.

enum class KnifeKind {
  drag,       ///< the blade trails behind the axis about which it turns freely
  tangential  ///< the control turns the blade into the direction of motion
};

struct KnifeOptions {
  KnifeKind kind = KnifeKind::drag;
  double offset_mm = 0;  ///< from the axis back to the tip; above 0 for drag knives, and 0 else
  /// Radians. Above it a drag knife is swivelled about its tip, and a tangential knife is lifted to turn.
  double turn_above = 0.1;
  /// How far a cut goes on beyond the place where it began. A tangential knife does so up to the next corner
  /// at which it is lifted.
  double overcut_mm = 0;
  double tolerance_mm = 0.1;         ///< how far the tip may be from the outline
  double chord_tolerance_mm = 0.02;  ///< of the axis' arcs, which are written as chords
  double step_mm = 0.025;            ///< the numbers that are written are multiples of it
};

/// One contour.
struct KnifeCut {
  /// The ways of the axis with the blade down, in multiples of the step; of a drag knife one stroke. Between
  /// two strokes the blade is lifted where it is.
  std::vector<std::vector<geom::Point>> strokes;
  /// The tip is never farther from the contour: a bound, at most a sixteenth of the tolerance too large.
  double off_mm = 0;
};

/// Makes the cuts of one plot or program, one after the other: a drag knife keeps the direction that it had
/// when it was lifted, and has to be lowered so that its tip is where the next cut begins.
class Knife {
 public:
  /// The blade of a drag knife begins with its axis in front of the tip, towards +x.
  explicit Knife(const KnifeOptions& options) : options_(options) {}

  /// Follows a contour from its first point in its own direction. Cost: O(points written), and for drag
  /// knives O(length / tolerance) where they turn. \pre a contour of make_region
  [[nodiscard]] KnifeCut cut(const geom::Contour& contour);

 private:
  KnifeOptions options_;
  geom::Point heading_{1, 0};  ///< from the tip to the axis, a unit vector
};

}  // namespace lekalo::nc
