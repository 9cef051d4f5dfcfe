#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "support/drawn_region_cases.hpp"

// The laws of drawing_writer.hpp.

namespace lekalo::io::io_drawing_writer_test {
namespace {

using cases::case_count;
using cases::seed;
using geom::Contour;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

std::vector<LayeredRegion> layered(const std::vector<Region>& regions) {
  std::vector<LayeredRegion> made;
  for (const Region& region : regions) made.push_back({region, "CUT", {}});
  return made;
}

double allowed(const Edge& arc) {
  double size = geom::arc_radius(arc);
  for (const Point p : {arc.from, arc.to, arc.centre}) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  return kWrittenArcError * size + 2 * std::abs(norm(arc.from - arc.centre) - norm(arc.to - arc.centre));
}

/// What came of one contour: the same edges, where some were halved two for one.
void expect_same(const Contour& written, const Contour& read, const std::string& name) {
  if (written.size() == 1) {
    ASSERT_EQ(read.size(), 1u) << name;
    EXPECT_EQ(read[0].kind, written[0].kind) << name;
    EXPECT_EQ(read[0].centre, written[0].centre) << name;
    EXPECT_LE(std::abs(geom::arc_radius(read[0]) - geom::arc_radius(written[0])), allowed(written[0]))
        << name;
    const Point first = written[0].from, centre = written[0].centre;
    if (first.y == centre.y && first.x > centre.x && centre.x + (first.x - centre.x) == first.x) {
      EXPECT_EQ(read[0], written[0]) << name;
    }
    return;
  }
  std::size_t k = 0;
  for (const Edge& edge : written) {
    std::vector<Edge> parts;
    do {
      ASSERT_LT(k, read.size()) << name;
      parts.push_back(read[k++]);
    } while (parts.size() < 4 && parts.back().to != edge.to);
    EXPECT_EQ(parts.front().from, edge.from) << name;
    EXPECT_EQ(parts.back().to, edge.to) << name;
    if (edge.kind == EdgeKind::line) {
      EXPECT_EQ(parts, std::vector<Edge>{edge}) << name;
      continue;
    }
    for (const Edge& part : parts) EXPECT_EQ(part.kind, edge.kind) << name;
    EXPECT_TRUE(parts.size() == 1 || geom::arc_sweep(edge) > 3) << name;
    const double rounding = 1e-15 * (norm(edge.from) + norm(edge.centre) + geom::arc_radius(edge));
    for (const Point p : cases::points_of(edge, 12))
      EXPECT_LE(cases::distance_to_edges(p, parts), allowed(edge) + rounding) << name;
    for (const Edge& part : parts)
      for (const Point p : cases::points_of(part, 12))
        EXPECT_LE(cases::distance_to_edges(p, {edge}), allowed(edge) + rounding) << name;
  }
  EXPECT_EQ(k, read.size()) << name;
}

void expect_same(const std::vector<Region>& written, const std::vector<Region>& read,
                 const std::string& name) {
  ASSERT_EQ(read.size(), written.size()) << name;
  for (std::size_t i = 0; i < written.size(); ++i) {
    expect_same(written[i].outer, read[i].outer, name);
    ASSERT_EQ(read[i].holes.size(), written[i].holes.size()) << name;
    for (std::size_t h = 0; h < written[i].holes.size(); ++h)
      expect_same(written[i].holes[h], read[i].holes[h], name);
  }
}

/// Of lines and of arcs of many radii and sweeps, also beyond half a turn and nearly of one.
Region ragged(Random& random) {
  const Point at{random.uniform(-500, 500), random.uniform(-500, 500)};
  geom::Ring corners;
  const std::size_t n = 3 + random.below(6);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [sine, cosine] =
        geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(n));
    corners.push_back(at + random.uniform(60, 80) * Point{cosine, sine});
  }
  Contour contour;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = corners[i], b = corners[(i + 1) % n], middle = 0.5 * (a + b);
    const double heights[] = {0, 1e-13, 1e-9, 1e-4, 0.1, 0.5, 3};
    const double height = heights[random.below(7)] * (random.below(2) == 0 ? 1 : -1);
    switch (random.below(3)) {
      case 0:
        contour.push_back({EdgeKind::line, a, b, {}});
        break;
      default: {
        // Bulging outwards a little (far centre) or through about half a turn and more.
        const bool out = random.below(2) == 0;
        const double away = random.below(2) == 0 ? height : (out ? 4 : -4);
        const Point centre = middle + away * perpendicular(b - a);
        contour.push_back({out ? EdgeKind::arc_ccw : EdgeKind::arc_cw, a, b, centre});
      }
    }
  }
  auto made = geom::make_region(contour);
  if (made && !geom::fault_of({*made})) return *std::move(made);
  return cases::region_detail::region(cases::boolean_slot(at.x, at.y, 5, 2, random.below(2) == 0));
}

