// Numbers, places and widths of the checker's solids at their very bounds.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lekalo/base/stop.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"
#include "verify/number/both.hpp"
#include "verify/solid/scan_widths.hpp"
#include "verify/solid/solid_window.hpp"

namespace lekalo::verify::verify_solid_number_test {
namespace {

using cases::decimal;

TEST(SolidNumber, AnEnclosureIsTheNumberItselfWhereADoubleIs) {
  for (const char* text : {"0", "0.5", "-3", "1e9", "-0.375", "5.9604644775390625e-8"}) {
    const Fraction value = to_fraction(decimal(text));
    for (const Span span : {enclosed(value), enclosed(decimal(text))}) {
      EXPECT_EQ(span.low, std::stod(text));
      EXPECT_EQ(span.high, std::stod(text));
    }
  }
  for (const char* text :
       {"0.1", "-0.1", "1e-30", "0.30000000000000000001", "-123456789.123456789123456789",
        "0.12345678901234567", "-0.98765432109876543", "123456789.123456789", "0.7", "0.3"}) {
    const Fraction value = to_fraction(decimal(text));
    for (const Span span : {enclosed(value), enclosed(decimal(text))}) {
      EXPECT_TRUE(Fraction(span.low) < value && value < Fraction(span.high)) << text;
      EXPECT_LE(span.high, step_up(step_up(span.low))) << text;
    }
  }
}

TEST(SolidNumber, ASureSignIsThatOfAllNumbersOfASpan) {
  for (const auto& [low, high, sign] : {std::tuple(0.0, 0.0, 0),
                                        {0, 1, 0},
                                        {-1, 0, 0},
                                        {-1, 1, 0},
                                        {5e-324, 1, 1},
                                        {-1, -5e-324, -1},
                                        {2, 2, 1},
                                        {-2, -2, -1}})
    EXPECT_EQ(sure_sign({low, high}), sign) << low << " " << high;
}

TEST(SolidNumber, MessagesHaveTheNearestDouble) {
  for (const char* text : {"0.1", "-0.1", "0", "0.3", "-0.7", "5", "1e-9", "123456.789", "-123456.789"})
    EXPECT_EQ(nearest(to_fraction(decimal(text))), std::stod(text)) << text;
  EXPECT_EQ(nearest(Fraction(power_of_ten(400))), std::numeric_limits<double>::max());
  EXPECT_EQ(nearest(Fraction(-power_of_ten(400))), -std::numeric_limits<double>::max());
  EXPECT_EQ(nearest(to_fraction(decimal("1e-399"))), 0);
}

// ---- places in a solid -----------------------------------------------------------------------------------

TEST(SolidPlace, WhatIsInsideIsToldToTheLastDigit) {
  const SolidMesh mesh = cases::checked(cases::block({0, 0, 0}, {4, 4, 4}));
  const PlacedSolid body(mesh);
  const auto holds = [&](const char* x, const char* y, const char* z) {
    const Exact3 p{to_fraction(decimal(x)), to_fraction(decimal(y)), to_fraction(decimal(z))};
    return body.holds(enclosed(p), p);
  };
  for (const char* x : {"1", "2", "3.5"})
    for (const char* y : {"1", "2", "0.5"}) {
      for (const char* in : {"1e-40", "2", "3.99999999999999999999999"}) {
        EXPECT_TRUE(holds(x, y, in)) << x << y << in;
        EXPECT_TRUE(holds(x, in, y)) << x << y << in;
        EXPECT_TRUE(holds(in, x, y)) << x << y << in;
      }
      for (const char* out : {"-1e-40", "-3", "4.0000000000000000000001", "9"}) {
        EXPECT_FALSE(holds(x, y, out)) << x << y << out;
        EXPECT_FALSE(holds(x, out, y)) << x << y << out;
        EXPECT_FALSE(holds(out, x, y)) << x << y << out;
      }
    }
}

/// The way up may meet a ridge, which is of one of its two sides alone.
TEST(SolidPlace, AWayThroughARidgeCrossesItOnce) {
  for (const double at : {-20.0, -3.0, 0.0, 50.0})
    for (const bool along_x : {false, true}) {
      solid::Mesh house;
      house.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 6, 0}, {0, 6, 0}, {2, 0, 3}, {2, 6, 3}};
      house.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {2, 3, 5},
                         {1, 2, 5}, {1, 5, 4}, {3, 0, 4}, {3, 4, 5}};
      for (solid::Vector& p : house.vertices) {
        p = p + solid::Vector{at, at, 0};
        if (along_x) std::swap(p.x, p.y);
      }
      const SolidMesh mesh = cases::checked(house);
      const PlacedSolid body(mesh);
      for (const double y : {1.0, 2.0, 3.0, 4.5})
        for (const auto& [z, in] : {std::pair(-1.0, false), {1, true}, {2.5, true}, {3.5, false}}) {
          Near3 p{2 + at, y + at, z};
          if (along_x) std::swap(p[0], p[1]);
          EXPECT_EQ(body.holds({just(p[0]), just(p[1]), just(p[2])},
                               {Fraction(p[0]), Fraction(p[1]), Fraction(p[2])}),
                    in)
              << at << " " << along_x << " " << y << " " << z;
        }
    }
}

