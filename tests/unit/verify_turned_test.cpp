// The checker and the files of a turned profile: the written ones are the profile, changed ones are not.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/fit/turning.hpp"
#include "verify/fit/turning_check.hpp"

namespace lekalo::verify_turned_test {
namespace {

using verify::ProfilePoint;
using verify::TurningClaim;
using Fault = std::optional<std::string>;

fit::Corrected turned(fit::Surface surface) {
  fit::Corrected c;
  c.surface = surface, c.nominal = 36, c.face = surface == fit::Surface::seat ? 27 : 9;
  c.profile = {{0, 35.98}, {4.5, 35.975}, {9, 35.96}};
  return c;
}

std::vector<ProfilePoint> whole(const fit::Corrected& c) {
  std::vector<ProfilePoint> points;
  for (auto p = c.profile.rbegin(); p != c.profile.rend(); ++p) points.push_back({p->z, p->diameter});
  for (std::size_t i = 1; i < c.profile.size(); ++i)
    points.push_back({-c.profile[i].z, c.profile[i].diameter});
  return points;
}

const std::vector<ProfilePoint> kPoints = whole(turned(fit::Surface::outside));

std::string changed(std::string text, std::string_view from, std::string_view to, std::size_t which = 0) {
  std::size_t at = text.find(from);
  while (which-- > 0) at = text.find(from, at + 1);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expect_fault(const Fault& fault, std::string_view why, std::string_view of) {
  ASSERT_TRUE(fault) << of;
  EXPECT_NE(fault->find(why), std::string::npos) << *fault << " of " << of;
}

TEST(VerifyTurned, TablesAreReadToHalfOfTheirLastDecimal) {
  const auto fault = [](const std::string& text) { return verify::fault_of_profile_table(text, kPoints); };
  const std::string table = fit::profile_csv(turned(fit::Surface::outside));
  EXPECT_EQ(fault(table), std::nullopt);
  EXPECT_EQ(fault(table.substr(0, table.size() - 1)), std::nullopt) << "without the last end of line";
  EXPECT_EQ(fault(changed(table, "4.5000,", "4.50005,")), std::nullopt);
  EXPECT_EQ(fault(changed(table, "35.9800", "35.97995")), std::nullopt);
  expect_fault(fault(changed(table, "4.5000,", "4.5001,")), "its point 1 is z 4.5001, diameter 35.975", "z");
  expect_fault(fault(changed(table, "4.5000,", "4.4999,")), "its point 1 is z", "z");
  expect_fault(fault(changed(table, "35.9800", "35.9801")), "its point 2 is z", "diameter");
  expect_fault(fault(changed(table, "35.9800", "35.9799")), "its point 2 is z", "diameter");
  expect_fault(fault(changed(table, "35.9600", "35.9601")), "its point 0 is z", "the first");
  expect_fault(fault(changed(table, "35.9600", "35.9601", 1)), "its point 4 is z", "the last");
  expect_fault(fault(changed(table, "4.5000,35.9750\n", "")), "it has 4 points and is to have 5",
               "a row less");
  expect_fault(fault(changed(table, "z_mm", "z_in")), "its first line", "head");
  expect_fault(fault(""), "its first line", "nothing");
  expect_fault(fault(changed(table, "4.5000,", "4.5000;")), "line 3 is not two numbers", "no comma");
  expect_fault(fault(changed(table, "4.5000,", ",")), "line 3 is not two numbers", "no z");
  expect_fault(fault(changed(table, ",35.9750", ",")), "line 3 is not two numbers", "no diameter");
  expect_fault(fault(changed(table, ",35.9750", "")), "line 3 is not two numbers", "z alone");
  expect_fault(fault(table + "\n"), "line 7 is not two numbers", "an empty line");
}

TEST(VerifyTurned, DrawingsAreOneOpenPolyline) {
  const auto fault = [](const std::string& text) { return verify::fault_of_profile_drawing(text, kPoints); };
  const std::string drawing = fit::profile_dxf(turned(fit::Surface::outside));
  EXPECT_EQ(fault(drawing), std::nullopt);
  EXPECT_EQ(fault(changed(drawing, "20\n17.98000", "20\n17.98002")), std::nullopt) << "half of a decimal";
  expect_fault(fault(changed(drawing, "20\n17.98000", "20\n17.98010")), "its point 0 is z 9", "a radius");
  expect_fault(fault(changed(drawing, "10\n4.5000", "10\n4.5001")), "its point 1 is z", "z");
  const auto line = std::count(drawing.begin(),
                               drawing.begin() + static_cast<std::ptrdiff_t>(drawing.find("70\n0")), '\n') +
                    2;
  expect_fault(fault(changed(drawing, "70\n0", "70\n1")), fmt::format("line {} closes or bends", line),
               "a closed one");
  EXPECT_EQ(fault(changed(drawing, "70\n0", "70\n4")), std::nullopt);
  expect_fault(fault(changed(drawing, "20\n17.98000", "20\n17.98000\n42\n0.5")), "bends what", "a bulge");
  expect_fault(fault(changed(drawing, "VERTEX", "POINT")), "no coordinate of a vertex", "another entity");
  expect_fault(fault(changed(drawing, "10\n4.5000", "10\n4.5x")), "no coordinate of a vertex", "no number");
  expect_fault(fault("10\n4.5\n"), "line 2 is no coordinate", "a coordinate of nothing");
  expect_fault(fault(changed(drawing, "0\nEOF\n", "")), "not one polyline", "no end");
  expect_fault(fault(drawing + "0\n"), "not one polyline", "an odd line");
  expect_fault(fault(changed(drawing, "0\nSEQEND\n8\nPROFILE\n", "")), "not one polyline", "no end of it");
  expect_fault(fault(changed(drawing, "0\nVERTEX\n8\nPROFILE\n10\n4.5000\n20\n17.98750\n", "")),
               "not one polyline", "a vertex less");
  // A vertex of a radius alone is none of the profile.
  expect_fault(fault(changed(drawing, "10\n9.0000\n", "")), "it has 4 points", "a radius without z");
  expect_fault(fault(changed(drawing, "20\n17.98750\n", "")), "its point 1 is z", "z without a radius");
}

struct Post {
  fit::Surface surface = fit::Surface::outside;
  fit::Lathe control = fit::Lathe::linuxcnc;
  bool radius = false;
};

std::vector<Post> posts() {
  std::vector<Post> all;
  for (const fit::Surface surface : {fit::Surface::outside, fit::Surface::bore})
    for (const fit::Lathe control : {fit::Lathe::linuxcnc, fit::Lathe::fanuc})
      for (const bool radius : {false, true}) all.push_back({surface, control, radius});
  return all;
}

std::string program_of(const Post& post) {
  return fit::turning_program(turned(post.surface), {post.control, post.radius, 60, 1200});
}

TurningClaim claim_of(const Post& post, double feed = 60, double spindle = 1200) {
  TurningClaim claim;
  claim.fanuc = post.control == fit::Lathe::fanuc, claim.radius = post.radius;
  claim.surface = post.surface == fit::Surface::bore   ? verify::TurnedSurface::bore
                  : post.surface == fit::Surface::seat ? verify::TurnedSurface::seat
                                                       : verify::TurnedSurface::outside;
  claim.feed = feed, claim.spindle = spindle, claim.face = turned(post.surface).face;
  return claim;
}

Fault fault_of(const std::string& program, const Post& post, double feed = 60, double spindle = 1200) {
  return verify::fault_of_turning(program, kPoints, claim_of(post, feed, spindle));
}

TEST(VerifyTurned, ProgramsOfEachControlAreTheProfile) {
  for (const Post& post : posts()) {
    const std::string program = program_of(post);
    EXPECT_EQ(fault_of(program, post), std::nullopt) << program;
    expect_fault(fault_of(program, post, 61), "the feed is another", program);
    expect_fault(fault_of(program, post, 60, 1201), "the speed", program);
    // Each control has its words, each unit of X its own.
    expect_fault(fault_of(program, {post.surface, post.control, !post.radius}), "", program);
    expect_fault(
        fault_of(program,
                 {post.surface, post.control == fit::Lathe::fanuc ? fit::Lathe::linuxcnc : fit::Lathe::fanuc,
                  post.radius}),
        "", program);
    expect_fault(
        fault_of(program, {post.surface == fit::Surface::bore ? fit::Surface::outside : fit::Surface::bore,
                           post.control, post.radius}),
        "a rapid motion at the part", program);
  }
}

TEST(VerifyTurned, EveryWordOfAProgramCounts) {
  for (const Post& post : posts()) {
    const std::string program = program_of(post);
    const bool fanuc = post.control == fit::Lathe::fanuc;
    const auto expect = [&](std::string_view from, std::string_view to, std::string_view why,
                            std::size_t which = 0) {
      expect_fault(fault_of(changed(program, from, to, which), post), why,
                   std::string(from) + " > " + std::string(to));
    };
    for (const char* mode : {"G21 ", "G18 ", "G40 ", "G80 ", "G97 "})
      expect(mode, "", "a motion before all modes are said");
    if (fanuc)
      expect("G97 G98", "G97", "a motion before all modes are said");
    else
      for (const char* mode : {"G90 ", "G94 ", " G61"})
        expect(mode, "", "a motion before all modes are said");
    expect(" M3", "", "a motion before all modes are said");
    expect("S1200 ", "", "a motion before all modes are said");
    expect("S1200 M3\n", "S1200 M3\nM5\n", "a motion after the spindle stands");
    expect("G18", "G17", "G17 is no word of such a program");
    expect("M3\n", "M4\n", "M4 is no word");
    expect("M3\n", "M\n", "M is no word");
    expect("M3\n", "3\n", "3 is no word");
    expect("G18", "GX", "GX is no word");
    expect("M5\n", "", "M30 comes before M5");
    expect("M5\nM30\n", "M5\n", "it does not end with M5 and M30");
    expect("M30\n", "M30\nG0 X0\n", "something follows M30");
    expect(" F60.0", "", "a cut from a place, or with a feed, that was not said");
    expect("G1 Z0.0000", "G1 G0 Z0.0000", "two motions");
    expect("G1 Z0.0000", "Z0.0000", "a place without a motion, or the other way round");
    expect("G1 Z0.0000 F60.0", "G1 F60.0", "a place without a motion, or the other way round");
    expect("G1 X", "G0 X", "a rapid motion at the part");
    expect("G1 X", "G2 X", "G2 is no word");
    expect("G0 Z1.0000", "G0 Z0.9999", "a rapid motion at the part");
    expect("G1 Z0.0000", "G1 Z0.0001", "its point 0 is z");
    expect("(LEKALO FIT", "LEKALO FIT", "is no word");
    expect("(LEKALO FIT", "(A) G1 (LEKALO FIT", "is no word");
    EXPECT_EQ(fault_of(changed(program, "M5\n", "M5\nM5\n"), post), std::nullopt);
    expect("G0 Z1.0000\n", "", "a cut from a place, or with a feed, that was not said");
    if (!fanuc) expect(post.radius ? "G8" : "G7", post.radius ? "G7" : "G8", "is no word of such a program");
    if (fanuc) {
      EXPECT_EQ(fault_of(changed(program, "%\nO0001\n", ""), post), std::nullopt);
      expect("O0001", "O0002", "O0002 is no word");
      expect("G98", "G98 G7", "G7 is no word");
      expect("G98", "G98 G8", "G8 is no word");
      expect("G98", "G98 G61", "G61 is no word");
      expect("M30\n%\n", "M30\nG1\n", "something follows M30");
    } else {
      expect_fault(fault_of("%\n" + program, post), "% is no word", "a percent sign");
      expect_fault(fault_of("O0001\n" + program, post), "O0001 is no word", "a number");
      expect_fault(fault_of(program + "%\n", post), "something follows M30", "a percent sign");
    }
    EXPECT_EQ(fault_of("\n" + program, post), std::nullopt) << "an empty line";
    EXPECT_EQ(fault_of(changed(program, "G1 Z0.0000", "G1 Z-0.0000"), post), std::nullopt);
  }
}

TEST(VerifyTurned, TheToolComesFromBeforeThePartAndGoesOffBehindIt) {
  for (const Post& post : posts()) {
    const std::string program = program_of(post);
    const auto expect = [&](std::string_view from, std::string_view to, std::string_view why,
                            std::size_t which = 0) {
      expect_fault(fault_of(changed(program, from, to, which), post), why,
                   std::string(from) + " > " + std::string(to));
    };
    const auto passes = [&](std::string_view from, std::string_view to, std::size_t which = 0) {
      EXPECT_EQ(fault_of(changed(program, from, to, which), post), std::nullopt) << from << " > " << to;
    };
    passes("G0 Z1.0000", "G0 Z1.0001");
    passes("G0 Z1.0000", "G0 Z5");
    // 1 mm before the face, 1 mm behind the other.
    expect("G0 Z1.0000\n", "G0 Z1.0000\nG1 Z0.9 F60.0\n", "a cut from a place");
    passes("G1 Z-19.0000", "G1 Z-19.0001");
    expect("G1 Z-19.0000", "G1 Z-18.9999", "it does not end behind the part");
    expect("G1 Z-19.0000\n", "", "a rapid motion at the part");
    expect("G0 Z1.0000\n",
           post.surface == fit::Surface::bore ? "G0 Z1.0000\nG0 X1\nG0 Z-5\nG0 Z1.0000\n"
                                              : "G0 Z1.0000\nG0 X99\nG0 Z-5\nG0 Z1.0000\n",
           "a rapid motion at the part");
    expect("G1 Z-19.0000\n", "G1 Z-19.0000\nG1 Z-19.0000\n", "a rapid motion at the part");
    expect("G1 Z0.0000 F60.0\n", "", "");
    // Off the surface along X alone, then back along Z at a distance.
    const std::string off = post.surface == fit::Surface::bore ? (post.radius ? "X16.98000" : "X33.9600")
                                                               : (post.radius ? "X18.98000" : "X37.9600");
    const std::size_t at = program.find("G0 " + off);
    ASSERT_NE(at, std::string::npos) << program;
    const std::string back = "G0 Z1.0000\nM5";
    expect("G0 " + off + "\n", "", "a rapid motion at the part");
    expect("G0 " + off, "G0 " + off + " Z-20.0", "a rapid motion at the part");
    passes(back, "G0 Z20\nM5");
    expect(back, post.surface == fit::Surface::bore ? "G0 Z20 X1\nM5" : "G0 Z20 X99\nM5",
           "a rapid motion at the part");
    passes(back, "M5");
    const double scale = post.radius ? 0.5 : 1, sign = post.surface == fit::Surface::bore ? -1 : 1;
    const double edge = post.surface == fit::Surface::bore ? 35.96 : 35.98;
    passes("G0 " + off, "G0 X" + std::to_string(scale * (edge + sign * 0.1001)));
    expect("G0 " + off, "G0 X" + std::to_string(scale * (edge + sign * 0.0999)),
           "a rapid motion at the part");
    expect("G0 " + off, "G0 X" + std::to_string(scale * (edge - sign * 1)), "a rapid motion at the part");
    expect(back, "G0 X" + std::to_string(scale * edge) + "\nM5", "a rapid motion at the part");
    // The program cuts the profile once.
    const std::string again = changed(
        program, "M5\n",
        "G0 X0\n" + program.substr(program.find("G0 Z1.0000"), at - program.find("G0 Z1.0000")) + "M5\n");
    expect_fault(fault_of(again, post), "", "twice");
  }
}

TEST(VerifyTurned, PlacesAreThoseOfTheProfile) {
  for (const Post& post : posts()) {
    const std::string program = program_of(post);
    for (std::size_t i = 0; i < kPoints.size(); ++i)
      for (const double by : {-0.0002, 0.0002}) {
        std::vector<ProfilePoint> z = kPoints, diameter = kPoints;
        diameter[i].diameter += by;
        const TurningClaim claim = claim_of(post);
        expect_fault(verify::fault_of_turning(program, diameter, claim), "its point", program);
        z[i].z += by;
        expect_fault(verify::fault_of_turning(program, z, claim), "", program);
      }
    std::vector<ProfilePoint> less(kPoints.begin(), kPoints.end() - 1);
    expect_fault(verify::fault_of_turning(program, less, claim_of(post)), "", program);
  }
}

// Beside a seat the shaft goes on: the tool comes onto it and leaves it along X, both times cutting.
TEST(VerifyTurned, OntoASeatTheToolIsFedAlongX) {
  for (const fit::Lathe control : {fit::Lathe::linuxcnc, fit::Lathe::fanuc})
    for (const bool radius : {false, true}) {
      const Post post{fit::Surface::seat, control, radius};
      const std::string program = program_of(post);
      const double scale = radius ? 0.5 : 1;
      const auto x = [&](double diameter) {
        return fmt::format("X{:.{}f}", scale * diameter, radius ? 5 : 4);
      };
      const auto expect = [&](const std::string& from, const std::string& to, std::string_view why,
                              std::size_t which = 0) {
        expect_fault(fault_of(changed(program, from, to, which), post), why, from + " > " + to);
      };
      const auto passes = [&](const std::string& from, const std::string& to, std::size_t which = 0) {
        EXPECT_EQ(fault_of(changed(program, from, to, which), post), std::nullopt) << from << " > " << to;
      };
      EXPECT_EQ(fault_of(program, post), std::nullopt) << program;
      passes("G0 Z1.0000", "G0 Z1.5");
      // 0.1 off the greatest diameter is off the surface.
      const std::string high = "G0 " + x(37.96), off = "G1 " + x(37.96) + "\nG0 Z1.0000";
      passes(high, "G0 " + x(36.081));
      expect(high, "G0 " + x(36.079), "a rapid motion at the part");
      expect(high, "G0 " + x(34), "a rapid motion at the part");
      passes(off, "G1 " + x(36.081) + "\nG0 Z1.0000");
      expect(off, "G1 " + x(36.079) + "\nG0 Z1.0000", "a rapid motion at the part");
      expect(off, "G1 " + x(36.079), "does not come onto the seat and go off it along X");
      expect(off, "G1 " + x(37.96) + " Z-37.0000\nG0 Z1.0000",
             "does not come onto the seat and go off it along X");
      expect(off, "G0 " + x(37.96) + "\nG0 Z1.0000", "a rapid motion at the part");
      passes(off, "G1 " + x(37.96));
      expect("G0 Z-18.0000\n", "G0 Z-18.1\n", "does not come onto the seat and go off it along X");
      expect("G0 Z-18.0000\n", "G0 Z-18.0000 " + x(40) + "\n", "a rapid motion at the part");
      expect("G0 Z-18.0000\n", "", "does not come onto the seat and go off it along X");
      expect("G1 " + x(35.96), "G0 " + x(35.96), "a rapid motion at the part");
      TurningClaim other = claim_of(post);
      other.face += 0.0002;
      expect_fault(verify::fault_of_turning(program, kPoints, other), "", program);
      other.face = 9;
      expect_fault(verify::fault_of_turning(program, kPoints, other), "", program);
      other = claim_of(post);
      other.surface = verify::TurnedSurface::outside;
      expect_fault(verify::fault_of_turning(program, kPoints, other), "", program);
    }
}

}  // namespace
}  // namespace lekalo::verify_turned_test
