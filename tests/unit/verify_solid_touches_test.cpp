// What the checker says of a blank that is its nominal mesh, moved to touches: each cut and each way is
// proved, and the widths follow from them.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "support/solid_results.hpp"

namespace lekalo::verify::verify_solid_touches_test {
namespace {

using cases::cube_in_cube;
using cases::Json;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// A way that no motion of a box of one goes.
Json still(int corner, const char* axis, bool above) {
  return {{"corner", corner}, {"axis", axis},    {"above", above},
          {"at", 0},          {"multiplier", 1}, {"terms", Json::array()}};
}

/// A nominal cube with half edges of 6 that lies where it is, known to 0.3, and touched at the middle of the
/// face at x = 6: nothing may move, so the material begins 0.3 within the triangles.
SolidResultFiles touched() {
  SolidResultFiles files = cube_in_cube();
  files.nominal = files.blank;
  files.points = "6 0 0\n-6 0 0\n";
  Json& r = files.result;
  const Json none{0, 0};
  Json touches{{"ball", 0},
               {"form", 0.3},
               {"directions", false},
               {"pivot", {0, 0, 0}},
               {"quaternion", {1, 0, 0, 0}},
               {"x", none},
               {"y", none},
               {"z", none},
               {"turn_x", none},
               {"turn_y", none},
               {"turn_z", none},
               {"balls", Json::array()},
               {"cuts", Json::array()},
               {"moved", {{"quaternion", {1, 0, 0, 0}}, {"x", 0}, {"y", 0}, {"z", 0}}},
               {"around", {{-6, -6, -6}, {6, 6, 6}}}};
  for (int corner = 0; corner < 8; ++corner)
    for (const char* axis : {"x", "y", "z"})
      for (const bool above : {false, true}) touches["ways"].push_back(still(corner, axis, above));
  r["scan"] = cases::scan_by_dip(0.1, 0.2, 0.3);
  r["scan"]["max_dip"] = nullptr, r["scan"]["touches"] = touches;
  r["clearance"] = 0.699999, r["contacts"][0]["distance"] = 0.7;
  r["inputs"].push_back({{"role", "points"}, {"path", "p"}, {"sha256", ""}, {"units", "mm"}, {"points", 2}});
  r["inputs"].push_back(
      {{"role", "nominal"}, {"path", "n"}, {"sha256", ""}, {"units", "mm"}, {"triangles", 12}});
  return files;
}

std::string told(const std::function<void(Json&)>& change,
                 const std::function<void(SolidResultFiles&)>& other = {}) {
  SolidResultFiles files = touched();
  change(files.result["scan"]["touches"]);
  if (other) other(files);
  return files.told();
}

/// It may lie up to 0.5 off along x, where a ball of 6 in its middle and the touch at x = 6 leave 0.4 and a
/// little.
void cut_above(Json& touches, double at = 0.41) {
  touches["x"] = {-0.5, 0.5};
  touches["balls"] = {{0, 0, 0, 6}};
  touches["cuts"].push_back({{"axis", "x"}, {"above", true}, {"at", at}, {"terms", {{0, 0, 1}}}});
}
/// And the touch at x = -6 the other way; the ways along x are as far.
void cut_both(Json& touches, double at = 0.41) {
  cut_above(touches, at);
  touches["cuts"].push_back({{"axis", "x"}, {"above", false}, {"at", -at}, {"terms", {{1, 0, 1}}}});
  for (Json& way : touches["ways"])
    if (way["axis"] == "x") way["at"] = at;
}
/// The widths are then 0.3 + 0.41, and the rest of the result fits them.
void fit(SolidResultFiles& files, double width = 0.71) {
  files.result["scan"]["widest"] = width;
  files.result["clearance"] = 1 - width - 1e-6, files.result["contacts"][0]["distance"] = 1 - width;
}

TEST(SolidTouches, WhatMayNotMoveHasTheFormForItsWidth) {
  EXPECT_EQ(touched().told(), "unproved");
  EXPECT_TRUE(
      says(told([](Json& t) { t["form"] = 0.31; }), "scan.widest is 0.3, but the widest triangle has 0.31"));
  EXPECT_TRUE(says(told([](Json& t) { t["form"] = 0.29; }), "scan.widest is 0.3"));
  const auto clearance = [](double value) {
    return told([](Json&) {}, [&](SolidResultFiles& files) { files.result["clearance"] = value; });
  };
  EXPECT_EQ(clearance(0.6999999), "unproved");
  EXPECT_TRUE(says(clearance(0.7000001), "refuted"));
}

TEST(SolidTouches, TouchesCutOffWhatTheyDoNotAllow) {
  EXPECT_EQ(told([](Json& t) { cut_both(t); }, [](SolidResultFiles& files) { fit(files); }), "unproved");
  // At 0.4 itself the touch would still be less than 0.4 off the surface.
  const std::string early = told([](Json& t) { cut_above(t, 0.4); });
  EXPECT_EQ(early, "refuted; scan.touches.cuts[0]: its terms do not prove that no motion is above x 0.4");
  const std::string other = told([](Json& t) {
    cut_both(t);
    t["cuts"][1]["terms"][0][0] = 0;
  });
  EXPECT_EQ(other, "refuted; scan.touches.cuts[1]: its terms do not prove that no motion is below x -0.41");
}

TEST(SolidTouches, DirectionsTakeABallToWhereItMetTheBlank) {
  // Balls of 2 mm whose centres lie 3 mm off the faces met them with that direction of any length.
  const auto met = [](const char* points, bool said = true, double at = 0.41) {
    return told(
        [&](Json& t) {
          cut_both(t, at);
          t["ball"] = 6, t["directions"] = said;
        },
        [&](SolidResultFiles& files) {
          fit(files, 0.3 + at);
          files.points = points;
        });
  };
  EXPECT_EQ(met("9 0 0 0.1 0 0\n-9 0 0 -7e3 0 0\n"), "unproved");
  EXPECT_TRUE(says(met("9 0 0 1 0 0\n-9 0 0 -1 0 0\n", true, 0.4), "cuts[0]: its terms do not prove"));
  EXPECT_TRUE(says(met("9 0 0 1 0 0\n-9 0 0 1 0 0\n"), "cuts[1]: its terms do not prove"));
  // A direction askew takes the place where it met along the face, and off it by its cosine.
  EXPECT_TRUE(says(met("9 0 0 1 0.5 0\n-9 0 0 -1 0 0\n"), "cuts[0]: its terms do not prove"));
  EXPECT_TRUE(says(met("9 0 0\n-9 0 0\n"), "scan.touches.directions is true, but the touches have none"));
  EXPECT_TRUE(says(met("9 0 0 1 0 0\n-9 0 0 -1 0 0\n", false),
                   "scan.touches.directions is false, but the touches have some"));
  EXPECT_TRUE(says(met("9 0 0 1 0 0\n-9 0 0 0 0 0\n"), "the direction of touch 1 is 0"));
  EXPECT_FALSE(says(met("9 0 0 1 0 0\n-9 0 0\n"), "unproved"));
}

TEST(SolidTouches, WhatIsCutLiesInWhatIsLeft) {
  for (const double at : {0.5000001, -0.5000001})
    EXPECT_TRUE(
        says(told([&](Json& t) { cut_above(t, at); }), "cuts[0] cuts x outside of the box that is left"));
  // The very end takes off all that is there, which is proved.
  EXPECT_TRUE(says(told([&](Json& t) { cut_above(t, 0.5); }), "ways[0]: its terms do not prove"));
  EXPECT_TRUE(says(told([](Json& t) {
                     t["turn_y"] = {0.1, 0};
                   }),
                   "scan.touches.turn_y is not in ascending order"));
  EXPECT_TRUE(says(told([](Json& t) {
                     cut_both(t);
                     t["cuts"][1]["at"] = -0.5000001;
                   }),
                   "cuts[1] cuts x outside of the box that is left"));
  // At the other end it takes off the end alone.
  EXPECT_EQ(told(
                [](Json& t) {
                  cut_both(t);
                  const Json above = t["cuts"][0], below = t["cuts"][1];
                  t["cuts"][1]["at"] = -0.5;
                  t["cuts"][0] = t["cuts"][1], t["cuts"][1] = above;
                  t["cuts"].push_back(below);
                },
                [](SolidResultFiles& files) { fit(files); }),
            "unproved");
  // The second cut is of what the first has left.
  EXPECT_TRUE(says(told([](Json& t) {
                     cut_above(t, 0.45);
                     t["cuts"].push_back(t["cuts"][0]);
                     t["cuts"][1]["at"] = 0.46;
                   }),
                   "cuts[1] cuts x outside"));
}

TEST(SolidTouches, TermsAreOfTouchesAndBallsThatAreThere) {
  const auto term = [](const Json& one) {
    return told([&](Json& t) {
      cut_both(t);
      t["cuts"][0]["terms"] = Json::array({one});
    });
  };
  EXPECT_TRUE(says(term({2, 0, 1}), "cuts[0] has a term of touch 2 and ball 0, which are not there"));
  EXPECT_TRUE(says(term({0, 1, 1}), "cuts[0] has a term of touch 0 and ball 1, which are not there"));
  EXPECT_TRUE(
      says(term({19'999'999, 0, 1}), "cuts[0] has a term of touch 19999999 and ball 0, which are not"));
  EXPECT_TRUE(says(term({20'000'000, 0, 1}), "has a number of nothing"));
  EXPECT_TRUE(says(term({0, 0, 0}), "cuts[0]: its terms do not prove"));
  EXPECT_TRUE(says(term({0, 0, -1}), "bad input"));
  EXPECT_TRUE(says(term({0.5, 0, 1}), "bad input"));
  EXPECT_TRUE(says(term({-1, 0, 1}), "bad input"));
  EXPECT_TRUE(says(term({0, 0}), "bad input"));
  const auto out = [](const Json& numbers) {
    return told([](Json& t) { cut_both(t); },
                [&](SolidResultFiles& files) {
                  fit(files);
                  files.result["scan"]["left_out"] = numbers;
                });
  };
  EXPECT_TRUE(says(out({0}), "cuts[0] has a term of touch 0 and ball 0, which are not there, or left out"));
  EXPECT_TRUE(says(out({2}), "scan.left_out names touch 2 of 2"));
}

TEST(SolidTouches, BallsHaveNoSurfaceInside) {
  const auto ball = [](const Json& one) {
    return told(
        [&](Json& t) {
          cut_both(t);
          t["balls"].push_back(one);
        },
        [](SolidResultFiles& files) { fit(files); });
  };
  EXPECT_EQ(ball({1, 0, 0, 5}), "unproved");
  EXPECT_EQ(ball({0, 0, 16, 10}), "unproved");
  EXPECT_TRUE(says(ball({1, 0, 0, 5.0000001}), "scan.touches.balls[1] is not what it has to be"));
  EXPECT_TRUE(says(ball({0, 0, 16, 10.000001}), "scan.touches.balls[1] is not what it has to be"));
  EXPECT_TRUE(says(ball({1, 0, 0, 0}), "bad input"));
}

/// A touch of the ball's centre over the middle of the face at x = 6, which may be `up` off, with one ball of
/// the cube. It cuts at `at`.
std::string centre(double ball, double x, const Json& one, bool above, double at) {
  return told(
      [&](Json& t) {
        t["ball"] = ball, t["x"] = {-1.5, 1.5}, t["balls"] = Json::array({one});
        t["cuts"].push_back({{"axis", "x"}, {"above", above}, {"at", at}, {"terms", {{0, 0, 1}}}});
      },
      [&](SolidResultFiles& files) { files.points = std::to_string(x) + " 0 0\n-6 0 0\n"; });
}
bool is_cut(const std::string& said) { return !says(said, "scan.touches.cuts"); }

TEST(SolidTouches, TheBallsRadiusCounts) {
  // d is 0.4. A large ball is outside: the surface is more than 3 - 0.4 from its centre, so that t < 0.4.
  EXPECT_TRUE(is_cut(centre(6, 9, {0, 0, 0, 6}, true, 0.45)));
  EXPECT_FALSE(is_cut(centre(6, 9, {0, 0, 0, 6}, true, 0.39)));
  // One of a radius of 2 d might as well lie inside: then no more is known than of a point, t < 1.2.
  EXPECT_FALSE(is_cut(centre(1.6, 6.8, {0, 0, 0, 6}, true, 1.19)));
  EXPECT_TRUE(is_cut(centre(1.6, 6.8, {0, 0, 0, 6}, true, 1.4)));
  EXPECT_FALSE(is_cut(centre(1.6, 6.8, {0, 0, 0, 6}, true, 0.8)));
  EXPECT_TRUE(is_cut(centre(1.7, 6.85, {0, 0, 0, 6}, true, 0.8)));
  // From the air: the surface is less than 3 + 0.4 from the centre, so that t > -0.4.
  EXPECT_TRUE(is_cut(centre(6, 9, {106, 0, 0, 100}, false, -0.45)));
  EXPECT_FALSE(is_cut(centre(6, 9, {106, 0, 0, 100}, false, -0.39)));
  // A radius has to be more than a touch is uncertain by.
  EXPECT_TRUE(says(centre(0.2, 6, {0, 0, 0, 6}, true, 1.4), "scan.touches.ball is not larger than twice"));
  EXPECT_FALSE(says(centre(0.21, 6, {0, 0, 0, 6}, true, 1.4), "scan.touches.ball is not larger than twice"));
}

TEST(SolidTouches, TheBoxIsAroundTheNominalMesh) {
  const auto around = [](const Json& low, const Json& high) {
    return told([&](Json& t) { t["around"] = {low, high}; });
  };
  EXPECT_EQ(around({-6, -7, -6}, {6, 6, 8}), "unproved");
  EXPECT_TRUE(says(around({-6, -5.999, -6}, {6, 6, 6}),
                   "scan.touches.around does not hold the nominal mesh along y"));
  EXPECT_TRUE(says(around({-6, -6, -6}, {5.999, 6, 6}),
                   "scan.touches.around does not hold the nominal mesh along x"));
  // It has a size along each axis, whatever the mesh has.
  solid::Mesh flat = cases::block({-6, -6, 0}, {6, 6, 0});
  for (std::size_t k = 4; k < 8; ++k) flat.vertices[k].x /= 2, flat.vertices[k].y /= 2;
  const auto around_flat = [&](double low, double high) {
    return told(
        [&](Json& t) {
          t["around"] = {{-6, -6, low}, {6, 6, high}};
        },
        [&](SolidResultFiles& files) { files.nominal = solid_files::stl_binary(flat); });
  };
  const std::string no_size = "scan.touches.around does not hold the nominal mesh along z";
  EXPECT_TRUE(says(around_flat(0, 0), no_size));
  EXPECT_FALSE(says(around_flat(0, 1e-3), no_size));
  EXPECT_TRUE(says(told([](Json& t) { t["around"] = {{-6, -6, -6}}; }), "bad input"));
  EXPECT_TRUE(says(told([](Json& t) { t["around"].push_back({0, 0, 0}); }), "bad input"));
  EXPECT_TRUE(says(around({-6, -6}, {6, 6, 6}), "bad input"));
}

TEST(SolidTouches, EveryCornerHasItsWays) {
  for (std::size_t way = 0; way < 48; ++way)
    EXPECT_EQ(told([&](Json& t) { t["ways"].erase(way); }),
              fmt::format("refuted; scan.touches.ways does not say how far corner {} goes along {}", way / 6,
                          "xyz"[way / 2 % 3]));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["at"] = -1e-9; }), "ways[3]: its terms do not prove"));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["multiplier"] = 0; }), "ways[3]: its terms do not prove"));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["multiplier"] = -1; }), "bad input"));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["corner"] = 8; }), "bad input"));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["axis"] = "turn_x"; }), "bad input"));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["axis"] = "u"; }), "bad input"));
  EXPECT_TRUE(says(told([](Json& t) { t["ways"][3]["above"] = 1; }), "bad input"));
  // Without a cut a corner may go as far as the box.
  const auto way = [](double at) {
    return told(
        [&](Json& t) {
          t["x"] = {-0.2, 0.25};
          for (Json& one : t["ways"])
            if (one["axis"] == "x") one["at"] = one["above"] == true ? at : 0.2;
        },
        [](SolidResultFiles& files) { fit(files, 0.55); });
  };
  EXPECT_EQ(way(0.25), "unproved");
  EXPECT_TRUE(says(way(0.2499),
                   "ways[1]: its terms do not prove that corner 0 goes no farther than 0.2499 mm along x"));
  // Terms of touches bound it, too.
  EXPECT_TRUE(says(told([](Json& t) {
                     cut_above(t, 0.45);
                     t["x"] = {-0.2, 0.5};
                     for (Json& one : t["ways"])
                       if (one["axis"] == "x") {
                         one["at"] = one["above"] == true ? 0.42 : 0.2;
                         if (one["above"] == true) one["terms"] = {{0, 0, 1}};
                       }
                   }),
                   "scan.widest is 0.3, but the widest triangle has 0.72"));
}