TEST(SolidPlace, OfEachPartOfASurfaceThereIsOneVertex) {
  solid::Mesh mesh = cases::block({0, 0, 0}, {4, 4, 4});
  const auto count = [&] {
    const SolidMesh made = cases::checked(mesh);
    return PlacedSolid(made).one_of_each_component().size();
  };
  EXPECT_EQ(count(), 1U);
  cases::append(mesh, cases::block({1, 1, 1}, {2, 2, 2}));
  EXPECT_EQ(count(), 2U);
  mesh.vertices.push_back({9, 9, 9});
  mesh.vertices.push_back({-9, 9, 9});
  EXPECT_EQ(count(), 2U);
  cases::append(mesh, cases::block({2, 2, 2}, {3, 3, 3}));  // by a corner it hangs together with the other
  EXPECT_EQ(count(), 2U);
}

TEST(SolidPlace, WhatNoTriangleUsesLiesNowhere) {
  solid::Mesh part = cases::block({1, 1, 1}, {9, 9, 9}), blank = cases::block({0, 0, 0}, {10, 10, 10});
  part.vertices.push_back({-5, 0, 0});
  blank.vertices.push_back({5, 5, 5});
  EXPECT_EQ(cases::answer(part, blank, cases::unturned(), "1"), "shown");
}

TEST(SolidPlace, SentencesNameTheFirstOfSeveral) {
  const auto said = [](double low, const char* clearance) {
    return cases::answer(cases::block({low, 1, 1}, {9, 9, 9}), cases::block({0, 0, 0}, {10, 10, 10}),
                         cases::unturned(), clearance);
  };
  for (const auto& [text, begin, end] :
       {std::tuple(said(1, "1.5"), "fault: the clearance 1.5 mm is above 1.00000000000000",
                   " mm: so near is triangle 9 of the part, placed at (1, 1, 1), to triangle 1 of the blank, "
                   "at (0, 0, 0)"),
        {said(0, "0"), "open: triangle 1 of the part, placed at (",
         ", touches triangle 9 of the blank, at (0, 0, 0): that the part does not pass through the blank's "
         "surface was "
         "not rechecked"},
        {said(0, "1e-300"), "fault: triangle 1 of the part, placed at (",
         ", 1, 1), touches triangle 9 of the blank, at (0, 0, 0)"}}) {
    EXPECT_TRUE(text.starts_with(begin)) << text;
    EXPECT_TRUE(text.ends_with(end)) << text;
  }
  EXPECT_EQ(cases::answer(cases::block({0, 0, 0}, {1, 1, 1}), cases::block({0, 0, 0}, {1, 1, 1}),
                          cases::unturned({"1e12", "-1e12", "1e12"}), "0")
                .find("fault: the part is not in the blank"),
            0U);
}

