#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <array>
#include <cstddef>
#include <gp_Dir.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_XYZ.hxx>
#include <vector>

namespace lekalo::step {

struct Range {
  double low = 0, high = 0;
  [[nodiscard]] double width() const noexcept { return high - low; }
};

/// Upper bounds of the lengths of a surface's derivatives over a box of parameters. A kink is a line across
/// which the first derivative jumps by up to so much.
struct DerivativeBounds {
  double u = 0, v = 0, uu = 0, kink_u = 0;
  void hold(const DerivativeBounds& other) noexcept;
};

/// A fan of the surface about a side that is one point: u goes from one corner to the other, v from the tip
/// to the base.
struct Fan {
  double u_a = 0, u_b = 0, v_tip = 0, v_base = 0;
  gp_XYZ tip, a, b;  ///< of the flat triangle
};

/// A B-spline as Bezier patches. Its derivatives over a box are bounded by the control points of the patches
/// cut to the box, which hull them; a rational one's by those of numerator and weight.
class Patches {
 public:
  explicit Patches(const Handle(Geom_BSplineSurface) & surface);
  /// A curve is a surface that does not depend on v.
  explicit Patches(const Handle(Geom_BSplineCurve) & curve);
  /// A curve that is moved along a direction, in which v is the length.
  Patches(const Handle(Geom_BSplineCurve) & curve, const gp_Dir& along);

  /// Points in whose hull a curve lies from one parameter to another. Nothing where a weight is not above 0.
  [[nodiscard]] std::vector<gp_XYZ> hull(Range u) const;
  /// Infinite where a weight is not above 0.
  [[nodiscard]] DerivativeBounds over(Range u, Range v) const;
  /// No point of the surface over the triangle of parameters is farther than this from its point of the flat
  /// triangle, which has the same barycentric coordinates. Patches are halved until the bound is not above
  /// `enough`, or near to what it bounds. Infinite where a weight is not above 0.
  [[nodiscard]] double farthest(const std::array<gp_Pnt2d, 3>& at, const std::array<gp_XYZ, 3>& flat,
                                double enough) const;
  /// The same of a fan. \param swapped  u and v have changed places
  [[nodiscard]] double farthest(const Fan& fan, bool swapped, double enough) const;

 private:
  /// A control point times its weight, and the weight.
  using Point = std::array<double, 4>;
  using Points = std::vector<Point>;
  /// The parameters of one direction: where the patches meet, and 0 or the period.
  struct Axis {
    int degree = 0;
    std::vector<double> knots;
    std::vector<bool> kinks;  ///< of each knot, if the curve may have one there
    double period = 0;
  };
  /// The part of a span that a box needs: from..to as parameters of the span from 0 to 1.
  struct Piece {
    std::size_t span = 0;
    double from = 0, to = 0, low = 0, width = 0;
  };
  /// A span with all parameters that it stands for; the first and the last go on without end.
  struct Cell {
    std::size_t span = 0;
    double low = 0, high = 0;    ///< where it is cut off
    double begin = 0, size = 0;  ///< where its own parameter is 0, and how long it is
    double end = 0;              ///< where its own parameter is 1
  };

  /// All spans, of each period that the range may meet; cells() are those that it meets.
  [[nodiscard]] static std::vector<Cell> spans(const Axis& axis, Range range);
  [[nodiscard]] static std::vector<Piece> pieces(const Axis& axis, Range range);
  [[nodiscard]] static std::vector<Cell> cells(const Axis& axis, Range range);
  [[nodiscard]] const Points& patch(std::size_t u, std::size_t v) const {
    return patches_[u * (v_.knots.size() - 1) + v];
  }
  [[nodiscard]] Points cut(const Piece& u, const Piece& v) const;
  [[nodiscard]] DerivativeBounds bounds(const Points& net, double width_u, double width_v) const;
  void add_kinks(const std::vector<Piece>& u, const std::vector<Piece>& v, DerivativeBounds& made) const;
  [[nodiscard]] double jump(const Points& before, double width_before, const Points& after,
                            double width_after) const;
  [[nodiscard]] std::size_t columns() const noexcept { return static_cast<std::size_t>(v_.degree) + 1; }

  Axis u_, v_;
  std::vector<Points> patches_;  ///< of span i of u and span j of v at i * spans of v + j, row by row of u
};

}  // namespace lekalo::step
