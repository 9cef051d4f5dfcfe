#include "written_contours.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "arc_middle.hpp"
#include "drawn_shapes.hpp"
#include "exact_arcs.hpp"
#include "io/text/decimal.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

using geom::DoubleDouble;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// The most neighbours looked at on either side of a number.
constexpr int kNeighbours = 8;

/// The first of value, its neighbours, their neighbours ... that is accepted; value if none is.
template <class Accept>
double nearest_accepted(double value, Accept&& accept) {
  if (accept(value)) return value;
  double up = value, down = value;
  for (int i = 0; i < kNeighbours; ++i) {
    up = std::nextafter(up, std::numeric_limits<double>::infinity());
    if (accept(up)) return up;
    down = std::nextafter(down, -std::numeric_limits<double>::infinity());
    if (accept(down)) return down;
  }
  return value;
}

double half_unit_of(double v) {
  return 0.5 * (std::nextafter(std::abs(v), std::numeric_limits<double>::infinity()) - std::abs(v));
}

/// The level of the centre: its distance to the left of the chord's middle in chords, (1 - b^2) / (4 b) for
/// the bulge b. A reader computes the centre from it, rounded in x and in y. The result is therefore a number
/// that rounds to both coordinates if there is one, else the centre's place along the perpendicular.
DoubleDouble left_of_chord(const Edge& arc) {
  const DoubleDouble dx = geom::two_sum(arc.to.x, -arc.from.x), dy = geom::two_sum(arc.to.y, -arc.from.y);
  const DoubleDouble half{0.5};
  const DoubleDouble x = DoubleDouble{arc.centre.x} - half * geom::two_sum(arc.from.x, arc.to.x);
  const DoubleDouble y = DoubleDouble{arc.centre.y} - half * geom::two_sum(arc.from.y, arc.to.y);
  const DoubleDouble projected = level_of_centre(arc);
  if (dx.hi == 0 || dy.hi == 0) return projected;
  DoubleDouble fine = -(x / dy), coarse = y / dx;
  double fine_unit = half_unit_of(arc.centre.x) / std::abs(dy.hi),
         coarse_unit = half_unit_of(arc.centre.y) / std::abs(dx.hi);
  if (fine_unit > coarse_unit) std::swap(fine, coarse), std::swap(fine_unit, coarse_unit);
  const double apart = (coarse - fine).hi;
  const double low = std::max(-fine_unit, apart - coarse_unit),
               high = std::min(fine_unit, apart + coarse_unit);
  return low <= high ? fine + DoubleDouble{0.5 * (low + high)} : projected;
}

/// Readers take numbers up to kLargestMillimetres, the sides of a page among them.
constexpr double kLargestWritten = kLargestMillimetres / 2;

double largest_number(const geom::Contour& contour) {
  const geom::Box box = geom::bounds(contour);
  double largest = 0;
  const auto include = [&](Point p) { largest = std::max({largest, std::abs(p.x), std::abs(p.y)}); };
  include(box.low), include(box.high);
  for (const Edge& edge : contour)
    if (edge.kind != EdgeKind::line) include(edge.centre), include({geom::arc_radius(edge), 0});
  return largest;
}

}  // namespace

namespace {

/// Fails where a chain is beyond what can be written.
Result<void> check_numbers(const geom::Contour& contour) {
  const double largest = largest_number(contour);
  if (largest <= kLargestWritten) return {};
  return failure(ErrorCode::usage,
                 fmt::format("a coordinate, centre or radius of {:.6g} mm cannot be written: drawings go up "
                             "to {:g} mm; an arc that flat is better a line",
                             largest, kLargestWritten));
}

}  // namespace