TEST(SolidPlace, AClearanceAtTheEndOfTheEnclosureIsDecidedExactly) {
  const SolidMesh part = cases::checked(cases::block({0, 0, 0}, {8, 8, 8})),
                  blank = cases::checked(cases::block({0, 0, 0}, {10, 10, 10}));
  const auto pair = SolidPair::make(part, blank, cases::unturned({"1", "1", "1"}));
  ASSERT_TRUE(pair);
  const double high = pair->check(decimal("1")).least.high;
  const auto fault = [&](double clearance) { return pair->check(exactly(clearance)).fault.value_or(""); };
  EXPECT_NE(fault(high).find("is nearer than the clearance to"), std::string::npos) << fault(high);
  EXPECT_NE(fault(step_up(high)).find("the clearance"), std::string::npos) << fault(step_up(high));
  EXPECT_EQ(fault(step_up(high)).find("the clearance 1"), 0U) << fault(step_up(high));
}

TEST(SolidPlace, ContactsAreBoundsUpToTheSlack) {
  const SolidMesh part = cases::checked(cases::block({0, 0, 0}, {8, 8, 8}));
  SolidMesh blank = cases::checked(cases::block({0, 0, 0}, {10, 10, 10}));
  const SolidPose pose = cases::unturned({"1", "1", "1"});
  const auto pair = SolidPair::make(part, blank, pose);
  ASSERT_TRUE(pair);
  const auto refusal = [&](const char* px, const char* bx, const char* distance, double slack,
                           Span width = {}) {
    SolidContact contact{{decimal(px), decimal("3"), decimal("4")},
                         {decimal(bx), decimal("4"), decimal("5")},
                         decimal(distance)};
    const auto bound = pair->bound_of(contact, slack, width);
    return bound ? std::string() : bound.error().message;
  };
  const auto number_after = [](const std::string& text, const std::string& words) {
    return std::stod(text.substr(text.find(words) + words.size()));
  };
  EXPECT_EQ(refusal("0", "0", "1", 1e-6), "");
  const std::string part_off = refusal("0.1", "0", "1.1", 0), blank_off = refusal("0", "0.1", "0.9", 1e-12),
                    apart = refusal("0", "0", "0", 1e-6);
  EXPECT_EQ(part_off.find("part_point, placed at (1.1, 4, 5), is 0.1"), 0U) << part_off;
  EXPECT_EQ(blank_off.find("blank_point (0.1, 4, 5) is 0.1"), 0U) << blank_off;
  EXPECT_NE(apart.find("mm apart, not 0"), std::string::npos) << apart;
  for (const auto& [text, words, px, bx, said] : {std::tuple(part_off, " is ", "0.1", "0", "1.1"),
                                                  {blank_off, " is ", "0", "0.1", "0.9"},
                                                  {apart, " are ", "0", "0", "0"}}) {
    const double most = number_after(text, words);
    EXPECT_EQ(refusal(px, bx, said, most), "") << text;
    EXPECT_NE(refusal(px, bx, said, step_down(most)), "") << text;
  }
  // The other end: the points are as far apart as is said, less the slack.
  const SolidMotion motion(pose);
  const Vec3 way = motion(Vec3{just(0), just(3), just(4)}) - Vec3{just(0), just(4), just(5)};
  const std::string most = fmt::format("{}", length(way).high + 0x1p-40);
  EXPECT_EQ(refusal("0", "0", most.c_str(), 0x1p-40), "");
  EXPECT_NE(refusal("0", "0", most.c_str(), step_down(0x1p-40) - 0x1p-52), "");
  blank.widths.assign(12, just(0.25));
  EXPECT_EQ(refusal("0", "0", "0.75", 1e-6, just(0.25)), "");
  EXPECT_NE(refusal("0", "0", "1", 1e-6, just(0.25))
                .find("mm apart but for the width of the blank's triangle, not 1"),
            std::string::npos);
}

