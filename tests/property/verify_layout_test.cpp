// Laws of the checker of layouts: what it says does not change when the whole document is moved, mirrored or
// turned by right angles; lies are found.

#include "lekalo/verify/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "support/crowded_layouts.hpp"
#include "support/layout_texts.hpp"

namespace lekalo::verify::verify_layout_test {
namespace {

using cases::add_part;
using cases::crowded;
using cases::empty_layout;
using cases::Json;
using cases::outline_json;
using cases::place;
using cases::Points;
using cases::rectangle;

std::vector<LayoutViolation> violations(const Json& layout) {
  const auto checked = verify_layout({"layout.json", layout.dump()});
  EXPECT_TRUE(checked) << checked.error().message;
  return checked ? checked->violations : std::vector<LayoutViolation>{};
}

/// The whole sheet, and all that lies on it, under x, y -> f(x, y) of the plane.
template <class F>
void change_outline(Json& outline, F f) {
  const auto change = [&](Json& loop) {
    for (auto& p : loop) {
      const auto [x, y] = f(p[0].get<double>(), p[1].get<double>());
      p = {x, y};
    }
  };
  change(outline["polygon"]["outer"]);
  if (outline["polygon"].contains("holes"))
    for (auto& hole : outline["polygon"]["holes"]) change(hole);
}
template <class F>
Json changed_stock(Json layout, F f) {
  Json& stock = layout["stocks"][0];
  change_outline(stock["outline"], f);
  for (const char* list : {"defects", "zones"})
    for (auto& feature : stock[list]) change_outline(feature["outline"], f);
  for (auto& at : layout["placements"]) {
    const auto [x, y] = f(at["x"].get<double>(), at["y"].get<double>());
    at["x"] = x, at["y"] = y;
  }
  return layout;
}

TEST(VerifyLayoutProperty, MovedTurnedAndMirroredDocumentsSayTheSame) {
  Random random(cases::seed(), 4101);
  std::array<int, 11> seen{};
  for (std::size_t i = 0; i < cases::case_count(100); ++i) {
    const Json layout = crowded(random);
    const auto expected = violations(layout);
    for (const LayoutViolation& v : expected) ++seen[static_cast<std::size_t>(v.kind)];

    const double by_x = static_cast<double>(random.below(100'000)) / 8, by_y = -123.5;
    EXPECT_EQ(violations(changed_stock(layout,
                                       [&](double x, double y) {
                                         return std::pair{x + by_x, y + by_y};
                                       })),
              expected);

    // A quarter turn of sheet and parts: angles of parts are then a quarter more.
    Json turned = changed_stock(layout, [](double x, double y) { return std::pair{-y, x}; });
    turned["stocks"][0]["grain_deg"] = turned["stocks"][0]["grain_deg"].get<double>() + 90;
    for (auto& part : turned["parts"]) part["rotations"] = {90, 180, {{"from", 260}, {"to", 290}}};
    for (auto& at : turned["placements"]) at["rotation_deg"] = at["rotation_deg"].get<double>() + 90;
    EXPECT_EQ(violations(turned), expected);

    // Mirrored parts in a mirrored sheet: M R(a) p = R(-a) M p.
    Json mirrored = changed_stock(layout, [](double x, double y) { return std::pair{-x, y}; });
    mirrored["stocks"][0]["grain_deg"] = 180 - mirrored["stocks"][0]["grain_deg"].get<double>();
    const auto flip = [](double x, double y) { return std::pair{-x, y}; };
    for (auto& part : mirrored["parts"]) {
      change_outline(part["outline"], flip);
      for (auto& area : part["areas"]) change_outline(area["outline"], flip);
      part["rotations"] = {0, -90, {{"from", -200}, {"to", -170}}};
      part["grain"]["deg"] = 180 - part["grain"]["deg"].get<double>();
    }
    for (auto& at : mirrored["placements"]) at["rotation_deg"] = -at["rotation_deg"].get<double>();
    EXPECT_EQ(violations(mirrored), expected);

    // Points in another order, loops the other way.
    Json other = layout;
    for (auto& part : other["parts"]) {
      Json& loop = part["outline"]["polygon"]["outer"];
      std::reverse(loop.begin(), loop.end());
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
    EXPECT_EQ(violations(other), expected);
  }
  for (std::size_t kind = 0; kind < seen.size(); ++kind)
    EXPECT_GT(seen[kind], 0) << name_of(static_cast<LayoutRule>(kind));
}

/// Hexagons in touch, 100 mm wide stock, nothing wrong.
Json tight(std::size_t rows, std::size_t columns) {
  Json layout = empty_layout();
  add_part(layout, "h", outline_json({{0, 0}, {4, -2}, {8, 0}, {8, 5}, {4, 7}, {0, 5}}));
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      place(layout, "h", static_cast<double>(8 * column + 4 * (row % 2)), static_cast<double>(7 * row + 2));
  const double width = static_cast<double>(8 * columns + 4), height = static_cast<double>(7 * rows + 2);
  layout["stocks"][0]["outline"] = outline_json(rectangle(0, 0, width, height));
  return layout;
}

TEST(VerifyLayoutProperty, NoLieOfOneStepIsBelieved) {
  const Json honest = tight(8, 8);
  ASSERT_TRUE(violations(honest).empty());
  Random random(cases::seed(), 4102);
  for (std::size_t i = 0; i < cases::case_count(200); ++i) {
    Json lie = honest;
    const std::size_t inner = (1 + random.below(6)) * 8 + 1 + random.below(6);
    Json& at = lie["placements"][inner];
    switch (random.below(4)) {
      case 0:
        at["x"] = at["x"].get<double>() + (random.below(2) == 0 ? 0x1p-20 : -0x1p-20);
        break;
      case 1:
        at["y"] = at["y"].get<double>() + (random.below(2) == 0 ? 0x1p-20 : -0x1p-20);
        break;
      case 2:
        at["rotation_deg"] = random.below(2) == 0 ? 1e-5 : -1e-5;
        break;
      default:
        at["x"] = honest["placements"][random.below(inner)]["x"];
        at["y"] = honest["placements"][inner - 1]["y"];
    }
    if (lie == honest) continue;  // the last kind may put it where it was
    EXPECT_FALSE(violations(lie).empty()) << at;
  }
}

TEST(VerifyLayoutProperty, ManyParts) {
  Json layout = tight(20, 25);
  EXPECT_TRUE(violations(layout).empty());
  layout["rules"] = {{"gap", 0x1p-20}};
  // Each touches two in its row and two in the next, but at the ends of rows.
  EXPECT_EQ(violations(layout).size(), 20U * 24 + 19U * (2 * 25 - 1));
}

}  // namespace
}  // namespace lekalo::verify::verify_layout_test
