#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "draw/paper/base64.hpp"
#include "draw/solid/cover.hpp"
#include "draw/solid/painting.hpp"
#include "draw/solid/section.hpp"
#include "draw/solid/solid_look.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/locate/solid_allowance.hpp"
#include "support/json.hpp"
#include "support/solids.hpp"

namespace lekalo::draw::solid_picture_test {
namespace {

using solid::Vector;

/// A block of 40 x 30 x 20 mm in one with 2 mm all around but 1 mm on its top.
SolidScene block_in_block() {
  SolidScene scene;
  scene.part_name = "folder/part.stl", scene.blank_name = "casting.ply";
  scene.status = "optimal", scene.method = "certified";
  scene.part = cases::block({0, 0, 0}, {40, 30, 20});
  scene.blank = cases::block({-2, -2, -2}, {42, 32, 21});
  const locate::MeasuredPart measured = locate::measured_part(scene.part, scene.blank, {}, 2000);
  scene.part = measured.mesh, scene.allowances = measured.allowances;
  scene.placement.inside = true, scene.placement.clearance = 1;
  scene.placement.contacts = {{0, 0, {20, 15, 20}, {20, 15, 21}, 1, 0.5},
                              {0, 0, {0, 15, 10}, {-2, 15, 10}, 2, 0.5}};
  scene.upper_bound = 1.0000001;
  return scene;
}

bool is_png(const Result<std::string>& bytes) { return bytes && bytes->substr(0, 8) == "\x89PNG\r\n\x1a\n"; }

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

Colour at(const Pixels& pixels, int column, int row) {
  return pixels.colours.at(static_cast<std::size_t>(row * pixels.columns + column));
}

PaintedPart triangle_at(double z, std::vector<double> values) {
  solid::Mesh mesh{{{-10, -10, z}, {10, -10, z}, {0, 10, z}}, {{0, 1, 2}}};
  return {shaded(mesh), std::move(values)};
}

SpaceView from_above(int size) {
  SpaceView view = seen_from({0, 0, 1});
  view.x = view.y = size / 2.0, view.scale = size / 20.0;
  return view;
}

TEST(SolidPicture, CoversEachSampleOfAFanOnce) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    // A square of 64 samples as a fan about a point of it.
    const ScreenPoint middle{random.uniform(1, 63), random.uniform(1, 63), 0};
    std::vector<ScreenPoint> rim;
    for (const auto& [x, y] : {std::pair{0, 0}, {64, 0}, {64, 64}, {0, 64}})
      rim.push_back({1.0 * x, 1.0 * y, 0});
    rim.insert(rim.begin() + 1, {random.uniform(1, 63), 0, 0});
    std::vector<int> counts(64 * 64);
    for (std::size_t k = 0; k < rim.size(); ++k) {
      std::array<ScreenPoint, 3> t{middle, rim[k], rim[(k + 1) % rim.size()]};
      if (round % 2 == 1) std::swap(t[1], t[2]);
      cover(t, 64, 0, 64, [&](int column, int row, const std::array<double, 3>& weights) {
        ++counts[static_cast<std::size_t>(64 * row + column)];
        EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
        EXPECT_NEAR(weights[0] * t[0].x + weights[1] * t[1].x + weights[2] * t[2].x, column + 0.5, 0.01);
        EXPECT_NEAR(weights[0] * t[0].y + weights[1] * t[1].y + weights[2] * t[2].y, row + 0.5, 0.01);
      });
    }
    EXPECT_EQ(counts, std::vector<int>(64 * 64, 1)) << round;
  }
}

TEST(SolidPicture, ATriangleFarOffThePictureCostsNothingAndOverflowsNowhere) {
  int covered = 0;
  const auto count = [&](int, int, const std::array<double, 3>&) { ++covered; };
  cover({ScreenPoint{1e18, 1e18, 0}, {2e18, 1e18, 0}, {1e18, 3e18, 0}}, 100, 0, 100, count);
  EXPECT_EQ(covered, 0);
  cover({ScreenPoint{-1e18, -1e18, 0}, {1e18, -1e18, 0}, {0, 1e18, 0}}, 100, 0, 100, count);
  EXPECT_EQ(covered, 100 * 100);
  cover({ScreenPoint{5, 5, 0}, {50, 50, 0}, {95, 95, 0}}, 100, 0, 100, count);
  EXPECT_EQ(covered, 100 * 100) << "a triangle without area";
}

