#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/units.hpp"
#include "lekalo/verify/verify.hpp"
#include "near.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {

/// A map of the plane: x runs along `x`, y along `y`, the origin goes to `shift`.
struct Affine {
  Vec x{just(1), just(0)}, y{just(0), just(1)}, shift{just(0), just(0)};
  [[nodiscard]] Vec direction(const Vec& v) const { return x * v.x + y * v.y; }
  [[nodiscard]] Vec operator()(const Vec& p) const { return direction(p) + shift; }
};
[[nodiscard]] Affine operator*(const Affine& after, const Affine& before);

/// An arc of a circle, counter-clockwise from `first` to `last`; its angles in degrees where they are known.
struct DrawnArc {
  Vec centre;
  Span radius;
  Vec first, last;
  Sweep sweep = Sweep::less;
  std::optional<Fraction> from_deg, to_deg;
};

struct DrawnCurve {
  std::vector<CurvePiece> pieces;
  std::string layer;
  /// On a layer that is switched off or frozen, or hidden otherwise.
  bool hidden = false;
};

/// A drawing with more curves than this is not read.
inline constexpr std::size_t kMostCurves = 2'000'000;

/// The curves of a drawing, mm. Bezier curves and ellipses are lines that are within `off` of them.
struct ReadDrawing {
  std::vector<DrawnCurve> curves;
  /// Kinds of things that draw curves and are not read here.
  std::set<std::string> not_read;
  bool says_unit = false;
  [[nodiscard]] bool too_large() const { return curves.size() > kMostCurves; }
};

/// Returns a name in capitals: DXF tells no names apart that differ in nothing else.
[[nodiscard]] std::string key_of(std::string_view name);

/// Makes curves of one layer from their numbers and a map.
class CurveMaker {
 public:
  CurveMaker(ReadDrawing& drawing, double off) : drawing_(drawing), off_(off) {}

  void line(const Affine& map, const Vec& from, const Vec& to);
  void arc(const Affine& map, const DrawnArc& arc);
  /// Adds the arc between two ends whose bulge is the tangent of a quarter of its sweep, or a line.
  void bulge(const Affine& map, const Vec& from, const Vec& to, const Decimal& bulge);
  void ellipse(const Affine& map, const Vec& centre, const Vec& u, const Vec& v, const Fraction& from_deg,
               const Fraction& to_deg);
  void cubic(const Affine& map, const std::array<Vec, 4>& poles);
  /// Ends the curve.
  void done(const std::string& layer, bool hidden);

 private:
  void strokes(const Affine& map, const DrawnArc& arc);
  /// Adds a line that stands for a curve within `off`.
  void stroke(const Vec& from, const Vec& to, double off);
  /// Says whether such curves take more strokes than are made; then the drawing is not read.
  bool too_many(double strokes, const char* curves);
  /// Calls take(part) for the whole or for its parts in their order; it returns the halves of those that it
  /// does not take.
  template <class Part, class Take>
  void in_parts(const Part& whole, const char* curves, const Take& take);

  ReadDrawing& drawing_;
  double off_;
  DrawnCurve curve_;
};

/// Reads the curves of a DXF or an SVG; bad_input names the place. A file that does not say its unit is in
/// `unit`. \param off  how far lines may be from the curves that they stand for, mm
[[nodiscard]] Result<ReadDrawing> read_dxf_drawing(const Document& document, LengthUnit unit, double off);
/// The fallback of an SVG is in mm, since one unit of it may be a pixel too.
[[nodiscard]] Result<ReadDrawing> read_svg_drawing(const Document& document, const Fraction& mm_per_unit,
                                                   double off);

}  // namespace lekalo::verify
