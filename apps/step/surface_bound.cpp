#include "surface_bound.hpp"

#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "patches.hpp"

namespace lekalo::step {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// A corner this near to the axis of a surface of revolution lies on it, mm: its angle says nothing.
constexpr double kOnAxis = 1e-7;
/// A triangle turns about the axis by no more, and its corners are where their parameters say within this,
/// rad.
constexpr double kMostTurn = 1.4, kMostOff = 0.1;

struct Box {
  Range u{kInfinite, -kInfinite}, v{kInfinite, -kInfinite};
  void hold(const gp_Pnt2d& at) {
    u = {std::min(u.low, at.X()), std::max(u.high, at.X())};
    v = {std::min(v.low, at.Y()), std::max(v.high, at.Y())};
  }
};

/// Bounds of the first two derivatives of a curve: constants, or those of a spline.
class CurveBound {
 public:
  CurveBound(double first, double second) : constant_{first, 0, second, 0} {}
  explicit CurveBound(const Handle(Geom_BSplineCurve) & spline) : patches_(Patches(spline)) {}
  [[nodiscard]] DerivativeBounds over(Range t) const {
    return patches_ ? patches_->over(t, {0, 0}) : constant_;
  }

 private:
  DerivativeBounds constant_;
  std::optional<Patches> patches_;
};

/// How far a curve is from a chord over a range of parameters.
double sagitta(const DerivativeBounds& curve, double width) {
  return curve.uu * width * width / 8 + curve.kink_u * width / 4;
}

Handle(Geom_BSplineCurve) spline_of(const Handle(Geom_Curve) & curve) {
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve); !spline.IsNull()) return spline;
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve); !bezier.IsNull())
    return GeomConvert::CurveToBSplineCurve(bezier);
  return {};
}

std::optional<CurveBound> bounded(Handle(Geom_Curve) curve) {
  while (true) {
    const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve);
    if (trimmed.IsNull()) break;
    curve = trimmed->BasisCurve();
  }
  if (!Handle(Geom_Line)::DownCast(curve).IsNull()) return CurveBound(1, 0);
  if (const auto circle = Handle(Geom_Circle)::DownCast(curve); !circle.IsNull())
    return CurveBound(circle->Radius(), circle->Radius());
  if (const auto ellipse = Handle(Geom_Ellipse)::DownCast(curve); !ellipse.IsNull())
    return CurveBound(ellipse->MajorRadius(), ellipse->MajorRadius());
  if (const auto spline = spline_of(curve); !spline.IsNull()) return CurveBound(spline);
  return std::nullopt;
}

/// The distance of a point of parameters from a chord, where lengths along u and v count so much.
double from_chord(const gp_Pnt2d& p, const gp_Pnt2d& a, const gp_Pnt2d& b, double along_u, double along_v) {
  const double x = (b.X() - a.X()) * along_u, y = (b.Y() - a.Y()) * along_v;
  const double px = (p.X() - a.X()) * along_u, py = (p.Y() - a.Y()) * along_v;
  const double square = x * x + y * y;
  const double share = square > 0 ? std::clamp((px * x + py * y) / square, 0.0, 1.0) : 0;
  return std::hypot(px - share * x, py - share * y);
}

/// How far a curve, which begins and ends with the control points, is from the chord; and its ends from those
/// of the chord.
double farthest_from_chord(const std::vector<gp_Pnt2d>& hull, const gp_Pnt2d& a, const gp_Pnt2d& b,
                           double along_u, double along_v) {
  double farthest = 0;
  for (const gp_Pnt2d& p : hull) farthest = std::max(farthest, from_chord(p, a, b, along_u, along_v));
  return farthest + std::max(from_chord(hull.front(), a, a, along_u, along_v),
                             from_chord(hull.back(), b, b, along_u, along_v));
}

// ---- surfaces of which a triangle stands for the flat triangle of its parameters ------------------------

class ParametricBound : public SurfaceBound {
 public:
  using SurfaceBound::SurfaceBound;

  /// The surface is curved along u alone.
  [[nodiscard]] double of_triangle(const std::array<Corner, 3>& corners, double) const override {
    Box box;
    for (const Corner& corner : corners) box.hold(corner.at);
    return sagitta(over(box.u, box.v), box.u.width()) + farthest_off(corners);
  }

  [[nodiscard]] double of_border(Corner from, Corner to, const std::vector<gp_Pnt2d>& hull) const override {
    Box box;
    box.hold(from.at);
    box.hold(to.at);
    for (const gp_Pnt2d& p : hull) box.hold(p);
    const DerivativeBounds d = over(box.u, box.v);
    return skew() * farthest_from_chord(hull, from.at, to.at, d.u, d.v);
  }

