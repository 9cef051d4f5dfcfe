#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <array>
#include <cstddef>
#include <vector>

namespace lekalo::step {

struct Range {
  double low = 0, high = 0;
  [[nodiscard]] double width() const noexcept { return high - low; }
};

/// Upper bounds of the lengths of a surface's derivatives over a box of parameters. A kink is a line across
/// which the first derivative jumps by up to so much.
struct DerivativeBounds {
  double u = 0, v = 0, uu = 0, uv = 0, vv = 0, kink_u = 0, kink_v = 0;
  double value = 0;  ///< of the vector itself
  void hold(const DerivativeBounds& other) noexcept;
};

/// The affine map of parameters that is `at` at (u, v).
struct Affine {
  double u = 0, v = 0;
  std::array<double, 3> at{}, along_u{}, along_v{};
  [[nodiscard]] std::array<double, 4> operator()(double x, double y) const;  ///< with the weight 1
};

/// A B-spline as Bezier patches. Its derivatives over a box are bounded by the control points of the patches
/// cut to the box, which hull them; a rational one's by those of numerator and weight.
class Patches {
 public:
  explicit Patches(const Handle(Geom_BSplineSurface) & surface);
  /// A curve is a surface that does not depend on v.
  explicit Patches(const Handle(Geom_BSplineCurve) & curve);

  /// Infinite where a weight is not above 0.
  [[nodiscard]] DerivativeBounds over(Range u, Range v) const;
  /// The same of w (S - L), with the weight w and L affine, divided by the least w: the second derivatives
  /// and the value.
  [[nodiscard]] DerivativeBounds over(Range u, Range v, const Affine& flat) const;

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

  [[nodiscard]] static std::vector<Piece> pieces(const Axis& axis, Range range);
  [[nodiscard]] Points cut(const Piece& u, const Piece& v) const;
  [[nodiscard]] DerivativeBounds bounds(const Points& net, double width_u, double width_v) const;
  [[nodiscard]] Points less(const Points& net, const Affine& flat, const Piece& u, const Piece& v) const;
  void add_kinks(const std::vector<Piece>& u, const std::vector<Piece>& v, const Points& reach,
                 DerivativeBounds& made) const;
  [[nodiscard]] double jump(const Points& before, double width_before, const Points& after,
                            double width_after, bool along_u, const Points& reach) const;
  [[nodiscard]] std::size_t columns() const noexcept { return static_cast<std::size_t>(v_.degree) + 1; }

  Axis u_, v_;
  std::vector<Points> patches_;  ///< of span i of u and span j of v at i * spans of v + j, row by row of u
};

}  // namespace lekalo::step
