#pragma once

#include "contact_program.hpp"
#include "lekalo/geom/polygon.hpp"
#include "locate/search/sinusoid.hpp"

namespace lekalo::locate {

/// A rounding costs no more than this, relatively.
inline constexpr double kUnit = 0x1p-53;

/// The uncertainty with which doubles know the shapes of a problem. Statements that must hold for the exact
/// shapes count it in.
struct Uncertainty {
  double part = 0, blank = 0;  ///< each coordinate is within this of the exact one, mm
  double scale = 0;            ///< largest |coordinate| in the local frame, mm
};

/// Returns a number that no placement at an angle in [from, to] exceeds, for the exact shapes behind the
/// doubles: the largest value of the basis's sinusoid over the interval plus everything that rounding can
/// hide.
/// \pre `part` and `blank` in the local frame, from <= to less than pi apart.
/// \return +infinity when the three edges are parallel.
/// docs/design/locate-convex.md, "What the rounding can hide".
[[nodiscard]] double proved_bound(const Basis& basis, const Angle& from, const Angle& to,
                                  const geom::Ring& part, const geom::Ring& blank,
                                  const Uncertainty& uncertainty);

}  // namespace lekalo::locate
