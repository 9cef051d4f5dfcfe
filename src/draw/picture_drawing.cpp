#include "picture_drawing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "lekalo/geom/distance.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr double kSamplesAround =
    800;                               ///< a sample every half millimetre of paper on a contour that fills it
constexpr double kBand = 2.0;          ///< width of the coloured band, mm of paper
constexpr double kThinBand = 1.2;      ///< of the coloured line for parts that have no room for the band
constexpr double kNearSamples = 0.15;  ///< mm of paper; closer samples share one piece of the band

/// Units in the last place of the largest coordinate, in a placed vertex and its distance.
constexpr double kRoundings = 16;

Ring placed(const Ring& part, const locate::Placement& at) {
  const auto pose = geom::BlankFromPart::from_angle(at.theta, {at.x, at.y});
  Ring ring(part.size());
  std::transform(part.begin(), part.end(), ring.begin(), pose);
  return ring;
}

double perimeter(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += geom::norm(ring[i + 1 == ring.size() ? 0 : i + 1] - ring[i]);
  }
  return sum;
}

Point nearest_of_outline(Point p, const Ring& ring) {
  Point nearest = ring[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point q = geom::nearest_on_segment(p, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    const double distance = geom::norm(q - p);
    if (distance < least) {
      least = distance;
      nearest = q;
    }
  }
  return nearest;
}

double extent(const Ring& ring) {
  const geom::Box box = geom::bounds(ring);
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

void set_range(Located& shapes) {
  const auto less = [](const auto& a, const auto& b) { return a.allowance < b.allowance; };
  const auto [thin, thick] = std::minmax_element(shapes.samples.begin(), shapes.samples.end(), less);
  shapes.thinnest = static_cast<std::size_t>(thin - shapes.samples.begin());
  shapes.least = thin->allowance;
  shapes.greatest = thick->allowance;
  const ColourRange range =
      colour_range(shapes.least, shapes.greatest, shapes.rounding, extent(shapes.blank));
  shapes.low = range.low;
  shapes.high = range.high;
}

/// Prefers a vertex in contact among places that are equally thin, for that is the one to show.
void prefer_contact(const PictureOfRings& rings, Located& shapes) {
  const double close = shapes.least + shapes.rounding + 1e-6 * (shapes.high - shapes.low);
  for (const locate::Contact& contact : rings.contacts) {
    const auto at_vertex = [&](const locate::AllowanceSample& sample) {
      return sample.part_edge == contact.part_vertex && sample.along == 0 && sample.allowance <= close;
    };
    const auto found = std::find_if(shapes.samples.begin(), shapes.samples.end(), at_vertex);
    if (found == shapes.samples.end()) continue;
    shapes.thinnest = static_cast<std::size_t>(found - shapes.samples.begin());
    return;
  }
}

/// A run of samples with one colour.
struct Piece {
  Ring line;      ///< on paper
  int level = 0;  ///< step of the colour scale, or below 0: outside the blank
};

/// The outline as pieces of one colour, each drawn a little into the next so that no seam shows.
std::vector<Piece> band_pieces(const Located& shapes, const View& view) {
  struct Stop {
    Point at;
    double allowance;
  };
  std::vector<Stop> stops;
  for (const locate::AllowanceSample& sample : shapes.samples) {
    const Point at = view(sample.at);
    if (!stops.empty() && geom::norm(at - stops.back().at) < kNearSamples) {
      stops.back().allowance = std::min(stops.back().allowance, sample.allowance);
    } else {
      stops.push_back({at, sample.allowance});
    }
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Stop& from = stops[i];
    const Stop& to = stops[i + 1 == stops.size() ? 0 : i + 1];
    const double allowance = std::min(from.allowance, to.allowance);
    const int level = allowance < -shapes.rounding ? -1 : scale_step(allowance, shapes.low, shapes.high);
    if (pieces.empty() || pieces.back().level != level) pieces.push_back({{from.at}, level});
    pieces.back().line.push_back(to.at);
  }
  constexpr double kInto = 0.5;  // mm of paper, some pixels of a small picture
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ring& next = pieces[i + 1 == pieces.size() ? 0 : i + 1].line;
    const Point begin = next[0], along = next[1] - begin;
    const double length = geom::norm(along);
    if (length > 0) pieces[i].line.push_back(begin + std::min(1.0, kInto / length) * along);
  }
  return pieces;
}

/// The lines of a piece near the visible rectangle.
std::vector<Ring> visible_lines(const Ring& line, const Rect& visible) {
  const Rect page = visible.grown(5);
  std::vector<Ring> lines;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto segment = clipped({line[i], line[i + 1]}, page);
    if (!segment) continue;
    if (lines.empty() || lines.back().back() != segment->a) lines.push_back({segment->a});
    lines.back().push_back(segment->b);
  }
  return lines;
}

void draw_band(const Located& shapes, const View& view, const Rect& visible, double width,
               std::vector<Item>& items) {
  for (const Piece& piece : band_pieces(shapes, view)) {
    const std::vector<Ring> lines = visible_lines(piece.line, visible);
    if (lines.empty()) continue;
    if (piece.level < 0) {
      items.push_back(PathItem{lines, false, stroked(kOutsideBase, width), {"allowance-outside-base", ""}});
      items.push_back(PathItem{lines, false, stroked(kOutside, width, 1.6), {"allowance-outside", ""}});
    } else {
      items.push_back(PathItem{lines, false, stroked(scale_colour(piece.level), width), {"allowance", ""}});
    }
  }
}

