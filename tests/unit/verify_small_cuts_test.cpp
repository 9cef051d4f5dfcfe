// Small programs in small pockets, judged in milliseconds: all figures of their reports to the eighth digit.
// That they are right is held by the tests of simulate; these hold that none of them changes unseen.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/verify/simulate.hpp"

namespace lekalo::verify::verify_small_cuts_test {
namespace {

/// The sides of a pocket: "x y" begins a contour, "L x y" is a line and "A x y cx cy" (or "C", clockwise) an
/// arc to x, y; "!" before one makes it open.
std::string contour(const std::vector<std::string>& sides) {
  std::string text;
  std::string from = sides.front();
  for (std::size_t i = 1; i < sides.size(); ++i) {
    std::string side = sides[i];
    const bool open = side.front() == '!';
    if (open) side.erase(0, 1);
    std::vector<std::string> words;
    for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
      end = side.find(' ', at);
      words.push_back(side.substr(at, end - at));
    }
    const std::string to = words[1] + ", " + words[2];
    text += fmt::format(R"({}{{"{}": {{"from": [{}], "to": [{}])", i == 1 ? "" : ", ",
                        words[0] == "L" ? "line" : "arc", from, to);
    if (words[0] != "L")
      text += fmt::format(R"(, "centre": [{}, {}], "ccw": {})", words[3], words[4], words[0] == "A");
    text += open ? R"(}, "open": true})" : "}}";
    from = to;
  }
  return "[" + text + "]";
}
std::string pocket(const std::vector<std::string>& outer, const std::vector<std::string>& hole = {}) {
  return fmt::format(R"({{"units": "mm", "outer": {}{}}})", contour(outer),
                     hole.empty() ? "" : R"(, "holes": [)" + contour(hole) + "]");
}

/// Numbers to the eighth digit; what is less than a rounding is 0.
std::string told(const std::vector<double>& numbers) {
  std::string text;
  for (const double n : numbers)
    text += fmt::format("{}{:.8g}", text.empty() ? "" : " ", std::abs(n) < 1e-9 ? 0 : n);
  return text;
}
/// The weights make sums of a list change when two of its items do.
double weight(std::size_t i) { return 1 + static_cast<double>(i % 7); }

std::string left(const SimulateReport& r) {
  std::string text = told({r.coverage_percent, r.coverage_low_percent, r.uncut_width_mm, r.gouge_mm,
                           r.reachable_mm2, r.uncut_mm2, r.left_before_mm2});
  double x = 0, y = 0, size = 0, area = 0;
  for (std::size_t i = 0; i < r.uncut.size(); ++i) {
    const UncutSpot& s = r.uncut[i];
    x += weight(i) * s.x, y += weight(i) * s.y, size += weight(i) * s.width_mm;
  }
  text += "; " + told({static_cast<double>(r.uncut.size()), x, y, size});
  x = y = size = 0;
  for (std::size_t i = 0; i < r.unreachable.size(); ++i) {
    const UnreachableSpot& s = r.unreachable[i];
    x += weight(i) * s.x, y += weight(i) * s.y, size += weight(i) * s.distance_mm,
        area += weight(i) * s.area_mm2;
  }
  return text + "; " + told({static_cast<double>(r.unreachable.size()), x, y, size, area});
}
std::string cut(const SimulateReport& r) {
  double x = 0, z = 0, engaged = 0, left = 0, entries = 0;
  for (std::size_t i = 0; i < r.samples.size(); ++i) {
    const EngagementSample& s = r.samples[i];
    x += weight(i) * s.x + s.y, z += weight(i) * s.z + s.length, engaged += weight(i) * s.engagement;
    left += weight(i) * s.left, entries += s.entry ? weight(i) : 0;
  }
  return told({r.engagement_max_deg, r.engagement_peak_deg, r.engagement_p95_deg, r.air_percent, r.entry_mm,
               r.entry_layer_mm, r.rapid_cut_mm, r.length_mm, r.turning_rad, static_cast<double>(r.retracts),
               r.seconds, r.lower_bound_seconds}) +
         "; " + told({static_cast<double>(r.samples.size()), x, z, engaged, left, entries});
}

struct Case {
  const char* name;
  std::string pocket, program;
  std::vector<std::pair<std::string, double>> earlier = {};
  std::string left, cut;
  double tool = 0.5, stock = 0, spacing = 0.05;
};

void judge(const std::vector<Case>& cases) {
  for (const Case& one : cases) {
    SimulateOptions options;
    options.tool_diameter = one.tool, options.stock_to_leave = one.stock, options.spacing = one.spacing;
    std::vector<EarlierProgram> earlier;
    for (const auto& [program, tool] : one.earlier) earlier.push_back({{"earlier", program}, tool});
    const auto report = simulate({"p", one.program}, {"pocket.json", one.pocket}, options, earlier);
    ASSERT_TRUE(report) << one.name << report.error().message;
    EXPECT_EQ(left(*report), one.left) << one.name;
    EXPECT_EQ(cut(*report), one.cut) << one.name;
  }
}

const std::string kBox = pocket({"0, 0", "L 1.6 0", "L 1.6 1", "L 0 1", "L 0 0"}),
                  kOpenBox = pocket({"0, 0", "L 1.6 0", "!L 1.6 1", "L 0 1", "L 0 0"}),
                  kRing = pocket({"0, 0", "L 2 0", "L 2 1.5", "L 0 1.5", "L 0 0"},
                                 {"0.8, 0.6", "L 1.1 0.6", "L 1.1 0.9", "L 0.8 0.9", "L 0.8 0.6"}),
                  kDisc = pocket({"1, 0", "A -1 0 0 0", "A 1 0 0 0"}),
                  kOpenDisc = pocket({"1, 0", "!A 0 1 0 0", "A 1 0 0 0"}),
                  // A room, and a neck that the tool does not get through; on the right a part too narrow.
    kNeck = pocket({"0, 0", "L 1 0", "L 1 0.3", "L 1.3 0.3", "L 1.3 0", "L 1.9 0", "L 1.9 0.2", "L 2.4 0.2",
                    "L 2.4 0.5", "L 1.9 0.5", "L 1.9 0.8", "L 1.3 0.8", "L 1.3 0.6", "L 1 0.6", "L 1 0.8",
                    "L 0 0.8", "L 0 0"}),
                  // A corner of the pocket that the tool goes round, whose one side is open.
    kThorn = pocket(
        {"0, 0", "L 1.6 0", "L 1.6 0.6", "A 1.3 0.9 1.3 0.6", "L 0.9 0.9", "!L 0.9 1.6", "L 0 1.6", "L 0 0"}),
                  kOpenIsland = pocket({"-1, -1", "L 1 -1", "L 1 1", "L -1 1", "L -1 -1"},
                                       {"0.3, 0", "!C -0.3 0 0 0", "!C 0.3 0 0 0"});
const std::string kDown = "G0 X0.3 Y0.3 Z1\nG1 Z-0.1 F300\n";

TEST(VerifySmallCuts, WhatIsLeftAndCutBetweenWalls) {
  judge({
      {.name = "slot",
       .pocket = kBox,
       .program = kDown + "G1 X1.2 F600\nG0 Z1\n",
       .left = "41.799004 40.736861 0.94742861 0 1.5463446 0.89998797 1.5463446; 20 54.234375 41.511719 "
               "31.425578; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.1 0 0 0.9 0 0 0.4113553 0.225; 24 77.25 -8.1 16200 8100 0"},
      {.name = "round",
       .pocket = kBox,
       .program = kDown + "G1 X1.3 F600\nY0.7\nX0.3\nY0.3\nG0 Z1\n",
       .left = "83.833619 82.417819 0.14128035 0 1.5463446 0.24998797 1.5463446; 14 37.703125 25.433594 "
               "5.4261863; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 1.7857143 0.1 0 0 2.8 4.712389 0 0.62690581 0.55252914; 66 242.3 -23 35391.514 "
              "14456.055 0"},
      {.name = "strips",
       .pocket = kRing,
       .program = "G0 X0.25 Y0.25 Z1\nG1 Z-0.1 F300\nX1.75 F600\nY1.25\nX0.25\n"
                  "Y0.77\nX0.55\nY0.25\nG0 Z1\nG0 X1.35\nG1 Z-0.1 F300\nG1 Y1.2 F900\nG0 Z1\n",
       .left = "96.409484 95.118387 0.21849783 0 2.8563264 0.10255686 2.8563264; 3 4.40625 4.4140625 "
               "1.1700048; 4 11.979167 10.458333 0.88822 0.13888889",
       .cut = "180 180 180 8.2373333 0.1 0 0 6.25 10.995574 1 1.3441515 0.85458336; 155 761.23833 -55.45 "
              "86962.457 43780.582 0"},
      {.name = "leaf",
       .pocket = kBox,
       .program = "G0 X0.3 Y0.3 Z1\nG1 Z-0.1 F300\nG1 X1.2 F600\nG0 Z1\n",
       .left = "43.185831 41.730652 0.93326791 0 1.5437276 0.877056 1.5437276; 19 59.962 41.43 31.491591; 4 "
               "9.5786667 6.976 0.92277228 0.14563556",
       .cut = "180 180 180 0 0.1 0 0 0.9 0 0 0.4113553 0.225; 24 77.25 -8.1 16200 8100 0",
       .tool = 0.512},
      {.name = "stock",
       .pocket = kBox,
       .program = kDown + "G1 X1.2 F600\nG0 Z1\n",
       .left = "54.605737 53.405614 0.65090658 0.075 0.95932366 0.4354779 0.95932366; 11 29.880859 24.982422 "
               "11.379924; 1 1.59375 0.98958333 0.26855335 0.64496528",
       .cut = "180 180 180 0 0.1 0 0 0.9 0 0 0.4113553 0.225; 24 77.25 -8.1 16200 8100 0",
       .stock = 0.125},
      {.name = "neck",
       .pocket = kNeck,
       .program = kDown + "G1 X0.6 Y0.5 F600\nG0 Z1\n",
       .left = "21.527928 20.28147 2.3545082 0 1.2535315 0.98367212 1.2535315; 28 112.42344 49.535938 "
               "99.356144; 10 41.733333 16.383333 4.4839934 1.2488889",
       .cut = "180 180 180 0 0.1 0 0 0.36055513 0 0 0.35741081 0.090138782; 8 17.55 -2.5394449 5220 2610 0",
       .tool = 0.4},
      {.name = "gouge",
       .pocket = kBox,
       .program = kDown + "G1 X1.2 Y0.1 F600\nX1.7 Y0.5\nG0 Z1\nG0 Y2\nG1 Z-0.1\nG0 Z1\n",
       .left = "46.873831 46.22288 1.1602122 1.2549876 1.5464468 0.82156792 1.5464468; 15 34.271484 "
               "36.845703 25.566035; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.2 0 0 1.5622669 0.89340989 1 0.78781061 0.3900756; 42 195.06111 -15.237733 "
              "30064.426 14944.426 0"},
      {.name = "one hole",
       .pocket = kBox,
       .program = kDown + "G0 Z1\n",
       .left = "0 0 1.8867962 0 1.5463446 1.5463446 1.5463446; 17 52.628906 31.480469 116.98137; 4 9.6041667 "
               "6.9583333 0.90597385 0.14149306",
       .cut = "0 0 0 0 0.1 0 0 0 0 0 0.32380832 0; 0 0 0 0 0 0"},
  });
}

TEST(VerifySmallCuts, LevelsRampsAndHelices) {
  judge({
      {.name = "levels",
       .pocket = kBox,
       .program = kDown + "G1 X1.2 F600\nY0.5\nG1 Z-0.2 F200\nX0.3 Y0.3 F500\nX0.7\nG0 Z1\n",
       .left = "44.496053 43.502764 0.8993872 0 1.5463446 0.8582823 1.5463446; 18 48.341797 36.337891 "
               "23.104244; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.2 0 0 2.4219544 6.2831853 0 0.65235878 0.51731949; 62 207.575 -35.278046 "
              "38027.554 17666.069 0"},
      {.name = "ramp",
       .pocket = kBox,
       .program = "G0 X0.3 Y0.3 Z1\nG1 Z0 F300\nG1 X1.2 Z-0.06 F600\nX0.3 Z-0.12\nX1.2\nY0.6\nX0.4\nG0 Z1\n",
       .left = "66.270549 65.122787 0.42397993 0 1.5463446 0.52157354 1.5463446; 15 42.945312 24.304688 "
               "11.906369; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "152.18186 180 180 0 2.7 0.12 0 3.8 9.424778 0 0.73531197 0.41680194; 100 352.3375 -32.8025 "
              "63906.659 28356.659 283"},
      {.name = "helix",
       .pocket = kDisc,
       .program =
           "G0 X0.3 Y0 Z1\nG1 Z0 F300\nG3 X0.3 Y0 Z-0.1 I-0.3 J0 P2 F400\nG3 X0.3 Y0 I-0.3 J0\nG1 X0.6 F800\n"
           "G3 X0.6 Y0 I-0.6 J0\nG2 X0.3 Y0 I-0.15 J0\nG0 Z1\n",
       .left = "72.000906 70.987956 0.29990878 0 3.1415849 0.8796153 3.1415849; 21 5.7832031 -2.0957031 "
               "18.616917; 0 0 0 0 0",
       .cut = "152.10584 180 132.84364 5.3893129 5.6158241 0.052083333 0 10.196017 34.557519 0 1.5586157 "
              "0.77162587; 259 33.097105 -74.803983 140183 56553.254 566"},
      {.name = "plunges",
       .pocket = kBox,
       .program =
           kDown +
           "G1 X0.9 F600\nG0 Z1\nG0 X0.8\nG0 Z-0.1\nG1 Y0.6 F300\nG0 Z1\nG0 X1 Y0.4\nG0 Z-0.15\nG1 X1.1\n"
           "G0 Z0.5\nG0 X1.2\nZ-0.05\nG0 X1.3\nG1 Z-0.15 F90\nX1.2 F700\nG0 Z1\n",
       .left = "22.37731 21.708083 1.6550249 0 1.5463446 1.2003143 1.5463446; 22 67.308594 43.914062 "
               "58.263606; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.4 0 0.3 1.2 6.2831853 3 1.0827014 0.22982048; 31 110.40667 -10.45 19538.534 "
              "9670.2938 0"},
  });
}

TEST(VerifySmallCuts, BeyondOpenEdges) {
  judge({
      {.name = "out",
       .pocket = kOpenBox,
       .program = kDown + "G1 X1.9 F600\nY0.6\nX0.9\nG0 Z1\n",
       .left = "64.832485 63.924938 0.90469438 0 1.5747297 0.55379331 1.5747297; 16 46.326172 31.134766 "
               "14.571624; 2 0.03125 1.9895833 0.266466 0.041666667",
       .cut = "180 180 180 23.099027 0.1 0 0 2.9 3.1415927 0 0.62838897 0.40867404; 70 392.03462 -25.1 "
              "27950.021 10564.02 0"},
      {.name = "in",
       .pocket = kOpenBox,
       .program = "G0 X2.2 Y0.5 Z1\nG0 Z-0.1\nG1 X1 F600\nG0 Z1\n",
       .left = "25.334409 24.77434 1.5808057 0 1.5747297 1.1757813 1.5747297; 20 57.380859 37.240234 "
               "53.472219; 2 0.03125 1.9895833 0.266466 0.041666667",
       .cut = "180 180 180 26.666667 0 0 0 1.2 0 0 0.30326271 0.20460178; 30 195 -10.3 13908.22 6954.11 0"},
      {.name = "half in",
       .pocket = kOpenBox,
       .program = "G0 X1.7 Y0.5 Z1\nG0 Z-0.1\nG1 X1 F600\nG0 Z1\n",
       .left = "25.334409 24.77434 1.5808057 0 1.5747297 1.1757813 1.5747297; 20 57.380859 37.240234 "
               "53.472219; 2 0.03125 1.9895833 0.266466 0.041666667",
       .cut =
           "180 180 180 0 0.1 0 0.1 0.7 0 0 0.25326271 0.17466657; 18 96.077778 -5.9 11831.303 5915.6516 0"},
      {.name = "arc",
       .pocket = kOpenDisc,
       .program = "G0 X0 Y0 Z1\nG1 Z-0.1 F300\nG1 X1 Y1 F600\nG0 Z1\n",
       .left = "18.866022 17.85811 1.4999398 0 3.1428593 2.5499267 3.1428593; 55 47.351562 67.011719 198.36; "
               "0 0 0 0 0",
       .cut = "180 180 180 33.333333 0.1 0 0 1.4142136 0 0 0.46277665 0.19428666; 36 93.388889 -12.685786 "
              "14124.707 7062.3533 0"},
      {.name = "thorn",
       .pocket = kThorn,
       .program = kDown + "G1 X0.6 Y0.6 F600\nX1.1 Y1.2\nG0 Z1\n",
       .left = "29.317484 28.584701 1.6000276 0 2.0090708 1.4200618 2.0090708; 28 83.1875 97.265625 "
               "75.670198; 3 3.2291667 4.8125 0.54772688 0.085503472",
       .cut = "180 180 180 3.0857051 0.1 0 0 1.205289 0.090659887 0 0.4418842 0.19221576; 33 117.05 "
              "-11.494711 15900.509 8609.3888 0"},
      {.name = "island",
       .pocket = kOpenIsland,
       .program = "G0 X0.6 Y0 Z1\nG1 Z-0.1 F300\nG1 X-0.1 F600\nY-0.7\nG0 Z1\n",
       .left = "16.696176 16.295605 1.9840436 0 3.6633755 3.0517318 3.6633755; 51 6.7402344 6.5527344 "
               "169.01139; 4 1.9791667 3.9583333 0.88822 0.13888889",
       .cut = "180 180 180 16.666667 0.1 0 0 1.4 1.5707963 0 0.46987213 0.21201453; 36 0.32777778 -12.7 "
              "15749.073 7279.2218 0"},
  });
}

TEST(VerifySmallCuts, AfterOtherTools) {
  const std::string slot = "G0 X0.4 Y0.4 Z1\nG1 Z-0.1 F300\nG1 X1.2 F600\nG0 Z1\n";
  judge({
      {.name = "wider",
       .pocket = kBox,
       .program = kDown + "G1 Y0.7 F600\nX1.3\nG0 Z1\n",
       .earlier = {{slot, 0.7}},
       .left = "82.737058 81.35902 0.23800186 0 1.5463446 0.26694457 0.60149813; 14 37.359375 29.402344 "
               "5.8285857; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "126.8699 168.46304 156.42182 3.5714286 0.1 0 0 1.4 1.5707963 0 0.46987213 0.16773324; 33 "
              "108.75833 -11.3 11279.793 10091.803 0"},
      {.name = "shallow and narrow",
       .pocket = kBox,
       .program = kDown + "G1 X1.3 F600\nY0.6\nG0 Z1\n",
       .earlier = {{slot, 0.2}, {"G0 X0.4 Y0.4 Z1\nG1 Z-0.05 F300\nG1 X1.2 Z-0.08 F600\nG0 Z1\n", 0.6}},
       .left = "53.864915 52.663891 0.90469438 0 1.5463446 0.71340741 1.3549231; 18 55.886719 34.710938 "
               "18.847099; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.1 0 0 1.3 1.5707963 0 0.45987213 0.2471384; 31 121.73333 -10.5 17092.033 "
              "6472.0328 0"},
  });
}

/// A line that ran twice with two feeds had that of its first run, and the bound was ten times too high.
TEST(VerifySmallCuts, EachRunOfALineHasItsOwnFeed) {
  SimulateOptions options;
  options.tool_diameter = 0.5;
  const std::string twice = kDown + "#101=0.5\n#102=60\nO<a> call\n#101=1.2\n#102=600\nO<a> call\nM2\n";
  const std::string program = twice + "O<a> sub\nG1 X#101 F#102\nO<a> endsub\n";
  const auto report = simulate({"p", program}, {"pocket.json", kBox}, options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NEAR(report->lower_bound_seconds, 0.9 * 0.5 / (0.4 * 0.5 * 10), 1e-6);
}

}  // namespace
}  // namespace lekalo::verify::verify_small_cuts_test