TEST(SolidPicture, ANearTriangleHidesAFarOne) {
  const PaintedBlank none;
  PaintedPart both = triangle_at(0, {0, 0, 0});
  const PaintedPart near = triangle_at(5, {1, 1, 1});
  for (std::size_t k = 0; k < 3; ++k) {
    both.surface.places.push_back(near.surface.places[k]);
    both.surface.normals.push_back(near.surface.normals[k]);
    both.values.push_back(1);
  }
  const Colour blue = at(paint(near, none, from_above(40), 40, 40, {}, 1).pixels, 20, 22);
  const Colour orange =
      at(paint(triangle_at(0, {0, 0, 0}), none, from_above(40), 40, 40, {}, 1).pixels, 20, 22);
  EXPECT_GT(blue.blue, blue.red);
  EXPECT_GT(orange.red, orange.blue);
  // The order of the triangles does not matter.
  for (const std::vector<solid::Triangle>& order : {std::vector<solid::Triangle>{{0, 1, 2}, {3, 4, 5}},
                                                    std::vector<solid::Triangle>{{3, 4, 5}, {0, 1, 2}}}) {
    both.surface.triangles = order;
    EXPECT_EQ(at(paint(both, none, from_above(40), 40, 40, {}, 1).pixels, 20, 22), blue);
  }
  const Painting marked = paint(near, none, from_above(40), 40, 40, {{0, 0, 5}, {0, 0, 0}, {0, 0, 6}}, 1);
  EXPECT_EQ(marked.seen, (std::vector<bool>{true, false, true}));
}