std::vector<Region> written_case(Random& random, std::uint64_t index) {
  return index % 2 == 0 ? cases::random_regions(random, index) : std::vector<Region>{ragged(random)};
}

std::vector<Region> read_back(const Result<Drawing>& drawing, double join_tolerance) {
  EXPECT_TRUE(drawing.has_value()) << (drawing ? "" : drawing.error().message);
  if (!drawing) return {};
  EXPECT_TRUE(drawing->unread.empty() && drawing->notices.empty())
      << (drawing->notices.empty() ? "" : drawing->notices.front());
  DrawingOptions options;
  options.join_tolerance = join_tolerance;
  const auto found = make_regions(*drawing, options);
  EXPECT_TRUE(found.has_value()) << (found ? "" : found.error().message);
  if (!found) return {};
  EXPECT_EQ(found->moved, 0);
  return found->regions;
}

std::vector<Region> read_dxf(const std::string& text, double join_tolerance = 0.01) {
  return read_back(parse_dxf(text, "written.dxf"), join_tolerance);
}
std::vector<Region> read_svg(const std::string& text, double join_tolerance = 0.01) {
  return read_back(parse_svg(text, "written.svg"), join_tolerance);
}

/// As by a program that does not keep what it does not know.
std::string without(std::string text, const std::string& word) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos;) text[at] = 'X';
  return text;
}
std::string as_others_read_dxf(const std::string& text) { return without(text, "LEKALO_EXACT_ARCS"); }
std::string as_others_read_svg(const std::string& text) { return without(text, "data-lekalo-arcs"); }

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(DrawingWriterLaws, LayersComeBackInBothFormats) {
  const auto region =
      cases::region_detail::region(cases::boolean_rectangle(0, 0, 20, 10),
                                   {cases::boolean_circle({5, 5}, 2), cases::boolean_circle({15, 5}, 2)});
  const std::vector<LayeredRegion> regions{{region, "Контур <1>", {"inner", "INNER"}}};
  const auto names = [](const Result<Drawing>& drawing) {
    std::vector<std::string> found;
    for (const Layer& layer : drawing->layers) found.push_back(layer.name);
    return found;
  };
  EXPECT_EQ(names(parse_svg(*svg_drawing(regions), "x.svg")),
            (std::vector<std::string>{"Контур <1>", "inner", "INNER"}));
  EXPECT_EQ(dxf_drawing(regions).error().code, ErrorCode::usage);
  auto allowed_names = regions;
  allowed_names[0].layer = "Контур 1";
  EXPECT_EQ(names(parse_dxf(*dxf_drawing(allowed_names), "x.dxf")),
            (std::vector<std::string>{"Контур 1", "inner"}));
  for (const char* name : {"", "a/b", "\xff", "a\nb", " a", "=", "\xed\xa0\x80"}) {
    EXPECT_FALSE(dxf_drawing({{region, name, {}}}).has_value()) << name;
  }
  for (const char* name : {"", "\xff", "a\nb"})
    EXPECT_FALSE(svg_drawing({{region, name, {}}}).has_value()) << name;
  EXPECT_EQ(dxf_drawing({{region, "0", {"one"}}}).error().message, "1 layers are given for 2 holes");
}