 protected:
  [[nodiscard]] virtual DerivativeBounds over(Range u, Range v) const = 0;
  /// |S_u du + S_v dv| is at most this times the root of the sum of both squares.
  [[nodiscard]] virtual double skew() const { return std::numbers::sqrt2; }

  /// How far corners are from the points of the surface that they stand for.
  [[nodiscard]] double farthest_off(const std::array<Corner, 3>& corners) const {
    double off = 0;
    for (const Corner& corner : corners) off = std::max(off, corner.place.Distance(value(corner.at)));
    return off;
  }
};

class PlaneBound final : public ParametricBound {
 public:
  using ParametricBound::ParametricBound;

 private:
  [[nodiscard]] DerivativeBounds over(Range, Range) const override { return {1, 1, 0, 0}; }
  [[nodiscard]] double skew() const override { return 1; }
};

/// Extrusions of curves that are no splines.
class ExtrusionBound final : public ParametricBound {
 public:
  ExtrusionBound(const Handle(Geom_Surface) & surface, CurveBound curve)
      : ParametricBound(surface), curve_(std::move(curve)) {}

 private:
  [[nodiscard]] DerivativeBounds over(Range u, Range) const override {
    DerivativeBounds d = curve_.over(u);
    d.v = 1;
    return d;
  }
  CurveBound curve_;
};

class SplineBound final : public ParametricBound {
 public:
  explicit SplineBound(const Handle(Geom_BSplineSurface) & surface)
      : ParametricBound(surface), patches_(surface) {
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    surface->Bounds(u0, u1, v0, v1);
    for (const double v : {v0, v1})
      if (is_point(surface, 0, v)) points_v_.push_back(v);
    for (const double u : {u0, u1})
      if (is_point(surface, 1, u)) points_u_.push_back(u);
  }
  SplineBound(const Handle(Geom_SurfaceOfLinearExtrusion) & surface, const Handle(Geom_BSplineCurve) & curve)
      : ParametricBound(surface), patches_(curve, surface->Direction()) {}

  [[nodiscard]] Free free_at(const Corner& corner) const override {
    if (is_at_point(corner.at.Y(), points_v_)) return Free::u;
    return is_at_point(corner.at.X(), points_u_) ? Free::v : Free::none;
  }

  [[nodiscard]] double of_triangle(const std::array<Corner, 3>& corners, double enough) const override {
    const double off = farthest_off(corners);
    std::array<Free, 3> free{};
    for (std::size_t k = 0; k < 3; ++k) free[k] = free_at(corners[k]);
    const auto tips = 3 - std::count(free.begin(), free.end(), Free::none);
    if (tips > 1) return kInfinite;
    if (tips == 1) {
      const auto tip = static_cast<std::size_t>(
          std::find_if(free.begin(), free.end(), [](Free one) { return one != Free::none; }) - free.begin());
      return of_fan(corners[tip], corners[(tip + 1) % 3], corners[(tip + 2) % 3], free[tip] == Free::v,
                    enough - off) +
             off + kOnAxis;
    }
    std::array<gp_Pnt2d, 3> at;
    std::array<gp_XYZ, 3> flat;
    for (std::size_t k = 0; k < 3; ++k) at[k] = corners[k].at, flat[k] = value(at[k]).XYZ();
    return patches_.farthest(at, flat, enough - off) + off;
  }

  [[nodiscard]] double of_border(Corner from, Corner to, const std::vector<gp_Pnt2d>& hull) const override {
    // Along a side that is one point nothing is between.
    if (std::all_of(hull.begin(), hull.end(),
                    [&](const gp_Pnt2d& p) {
                      return is_at_point(p.X(), points_u_) || is_at_point(p.Y(), points_v_);
                    }) &&
        from.place.Distance(to.place) <= kOnAxis)
      return kOnAxis;
    if (is_at_point(from.at.Y(), points_v_)) from.at.SetX(to.at.X());
    if (is_at_point(to.at.Y(), points_v_)) to.at.SetX(from.at.X());
    if (is_at_point(from.at.X(), points_u_)) from.at.SetY(to.at.Y());
    if (is_at_point(to.at.X(), points_u_)) to.at.SetY(from.at.Y());
    return ParametricBound::of_border(from, to, hull);
  }

 private:
  [[nodiscard]] DerivativeBounds over(Range u, Range v) const override { return patches_.over(u, v); }

