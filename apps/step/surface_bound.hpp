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
  explicit SurfaceBound(const Handle(Geom_Surface) & surface) : surface_(surface) {}
  virtual ~SurfaceBound() = default;
  SurfaceBound(const SurfaceBound&) = delete;
  SurfaceBound& operator=(const SurfaceBound&) = delete;

  /// No point of the triangle is farther than this from its point of the surface, mm. No work is done once
  /// it is not above `enough`.
  [[nodiscard]] virtual double of_triangle(const std::array<Corner, 3>& corners, double enough) const = 0;
  /// Between a side of a triangle and the curve of parameters that it stands for, which the control points
  /// hull, no point of the surface is farther than this from either, mm.
  [[nodiscard]] virtual double of_border(Corner from, Corner to, const std::vector<gp_Pnt2d>& hull) const = 0;

  /// The parameter that says nothing at a corner, for its line is one point, as at a pole of a sphere: a side
  /// that begins there has the other corner's.
  enum class Free : unsigned char { none, u, v };
  [[nodiscard]] virtual Free free_at(const Corner&) const { return Free::none; }
  /// The parameters in the middle of a side of a triangle.
  [[nodiscard]] gp_Pnt2d middle(const Corner& a, const Corner& b) const;
  [[nodiscard]] gp_Pnt value(const gp_Pnt2d& at) const { return surface_->Value(at.X(), at.Y()); }

 private:
  Handle(Geom_Surface) surface_;
};

/// Returns the bounds of a surface, or nothing where none is known, and what kind of surface it is.
struct BoundedSurface {
  std::unique_ptr<SurfaceBound> bound;
  std::string kind;
};
[[nodiscard]] BoundedSurface bounded(Handle(Geom_Surface) surface);

}  // namespace lekalo::step