/// Also ends that are off their circle by up to what regions allow, other places and sizes, and circles that
/// begin anywhere.
Region loose(Random& random) {
  const double size = std::pow(2.0, random.uniform(-20, 20)),
               away = random.uniform(0, std::min(1e3 * size, 1e6));
  const Point at{random.uniform(-away, away), random.uniform(-away, away)};
  const auto turn = [&] { return geom::sincos(random.uniform(0, 6.28)); };
  if (random.below(4) == 0) {
    const auto [sine, cosine] = turn();
    const Point start = at + size * Point{cosine, sine};
    if (auto made = geom::make_region({{EdgeKind::arc_ccw, start, start, at}})) return *std::move(made);
  }
  if (random.below(4) == 0) {
    // A circle whose end has missed its beginning.
    const Point a = at + Point{size, 0};
    const double gap = std::min(1e-3, 0.2 * size) * std::pow(2.0, random.uniform(-10, 0));
    const auto [sine, cosine] = turn();
    const Point b = a + gap * Point{cosine, sine};
    if (auto made = geom::make_region({{EdgeKind::arc_ccw, a, b, at}, {EdgeKind::line, b, a, {}}});
        made && !geom::fault_of({*made}))
      return *std::move(made);
  }
  const std::size_t n = 2 + random.below(5);
  geom::Ring corners;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [sine, cosine] = geom::sincos(6.2831853 * static_cast<double>(i) / static_cast<double>(n));
    corners.push_back(at + size * Point{cosine, sine});
  }
  Contour contour;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = corners[i], b = corners[(i + 1) % n], chord = b - a;
    if (n > 2 && random.below(3) == 0) {
      contour.push_back({EdgeKind::line, a, b, {}});
      continue;
    }
    const double heights[] = {0, 1e-15, 1e-8, 0.3, 2, 1e4, 1e6, 1e9};
    const double height = heights[random.below(8)] * (random.below(4) == 0 ? -1 : 1);
    const double off[] = {0, 1e-12, 1e-4};
    const Point along = off[random.below(3)] * random.uniform(-1, 1) *
                        (norm(chord) > 0 ? 1 / norm(chord) : 0) * std::min(1.0, size) * chord;
    contour.push_back({EdgeKind::arc_ccw, a, b, 0.5 * (a + b) + height * perpendicular(chord) + along});
  }
  auto made = geom::make_region(contour);
  if (made && !geom::fault_of({*made}) && dxf_drawing({{*made, "0", {}}})) return *std::move(made);
  return cases::region_detail::region(cases::boolean_slot(at.x, at.y, 5, 2, random.below(2) == 0));
}

std::vector<Region> exact_case(Random& random, std::uint64_t index) {
  return index % 4 == 3 ? std::vector<Region>{loose(random)} : written_case(random, index);
}

TEST(DrawingWriterLaws, RegionsComeBackBitForBitAndAreWrittenAgainAsTheSameBytes) {
  std::size_t arcs = 0, stated[] = {0, 0};
  for (std::uint64_t index = 0; index < case_count(300); ++index) {
    Random random(seed(), 11000 + index);
    const auto regions = exact_case(random, index);
    const std::string name = "seed " + std::to_string(seed()) + " case " + std::to_string(index);
    const auto dxf = dxf_drawing(layered(regions)), svg = svg_drawing(layered(regions));
    ASSERT_TRUE(dxf && svg) << name;
    // What is narrower than the join tolerance is taken for two copies of a line.
    const double join_tolerance = index % 4 == 3 ? 0 : 0.01;
    const auto from_dxf = read_dxf(*dxf, join_tolerance), from_svg = read_svg(*svg, join_tolerance);
    ASSERT_EQ(from_dxf, regions) << name << "\n" << *dxf;
    ASSERT_EQ(from_svg, regions) << name << "\n" << *svg;
    EXPECT_EQ(*dxf_drawing(layered(from_svg)), *dxf) << name;
    EXPECT_EQ(*svg_drawing(layered(from_dxf)), *svg) << name;
    for (const Edge& edge : cases::edges_of(regions)) arcs += edge.kind == EdgeKind::line ? 0 : 1;
    stated[0] += count_of(*dxf, "cw ") + count_of(*dxf, "start ");
    stated[1] += count_of(*svg, "cw ") + count_of(*svg, "start ");
  }
  // Otherwise the records are not tested.
  EXPECT_GT(stated[0], case_count(300) / 4);
  EXPECT_GT(stated[1], case_count(300) / 4);
  std::printf("%zu arcs, of which DXF states %zu and SVG %zu beside their curves\n", arcs, stated[0],
              stated[1]);
}

TEST(DrawingWriterLaws, OtherProgramsSeeTheSameCurvesWithinTheStatedError) {
  for (std::uint64_t index = 0; index < case_count(150); ++index) {
    Random random(seed(), 11000 + index);
    const auto regions = written_case(random, index);
    const std::string name = "seed " + std::to_string(seed()) + " case " + std::to_string(index);
    const auto read = read_dxf(as_others_read_dxf(*dxf_drawing(layered(regions))));
    expect_same(regions, read, name);
    expect_same(regions, read_svg(as_others_read_svg(*svg_drawing(layered(regions)))), name);
    if (HasFailure()) return;
  }
}