TEST(SolidTouches, AWayIsOfItsCorner) {
  // A turn about z, of a tangent of 0.005 for half of it, takes each corner 0.06 along x and y.
  const auto turned = [](double x, double y) {
    return told([&](Json& t) {
      t["turn_z"] = {-0.005, 0.005};
      for (Json& one : t["ways"])
        if (one["axis"] != "z") one["at"] = one["axis"] == "x" ? x : y;
    });
  };
  EXPECT_TRUE(says(turned(0.0595, 0.0605), "ways[0]: its terms do not prove"));
  EXPECT_TRUE(says(turned(0.0605, 0.0595), "ways[2]: its terms do not prove"));
  EXPECT_TRUE(says(turned(0.0605, 0.0605), "scan.widest is 0.3, but the widest triangle has 0.3855"));
  // A way is no shorter than none, even to where the corner was put.
  EXPECT_TRUE(says(told([](Json& t) {
                     t["moved"]["z"] = 0.25;
                     for (Json& one : t["ways"])
                       if (one["axis"] == "z") one["at"] = one["above"] == true ? -0.25 : 0.25;
                   }),
                   "ways[5]: its terms do not prove"));
}

TEST(SolidTouches, WaysOfCornersAreMixed) {
  // The corners at x = 6 go 0.2 farther: the face there has 0.5, that at x = -6 the form alone.
  const auto width = [](double farthest) {
    return told(
        [](Json& t) {
          for (Json& one : t["ways"])
            if (one["axis"] == "y" && one["corner"].get<int>() % 2 == 1) one["at"] = 0.2;
        },
        [&](SolidResultFiles& files) { fit(files, farthest); });
  };
  EXPECT_EQ(width(0.5), "unproved");
  EXPECT_TRUE(says(width(0.4), "scan.widest is 0.4, but the widest triangle has 0.5"));
  // Along two axes it is the length of both.
  EXPECT_TRUE(says(told([](Json& t) {
                     for (Json& one : t["ways"])
                       if (one["axis"] != "z") one["at"] = one["axis"] == "x" ? 0.3 : 0.4;
                   }),
                   "the widest triangle has 0.8"));
  // Of two ways of a corner the farther one counts, whichever stands first.
  for (const bool first : {true, false})
    EXPECT_TRUE(says(told([&](Json& t) {
                       Json way = still(0, "x", true), ways = Json::array();
                       way["at"] = 0.5;
                       if (first) ways.push_back(way);
                       for (const Json& one : t["ways"]) ways.push_back(one);
                       if (!first) ways.push_back(way);
                       t["ways"] = ways;
                     }),
                     "the widest triangle has 0.8"));
  // What a corner is off its place counts.
  EXPECT_TRUE(says(told([](Json& t) { t["moved"]["z"] = 0.25; }), "ways[4]"));
  EXPECT_TRUE(says(told([](Json& t) {
                     t["moved"]["z"] = 0.25;
                     for (Json& one : t["ways"])
                       if (one["axis"] == "z" && one["above"] == false) one["at"] = 0.25;
                   }),
                   "the widest triangle has 0.8"));
}