/// Twice the area over the perimeter: the width of a long shape, less than that of a round one.
double typical_width(const Ring& ring) {
  const double around = perimeter(ring);
  return around > 0 ? 2 * std::abs(geom::signed_area(ring)) / around : 0;
}

}  // namespace

Located located(const PictureOfRings& rings, const locate::Placement& result) {
  Located shapes;
  shapes.blank = rings.blank;
  shapes.part = placed(rings.part, result);
  shapes.start = placed(rings.part, rings.start);
  const double step = perimeter(shapes.part) / kSamplesAround;
  auto samples = locate::contour_allowance(rings.part, rings.blank, result, step);
  if (!samples) return shapes;
  shapes.samples = std::move(*samples);
  const double largest =
      std::max({geom::largest_coordinate(shapes.blank), geom::largest_coordinate(shapes.part),
                geom::largest_coordinate(rings.part)});
  shapes.rounding = kRoundings * std::numeric_limits<double>::epsilon() * largest;
  set_range(shapes);
  prefer_contact(rings, shapes);
  shapes.blank_at_thinnest = nearest_of_outline(shapes.samples[shapes.thinnest].at, shapes.blank);
  return shapes;
}

std::vector<ContactLine> contact_lines(const PictureOfRings& rings, const Located& shapes) {
  std::vector<ContactLine> lines;
  for (std::size_t i = 0; i < rings.contacts.size(); ++i) {
    const locate::Contact& contact = rings.contacts[i];
    if (contact.part_vertex >= shapes.part.size() || contact.blank_edge >= shapes.blank.size()) continue;
    const Point a = shapes.blank[contact.blank_edge];
    const Point b = shapes.blank[contact.blank_edge + 1 == shapes.blank.size() ? 0 : contact.blank_edge + 1];
    const Point vertex = shapes.part[contact.part_vertex], along = b - a;
    const Point foot = a + (dot(vertex - a, along) / dot(along, along)) * along;
    lines.push_back({i, vertex, foot, a, b});
  }
  return lines;
}

std::string contact_label(const PictureOfRings& rings, const locate::Contact& contact) {
  const auto number = [](const std::vector<std::uint32_t>& numbers, std::uint32_t index) {
    return index < numbers.size() ? numbers[index] : index;
  };
  return fmt::format("v{} e{}", number(rings.vertex_numbers, contact.part_vertex),
                     number(rings.edge_numbers, contact.blank_edge));
}

void draw_shapes(const Located& shapes, const View& view, const Rect& visible, std::vector<Item>& items) {
  const Ring blank = on_paper(shapes.blank, view, visible), part = on_paper(shapes.part, view, visible);
  const bool thin = typical_width(shapes.part) * view.scale < 1.5 * kBand;
  items.push_back(ClipBegin{{visible.ring()}});
  // The blank is painted over the part, so what it leaves uncovered of the part is what sticks out.
  if (shapes.sticks_out())
    items.push_back(PathItem{{part}, true, filled({250, 190, 196}), {"part-outside", ""}});
  items.push_back(PathItem{{blank}, true, filled(kBlankFill), {"blank", "blank"}});
  items.push_back(ClipBegin{{blank}});
  items.push_back(PathItem{{part}, true, filled(kPaper), {"part", "part at the result"}});
  items.push_back(ClipEnd{});
  if (!thin) items.push_back(ClipBegin{{part}});
  draw_band(shapes, view, visible, thin ? kThinBand : 2 * kBand, items);
  if (!thin) items.push_back(ClipEnd{});
  items.push_back(PathItem{{blank}, true, stroked(kBlankLine, 0.3), {"blank-outline", ""}});
  items.push_back(PathItem{{part}, true, stroked(kInk, thin ? 0.12 : 0.28), {"part-outline", ""}});
  items.push_back(ClipEnd{});
}

void draw_start(const Located& shapes, const View& view, const Rect& visible, std::vector<Item>& items) {
  items.push_back(PathItem{{on_paper(shapes.start, view, visible)},
                           true,
                           stroked(kStartLine, 0.35, 1.3),
                           {"start", "part at the start"}});
}

void draw_contacts(const PictureOfRings& rings, const std::vector<ContactLine>& lines, const View& view,
                   const Rect& visible, std::vector<Item>& items) {
  items.push_back(ClipBegin{{visible.ring()}});
  for (const ContactLine& line : lines) {
    const auto edge = clipped({view(line.edge_from), view(line.edge_to)}, visible.grown(5));
    if (edge) {
      items.push_back(PathItem{{{edge->a, edge->b}}, false, stroked(kInk, 0.5), {"contact-edge", ""}});
    }
  }
  for (const ContactLine& line : lines) {
    const locate::Contact& contact = rings.contacts[line.index];
    const Point vertex = view(line.vertex), foot = view(line.foot);
    Paint stroke = stroked(kInk, 0.5);
    stroke.round = true;
    items.push_back(
        PathItem{{{vertex, foot}}, false, stroke, {"contact", "contact " + contact_label(rings, contact)}});
    Paint dot = filled(kPaper);
    dot.stroke = kInk;
    dot.width = 0.4;
    items.push_back(DotItem{vertex, 0.8, dot, {"contact-vertex", ""}});
    items.push_back(DotItem{foot, 0.4, filled(kInk), {"contact-foot", ""}});
  }
  items.push_back(ClipEnd{});
}

}  // namespace lekalo::draw