Result<WrittenDrawing> written_drawing(const std::vector<LayeredRegion>& regions, const DrawingExtras& extras,
                                       bool (*same_name)(const std::string&, const std::string&)) {
  WrittenDrawing made;
  const auto layer = [&](const std::string& name) {
    const auto found = std::find_if(made.layers.begin(), made.layers.end(),
                                    [&](const std::string& known) { return same_name(known, name); });
    const auto index = static_cast<std::size_t>(found - made.layers.begin());
    if (index == made.layers.size()) made.layers.push_back(name);
    return index;
  };
  const auto add = [&](const geom::Contour& contour, const std::string& name) {
    const geom::Box box = geom::bounds(contour);
    if (made.contours.empty()) made.box = box;
    made.box = {{std::min(made.box.low.x, box.low.x), std::min(made.box.low.y, box.low.y)},
                {std::max(made.box.high.x, box.high.x), std::max(made.box.high.y, box.high.y)}};
    made.contours.push_back({&contour, layer(name)});
  };
  for (const LayeredRegion& one : regions) {
    std::vector<const geom::Contour*> contours{&one.region.outer};
    for (const geom::Contour& hole : one.region.holes) contours.push_back(&hole);
    for (const geom::Contour* contour : contours) LEKALO_CHECK(check_numbers(*contour));
    const std::size_t holes = one.region.holes.size(), named = one.hole_layers.size();
    if (named != 0 && named != holes)
      return failure(ErrorCode::usage, fmt::format("{} layers are given for {} holes", named, holes));
    add(one.region.outer, one.layer);
    for (std::size_t h = 0; h < holes; ++h)
      add(one.region.holes[h], named == 0 ? one.layer : one.hole_layers[h]);
  }
  for (const DrawnChain& chain : extras.chains) {
    LEKALO_CHECK(check_numbers(chain.edges));
    add(chain.edges, chain.layer.name);
    made.contours.back().is_open = !(chain.edges.back().to == chain.edges.front().from);
    made.contours.back().colour = chain.layer.colour;
  }
  const auto extend = [&](Point p) {
    made.box = {{std::min(made.box.low.x, p.x), std::min(made.box.low.y, p.y)},
                {std::max(made.box.high.x, p.x), std::max(made.box.high.y, p.y)}};
  };
  for (const DrawnLine& line : extras.lines) {
    extend(line.from), extend(line.to);
    made.lines.push_back({line.from, line.to, layer(line.layer)});
  }
  for (const DrawnText& text : extras.texts) {
    // Widths are multiples of the font's size, of which capitals are 0.72.
    std::string clean = clean_text(text.text);
    const Point half = text.height * Point{0.5 * text_width(clean) / 0.72, 1};
    extend(text.middle - half), extend(text.middle + half);
    made.texts.push_back({std::move(clean), text.middle, text.height, layer(text.layer)});
  }
  for (const ReadText& text : extras.set_texts) {
    // It is turned to any side, so that its box is a circle's.
    std::string clean = clean_text(text.text);
    const double reach = text.height * (1 + text.width_factor * text_width(clean) / 0.72);
    extend(text.at - Point{reach, reach}), extend(text.at + Point{reach, reach});
    made.set_texts.push_back({&text, std::move(clean), layer(text.layer.name)});
  }
  for (const std::string& name : made.layers) {
    LayerColour colour{name, 7, 0};
    for (const LayerColour& known : extras.colours)
      if (same_name(known.layer, name)) colour = known;
    made.colours.push_back(colour);
  }
  return made;
}

std::optional<std::vector<std::uint32_t>> letters_of(const std::string& text) {
  std::vector<std::uint32_t> letters;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80 ? 0 : first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    if (first >= 0xf8 || (first >= 0x80 && first < 0xc0)) return std::nullopt;
    std::uint32_t letter = more == 0 ? first : first & (0x3fU >> static_cast<unsigned>(more));
    for (int k = 0; k < more; ++k) {
      if (i == text.size()) return std::nullopt;
      const auto next = static_cast<unsigned char>(text[i++]);
      if ((next & 0xc0U) != 0x80U) return std::nullopt;
      letter = letter << 6U | (next & 0x3fU);
    }
    constexpr std::uint32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
    if (letter < kLeast[more] || letter > 0x10ffff || (letter >= 0xd800 && letter < 0xe000))
      return std::nullopt;
    letters.push_back(letter);
  }
  return letters;
}

double bulge_of(const Edge& arc) {
  const DoubleDouble aimed = bulge_of_level(left_of_chord(arc), arc.kind == EdgeKind::arc_ccw);
  return nearest_accepted(aimed.hi, [&](double bulge) {
    const auto read = bulge_arc({arc.from, 0}, {arc.to, 0}, bulge);
    return read && std::get<Edge>(read->shape) == arc;
  });
}

double radius_of_circle(const Edge& circle_edge) {
  const Point centre = circle_edge.centre;
  if (circle_edge.from.y != centre.y || !(circle_edge.from.x > centre.x))
    return geom::arc_radius(circle_edge);
  return nearest_accepted(circle_edge.from.x - centre.x, [&](double radius) {
    return radius > 0 && std::get<Edge>(circle({centre, 0}, {radius, 0}).shape).from == circle_edge.from;
  });
}

std::vector<Edge> halves_of(const Edge& arc) {
  Edge first = arc, second = arc;
  first.to = second.from = middle_of(make_curve(arc));
  return {first, second};
}

}  // namespace lekalo::io