TEST(SolidTouches, TheBlankIsTheNominalMesh) {
  const auto files = [](const std::function<void(SolidResultFiles&)>& change) {
    return told([](Json&) {}, change);
  };
  // Its triangles are the same, in their order.
  solid::Mesh other = cases::block({-6, -6, -6}, {6, 6, 6});
  std::swap(other.triangles[0], other.triangles[7]);
  EXPECT_TRUE(
      says(files([&](SolidResultFiles& f) { f.nominal = solid_files::stl_binary(other); }), "refuted"));
  EXPECT_TRUE(says(files([&](SolidResultFiles& f) {
                     f.nominal = solid_files::stl_binary(cases::block({-6, -6, -6}, {6, 6, 5.5}));
                   }),
                   "the widest triangle has 0.8"));
  solid::Mesh more = cases::block({-6, -6, -6}, {6, 6, 6});
  cases::append(more, cases::block({-1, -1, -1}, {1, 1, 1}));
  EXPECT_TRUE(says(files([&](SolidResultFiles& f) {
                     f.nominal = solid_files::stl_binary(more);
                     f.result["inputs"][3]["triangles"] = 24;
                   }),
                   "the blank has 12 triangles, and the nominal mesh 24"));
  EXPECT_TRUE(says(files([](SolidResultFiles& f) { f.result["inputs"][3]["triangles"] = 11; }),
                   "the nominal mesh is said to have 11 triangles, but nominal.stl has 12"));
  for (const auto& without : {&SolidResultFiles::nominal, &SolidResultFiles::points})
    EXPECT_TRUE(says(files([&](SolidResultFiles& f) { (f.*without).reset(); }), "or was checked without"));
  for (const std::size_t input : {2, 3})
    EXPECT_TRUE(says(files([&](SolidResultFiles& f) { f.result["inputs"].erase(input); }),
                     "names no touches or no nominal"));
  EXPECT_TRUE(says(files([](SolidResultFiles& f) { f.result["inputs"].push_back(f.result["inputs"][3]); }),
                   "inputs name two nominal meshes"));
  EXPECT_TRUE(says(files([](SolidResultFiles& f) {
                     f.result["scan"].erase("touches");
                     f.result["scan"]["max_dip"] = 0.2;
                   }),
                   "inputs name a nominal mesh, but scan has no touches"));
  EXPECT_TRUE(says(files([](SolidResultFiles& f) { f.result["scan"] = nullptr; }),
                   "inputs name a nominal mesh, but scan has no touches"));
  for (const char* form : {"min_radius", "max_dip"})
    EXPECT_TRUE(says(files([&](SolidResultFiles& f) { f.result["scan"][form] = 0.2; }),
                     "scan has a min_radius or a max_dip, and touches"));
  EXPECT_TRUE(says(files([](SolidResultFiles& f) { f.result["scan"].erase("touches"); }),
                   "scan has neither a min_radius nor a max_dip"));
  EXPECT_TRUE(
      says(files([](SolidResultFiles& f) { f.result["inputs"][2]["points"] = 3; }), "3 points are said"));
}