  /// Says whether a side of the patch is one point.
  static bool is_point(const Handle(Geom_BSplineSurface) & surface, int direction, double at) {
    const Handle(Geom_Curve) side = direction == 0 ? surface->VIso(at) : surface->UIso(at);
    const auto spline = Handle(Geom_BSplineCurve)::DownCast(side);
    if (spline.IsNull()) return false;
    for (int k = 2; k <= spline->NbPoles(); ++k)
      if (spline->Pole(k).Distance(spline->Pole(1)) > kOnAxis) return false;
    return true;
  }
  static bool is_at_point(double at, const std::vector<double>& points) {
    return std::any_of(points.begin(), points.end(),
                       [&](double point) { return std::abs(at - point) <= 1e-9 * (1 + std::abs(point)); });
  }

  /// A triangle whose tip is a side of the patch that is one point. It stands for a fan, from the tip to the
  /// nearer of the other corners, whose v is the same along its base, and for the triangle beyond the base.
  [[nodiscard]] double of_fan(const Corner& tip, const Corner& a, const Corner& b, bool swapped,
                              double enough) const {
    const auto along = [&](const Corner& corner) { return swapped ? corner.at.Y() : corner.at.X(); };
    const auto out = [&](const Corner& corner) { return swapped ? corner.at.X() : corner.at.Y(); };
    const double high_a = out(a) - out(tip), high_b = out(b) - out(tip);
    if (!(high_a * high_b > 0)) return kInfinite;
    const bool a_is_nearer = std::abs(high_a) <= std::abs(high_b);
    const Corner &near = a_is_nearer ? a : b, &far = a_is_nearer ? b : a;
    const gp_XYZ p = value(tip.at).XYZ(), at_near = value(near.at).XYZ(), at_far = value(far.at).XYZ();
    const double share = a_is_nearer ? high_a / high_b : high_b / high_a;
    const gp_XYZ cut = p + share * (at_far - p);
    const double of_fan = patches_.farthest(
        Fan{along(near), along(far), out(tip), out(near), p, at_near, cut}, swapped, enough);
    if (share == 1) return of_fan;
    const gp_Pnt2d at_cut = swapped ? gp_Pnt2d(out(near), along(far)) : gp_Pnt2d(along(far), out(near));
    return std::max(of_fan, patches_.farthest({near.at, far.at, at_cut}, {at_near, at_far, cut}, enough));
  }

  Patches patches_;
  std::vector<double> points_u_, points_v_;
};

// ---- surfaces of revolution ------------------------------------------------------------------------------

/// A point of the triangle stands for that of the surface at its own angle about the axis, and with the v
/// that is between those of the corners as the point is between them.
class RevolvedBound final : public SurfaceBound {
 public:
  RevolvedBound(const Handle(Geom_Surface) & surface, const gp_Pnt& origin, const gp_Dir& x, const gp_Dir& y,
                CurveBound profile)
      : SurfaceBound(surface),
        origin_(origin),
        x_(x),
        y_(y),
        z_(gp_Vec(x) ^ gp_Vec(y)),
        profile_(std::move(profile)) {}

  [[nodiscard]] Free free_at(const Corner& corner) const override {
    return cylindrical(corner.place).radius <= kOnAxis ? Free::u : Free::none;
  }

