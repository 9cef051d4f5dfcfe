#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "entities.hpp"
#include "fit_spline.hpp"
#include "io/text/refusal.hpp"

// Reads SPLINE.

namespace lekalo::io {
namespace {

using geom::Point;

/// A spline as it stands in the file.
struct SplineText {
  Spline spline;
  unsigned degree = 0;
  unsigned said_knots = 0, said_poles = 0;  ///< 0: not said
  std::vector<Point> fit_points;
  double fit_error = 0;
  Point tangents[2];  ///< at the begin and the end; both coordinates 0 where none is said
  double pole_error = 0, knot_error = 0;
  bool weights_rounded = false;
  bool wants_y = false;
  std::string_view last_knot;
  bool knots_unclear = false;  ///< different decimals became the same double
};

/// The largest distance between poles that carry one span, from above.
double local_size(const Spline& spline) {
  // Windows of degree + 1 poles; the box of two halves' boxes is not needed sharp, so each window is walked.
  double size = 0;
  const std::size_t window = spline.degree + 1;
  for (std::size_t first = 0; first + window <= spline.poles.size(); ++first) {
    Point low = spline.poles[first], high = low;
    for (std::size_t i = first; i < first + window; ++i) {
      low = {std::min(low.x, spline.poles[i].x), std::min(low.y, spline.poles[i].y)};
      high = {std::max(high.x, spline.poles[i].x), std::max(high.y, spline.poles[i].y)};
    }
    size = std::max(size, geom::norm(high - low));
  }
  return size * (1 + 0x1p-40);
}

/// The distance by which rounded poles, knots and weights may have moved the curve (docs/design/drawing.md,
/// "Errors").
double spline_error(const SplineText& text) {
  const Spline& spline = text.spline;
  double error = 1.5 * text.pole_error;
  if (text.knot_error == 0 && !text.weights_rounded) return error;
  const double size = local_size(spline);
  double narrowest = HUGE_VAL;
  for (std::size_t i = spline.degree; i < spline.poles.size(); ++i) {
    const double width = spline.knots[i + 1] - spline.knots[i];
    if (width > 0) narrowest = std::min(narrowest, width);
  }
  double spread = 1;
  if (!spline.weights.empty()) {
    const auto [least, most] = std::minmax_element(spline.weights.begin(), spline.weights.end());
    spread = 2 * *most / *least;
  }
  const double knots = 8 * static_cast<double>(spline.degree) * text.knot_error / narrowest * spread;
  const double weights = text.weights_rounded ? 4 * kUnitRoundoff : 0;
  // The curve never leaves the hull of the poles around it, however little is known of its knots.
  error += text.knots_unclear || !(knots + weights < 1) ? size : (knots + weights) * size;
  return error * (1 + 0x1p-40);
}

/// Says why a spline is not read; null where it is.
const char* unread_because(const SplineText& text) {
  const Spline& spline = text.spline;
  if (spline.poles.empty()) return "without control points";
  if (spline.knots.empty()) return "without knots";
  if (text.degree == 0) return "degree 0";
  if (text.degree > kHighestDegree) return "degree above 15";
  if (std::any_of(spline.weights.begin(), spline.weights.end(), [](double w) { return !(w > 0); })) {
    return "a weight not above 0";
  }
  return nullptr;
}

/// Says why the curve between the first and the last knot that counts cannot be read, or nullptr.
const char* broken_because(const Spline& spline) {
  const std::size_t p = spline.degree, n = spline.poles.size();
  if (spline.knots[p] == spline.knots[n]) return "of no length";
  // A knot repeated more than `degree` times inside leaves a gap there.
  for (std::size_t i = 1; i + p < n + p; ++i) {
    const bool inside = spline.knots[i] > spline.knots[p] && spline.knots[i] < spline.knots[n];
    if (inside && spline.knots[i] == spline.knots[i + p]) return "in pieces";
  }
  return nullptr;
}

}  // namespace

Result<void> DxfEntities::read_fit(std::vector<Point>& points, double& error, Point (&tangents)[2]) {
  const int code = at_.code();
  const bool is_point = code % 10 == 1, is_x = code < 20;
  LEKALO_TRY(const auto value, number(is_point));
  if (is_point && is_x) points.push_back({value.value, 0});
  if (is_point) {
    if (points.empty()) return refuse_line(at_.name(), at_.line(), "a y without its x");
    if (!is_x) points.back().y = value.value;
    error = std::max(error, value.error);
    return {};
  }
  Point& tangent = tangents[code % 10 - 2];
  (is_x ? tangent.x : tangent.y) = value.value;
  return {};
}

Result<void> DxfEntities::read_spline(DxfBlock& into) {
  SplineText text;
  Spline& spline = text.spline;
  while (at_.next() && at_.code() != 0) {
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    const int code = at_.code();
    if (code >= 11 && code <= 23 && code % 10 >= 1 && code % 10 <= 3) {
      LEKALO_CHECK(read_fit(text.fit_points, text.fit_error, text.tangents));
    }
    if (code == 30 || code == 31) note_height();
    if (code == 71 || code == 72 || code == 73) {
      LEKALO_TRY(const auto value, whole_number());
      (code == 71 ? text.degree : code == 72 ? text.said_knots : text.said_poles) = value;
    }
    if (code != 10 && code != 20 && code != 40 && code != 41) continue;
    LEKALO_TRY(const auto value, number(code < 40));
    if (code == 40) {
      if (!spline.knots.empty() && !(spline.knots.back() <= value.value)) {
        return refuse_line(at_.name(), at_.line(),
                           fmt::format("the knot {} of the SPLINE of line {} is below the one before it",
                                       excerpt(at_.value()), common_.line));
      }
      const bool repeats = !spline.knots.empty() && spline.knots.back() == value.value;
      text.knots_unclear =
          text.knots_unclear || (repeats && value.error > 0 && at_.value() != text.last_knot);
      text.last_knot = at_.value();
      text.knot_error = std::max(text.knot_error, value.error);
      spline.knots.push_back(value.value);
    } else if (code == 41) {
      text.weights_rounded = text.weights_rounded || value.error > 0;
      spline.weights.push_back(value.value);
    } else if (text.wants_y != (code == 20)) {
      return refuse_line(at_.name(), at_.line(),
                         text.wants_y ? "an x, but the one before has no y" : "a y without its x");
    } else if (code == 10) {
      spline.poles.push_back({value.value, 0});
      text.pole_error = std::max(text.pole_error, value.error);
      text.wants_y = true;
    } else {
      spline.poles.back().y = value.value;
      text.pole_error = std::max(text.pole_error, value.error);
      text.wants_y = false;
    }
  }
  if (!at_.ok()) return {};
  if (text.wants_y) return refuse_entity("has an x without its y");
  const std::size_t knots = spline.knots.size(), poles = spline.poles.size();
  const bool miscounted = (text.said_knots != 0 && text.said_knots != knots) ||
                          (text.said_poles != 0 && text.said_poles != poles) ||
                          (!spline.weights.empty() && spline.weights.size() != poles) ||
                          (poles != 0 && knots != 0 && knots != poles + text.degree + 1) ||
                          (poles != 0 && poles <= text.degree);
  if (miscounted) {
    return refuse_entity(
        fmt::format("has {} knots, {} control points and {} weights for degree {}; the file is damaged",
                    knots, poles, spline.weights.size(), text.degree));
  }
  if (is_out_of_sight(into)) return {};
  if (spline.poles.empty() && !text.fit_points.empty()) {
    const auto said = [](const Point& p) { return p == Point{} ? std::nullopt : std::optional<Point>(p); };
    auto through =
        spline_through(text.fit_points, text.fit_error, said(text.tangents[0]), said(text.tangents[1]));
    if (through) return add(into, {}, *std::move(through));
    count_unread(into, "of no length");
    return {};
  }
  if (const char* why = unread_because(text)) {
    count_unread(into, why);
    return {};
  }
  spline.degree = text.degree;
  if (const char* why = broken_because(spline)) {
    count_unread(into, why);
    return {};
  }
  const double error = spline_error(text);
  if (std::adjacent_find(spline.weights.begin(), spline.weights.end(), std::not_equal_to<>()) ==
      spline.weights.end()) {
    spline.weights.clear();
  }
  // Poles are points of the drawing; the image of the curve is the curve of their images.
  return add(into, {}, {std::move(spline), error});
}

}  // namespace lekalo::io
