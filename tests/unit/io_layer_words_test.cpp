#include <gtest/gtest.h>

#include "io/drawing/layers.hpp"

namespace lekalo::io::io_layer_words_test {
namespace {

Drawing drawing_of(std::vector<Layer> layers) {
  Drawing drawing;
  drawing.name = "a.dxf";
  drawing.layers = std::move(layers);
  for (std::uint32_t i = 0; i < drawing.layers.size(); ++i) drawing.curves.push_back({geom::Edge{}, 0, i, 0});
  return drawing;
}

std::string taken(const Drawing& drawing, const std::vector<std::string>& take,
                  const std::vector<std::string>& leave = {}) {
  DrawingOptions options;
  options.take = take;
  options.leave = leave;
  const auto choice = choose_layers(drawing, options);
  if (!choice) return choice.error().message;
  std::string text;
  for (const bool one : choice->taken) text += one ? 'x' : '-';
  return text;
}

TEST(LayerWords, NamesColoursAndLineTypesChoose) {
  const Drawing drawing = drawing_of({{"cut", false, "#ff0000"},
                                      {"cut", false, "#0000ff"},
                                      {"cut", false, "#0000ff", "DASHED"},
                                      {"text", false, "#0000ff"},
                                      {"cut", true, "#ff0000"}});
  EXPECT_EQ(taken(drawing, {}), "xxxx-");
  EXPECT_EQ(taken(drawing, {"CUT"}), "xxx-x")
      << "a layer in any case of letters, hidden ones where they are named";
  EXPECT_EQ(taken(drawing, {"#0000FF"}), "-xxx-");
  EXPECT_EQ(taken(drawing, {"cut:#0000ff"}), "-xx--");
  EXPECT_EQ(taken(drawing, {"cut:#0000ff:dashed"}), "--x--");
  EXPECT_EQ(taken(drawing, {"dashed"}), "--x--");
  EXPECT_EQ(taken(drawing, {"cut:dashed"}), "--x--");
  EXPECT_EQ(taken(drawing, {}, {"#0000ff"}), "x----");
  EXPECT_EQ(taken(drawing, {"#00ff00"}),
            "a.dxf: no curve is on a layer '#00ff00'; there are 'cut:#ff0000', 'cut:#0000ff', "
            "'cut:#0000ff:DASHED', 'text', 'cut'");
}

}  // namespace
}  // namespace lekalo::io::io_layer_words_test
