#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/cases.hpp"
#include "support/layout_documents.hpp"
#include "support/layout_texts.hpp"

/// Plots for knives of generated sheets: the blade of a drag knife, pulled along by formulas of this test
/// alone, cuts the outlines, and the checker says so; of what was changed it says the contrary.
namespace lekalo::verify::property_verify_knife_test {
namespace {

using geom::Point;

int cases_wanted() { return static_cast<int>(cases::case_count(80)); }

/// A slot with round ends, so that lines and arcs meet without a corner.
layout::Outline slot(Random& random) {
  const double r = random.uniform(0.6, 12), l = random.uniform(1, 80);
  const auto region = geom::make_region({{geom::EdgeKind::line, {0, -r}, {l, -r}, {}},
                                         {geom::EdgeKind::arc_ccw, {l, -r}, {l, r}, {l, 0}},
                                         {geom::EdgeKind::line, {l, r}, {0, r}, {}},
                                         {geom::EdgeKind::arc_ccw, {0, r}, {0, -r}, {0, 0}}});
  if (!region) throw std::logic_error("test input: " + region.error().message);
  auto polygon = geom::grid_region_of_curves(*region, geom::ChordSide::grow, 0.05);
  if (!polygon) throw std::logic_error("test input: " + polygon.error().message);
  layout::Outline outline;
  outline.polygon = *std::move(polygon);
  outline.curves.push_back(*region);
  outline.chord_tolerance_mm = 0.05;
  return outline;
}

/// Two parts, far from each other, as the text of a layout.
std::string some_layout(Random& random) {
  auto document = io::read_layout(cases::empty_layout().dump(), "empty");
  if (!document) throw std::logic_error("test input: " + document.error().message);
  for (const char* id : {"a", "b"}) {
    layout::Part part;
    part.id = id;
    part.outline = random.below(4) == 0 ? slot(random) : cases::random_outline(random, geom::ChordSide::grow);
    part.may_mirror = true;
    document->document.parts.push_back(std::move(part));
  }
  cases::Json json = cases::Json::parse(io::write_layout(document->document));
  json.erase("next_id");
  double x = 0;
  for (const char* id : {"a", "b"}) {
    place(json, id, x, random.uniform(-50, 50), random.uniform(0, 360))["mirrored"] = random.below(2) == 0;
    x += 5000;
  }
  return json.dump();
}

using Stroke = std::vector<Point>;

/// The strokes of pen 1.
std::vector<Stroke> strokes_of(const std::string& plot) {
  std::vector<Stroke> strokes;
  Point at;
  for (std::size_t begin = 0; begin < plot.size();) {
    const std::size_t end = std::min(plot.find(';', begin), plot.size());
    std::string word = plot.substr(begin, end - begin);
    begin = end + 1;
    word.erase(std::remove(word.begin(), word.end(), '\n'), word.end());
    if (word.rfind("PU", 0) != 0 && word.rfind("PD", 0) != 0) continue;
    const bool down = word[1] == 'D';
    std::vector<double> numbers;
    for (std::size_t i = 2; i < word.size();) {
      const std::size_t comma = std::min(word.find(',', i), word.size());
      numbers.push_back(0.025 * std::atoi(word.substr(i, comma - i).c_str()));
      i = comma + 1;
    }
    if (down) strokes.push_back({at});
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      at = {numbers[i], numbers[i + 1]};
      if (down) strokes.back().push_back(at);
    }
  }
  return strokes;
}

/// Pulls the tip behind the axis as a trailer is pulled: after each small step it lies on the line from where
/// it was to the axis, at the offset.
struct Trailer {
  double offset;
  Point tip;
  std::vector<Point> cut;

