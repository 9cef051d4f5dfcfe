// Drawings in the styles of seven programs, against what python3-svgelements reads in them
// (data/svg/oracle.py made data/svg/expected.json).

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "lekalo/io/svg/svg.hpp"
#include "support/drawn_measures.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

namespace lekalo::io::io_svg_test {
namespace {

const std::string kFolder = cases::source_dir() + "/tests/corpus/data/svg/";

std::string text_of(const std::string& file) {
  std::ifstream in(kFolder + file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_FALSE(text.str().empty()) << file;
  return text.str();
}

Drawing drawing_of(const std::string& file) {
  auto drawing = parse_svg(text_of(file), file);
  EXPECT_TRUE(drawing.has_value()) << (drawing ? "" : drawing.error().message);
  return drawing ? *std::move(drawing) : Drawing{};
}

struct Entity {
  std::string handle;
  std::size_t curves = 0;
  double length = 0, area = 0, error = 0;
  geom::Point first, last;
};
std::vector<Entity> shown_entities(const Drawing& drawing) {
  std::map<std::uint32_t, Entity> found;
  for (const DrawnCurve& curve : drawing.curves) {
    if (drawing.layers[curve.layer].hidden) continue;
    Entity& entity = found[curve.entity];
    const cases::DrawnMeasures measures = cases::measure(curve.shape);
    if (entity.curves++ == 0) entity.first = cases::first_of(curve.shape);
    entity.last = cases::last_of(curve.shape);
    entity.handle = drawing.entities[curve.entity].handle;
    entity.length += measures.length;
    entity.area += measures.area;
    entity.error = std::max(entity.error, curve.error);
  }
  std::vector<Entity> list;
  for (auto& [index, entity] : found) list.push_back(std::move(entity));
  return list;
}

TEST(SvgCorpus, LengthsAreasAndPlacesAreThoseOfAnIndependentReader) {
  const cases::Json expected = cases::Json::parse(text_of("expected.json"));
  ASSERT_GE(expected.size(), 7u);
  for (const std::string& file : expected.keys()) {
    SCOPED_TRACE(file);
    const std::vector<Entity> entities = shown_entities(drawing_of(file));
    ASSERT_EQ(entities.size(), expected[file].size());
    for (std::size_t i = 0; i < entities.size(); ++i) {
      const auto& want = expected[file][i];
      const Entity& got = entities[i];
      SCOPED_TRACE(i);
      EXPECT_EQ(got.handle, want["id"].get<std::string>());
      const double length = want["length"];
      EXPECT_NEAR(got.length, length, 1e-9 * length);
      // The oracle integrates in the drawing's own units, because it takes 0.0393701 inch for a millimetre.
      // Its sums and ours cancel to about 1e-13 mm of the length where hardly any area is left.
      const double area = want["area"];
      EXPECT_NEAR(got.area, area, 1e-9 * std::abs(area) + 1e-13 * length);
      EXPECT_NEAR(got.first.x, want["first"][0].get<double>(), 1e-12);
      EXPECT_NEAR(got.first.y, want["first"][1].get<double>(), 1e-12);
      EXPECT_NEAR(got.last.x, want["last"][0].get<double>(), 1e-12);
      EXPECT_NEAR(got.last.y, want["last"][1].get<double>(), 1e-12);
      EXPECT_LT(got.error, 1e-5);  // a half turn of which the decimals are not sure
    }
  }
}

std::vector<std::string> layers_of(const Drawing& drawing) {
  std::vector<std::string> names;
  for (const Layer& layer : drawing.layers) {
    // A layer in two colours stands there twice.
    const std::string name = layer.name + (layer.hidden ? " (hidden)" : "");
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}
std::map<std::string, std::size_t> unread_of(const Drawing& drawing) {
  std::map<std::string, std::size_t> counts;
  for (const Unread& unread : drawing.unread) counts[unread.name] = unread.count;
  return counts;
}

TEST(SvgCorpus, LayersUnitsAndWhatIsNotRead) {
  using Names = std::vector<std::string>;
  using Counts = std::map<std::string, std::size_t>;
  const Drawing inkscape = drawing_of("inkscape.svg");
  EXPECT_EQ(layers_of(inkscape), (Names{"Outline", "Bores", "Notes (hidden)"}));
  EXPECT_EQ(unread_of(inkscape), (Counts{{"linearGradient", 1}, {"marker", 1}, {"text", 1}}));
  EXPECT_EQ(inkscape.unit, "mm");
  EXPECT_TRUE(inkscape.notices.empty());
  const Drawing illustrator = drawing_of("illustrator.svg");
  EXPECT_EQ(layers_of(illustrator), (Names{"Kontur", "Bohrungen", "Versteckt (hidden)"}));
  EXPECT_EQ(illustrator.unit, "px");
  EXPECT_EQ(illustrator.notices.size(), 1u);
  EXPECT_EQ(layers_of(drawing_of("coreldraw.svg")), (Names{"Слой_x0020_1"}));
  EXPECT_EQ(layers_of(drawing_of("librecad.svg")), (Names{"0", "bores", "curves"}));
  EXPECT_EQ(layers_of(drawing_of("openscad.svg")), (Names{""}));
  EXPECT_EQ(unread_of(drawing_of("lightburn.svg")), (Counts{{"image", 1}, {"text", 1}}));
  EXPECT_EQ(layers_of(drawing_of("affinity.svg")), (Names{"Layer1"}));
}

TEST(SvgCorpus, ArcsStayArcsUnderMapsThatKeepCircles) {
  const auto arcs = [](const std::string& file) {
    const Drawing drawing = drawing_of(file);
    std::size_t edges = 0, ellipses = 0;
    for (const DrawnCurve& curve : drawing.curves) {
      const auto* edge = std::get_if<geom::Edge>(&curve.shape);
      edges += edge != nullptr && edge->kind != geom::EdgeKind::line ? 1 : 0;
      ellipses += std::holds_alternative<EllipseArc>(curve.shape) ? 1 : 0;
    }
    return std::pair(edges, ellipses);
  };
  EXPECT_EQ(arcs("librecad.svg"), (std::pair<std::size_t, std::size_t>(6, 5)));
  EXPECT_EQ(arcs("inkscape.svg"), (std::pair<std::size_t, std::size_t>(4 + 4 + 2, 2)));
  EXPECT_EQ(arcs("coreldraw.svg"), (std::pair<std::size_t, std::size_t>(4 + 2, 1)));
}

}  // namespace
}  // namespace lekalo::io::io_svg_test
