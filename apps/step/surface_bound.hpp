#pragma once

#include <Geom_Surface.hxx>
#include <array>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <memory>
#include <string>
#include <vector>

namespace lekalo::step {

/// A corner of a triangle of a face: its place, and the parameters that it stands for.
struct Corner {
  gp_Pnt place;
  gp_Pnt2d at;
};

/// Bounds how far the triangles of a face are from its surface. docs/design/step.md has the proofs.
///
/// A triangle stands for the points of the surface over a triangle of parameters, whose sides are the same
/// for both triangles beside them; infinity says that nothing can be proved of a triangle so large.
class SurfaceBound {
 public:
  virtual ~SurfaceBound() = default;
  /// No point of the triangle is farther than this from its point of the surface, mm.
  [[nodiscard]] virtual double of_triangle(const std::array<Corner, 3>& corners) const = 0;
  /// Between a side of a triangle and the curve of parameters that it stands for, which the control points
  /// hull, no point of the surface is farther than this from either, mm.
  [[nodiscard]] virtual double of_border(Corner from, Corner to, const std::vector<gp_Pnt2d>& hull) const = 0;
};

/// Returns the bounds of a surface, or nothing where none is known, and what kind of surface it is.
struct BoundedSurface {
  std::unique_ptr<SurfaceBound> bound;
  std::string kind;
};
[[nodiscard]] BoundedSurface bounded(Handle(Geom_Surface) surface);

}  // namespace lekalo::step