// ---- the window ------------------------------------------------------------------------------------------

SolidWindow window(SolidFreedom freedom, const char* turn, const char* pivot = "0") {
  SolidWindow made;
  made.freedom = freedom;
  made.start = cases::unturned();
  made.pivot = {decimal(pivot), decimal("0"), decimal("0")};
  made.shift = decimal("0.5"), made.turn_deg = decimal(turn);
  return made;
}
std::string off(const SolidWindow& window, const SolidPose& pose) {
  return off_window(window, pose).value_or("");
}

TEST(SolidWindow, EachDirectionHasItsEnd) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const char* sign : {"", "-"}) {
      std::array<std::string, 3> shift{"0", "0", "0"};
      shift[axis] = sign + std::string("0.5");
      EXPECT_EQ(off(window(SolidFreedom::xyz, "0"), cases::unturned(shift)), "");
      // The numbers of a place may be rounded by 4e-15 of their sizes, here 1.
      shift[axis] = sign + std::string("0.500000000000004");
      EXPECT_EQ(off(window(SolidFreedom::xyz, "0"), cases::unturned(shift)), "");
      shift[axis] = sign + std::string("0.5000000000000041");
      EXPECT_EQ(off(window(SolidFreedom::xyz, "0"), cases::unturned(shift)),
                std::string("the pivot's ") + "xyz"[axis] +
                    " is 0.5000000000000041 mm from its place at the start, more than 0.5");
      std::array<std::string, 4> q{"1", "0", "0", "0"};
      const SolidWindow half = window(SolidFreedom::six, "90");
      for (const char* in : {"1", "1.000000000000004"}) {
        q[axis + 1] = sign + std::string(in);
        EXPECT_EQ(off(half, cases::solid_pose(q, {"0", "0", "0"})), "") << in;
      }
      q[axis + 1] = sign + std::string("1.0000000000000041");
      EXPECT_EQ(off(half, cases::solid_pose(q, {"0", "0", "0"}))
                    .find(std::string("its rotation from the start's has the turn_") + "xyz"[axis] + " " +
                          sign + "1.000000000000004"),
                0U);
    }
  // Rounding is counted by the sizes of the pivot and of the place.
  const SolidWindow far = window(SolidFreedom::xyz, "0", "1000000");
  EXPECT_EQ(off(far, cases::unturned({"0.500000003", "0", "0"})), "");
  EXPECT_NE(off(far, cases::unturned({"0.500000005", "0", "0"})), "");
}

TEST(SolidWindow, ARotationByHalfATurnIsBeyondAllDoubles) {
  const SolidWindow most = window(SolidFreedom::six, "90");
  EXPECT_EQ(off(most, cases::solid_pose({"0", "0", "1", "0"}, {"0", "0", "0"})),
            "its rotation from the start's has the turn_y inf, beyond 1");
  EXPECT_EQ(off(most, cases::solid_pose({"1e-399", "0", "1e9", "0"}, {"0", "0", "0"}))
                .find("its rotation from the start's has the turn_y 1.79769313486"),
            0U);
  EXPECT_EQ(off(most, cases::solid_pose({"-1e-399", "0", "1e9", "0"}, {"0", "0", "0"}))
                .find("its rotation from the start's has the turn_y -1.79769313486"),
            0U);
}

// ---- widths of a scan ------------------------------------------------------------------------------------