// Whichever of the two a program takes, the curve or what is stated beside it.
TEST(DrawingWriterLaws, TheErrorOfAnExactArcReachesToTheCurveBesideIt) {
  std::size_t compared = 0;
  for (std::uint64_t index = 0; index < case_count(150); ++index) {
    Random random(seed(), 11000 + index);
    const auto regions = index % 2 == 0 ? std::vector<Region>{loose(random)} : exact_case(random, index);
    const std::string dxf = *dxf_drawing(layered(regions)), svg = *svg_drawing(layered(regions));
    const auto compare = [&](const Drawing& exact, const Drawing& plain) {
      std::size_t k = 0;
      for (const DrawnCurve& curve : exact.curves) {
        const Edge& edge = std::get<Edge>(curve.shape);
        std::vector<Edge> parts;
        double error = curve.error;
        do {
          ASSERT_LT(k, plain.curves.size());
          parts.push_back(std::get<Edge>(plain.curves[k].shape));
          error = std::max(error, plain.curves[k++].error);
        } while (parts.size() < 4 && parts.back().to != edge.to && parts.back().from != parts.back().to);
        if (parts == std::vector<Edge>{edge}) continue;
        ++compared;
        const double size = norm(edge.from) + norm(edge.centre) + geom::arc_radius(edge);
        for (const Point p : cases::points_of(edge, 12))
          EXPECT_LE(cases::distance_to_edges(p, parts), curve.error + 1e-15 * size) << index;
        for (const Edge& part : parts)
          for (const Point p : cases::points_of(part, 12))
            EXPECT_LE(cases::distance_to_edges(p, {edge}), curve.error + 1e-15 * size) << index;
      }
      EXPECT_EQ(k, plain.curves.size());
    };
    compare(*parse_dxf(dxf, "a.dxf"), *parse_dxf(as_others_read_dxf(dxf), "a.dxf"));
    compare(*parse_svg(svg, "a.svg"), *parse_svg(as_others_read_svg(svg), "a.svg"));
    if (HasFailure()) return;
  }
  EXPECT_GT(compared, case_count(150) / 4);
}

TEST(DrawingWriterLaws, ExactArcsOfCurvesThatWereMovedSinceAreLeftOutAndSaidToBe) {
  std::size_t moved = 0;
  for (std::uint64_t index = 0; index < case_count(150); ++index) {
    Random random(seed(), 14000 + index);
    const std::vector<Region> regions{ragged(random)};
    const std::string dxf = *dxf_drawing(layered(regions));
    const std::size_t stated = count_of(dxf, "LEKALO_EXACT_ARCS") == 0 ? 0 : count_of(dxf, "cw ");
    if (stated == 0) continue;
    ++moved;
    // Every vertex by a thousandth of a millimetre, as a program that keeps what it does not know does.
    std::string edited;
    const std::size_t begin = dxf.find("AcDbPolyline"), end = dxf.find("ENDSEC", begin);
    for (std::size_t at = 0; at < dxf.size();) {
      const std::size_t next = std::min(dxf.find('\n', at), dxf.size() - 1) + 1;
      const std::string line = dxf.substr(at, next - at);
      edited += line;
      at = next;
      if (at < begin || at > end || line != " 10\n") continue;
      const std::size_t behind = dxf.find('\n', at) + 1;
      edited += std::to_string(std::stod(dxf.substr(at, behind - at)) + 0.001) + "\n";
      at = behind;
    }
    const auto drawing = parse_dxf(edited, "edited.dxf");
    ASSERT_TRUE(drawing.has_value()) << drawing.error().message;
    ASSERT_EQ(drawing->notices.size(), 1u) << index;
    EXPECT_EQ(drawing->notices[0], "edited.dxf: the exact numbers of " + std::to_string(stated) +
                                       " arcs do not fit their curves, which were changed since; the curves "
                                       "count");
    const auto plain = parse_dxf(as_others_read_dxf(edited), "edited.dxf");
    ASSERT_EQ(drawing->curves.size(), plain->curves.size());
    for (std::size_t i = 0; i < plain->curves.size(); ++i)
      EXPECT_EQ(std::get<Edge>(drawing->curves[i].shape), std::get<Edge>(plain->curves[i].shape));
  }
  EXPECT_GT(moved, case_count(150) / 8);
}