TEST(SolidPicture, AllowancesHaveTheColoursOfTheScale) {
  EXPECT_EQ(colour_of_value(0), scale_colour(0));
  EXPECT_EQ(colour_of_value(-1e-12), scale_colour(0)) << "rounding is not missing material";
  EXPECT_EQ(colour_of_value(0.5), scale_colour(kColourSteps / 2));
  EXPECT_EQ(colour_of_value(1), scale_colour(kColourSteps - 1));
  EXPECT_EQ(colour_of_value(-0.01), kOutside);
  // Light changes them by less than colours of the scale differ, and nothing is black.
  for (const double value : {-1.0, 0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Colour seen =
        at(paint(triangle_at(0, {value, value, value}), {}, from_above(40), 40, 40, {}, 1).pixels, 20, 22);
    const Colour meant = colour_of_value(value);
    EXPECT_NEAR(seen.red, meant.red, 40) << value;
    EXPECT_NEAR(seen.green, meant.green, 40) << value;
    EXPECT_NEAR(seen.blue, meant.blue, 40) << value;
    EXPECT_GT(seen.red + seen.green + seen.blue, 120) << value;
  }
}

TEST(SolidPicture, GlassLetsThePartShowAndNothingOfItShowsWhatNobodyMeasured) {
  const PaintedPart part = triangle_at(0, {0, 0, 0});
  PaintedBlank pane{triangle_at(5, {}).surface, {}};
  const Colour bare = at(paint(part, {}, from_above(40), 40, 40, {}, 1).pixels, 20, 22);
  const Colour behind = at(paint(part, pane, from_above(40), 40, 40, {}, 1).pixels, 20, 22);
  EXPECT_NE(behind, bare);
  EXPECT_NEAR(behind.red, bare.red, 30);
  pane.unknown = {1};
  const Colour unknown = at(paint(part, pane, from_above(40), 40, 40, {}, 1).pixels, 20, 22);
  EXPECT_LT(unknown.blue, bare.blue + 40);
  EXPECT_NE(unknown, behind);
  // A pane behind the part is not seen.
  EXPECT_EQ(at(paint(part, {triangle_at(-5, {}).surface, {}}, from_above(40), 40, 40, {}, 1).pixels, 20, 22),
            bare);
}

TEST(SolidPicture, SmallBendsAreSmoothAndLargeOnesAreEdges) {
  const ShadedMesh block = shaded(cases::block({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(block.places.size(), 24U);
  EXPECT_EQ(block.edges.size(), 12U);
  for (const Vector n : block.normals) EXPECT_NEAR(norm(n), 1, 1e-12);
  // A flat roof of 20 degrees.
  const ShadedMesh roof = shaded({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0.18}, {1, 1, 0.18}, {2, 0, 0}, {2, 1, 0}},
                                  {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}});
  EXPECT_EQ(roof.places.size(), 6U);
  const ShadedMesh bad = shaded({{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 0, 0}}});
  for (const Vector n : bad.normals) EXPECT_TRUE(std::isfinite(n.x + n.y + n.z)) << "triangles without area";
}

TEST(SolidPicture, ASectionShowsPartAndBlank) {
  const ShadedMesh part = shaded(cases::block({-4, -4, -4}, {4, 4, 4})),
                   blank = shaded(cases::block({-8, -8, -8}, {8, 8, 8}));
  SpaceView view = seen_from({0, -1, 0});
  view.x = view.y = 50, view.scale = 5;
  const Pixels pixels = section_picture(part, blank, view, 100, 100);
  EXPECT_EQ(at(pixels, 50, 50), (Colour{255, 236, 206}));
  EXPECT_EQ(at(pixels, 2, 50), kPaper);
  const Colour hatched = at(pixels, 20, 50);
  EXPECT_NE(hatched, kPaper);
  EXPECT_NE(hatched, at(pixels, 50, 50));
  EXPECT_EQ(section_lines(part, view).size(), 8U);
  // Where the part sticks out of the blank its section is red.
  view.centre = {0, 0, 0};
  const Pixels other_way = section_picture(blank, part, view, 100, 100);
  EXPECT_EQ(at(other_way, 20, 50), (Colour{255, 170, 170}));
  // Magnified a million times, there is still the edge in the middle.
  view.centre = {4, 0, 0}, view.scale = 5e6;
  const Pixels close = section_picture(part, blank, view, 100, 100);
  EXPECT_EQ(at(close, 30, 50), (Colour{255, 236, 206}));
  EXPECT_LT(at(close, 50, 20).red, 130) << "half of its line";
  EXPECT_NE(at(close, 70, 50), at(close, 30, 50));
}

TEST(SolidPicture, TheTightestContactFacesTheViewer) {
  for (const Vector way : {Vector{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    SolidScene scene = block_in_block();
    const Vector place = Vector{20, 15, 10} + Vector{20 * way.x, 15 * way.y, 10 * way.z};
    scene.placement.contacts.push_back({0, 0, place, place + 0.5 * way, 0.5, 1});
    const SolidLook look(scene);
    ASSERT_TRUE(look.focus);
    EXPECT_EQ(look.focus->contact.value(), 2U);
    const SpaceView view = facing(look);
    EXPECT_GT(dot(view.towards, way), 0.5);
    EXPECT_NEAR(norm(view.up), 1, 1e-12);
    EXPECT_GT(view.up.z, 0);
    EXPECT_TRUE(paint(look.part, {}, view, 10, 10, {}, 1).seen.empty());
  }
}

TEST(SolidPicture, ThePoseIsPrintedAsShiftAndTurn) {
  SolidScene scene = block_in_block();
  scene.placement.pose = {{-2, 0, 0, -2}, {1.5, -0.25, 1e-7}};  // a quarter turn, in any length and sign
  scene.min_allowance = 1.5, scene.shortfall = 0.5;
  const std::vector<SolidFigure> figures = figures_of(scene, SolidLook(scene));
  const auto value = [&](const char* kind) {
    for (const SolidFigure& figure : figures)
      if (std::string(figure.kind) == kind) return figure.value;
    return std::string("none");
  };
  EXPECT_EQ(value("turn-deg"), "90.0000000°");
  EXPECT_EQ(value("axis"), "0.0000 0.0000 1.0000");
  EXPECT_EQ(value("x"), "1.500000 mm");
  EXPECT_EQ(value("upper-bound"), "1.000001 mm") << "rounded up";
  EXPECT_EQ(value("shortfall"), "0.500000 mm");
  scene.placement.pose = {};
  scene.upper_bound.reset();
  for (const SolidFigure& figure : figures_of(scene, SolidLook(scene))) {
    EXPECT_STRNE(figure.kind, "axis") << "without a turn there is no axis";
    if (std::string(figure.kind) == "upper-bound") {
      EXPECT_EQ(figure.value, "not proved");
    }
  }
}

TEST(SolidPicture, IsAPngOfTheSizeAskedForAndTheSameForAnyNumberOfThreads) {
  const SolidScene scene = block_in_block();
  const auto bytes = solid_png(scene, 800, 1);
  ASSERT_TRUE(is_png(bytes));
  EXPECT_EQ(big_endian(*bytes, 16), 800U);
  EXPECT_EQ(big_endian(*bytes, 20), 600U);
  for (const unsigned threads : {1U, 2U, 5U})
    EXPECT_TRUE(*solid_png(scene, 800, threads) == *bytes) << threads;
  for (const int width : {0, 99, 20'001}) {
    const auto refused = solid_png(scene, width);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
}

TEST(SolidPicture, ShowsWhatTheSceneHolds) {
  const auto bytes = solid_png(block_in_block(), 400);
  SolidScene changed = block_in_block();
  changed.placement.contacts.pop_back();
  EXPECT_FALSE(*solid_png(changed, 400) == *bytes);
  changed = block_in_block();
  changed.min_allowance = 1.5;
  EXPECT_TRUE(SolidLook(changed).missing());
  EXPECT_FALSE(*solid_png(changed, 400) == *bytes);
  changed = block_in_block();
  changed.unknown = {0, 1};
  EXPECT_FALSE(*solid_png(changed, 400) == *bytes);
}

TEST(SolidPicture, DrawsWhateverComes) {
  std::vector<SolidScene> scenes(7, block_in_block());
  scenes[0].placement.contacts.clear();
  scenes[1].allowances.clear();
  scenes[1].placement.contacts.clear();
  // Triangles without area, and vertices that nothing uses.
  scenes[2].part.triangles.push_back({0, 0, 0});
  scenes[2].part.triangles.push_back({0, 1, 1});
  scenes[2].part.vertices.emplace_back(), scenes[2].allowances.push_back(1);
  // A body a million kilometres away, and one of less than an atom.
  for (solid::Mesh* mesh : {&scenes[3].part, &scenes[3].blank})
    for (Vector& p : mesh->vertices) p = p + Vector{1e12, -1e12, 1e12};
  scenes[3].placement.contacts.clear();
  for (solid::Mesh* mesh : {&scenes[4].part, &scenes[4].blank})
    for (Vector& p : mesh->vertices) p = 1e-12 * p;
  for (double& allowance : scenes[4].allowances) allowance *= 1e-12;
  scenes[4].placement.contacts.clear();
  // The part is far from the blank.
  scenes[5].placement.pose.shift = {1e9, 0, 0};
  scenes[5].placement.inside = false;
  for (double& allowance : scenes[5].allowances) allowance = -1e9;
  scenes[5].placement.contacts.clear();
  // Touching, and a contact that is no part of the surface.
  scenes[6].placement.contacts = {{0, 0, {20, 15, 20}, {20, 15, 20}, 0, 1},
                                  {9, 9, {999, 0, 0}, {0, 0, 999}, 5, 0}};
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    EXPECT_TRUE(is_png(solid_png(scenes[k], 300))) << k;
    EXPECT_GT(solid_page(scenes[k]).size(), 20'000U) << k;
  }
}

TEST(SolidPicture, TheWorstPlaceIsInSightWhereThePartSticksOut) {
  SolidScene scene = block_in_block();
  scene.placement.inside = false;
  scene.placement.pose.shift = {0, 0, 3};
  scene.allowances =
      locate::measured_part(scene.part, scene.blank, locate::motion_of(scene.placement.pose), 2).allowances;
  const SolidLook look(scene);
  EXPECT_TRUE(look.touches.empty()) << "contacts of a part that is not inside are none";
  ASSERT_TRUE(look.focus);
  EXPECT_NEAR(look.focus->place.z, 23, 1e-9);
  EXPECT_NEAR(look.focus->on_blank.z, 21, 1e-9);
  EXPECT_NEAR(look.focus->distance, -2, 1e-9);
  EXPECT_GT(facing(look).towards.z, 0.5);
  EXPECT_EQ(clearance_text(scene, look), "not inside");
  ASSERT_FALSE(key_of(scene, look).empty());
  EXPECT_EQ(key_of(scene, look).front().words.substr(0, 28), "outside the blank, by up to ");
}

std::size_t count_of(const std::string& text, const std::string& wanted) {
  std::size_t count = 0;
  for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) ++count;
  return count;
}

cases::Json scene_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"scene\">";
  const std::size_t from = page.find(begin) + begin.size();
  return cases::Json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(SolidPage, TextsOfAnAttackerStayTexts) {
  SolidScene scene = block_in_block();
  const std::size_t scripts = count_of(solid_page(scene), "</script");
  for (const std::string& name :
       {std::string("</script><script>alert(1)</script>"),
        std::string("<!-- <script> \"quoted\" & 'more' \\"), std::string("Gehäuse Корпус 部品 \xff\xfe"),
        std::string("/* page.css */"), std::string("/* page.js */"), std::string("\"the scene\""),
        std::string("the title"), std::string("a\u2028b\n\r\t")}) {
    scene.part_name = scene.blank_name = scene.status = scene.method = name;
    scene.notes = {name};
    const std::string page = solid_page(scene);
    EXPECT_EQ(count_of(page, "</script"), scripts) << name;
    EXPECT_EQ(count_of(page, "<script"), 2U) << name;
    EXPECT_EQ(page.find("alert(1)</"), std::string::npos) << name;
    const cases::Json json = scene_of(page);
    EXPECT_EQ(json["method"].get<std::string>(), io::as_utf8(name));
    EXPECT_EQ(json["notes"][0].get<std::string>(), io::as_utf8(name));
    EXPECT_NE(page.find("--glass:"), std::string::npos) << name;
    EXPECT_NE(page.find("function start()"), std::string::npos) << name;
  }
}

TEST(SolidPage, HoldsTheSolidsToASixtyFiveThousandthOfTheirSize) {
  SolidScene scene = block_in_block();
  scene.unknown = {2, 3};
  const std::string page = solid_page(scene);
  EXPECT_EQ(page, solid_page(scene));
  const cases::Json json = scene_of(page);
  EXPECT_EQ(json["extent"].dump(), "[44,34,23]");
  EXPECT_DOUBLE_EQ(json["step"].get<double>(), 44.0 / 65535);
  EXPECT_EQ(json["blankMesh"]["triangles"], 12);
  EXPECT_EQ(json["blankMesh"]["known"], 10);
  EXPECT_EQ(json["contacts"][0]["text"].get<std::string>(), "1.0000 mm");
  EXPECT_EQ(json["contacts"][1]["outward"].dump(), "[-1,0,0]");
  EXPECT_EQ(json["contacts"][1]["place"].dump(), "[2,17,12]");
  EXPECT_EQ(page.find("http"), page.find("http-equiv")) << "nothing is fetched";
  EXPECT_EQ(count_of(page, "http"), 1U);
}

TEST(SolidPage, NamesTheWorstPlaceOfAPartThatSticksOut) {
  SolidScene scene = block_in_block();
  EXPECT_EQ(scene_of(solid_page(scene))["contactsTitle"].get<std::string>(), "Contacts");
  scene.placement.inside = false;
  EXPECT_EQ(scene_of(solid_page(scene))["contactsTitle"].get<std::string>(), "No contacts");
  for (double& allowance : scene.allowances) allowance -= 3;
  scene.placement.pose.shift = {0, 0, 3};
  const cases::Json json = scene_of(solid_page(scene));
  EXPECT_EQ(json["contactsTitle"].get<std::string>(), "Where most is missing");
  EXPECT_EQ(json["contacts"].size(), 1U);
  EXPECT_EQ(json["contacts"][0]["text"].get<std::string>(), "2.0000 mm outside");
}

TEST(SolidPage, Base64IsThatOfTheStandard) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00\xfb", 4)), "//4A+w==");
}

}  // namespace
}  // namespace lekalo::draw::solid_picture_test
