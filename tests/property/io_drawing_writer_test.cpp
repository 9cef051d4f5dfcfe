#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lekalo/io/drawing_regions.hpp"
#include "lekalo/io/drawing_writer.hpp"
#include "lekalo/io/svg.hpp"
#include "support/drawn_region_cases.hpp"

// The laws of drawing_writer.hpp.

namespace lekalo::io {
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
    } while (parts.size() < 2 && parts.back().to != edge.to);
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

std::vector<Region> read_back(const Result<Drawing>& drawing) {
  EXPECT_TRUE(drawing.has_value()) << (drawing ? "" : drawing.error().message);
  if (!drawing) return {};
  EXPECT_TRUE(drawing->unread.empty() && drawing->notices.empty());
  const auto found = make_regions(*drawing);
  EXPECT_TRUE(found.has_value()) << (found ? "" : found.error().message);
  if (!found) return {};
  EXPECT_EQ(found->moved, 0);
  return found->regions;
}

std::vector<Region> read_dxf(const std::string& text) { return read_back(parse_dxf(text, "written.dxf")); }
std::vector<Region> read_svg(const std::string& text) { return read_back(parse_svg(text, "written.svg")); }

/// Where nothing is negative the page begins at the origin.
std::vector<Region> made_positive(const std::vector<Region>& regions) {
  double low = 0;
  for (const Region& region : regions)
    low = std::min({low, geom::bounds(region.outer).low.x, geom::bounds(region.outer).low.y});
  const Point by{std::ceil(-low), std::ceil(-low)};
  std::vector<Region> moved;
  for (const Region& region : regions) {
    Region one;
    for (const Edge& edge : region.outer) one.outer.push_back(cases::shifted(edge, by));
    for (const Contour& hole : region.holes) {
      one.holes.emplace_back();
      for (const Edge& edge : hole) one.holes.back().push_back(cases::shifted(edge, by));
    }
    if (auto made = geom::make_region(one.outer, one.holes)) moved.push_back(*std::move(made));
  }
  return moved;
}

TEST(DrawingWriterLaws, SvgComesBackAsItWasWritten) {
  for (std::uint64_t index = 0; index < case_count(150); ++index) {
    Random random(seed(), 13000 + index);
    const auto regions = made_positive(written_case(random, index));
    if (regions.empty() || geom::fault_of(regions)) continue;
    const auto text = svg_drawing(layered(regions));
    ASSERT_TRUE(text.has_value()) << text.error().message;
    expect_same(regions, read_svg(*text),
                "seed " + std::to_string(seed()) + " case " + std::to_string(index));
    if (HasFailure()) return;
  }
}

TEST(DrawingWriterLaws, SvgOfNegativePlacesIsMovedByWholeMillimetres) {
  const auto square = cases::region_detail::region(cases::boolean_rectangle(-3.25, 2.5, 10, 20));
  const auto read = read_svg(*svg_drawing({{square, "CUT", {}}}));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0], cases::region_detail::region(cases::boolean_rectangle(0.75, 2.5, 10, 20)));
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

TEST(DrawingWriterLaws, DxfComesBackAsItWasWritten) {
  std::size_t arcs = 0, exact = 0;
  for (std::uint64_t index = 0; index < case_count(150); ++index) {
    Random random(seed(), 11000 + index);
    const auto regions = written_case(random, index);
    const std::string name = "seed " + std::to_string(seed()) + " case " + std::to_string(index);
    const auto text = dxf_drawing(layered(regions));
    ASSERT_TRUE(text.has_value()) << text.error().message;
    const auto read = read_dxf(*text);
    expect_same(regions, read, name);
    if (HasFailure()) return;
    // What was read from such a file is written and read again bit for bit.
    const auto again = dxf_drawing(layered(read));
    EXPECT_EQ(read_dxf(*again), read) << name;
    const auto before = cases::edges_of(regions), after = cases::edges_of(read);
    for (const Edge& edge : before) {
      if (edge.kind == EdgeKind::line) continue;
      ++arcs;
      exact += std::find(after.begin(), after.end(), edge) != after.end() ? 1 : 0;
    }
  }
  RecordProperty("arcs", static_cast<int>(arcs));
  RecordProperty("exact", static_cast<int>(exact));
  std::printf("%zu of %zu arcs came back bit for bit\n", exact, arcs);
}

}  // namespace
}  // namespace lekalo::io