WrittenSolidScan scan(const char* guard, const char* radius, const char* dip = nullptr) {
  WrittenSolidScan made;
  made.guard = decimal(guard);
  if (radius != nullptr) made.min_radius = decimal(radius);
  if (dip != nullptr) made.max_dip = decimal(dip);
  return made;
}
/// A mesh of triangles on their own, which need not be closed here.
SolidMesh triangles(const std::vector<std::array<Near3, 3>>& all) {
  SolidMesh mesh;
  for (const auto& t : all) {
    const auto first = static_cast<std::uint32_t>(mesh.near.size());
    for (const Near3& p : t) mesh.near.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(SolidWidth, IsByTheSmallestCircleAroundATriangle) {
  struct Case {
    std::array<Near3, 3> t;
    double circle;  ///< squared radius
  };
  const double equal = std::sqrt(3) / 2;
  for (const Case& c :
       {Case{{{{0, 0, 0}, {6, 0, 0}, {0, 8, 0}}}, 25}, Case{{{{0, 0, 0}, {10, 0, 0}, {1, 1, 0}}}, 25},
        Case{{{{0, 0, 0}, {0, 10, 0}, {0, 2, 0}}}, 25}, Case{{{{0, 0, 1}, {0, 8, 1}, {4, 8, 1}}}, 20},
        Case{{{{-3, 0, 4}, {3, 0, 4}, {0, 0, 10}}}, 14.0625},
        Case{{{{0, 0, 0}, {2, 0, 0}, {1, 2 * equal, 0}}}, 4.0 / 3},
        Case{{{{0, 0, 0}, {14, 0, 0}, {5, 12, 0}}}, 66.015625}})
    for (int turn = 0; turn < 6; ++turn)
      // Near the radius, where fractions decide, and far from it.
      for (const char* radius : {"9", "8.2", "100", "8.13", "5.01", "3.76"}) {
        std::array<Near3, 3> t = c.t;
        std::rotate(t.begin(), t.begin() + turn % 3, t.end());
        if (turn >= 3) std::swap(t[0], t[1]);
        const ScanWidths widths = scan_widths(triangles({t}), scan("0.001", radius));
        const double r = std::stod(radius), left = (r - 0.001) * (r - 0.001) - c.circle;
        ASSERT_EQ(widths.of.size(), 1U);
        EXPECT_EQ(widths.unknown, left > 0 ? 0U : 1U) << radius << " " << c.circle;
        const double is = left > 0 ? r - std::sqrt(left) : 0.001;
        EXPECT_NEAR(widths.of[0].low, is, 1e-10) << radius << " " << c.circle;
        EXPECT_NEAR(widths.of[0].high, is, 1e-10) << radius << " " << c.circle;
      }
}

TEST(SolidWidth, AtTheRadiusATriangleIsUnknown) {
  const SolidMesh mesh = triangles({{{{0, 0, 0}, {6, 0, 0}, {0, 8, 0}}}});
  EXPECT_EQ(scan_widths(mesh, scan("0", "5")).unknown, 1U);
  EXPECT_EQ(scan_widths(mesh, scan("0", "5")).unknown_area.low > 23.9, true);
  EXPECT_EQ(scan_widths(mesh, scan("0", "5.00000000000000000001")).unknown, 0U);
  EXPECT_EQ(scan_widths(mesh, scan("0.5", "5.5")).unknown, 1U);
  EXPECT_EQ(scan_widths(mesh, scan("0.5", "5.5000000000000000001")).unknown, 0U);
}

/// Its largest angle is a little more than a right one, and doubles do not tell which of the long sides is
/// the longer one.
TEST(SolidWidth, OfANeedleItHoldsTheExactOne) {
  const double length = 0x1.8p20, thin = 0x1p-12, back = 0.25, radius = 900'000;
  const Near3 blunt{0, 0, 0}, sharp{thin, 0, 0}, tip{-back, length, 0};
  const Fraction wide = Fraction(thin) + Fraction(back),
                 longest = wide * wide + Fraction(length) * Fraction(length),
                 left = Fraction(radius) * Fraction(radius) - longest / 4;
  for (const std::array<Near3, 3>& t : {std::array{blunt, sharp, tip}, std::array{sharp, blunt, tip},
                                        std::array{tip, sharp, blunt}, std::array{tip, blunt, sharp}}) {
    const Span width = scan_widths(triangles({t}), scan("0", "900000")).of[0];
    const Fraction low = Fraction(radius) - Fraction(width.low),
                   high = Fraction(radius) - Fraction(width.high);
    EXPECT_TRUE(low * low >= left && high * high <= left);
    EXPECT_LT(width.high - width.low, 1e-7);
  }
}

TEST(SolidWidth, SpansDecideNearlyAlways) {
  std::vector<std::array<Near3, 3>> all;
  for (int k = 0; k < 300; ++k)
    for (const Near3& third : {Near3{0, 3, 1}, {2.5, 2, 0.5}, {1, 0.5, 0}})
      all.push_back({{{0, 0, 0}, {4, 0, 0.25}, third}});
  RunControl run;
  run.work_limit = 1500;  // a look at each, and none by fractions, which count for ten
  const auto widths = stoppable(run, [&] { return scan_widths(triangles(all), scan("0.1", "5")).of.size(); });
  ASSERT_TRUE(widths) << "by fractions";
  EXPECT_EQ(*widths, all.size());
}

TEST(SolidWidth, FarFromTheOriginTextsAreReadExactly) {
  SolidMesh mesh = triangles({{{{1e6, 0, 0}, {1e6 + 0.0625, 0, 0}, {1e6, 0.0625, 0}}}});
  for (const Near3& p : mesh.near) mesh.written.push_back({exactly(p[0]), exactly(p[1]), exactly(p[2])});
  const Span is = scan_widths(mesh, scan("0", "0.05")).of[0];
  EXPECT_LT(is.high - is.low, 1e-15);
  EXPECT_NEAR(is.low, 0.05 - std::sqrt(0.0025 - 0.001953125), 1e-15);
}

TEST(SolidWidth, OfTheUndersideItIsWhatIsSaidOfIt) {
  const SolidMesh mesh = triangles({{{{0, 0, -6}, {6, 0, -6}, {0, 8, -6}}},
                                    {{{0, 0, -6}, {6, 0, -5}, {0, 8, -5}}},
                                    {{{0, 0, -5.9}, {6, 0, -5}, {0, 8, -5}}}});
  WrittenSolidScan said = scan("0.25", nullptr, "0.5");
  said.underside = {decimal("-6.5"), decimal("0.5")};
  const auto widths = [&] {
    std::vector<double> all;
    for (const Span width : scan_widths(mesh, said).of) all.push_back(width.low);
    return all;
  };
  EXPECT_EQ(widths(), (std::vector<double>{0.5, 1, 0.75}));
  said.underside->z = decimal("-5.25");
  EXPECT_EQ(widths(), (std::vector<double>{0.75, 1, 1}));
  said.underside->flat = decimal("0.125"), said.underside->z = decimal("-6");
  EXPECT_EQ(widths(), (std::vector<double>{0.125, 0.75, 0.75}));
}

TEST(SolidWidth, OfTwoStatementsTheBetterOneCounts) {
  const SolidMesh mesh =
      triangles({{{{0, 0, 0}, {6, 0, 0}, {0, 8, 0}}}, {{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}}});
  // By the radius 13 the first triangle is 1 wide.
  EXPECT_NEAR(scan_widths(mesh, scan("0", "13", "2")).of[0].low, 1, 1e-12);
  EXPECT_EQ(scan_widths(mesh, scan("0", "13", "0.5")).of[0].low, 0.5);
  EXPECT_NEAR(scan_widths(mesh, scan("0", "13", "0.75")).of[1].low, 0.75, 0);
  // Of two that are as good it is the radius.
  WrittenSolidScan even = scan("0", "13");
  even.max_dip = exactly(scan_widths(mesh, even).widest.high);
  EXPECT_LT(scan_widths(mesh, even).of[1].high, 0.5);
  // One that leaves a triangle unknown says nothing.
  EXPECT_EQ(scan_widths(mesh, scan("0", "4", "3")).of[1].low, 3);
  EXPECT_EQ(scan_widths(mesh, scan("0", "4", "3")).unknown, 0U);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_number_test