TEST(SolidTouches, WhatHangsTogetherInOnePointAloneIsNotTheBlank) {
  const auto two = [](double low, double high) {
    solid::Mesh made = cases::block({-6, -6, -6}, {6, 6, 6});
    cases::append(made, cases::block({low, low, low}, {high, high, high}));
    return solid_files::stl_binary(made);
  };
  // A corner of the nominal mesh's second cube may be the first of its first cube.
  const auto touching_at = [&](double corner) {
    return told(
        [](Json& t) {
          t["around"][0] = {-8, -8, -8};
        },
        [&](SolidResultFiles& files) {
          files.nominal = two(-8, corner), files.blank = two(7, 9);
          files.result["inputs"][1]["triangles"] = files.result["inputs"][3]["triangles"] = 24;
        });
  };
  const std::string apart = "of the blank does not hang together as that of the nominal mesh does";
  EXPECT_TRUE(says(touching_at(-6), apart));
  EXPECT_FALSE(says(touching_at(-7), apart));
}

TEST(SolidTouches, AFormThatIsNotReadIsLeftOpen) {
  const auto told_of = [](const std::string& bytes, std::optional<std::string> SolidResultFiles::*file) {
    return told([](Json&) {}, [&](SolidResultFiles& files) { files.*file = bytes; });
  };
  const std::string quads =
      "v -6 -6 -6\nv 6 -6 -6\nv 6 6 -6\nv -6 6 -6\nv 0 0 6\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
  EXPECT_EQ(told_of(quads, &SolidResultFiles::nominal), "incomplete");
}

TEST(SolidTouches, NumbersAreOfTheirKind) {
  const auto bad = [](const std::function<void(Json&)>& change) { return says(told(change), "bad input"); };
  EXPECT_TRUE(bad([](Json& t) { t["form"] = 0; }));
  EXPECT_TRUE(bad([](Json& t) { t["ball"] = -1; }));
  EXPECT_TRUE(bad([](Json& t) { t["quaternion"] = {0, 0, 0, 0}; }));
  EXPECT_TRUE(bad([](Json& t) { t["moved"]["quaternion"] = {0, 0, 0, 0}; }));
  EXPECT_TRUE(bad([](Json& t) { t["balls"] = {{1, 2, 3}}; }));
  EXPECT_TRUE(bad([](Json& t) { t["unheard"] = 1; }));
  for (const char* key :
       {"ball", "form", "pivot", "quaternion", "x", "turn_z", "balls", "cuts", "moved", "around", "ways"})
    EXPECT_TRUE(bad([&](Json& t) { t.erase(key); })) << key;
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_touches_test