  [[nodiscard]] double of_triangle(const std::array<Corner, 3>& corners, double) const override {
    Box angles, heights;
    std::array<Cylindrical, 3> places;
    double off = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      places[k] = cylindrical(corners[k]);
      if (places[k].radius > kOnAxis) {
        angles.hold(corners[k].at);
      } else {
        off = 2 * kOnAxis;
      }
      heights.hold(corners[k].at);
    }
    if (!(angles.u.low <= angles.u.high)) return kInfinite;
    const double middle = 0.5 * (angles.u.low + angles.u.high);
    double bulge = 0, off_corner = 0;
    bool before = false, beyond = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Cylindrical& place = places[k];
      const bool on_axis = place.radius <= kOnAxis;
      const double is = on_axis ? 0 : std::remainder(place.angle - middle, 2 * std::numbers::pi);
      if (!on_axis &&
          (!(std::abs(is) <= kMostTurn) || !(std::abs(is - (corners[k].at.X() - middle)) <= kMostOff)))
        return kInfinite;
      before = before || (!on_axis && !place.beyond), beyond = beyond || (!on_axis && place.beyond);
      bulge = std::max(bulge, place.radius * (1 - std::cos(is)));
      const Cylindrical meant = cylindrical(value(corners[k].at));
      off_corner = std::max(off_corner, std::hypot(place.radius - meant.radius, place.height - meant.height));
    }
    if (before && beyond) return kInfinite;
    return bulge + sagitta(profile_.over(heights.v), heights.v.width()) + off + off_corner;
  }

  [[nodiscard]] double of_border(Corner from, Corner to, const std::vector<gp_Pnt2d>& hull) const override {
    const Cylindrical a = cylindrical(from), b = cylindrical(to);
    const bool a_on_axis = a.radius <= kOnAxis, b_on_axis = b.radius <= kOnAxis;
    if (a_on_axis) from.at.SetX(to.at.X());
    if (b_on_axis) to.at.SetX(from.at.X());
    Box box;
    box.hold(from.at);
    box.hold(to.at);
    for (const gp_Pnt2d& p : hull) box.hold(p);
    const DerivativeBounds profile = profile_.over(box.v);
    const double widest = std::max(a.radius, b.radius) + profile.u * box.v.width();
    double bent = 0;  // how far the angle along the chord is from changing evenly
    if (!a_on_axis && !b_on_axis) {
      const double turn = std::remainder(b.angle - a.angle, 2 * std::numbers::pi);
      if (a.beyond != b.beyond || !(std::abs(turn) <= kMostTurn) ||
          !(std::abs(turn - (to.at.X() - from.at.X())) <= kMostOff))
        return kInfinite;
      const double across = a.radius * b.radius * std::abs(std::sin(turn));
      const double square_a = a.radius * a.radius, square_b = b.radius * b.radius;
      const double square = square_a + square_b - 2 * a.radius * b.radius * std::cos(turn);
      const double most = std::max(a.radius, b.radius);
      // The chord's least distance from the axis: at an end, or at the foot of the axis.
      double least = std::min(a.radius, b.radius);
      if (std::abs(square_a - square_b) < square) least = std::min(least, across / std::sqrt(square));
      bent = std::max(0.0, across * (1 / (least * least) - 1 / (most * most)) / 4);
      const double off_a = std::abs(std::remainder(a.angle - from.at.X(), 2 * std::numbers::pi)),
                   off_b = std::abs(std::remainder(b.angle - to.at.X(), 2 * std::numbers::pi));
      // The line that the chord stands for is not farther from that of the parameters than both are high:
      // along a circle of the surface it is that circle, however the angle changes.
      bent = std::min(widest * bent, profile.u * std::abs(to.at.Y() - from.at.Y())) +
             widest * std::max(off_a, off_b);
    }
    return farthest_from_chord(hull, from.at, to.at, widest, profile.u) + bent;
  }

 private:
  struct Cylindrical {
    double radius = 0, angle = 0, height = 0;
    bool beyond = false;  ///< the axis
  };
  [[nodiscard]] Cylindrical cylindrical(const gp_Pnt& p) const {
    const gp_Vec from(origin_, p);
    const double x = from * gp_Vec(x_), y = from * gp_Vec(y_);
    return {std::hypot(x, y), std::atan2(y, x), from * z_, false};
  }

  /// A profile that has crossed the axis goes on at the angle of the other side.
  [[nodiscard]] Cylindrical cylindrical(const Corner& corner) const {
    Cylindrical made = cylindrical(corner.place);
    const double turn = std::remainder(made.angle - corner.at.X(), 2 * std::numbers::pi);
    made.beyond = std::abs(turn) > std::numbers::pi / 2;
    if (made.beyond) made.angle += std::numbers::pi;
    return made;
  }

  gp_Pnt origin_;
  gp_Dir x_, y_;
  gp_Vec z_;
  CurveBound profile_;
};

std::unique_ptr<SurfaceBound> revolved(const Handle(Geom_ElementarySurface) & surface, CurveBound profile) {
  const gp_Ax3& frame = surface->Position();
  return std::make_unique<RevolvedBound>(surface, frame.Location(), frame.XDirection(), frame.YDirection(),
                                         std::move(profile));
}