TEST(DrawingWriterLaws, SvgIsReadByItsCurvesWhereTheyOrThePageWereChanged) {
  const Point start{-3 + std::sqrt(2.0), 7 - std::sqrt(2.0)};
  const auto disc = geom::make_region({{EdgeKind::arc_ccw, start, start, {-3, 7}}});
  const std::string svg = *svg_drawing({{*disc, "CUT", {}}});
  ASSERT_NE(svg.find("data-lekalo-arcs=\"0 1 start "), std::string::npos) << svg;
  EXPECT_EQ(read_svg(svg), std::vector<Region>{*disc});
  const auto changed = [&](const std::string& what, const std::string& by) {
    std::string text = svg;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what << svg;
    return *parse_svg(text.replace(at, what.size(), by), "x.svg");
  };
  const auto circle_of = [](const Drawing& drawing) { return std::get<Edge>(drawing.curves.front().shape); };
  const Drawing moved = changed("cx=\"-3\"", "cx=\"-3.5\"");
  EXPECT_EQ(moved.notices,
            std::vector<std::string>{"x.svg: the exact numbers of 1 arcs do not fit their curves, which were "
                                     "changed since; the curves count"});
  EXPECT_EQ(circle_of(moved).centre, (Point{-3.5, 7}));
  for (const char* text : {"0 1 start nan 1", "0 1 ccw 1 2", "9 1 start 1 2", "0 0 start 1 2", "x", ";",
                           "0 1 start 1 2 3", "0 5 start 1 2", "18446744073709551615 2 cw 1 2"}) {
    const Drawing odd =
        changed("data-lekalo-arcs=\"0 1 start", std::string("data-lekalo-arcs=\"") + text + "\" id=\"");
    EXPECT_EQ(odd.notices.size(), 1u) << text;
    EXPECT_EQ(circle_of(odd).from.y, 7) << text;
  }
  // A page cut to another size: where its corner was no longer says where it is.
  const Drawing cut = changed("viewBox=\"-5 ", "viewBox=\"-6 ");
  EXPECT_EQ(cut.notices,
            std::vector<std::string>{"x.svg: its page was changed since it was written, and no longer says "
                                     "where its corner lies; the origin is that corner"});
  EXPECT_EQ(circle_of(cut).centre.x, 3);
}

// On a sheet of 3 m, lines of 0.2 mm were too fine for any screen.
TEST(DrawingWriterLaws, LinesOfALargePageAreWideEnoughToBeSeen) {
  const auto stroke = [](double side) {
    const auto line = [](Point a, Point b) { return Edge{EdgeKind::line, a, b, {}}; };
    const auto square = *geom::make_region({line({0, 0}, {side, 0}), line({side, 0}, {side, side}),
                                            line({side, side}, {0, side}), line({0, side}, {0, 0})});
    const std::string svg = *svg_drawing({{square, "CUT", {}}});
    const std::size_t at = svg.find("stroke-width=\"") + 14;
    return std::stod(svg.substr(at));
  };
  EXPECT_EQ(stroke(100), 0.2);
  EXPECT_EQ(stroke(1000), 0.7);
  EXPECT_EQ(stroke(3000), 2.1);
}

// A file whose exact numbers are beside other entities, or beside none.
TEST(DrawingWriterLaws, ExactArcsFindTheirEntitiesByHandle) {
  const auto disc = *geom::make_region({{EdgeKind::arc_ccw, {1, 5}, {1, 5}, {1, 1}}});
  const std::string dxf = *dxf_drawing({{disc, "CUT", {}}});
  const std::size_t record = dxf.find(" 0 1 start 1 5");
  ASSERT_NE(record, std::string::npos) << dxf;
  EXPECT_EQ(read_dxf(dxf), std::vector<Region>{disc});
  std::string other = dxf;
  other.insert(record, "F");
  const auto drawing = parse_dxf(other, "x.dxf");
  ASSERT_TRUE(drawing.has_value());
  EXPECT_EQ(drawing->notices.size(), 1u);
  EXPECT_EQ(std::get<Edge>(drawing->curves[0].shape).from, (Point{5, 1}));
}

}  // namespace
}  // namespace lekalo::io::io_drawing_writer_test