  void pull(Point from, Point to) {
    const double way = norm(to - from);
    const int steps = std::max(1, static_cast<int>(way / 0.004));
    for (int i = 1; i <= steps; ++i) {
      const Point axis = from + (static_cast<double>(i) / steps) * (to - from), back = tip - axis;
      tip = axis + (offset / norm(back)) * back;
      if (i == steps || i % 8 == 0) cut.push_back(tip);
    }
  }
};

double to_edge(Point p, const geom::Edge& edge) {
  const double ends = std::min(norm(p - edge.from), norm(p - edge.to));
  if (edge.kind == geom::EdgeKind::line) {
    const Point way = edge.to - edge.from;
    const double share = dot(p - edge.from, way) / dot(way, way);
    return share <= 0 || share >= 1 ? ends : std::abs(cross(way, p - edge.from)) / norm(way);
  }
  const double round = std::abs(norm(p - edge.centre) - norm(edge.from - edge.centre));
  if (edge.from == edge.to) return round;
  // Arcs of slots are half circles.
  const Point middle = edge.kind == geom::EdgeKind::arc_ccw ? -perpendicular(edge.from - edge.centre)
                                                            : perpendicular(edge.from - edge.centre);
  return dot(p - edge.centre, middle) <= 0 ? round : ends;
}

/// The contours of a part as drawn.
std::vector<geom::Contour> contours_of(const layout::Outline& outline) {
  std::vector<geom::Contour> contours;
  if (!outline.curves.empty()) {
    contours = outline.curves.front().holes;
    contours.push_back(outline.curves.front().outer);
    return contours;
  }
  const geom::GridRegion& polygon = outline.polygon;
  for (std::size_t loop = 0; loop < polygon.loops(); ++loop) {
    const std::size_t begin = polygon.loop_starts[loop], end = polygon.loop_starts[loop + 1];
    geom::Contour& contour = contours.emplace_back();
    for (std::size_t k = begin; k < end; ++k)
      contour.push_back({geom::EdgeKind::line,
                         geom::mm_from_grid(polygon.points[k]),
                         geom::mm_from_grid(polygon.points[k + 1 == end ? begin : k + 1]),
                         {}});
  }
  return contours;
}

/// A point of the sheet in the frame of a part.
Point in_part(Point p, const layout::Placement& placement) {
  const double c = std::ldexp(static_cast<double>(placement.rotation.c), -52),
               s = std::ldexp(static_cast<double>(placement.rotation.s), -52);
  const Point away = p - geom::mm_from_grid(placement.at);
  const Point turned{c * away.x + s * away.y, c * away.y - s * away.x};
  return placement.mirrored ? Point{-turned.x, turned.y} : turned;
}

std::vector<Point> places_on(const geom::Edge& edge) {
  if (edge.kind == geom::EdgeKind::line)
    return {edge.from, edge.from + 0.31 * (edge.to - edge.from), edge.from + 0.77 * (edge.to - edge.from)};
  const double turn = edge.from == edge.to ? kTurn : kPi;
  std::vector<Point> places;
  for (int i = 0; i < 12; ++i) {
    const double angle = (edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1) * turn * i / 12;
    const Point out = edge.from - edge.centre;
    places.push_back(edge.centre + std::cos(angle) * out + std::sin(angle) * geom::perpendicular(out));
  }
  return places;
}

/// How far what was cut is from the outlines at most, either way.
double farthest(const layout::Document& document, const std::vector<Point>& cut) {
  double most = 0;
  for (const layout::Placement& placement : document.placements) {
    std::vector<Point> mine;
    for (const Point p : cut)
      // Placements are 5 m apart, and parts within 2 m of their origin.
      if (norm(p - geom::mm_from_grid(placement.at)) < 2500) mine.push_back(in_part(p, placement));
    const auto contours = contours_of(document.parts[placement.part].outline);
    for (const Point p : mine) {
      double least = 1e9;
      for (const geom::Contour& contour : contours)
        for (const geom::Edge& edge : contour) least = std::min(least, to_edge(p, edge));
      most = std::max(most, least);
    }
    for (const geom::Contour& contour : contours)
      for (const geom::Edge& edge : contour)
        for (const Point p : places_on(edge)) {
          double least = 1e9;
          for (const Point q : mine) least = std::min(least, dot(p - q, p - q));
          most = std::max(most, std::sqrt(least));
        }
  }
  return most;
}

std::string told(const Result<ClaimReport>& report) {
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}

/// The plot with one place of a stroke moved by 4 mm.
std::string spoiled(const std::string& plot, Random& random) {
  std::vector<std::size_t> commas;
  for (std::size_t i = plot.find("PD"); i < plot.size(); ++i)
    if (plot[i] == ',' && plot[i - 1] != ',' && plot.rfind("PU", i) < plot.rfind("PD", i))
      commas.push_back(i);
  const std::size_t at = commas[random.below(commas.size())];
  const std::size_t end = plot.find_first_of(",;", at + 1);
  const int value = std::atoi(plot.substr(at + 1, end - at - 1).c_str());
  return plot.substr(0, at + 1) + std::to_string(value + 160) + plot.substr(end);
}

/// Places on the strokes of a knife that is where the plot says.
std::vector<Point> straight_cut(const std::vector<Stroke>& strokes) {
  std::vector<Point> cut;
  for (const Stroke& stroke : strokes)
    for (std::size_t k = 1; k < stroke.size(); ++k) {
      const Point way = stroke[k] - stroke[k - 1];
      const int parts = 1 + static_cast<int>(norm(way) / 0.1);
      for (int part = 0; part <= parts; ++part)
        cut.push_back(stroke[k - 1] + (static_cast<double>(part) / parts) * way);
    }
  return cut;
}

io::ExportRequest request_of(const std::vector<io::ExportWord>& words) {
  auto request = io::read_export_words(io::ExportForm::hpgl, words, "");
  if (!request) throw std::logic_error("test input: " + request.error().message);
  return *std::move(request);
}

TEST(KnifeProperty, TheTipOfADragKnifeFollowsTheOutlines) {
  double worst = 0;
  for (int i = 0; i < cases_wanted(); ++i) {
    Random random(2301, static_cast<std::uint64_t>(i));
    const std::string text = some_layout(random);
    const auto read = io::read_layout(text, "layout");
    ASSERT_TRUE(read.has_value()) << read.error().message;
    const double offset = random.uniform(0.05, 1.2), overcut = i % 2 == 0 ? 0 : random.uniform(0, 2);
    const auto made = io::export_layout(read->document, "x",
                                        request_of({{"process", "drag-knife"},
                                                    {"blade-offset", fmt::format("{}", offset)},
                                                    {"overcut", fmt::format("{}", overcut)},
                                                    {"turn-above", fmt::format("{}", random.uniform(1, 15))},
                                                    {"only", "CUT"}}));
    ASSERT_TRUE(made.has_value()) << i << ": " << made.error().message;
    const std::string& plot = made->files[0].bytes;
    // The axis begins in front of the tip, towards +x.
    Trailer blade{offset, {}, {}};
    Point forward{1, 0};
    for (const Stroke& stroke : strokes_of(plot)) {
      blade.tip = stroke.front() - offset * forward;
      blade.cut.push_back(blade.tip);
      for (std::size_t k = 1; k < stroke.size(); ++k) blade.pull(stroke[k - 1], stroke[k]);
      forward = (1 / offset) * (stroke.back() - blade.tip);
    }
    const double off = farthest(read->document, blade.cut);
    worst = std::max(worst, off);
    EXPECT_LE(off, 0.1) << i;
    ExportWords words;
    words.only = {"CUT"};
    words.knife = KnifeWords{offset, 0, 0.1};
    EXPECT_EQ(told(verify_export({"p.plt", plot}, {"l", text}, words)), "") << i;
    // What goes on beyond the end may lie on the outline wherever it is.
    if (overcut == 0) {
      EXPECT_NE(told(verify_export({"p.plt", spoiled(plot, random)}, {"l", text}, words)), "") << i;
    }
    words.knife->blade_offset = offset + 1;
    EXPECT_NE(told(verify_export({"p.plt", plot}, {"l", text}, words)), "") << i << ": another blade";
  }
  RecordProperty("worst_um", static_cast<int>(worst * 1000));
}

TEST(KnifeProperty, ATangentialKnifeIsLiftedAtCorners) {
  for (int i = 0; i < cases_wanted(); ++i) {
    Random random(2302, static_cast<std::uint64_t>(i));
    const std::string text = some_layout(random);
    const auto read = io::read_layout(text, "layout");
    ASSERT_TRUE(read.has_value()) << read.error().message;
    const double above = random.uniform(5, 40), overcut = i % 2 == 0 ? 0 : random.uniform(0, 2);
    const auto made = io::export_layout(read->document, "x",
                                        request_of({{"process", "tangential-knife"},
                                                    {"overcut", fmt::format("{}", overcut)},
                                                    {"turn-above", fmt::format("{}", above)},
                                                    {"only", "CUT"}}));
    ASSERT_TRUE(made.has_value()) << i << ": " << made.error().message;
    const std::string& plot = made->files[0].bytes;
    const std::vector<Stroke> strokes = strokes_of(plot);
    std::size_t corners = 0, smooth = 0;
    for (const layout::Placement& placement : read->document.placements)
      for (const geom::Contour& contour : contours_of(read->document.parts[placement.part].outline)) {
        std::size_t sharp = 0;
        for (std::size_t k = 0; k < contour.size(); ++k) {
          const geom::Edge &in = contour[k], &out = contour[(k + 1) % contour.size()];
          if (in.kind != geom::EdgeKind::line || out.kind != geom::EdgeKind::line) continue;
          const Point a = in.to - in.from, b = out.to - out.from;
          if (std::abs(std::atan2(cross(a, b), dot(a, b))) > kDegree * above) ++sharp;
        }
        // A contour whose first place is no corner begins in the middle of a stroke.
        const geom::Edge &last = contour.back(), &first = contour.front();
        const Point a = last.to - last.from, b = first.to - first.from;
        const bool begins_sharp = last.kind == geom::EdgeKind::line && first.kind == geom::EdgeKind::line &&
                                  std::abs(std::atan2(cross(a, b), dot(a, b))) > kDegree * above;
        corners += sharp;
        smooth += begins_sharp ? 0 : 1;
      }
    EXPECT_EQ(strokes.size(), corners + smooth) << i;
    ExportWords words;
    words.only = {"CUT"};
    words.knife = KnifeWords{0, kDegree * above, 0.1};
    EXPECT_EQ(told(verify_export({"p.plt", plot}, {"l", text}, words)), "") << i;
    EXPECT_LE(farthest(read->document, straight_cut(strokes)), 0.1) << i;
    // A place that moved along its edge spoils nothing.
    const std::string changed = spoiled(plot, random);
    if (overcut == 0 && farthest(read->document, straight_cut(strokes_of(changed))) > 0.2) {
      EXPECT_NE(told(verify_export({"p.plt", changed}, {"l", text}, words)), "") << i;
    }
    if (corners == 0) continue;
    // Without the lifts it is no plot for this knife.
    std::string joined = plot;
    for (std::size_t at = joined.find("\nPU"); (at = joined.find("\nPU", at + 1)) != std::string::npos;) {
      const std::size_t down = joined.find(";PD", at);
      if (down == std::string::npos) break;
      const std::string place = joined.substr(at + 3, down - at - 3);
      const std::string before = joined.substr(0, at);
      if (before.size() < place.size() + 1 || before.substr(before.size() - place.size() - 1) != place + ";")
        continue;
      joined = before.substr(0, before.size() - 1) + "," + joined.substr(down + 3);
    }
    EXPECT_NE(told(verify_export({"p.plt", joined}, {"l", text}, words)), "") << i;
  }
}

}  // namespace
}  // namespace lekalo::verify::property_verify_knife_test