/// Only where the curve lies in a half plane at the axis: there u is the angle from it.
std::unique_ptr<SurfaceBound> revolved(const Handle(Geom_SurfaceOfRevolution) & surface) {
  Handle(Geom_Curve) curve = surface->BasisCurve();
  auto bound = bounded(curve);
  if (!bound) return nullptr;
  while (true) {
    const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve);
    if (trimmed.IsNull()) break;
    curve = trimmed->BasisCurve();
  }
  // Points that span the curve: it lies in a plane if they do.
  std::vector<gp_Pnt> points;
  if (const auto spline = spline_of(curve); !spline.IsNull()) {
    for (int k = 1; k <= spline->NbPoles(); ++k) points.push_back(spline->Pole(k));
  } else {
    const double first = surface->BasisCurve()->FirstParameter(),
                 last = surface->BasisCurve()->LastParameter();
    const bool is_line = !Handle(Geom_Line)::DownCast(curve).IsNull();
    for (const double t :
         is_line ? std::vector<double>{0, 1} : std::vector<double>{first, 0.5 * (first + last), last})
      points.push_back(curve->Value(t));
    if (!is_line)
      for (const double t : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) points.push_back(curve->Value(t));
  }
  const gp_Ax1 axis = surface->Axis();
  const gp_Vec along(axis.Direction());
  gp_Vec out(0, 0, 0);
  for (const gp_Pnt& p : points) {
    const gp_Vec from(axis.Location(), p), away = from - (from * along) * along;
    if (away.SquareMagnitude() > out.SquareMagnitude()) out = away;
  }
  if (!(out.Magnitude() > 1e-6)) return nullptr;
  const gp_Dir x(out), y(along ^ gp_Vec(x));
  for (const gp_Pnt& p : points)
    if (!(std::abs(gp_Vec(axis.Location(), p) * gp_Vec(y)) <= kOnAxis)) return nullptr;
  return std::make_unique<RevolvedBound>(surface, axis.Location(), x, y, *std::move(bound));
}

}  // namespace

gp_Pnt2d SurfaceBound::middle(const Corner& a, const Corner& b) const {
  const Free of_a = free_at(a), of_b = free_at(b);
  gp_Pnt2d made(0.5 * (a.at.X() + b.at.X()), 0.5 * (a.at.Y() + b.at.Y()));
  if (of_a == of_b) return made;
  const Free free = of_a == Free::none ? of_b : of_a;
  const gp_Pnt2d& bound = of_a == Free::none ? a.at : b.at;
  free == Free::u ? made.SetX(bound.X()) : made.SetY(bound.Y());
  return made;
}

BoundedSurface bounded(Handle(Geom_Surface) surface) {
  while (true) {
    const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
    if (trimmed.IsNull()) break;
    surface = trimmed->BasisSurface();
  }
  if (!Handle(Geom_Plane)::DownCast(surface).IsNull())
    return {std::make_unique<PlaneBound>(surface), "plane"};
  if (const auto s = Handle(Geom_CylindricalSurface)::DownCast(surface); !s.IsNull())
    return {revolved(s, {1, 0}), "cylinder"};
  if (const auto s = Handle(Geom_ConicalSurface)::DownCast(surface); !s.IsNull())
    return {revolved(s, {1, 0}), "cone"};
  if (const auto s = Handle(Geom_SphericalSurface)::DownCast(surface); !s.IsNull())
    return {revolved(s, {s->Radius(), s->Radius()}), "sphere"};
  if (const auto s = Handle(Geom_ToroidalSurface)::DownCast(surface); !s.IsNull())
    return {revolved(s, {s->MinorRadius(), s->MinorRadius()}), "torus"};
  if (const auto s = Handle(Geom_BSplineSurface)::DownCast(surface); !s.IsNull())
    return {std::make_unique<SplineBound>(s), "spline"};
  if (const auto s = Handle(Geom_BezierSurface)::DownCast(surface); !s.IsNull())
    return {std::make_unique<SplineBound>(GeomConvert::SurfaceToBSplineSurface(s)), "spline"};
  if (const auto s = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface); !s.IsNull()) {
    Handle(Geom_Curve) basis = s->BasisCurve();
    while (true) {
      const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(basis);
      if (trimmed.IsNull()) break;
      basis = trimmed->BasisCurve();
    }
    if (const auto spline = spline_of(basis); !spline.IsNull())
      return {std::make_unique<SplineBound>(s, spline), "extrusion"};
    auto curve = bounded(basis);
    if (!curve) return {nullptr, "extrusion of a curve that is neither line, circle, ellipse nor spline"};
    return {std::make_unique<ExtrusionBound>(s, *std::move(curve)), "extrusion"};
  }
  if (const auto s = Handle(Geom_SurfaceOfRevolution)::DownCast(surface); !s.IsNull()) {
    auto bound = revolved(s);
    if (!bound)
      return {nullptr, "surface of revolution of a curve that does not lie in a plane with the axis"};
    return {std::move(bound), "revolution"};
  }
  return {nullptr, "offset surface or one of an unknown kind"};
}

}  // namespace lekalo::step
