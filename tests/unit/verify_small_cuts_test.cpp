// Small programs in small pockets, judged in milliseconds: all figures of their reports to the eighth digit.
// That they are right is held by the tests of simulate; these hold that none of them changes unseen.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lekalo/verify/simulate.hpp"
#include "verify/pocket/cut_path.hpp"

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

TEST(VerifySmallCuts, AtTheBounds) {
  const std::string cut = "G0 X0.3 Y0.3 Z1\nG1 Z-1 F300\nG1 X1.2 F600\nG0 Z1\n";
  const std::string ramp = "G0 X0.3 Y0.3 Z1\nG1 Z0 F300\nG1 X0.6 Z-0.05 F600\n",
                    rest = "X0.9 Z-0.1\nX0.3\nG0 Z1\n";
  judge({
      {.name = "as deep",
       .pocket = kBox,
       .program = cut + "G0 X0.3 Y0.6\nG1 Z-0.999999 F300\nG1 X1.2 Y0.5 F600\nG0 Z1\n",
       .left = "64.125089 62.988414 0.5819592 0 1.5463446 0.55474976 1.5463446; 16 51.556641 25.244141 "
               "12.948484; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 1.999999 0 0 1.8055385 0.11065722 1 1.311584 0.33231642; 48 166.1875 -187.19436 "
              "24882.856 16583.435 0"},
      {.name = "less deep",
       .pocket = kBox,
       .program = cut + "G0 X0.3 Y0.6\nG1 Z-0.9999985 F300\nG1 X1.2 Y0.5 F600\nG0 Z1\n",
       .left = "41.799004 40.736861 0.94742861 0 1.5463446 0.89998797 1.5463446; 20 54.234375 41.511719 "
               "31.425578; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 1.9999985 0 0 1.8055385 0.11065722 1 1.3115839 0.33231642; 48 166.1875 "
              "-187.19431 24882.856 16583.435 0"},
      {.name = "beside what is as deep",
       .pocket = kBox,
       .program = cut,
       .earlier = {{"G0 X0.3 Y0.5 Z1\nG1 Z-0.999999 F300\nG1 X1.2 Y0.45 F600\nG0 Z1\n", 0.5}},
       .left = "57.54084 56.42544 0.66922965 0 1.5463446 0.65656494 0.89929111; 18 58.736328 31.470703 "
               "16.721843; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "72.274316 107.4576 93.976765 0 1 0 0 0.9 0 0 0.62390593 0.080974343; 24 77.25 -89.1 6522.9872 "
              "60.32634 0"},
      {.name = "beside what is less deep",
       .pocket = kBox,
       .program = cut,
       .earlier = {{"G0 X0.3 Y0.5 Z1\nG1 Z-0.9999985 F300\nG1 X1.2 Y0.45 F600\nG0 Z1\n", 0.5}},
       .left = "41.799004 40.736861 0.94742861 0 1.5463446 0.89998797 1.5463446; 20 54.234375 41.511719 "
               "31.425578; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 1 0 0 0.9 0 0 0.62390593 0.225; 24 77.25 -89.1 16200 8100 0"},
      {.name = "leaf beside air",
       .pocket = kOpenBox,
       .program = kDown + "G1 X1.7 F600\nG0 Z1\n",
       .left = "48.893282 47.274821 0.93147955 0 1.5718638 0.803328 1.5718638; 24 88.95 55.71 44.758648; 2 "
               "0.032 1.9946667 0.27664261 0.043690667",
       .cut =
           "180 180 180 9.0909091 0.1 0 0 1.4 0 0 0.4613553 0.2689083; 33 141.8 -11.3 18122.331 9061.1656 0",
       .tool = 0.512},
      {.name = "wide",
       .pocket = kBox,
       .program = kDown + "G1 X1.2 F600\nG0 Z1\n",
       .earlier = {{"G0 X0.4 Y-1.3 Z1\nG1 Z-0.1 F300\nG1 X1.2 F600\nG0 Z1\n", 3}},
       .left = "48.316441 47.685026 0.94742861 0 1.5466175 0.79934697 1.2661154; 16 45.162109 40.435547 "
               "29.177253; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "113.721 117.75068 116.5136 0 0.1 0 0 0.9 0 0 0.4113553 0.15829878; 24 77.25 -8.1 10253.839 "
              "8100 0"},
      {.name = "through the wall",
       .pocket = kBox,
       .program = kDown + "G1 X1.2 F600\nX1.7 Y0.5\nG0 Z1\n",
       .left = "49.361811 48.33915 0.90469438 0.35006018 1.5463521 0.7830447 1.5463521; 17 46.007812 "
               "35.957031 25.825923; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.1 0 0 1.4385165 0.38050638 0 0.46520694 0.35962295; 39 170.41667 -13.561484 "
              "26987.982 13487.982 0"},
      {.name = "twice down",
       .pocket = kBox,
       .program = kDown + "G1 X0.302 F600\nG0 Z1\nG0 X0.3\nG0 Z-0.1\nG0 Z1\n",
       .left = "12.762907 12.160144 1.8867962 0 1.5463446 1.3489861 1.5463446; 15 44.558594 31.128906 "
               "43.347492; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "0 180 180 0 0.1 0 0 0.002 0 1 0.48870994 0.0005; 1 0.602 -0.098 180 90 0"},
      {.name = "a hole a little narrower",
       .pocket = kBox,
       .program = "G0 X0.3001 Y0.3 Z1\nG0 Z-0.1\nG0 Z1\n",
       .earlier = {{"G0 X0.3 Y0.3 Z1\nG1 Z-0.1 F300\nG1 X0.3002\nG0 Z1\n", 0.465}},
       .left = "10.988481 10.427384 1.8867962 0 1.5463446 1.3764248 1.3764248; 15 45.013672 31.736328 "
               "44.697795; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "0 0 0 0 0 0 0 0 0 0 0.18761663 0; 0 0 0 0 0 0"},
      {.name = "another's ramp",
       .pocket = kBox,
       .program = "G0 X1 Y0.3 Z1\nG1 Z-0.1 F300\nX0.3 F600\nG0 Z1\n",
       .earlier = {{"G0 X0.3 Y0.3 Z1\nG1 Z0 F300\nX1 Z-0.1 F600\nG0 Z1\n", 0.5}},
       .left = "35.332044 34.381107 1.1389299 0 1.5463446 0.99998945 1.5463446; 20 65.40625 38.519531 "
               "36.204613; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.016666667 0 0 0.7 0 0 0.3913553 0.175; 18 46.277778 -5.9 11880 5940 0"},
      {.name = "gouged corner",
       .pocket = kBox,
       .program = "G0 X0.2 Y0.2 Z1\nG1 Z-0.1 F300\nG1 X1.2 F600\nG0 Z1\n",
       .left = "40.446276 39.402832 1.1249999 0.056 1.5441778 0.91961537 1.5441778; 16 49.552 40.068 "
               "36.995491; 4 9.5786667 6.976 0.92277228 0.14563556",
       .cut = "180 180 180 0 0.1 0 0 1 0 0 0.4213553 0.25; 24 70.633333 -8 16200 8100 0",
       .tool = 0.512},
      {.name = "shallow ramp",
       .pocket = kBox,
       .program = "G0 X0.3 Y0.3 Z1\nG1 Z0 F300\nX1.2 Z-0.01 F600\nG0 Z1\n",
       .left = "0 0 1.8867962 0 1.5463446 1.5463446 1.5463446; 17 52.628906 31.480469 116.98137; 4 9.6041667 "
               "6.9583333 0.90597385 0.14149306",
       .cut = "0 0 0 0 0.9 0.01 0 0.9 0 0 0.3874988 0; 24 77.25 0.42166667 16200 8100 90"},
      {.name = "far and back",
       .pocket = pocket({"0, 0", "L 3 0", "L 3 0.75", "L 0 0.75", "L 0 0"}),
       .program =
           kDown + "G1 X0.5 F600\nG0 Z1\nG0 X2.6\nG1 Z-0.1\nX2.5\nG0 Z1\nG0 X0.3\nG1 Z-0.1\nX0.5\nG0 Z1\n",
       .left = "24.709651 24.024747 1.6903432 0 2.1963344 1.6536279 2.1963344; 29 173.91211 41.673828 "
               "75.459096; 4 17.979167 5.2083333 0.88822 0.13888889",
       .cut = "180 180 180 40 0.2 0 0 0.5 6.2831853 2 1.0223459 0.075; 13 54.716667 -4.4 5220 2610 0"},
      {.name = "back over one stroke of a ramp",
       .pocket = kBox,
       .program = "G0 X0.5 Y0.3 Z1\nG1 Z0 F300\nX0.6 Z-0.1 F600\nZ-0.05\nX0.3\nG0 Z1\n",
       .left = "0 0 1.8867962 0 1.5463446 1.5463446 1.5463446; 17 52.628906 31.480469 116.98137; 4 9.6041667 "
               "6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.1 0.1 0 0.4 3.1415927 0 0.36441365 0.075; 9 16.25 -1.25 5580 2790 3"},
      {.name = "a ramp of a hair",
       .pocket = kBox,
       .program = "G0 X0.3 Y0.3 Z1\nG1 Z0 F300\nX0.9 Z-0.0009 F600\nG0 Z1\n",
       .left = "0 0 1.8867962 0 1.5463446 1.5463446 1.5463446; 17 52.628906 31.480469 116.98137; 4 9.6041667 "
               "6.9583333 0.90597385 0.14149306",
       .cut = "0 0 0 0 0.6 0 0 0.6 0 0 0.35705947 0; 15 41.24 0.57054 10260 5130 57"},
      {.name = "back higher",
       .pocket = kBox,
       .program = "G0 X0.3 Y0.3 Z1\nG1 Z0 F300\nX1.1 Z-0.1 F600\nZ-0.0437\nX0.3\nX0.5 Y0.5\nG0 Z1\n",
       .left = "0 0 1.8867962 0 1.5463446 1.5463446 1.5463446; 17 52.628906 31.480469 116.98137; 4 9.6041667 "
               "6.9583333 0.90597385 0.14149306",
       .cut = "87.833428 123.46304 123.46304 18.209548 1.2571429 0.1 0 1.8828427 5.4977871 0 0.52149201 "
              "0.15624853; 48 142.03333 -7.5056573 26952.133 14200.593 137"},
      {.name = "short lines",
       .pocket = kBox,
       .program = ramp + "X0.602\nX0.608\n" + rest,
       .left = "32.099001 31.197803 1.2723536 0 1.5463446 1.0499834 1.5463446; 19 53.582031 41.351562 "
               "39.540599; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "0 180 180 0 1.192 0.1 0 1.2 3.1415927 0 0.43862227 0.152; 30 79.011333 -7.7944444 20700 10350 "
              "112"},
      {.name = "longer lines",
       .pocket = kBox,
       .program = ramp + "X0.612\nX0.624\n" + rest,
       .left = "32.099001 31.197803 1.2723536 0 1.5463446 1.0499834 1.5463446; 19 53.582031 41.351562 "
               "39.540599; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.816 0.1 0 1.2 3.1415927 0 0.43856896 0.156; 30 79.226667 -7.7944444 20700 "
              "10350 81"},
      {.name = "short lines of another entry",
       .pocket = kBox,
       .program = ramp + "X0.602\nG0 Z1\nG1 Z-0.05 F300\nX0.608 F600\n" + rest,
       .left = "32.099001 31.197803 1.2723536 0 1.5463446 1.0499834 1.5463446; 19 53.582031 41.351562 "
               "39.540599; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 0 0.872 0.1 0 1.2 3.1415927 1 0.74783278 0.152; 30 79.011333 -7.7944444 20700 "
              "10350 82"},
      {.name = "at the end",
       .pocket = kBox,
       .program = ramp + "X0.602\nX0.608",
       .left = "12.956768 12.364404 1.7344048 0 1.5463446 1.3459883 1.5463446; 23 64.074219 47.414062 "
               "70.317938; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "0 180 180 0 0.3 0.05 0 0.308 0 0 0.24999412 0.002; 9 18.834667 -0.82811111 5580 2790 28"},
      {.name = "there and back",
       .pocket = kBox,
       .program = kDown + "G1 X0.75 F600\nX0.3\nG0 X0.5\nG0 Z1\n",
       .left = "27.248465 26.423833 1.499435 0 1.5463446 1.1249894 1.5463446; 21 64.166016 43.572266 "
               "48.975688; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 59.090909 0.1 0 0 1.1 6.2831853 0 0.47133761 0.1125; 10 21.2 -2.3 1800 900 0",
       .spacing = 10},
      {.name = "lasting",
       .pocket = kBox,
       .program = kDown + "G1 X0.5 F600\nX0.3\nG0 Z1\n",
       .left = "19.164885 18.46656 1.8867962 0 1.5463446 1.2499894 1.5463446; 24 77.408203 47.587891 "
               "66.867121; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "180 180 180 50 0.1 0 0 0.4 3.1415927 0 0.3813553 0.05; 10 17 -3 2700 1350 0"},
      {.name = "not lasting",
       .pocket = kBox,
       .program = kDown + "G1 X0.4 F600\nG0 Z1\n",
       .left = "15.931841 15.283255 1.8867962 0 1.5463446 1.2999834 1.5463446; 15 45.302734 31.966797 "
               "41.896918; 4 9.6041667 6.9583333 0.90597385 0.14149306",
       .cut = "0 180 180 0 0.1 0 0 0.1 0 0 0.33045516 0.025; 3 3.1666667 -0.5 1080 540 0"},
      {.name = "twentieth",
       .pocket = pocket({"0, 0", "L 3 0", "L 3 0.75", "L 0 0.75", "L 0 0"}),
       .program = "G0 X0.25 Y0.25 Z1\nG1 Z-0.125 F300\nG1 X2.75 F600\nG0 Z1\n",
       .earlier = {{"G0 X0 Y0.375 Z1\nG1 Z-0.125 F300\nG1 X2.5 F600\nG0 Z1\n", 0.5}},
       .left = "81.503697 80.297658 0.483882 0 2.1963848 0.40625 0.85087978; 11 55.296875 27.28125 "
               "9.1259596; 4 17.979167 5.2083333 0.88822 0.13888889",
       .cut = "155.70481 180 155.70481 0 0.125 0 0 2.5 0 0 0.57740961 0.21484375; 20 131.875 -7.125 "
              "6013.5485 926.4341 0",
       .spacing = 0.125},
  });
}

TEST(VerifySmallCuts, UnderAPlungingToolMaterialIsFoundOnEverySide) {
  const auto hole = [](double x, double y, const char* down) {
    return fmt::format("G0 X{} Y{} Z1\n{} Z-0.1\nG1 X{}\nG0 Z1\n", 0.8 + x, 0.5 + y, down, 0.802 + x);
  };
  for (const int left_out : {0, 1, 2, 3, 4}) {
    // Three holes about the place leave a speck on the fourth side.
    std::string program = "G21 G90 G17 F300\n";
    for (const int side : {0, 1, 2, 3})
      if (side != left_out)
        program += hole((side & 1) != 0 ? 0.11 : -0.11, (side & 2) != 0 ? 0.11 : -0.11, "G1");
    program += hole(0, 0, "G0");
    SimulateOptions options;
    options.tool_diameter = 0.5;
    const auto report = simulate({"p", program}, {"pocket.json", kBox}, options);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_NEAR(report->rapid_cut_mm, left_out == 4 ? 0 : 0.1, 1e-12) << left_out;
  }
}

TEST(VerifySmallCuts, UnderAPlungingToolAPostIsFoundInEveryQuarter) {
  for (const int side : {0, 1, 2, 3}) {
    const double x = 0.8 + ((side & 1) != 0 ? 0.06 : -0.06), y = 0.5 + ((side & 2) != 0 ? 0.06 : -0.06);
    const std::string program = fmt::format(
        "G21 G90 G17\nG0 X{} Y{} Z1\nG1 Z-0.1 F300\nG3 I-0.28 J0\nG0 Z1\nG0 X0.8 Y0.5\nG0 Z-0.1\n", x + 0.28,
        y);
    SimulateOptions options;
    options.tool_diameter = 0.5;
    const auto report = simulate({"p", program}, {"pocket.json", kBox}, options);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_NEAR(report->rapid_cut_mm, 0.1, 1e-12) << side;
  }
}

TEST(VerifySmallCuts, AThousandSpotsAreTold) {
  SimulateOptions options;
  options.tool_diameter = 0.06;
  const std::string slot = "G21 G90 G17\nG0 X0.7 Y0.5 Z1\nG1 Z-0.1 F300\nX0.9\n";
  const auto report = simulate({"p", slot}, {"pocket.json", kBox}, options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->uncut.size(), 1000U);
}

TEST(VerifySmallCuts, SomeLinesAloneGiveTheSameSamples) {
  SimulateOptions options;
  options.tool_diameter = 0.5, options.threads = 1;
  const std::string
      text = "G21 G90 G17\nG0 X0.3 Y0.3 Z1\nG1 Z0 F600\nG1 X0.6 Z-0.1\nY0.6\nX1.1\nY0.3\nX0.6\nG0 Z1\n",
      before = "G0 X0.4 Y0.4 Z1\nG1 Z-0.1 F300\nX0.45\nX0.5\nX0.9\nX1.2\nG0 Z1\n";
  const Document program{"p", text}, box{"pocket.json", kBox};
  const std::vector<EarlierProgram> earlier{{{"earlier", before}, 0.2}};
  std::vector<Progress> told;
  const auto whole = simulate(program, box, options, earlier, [&](const Progress& p) { told.push_back(p); });
  ASSERT_TRUE(whole) << whole.error().message;
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].fraction, 0);
  for (const std::vector<LineRange>& lines :
       {std::vector<LineRange>{{4, 4}}, {{5, 6}, {8, 30}}, {{1, 3}}, {}}) {
    const auto some = engagement_on(program, box, options, earlier, lines);
    ASSERT_TRUE(some) << some.error().message;
    std::size_t k = 0;
    for (const EngagementSample& sample : whole->samples)
      for (const LineRange& range : lines)
        if (sample.line >= range.first && sample.line <= range.last) {
          ASSERT_LT(k, some->size());
          EXPECT_EQ((*some)[k].x, sample.x);
          EXPECT_EQ((*some)[k].line, sample.line);
          EXPECT_EQ((*some)[k].feed, 600);
          EXPECT_NEAR((*some)[k++].engagement, sample.engagement, 1e-9);
        }
    EXPECT_EQ(k, some->size());
  }
  const auto stretches = cut_stretches({"p", "G21 G90 G17\nG0 X0 Y0 Z1\nG1 Z-1 F9\nX5 Z-3\nX900 Z-2\n"}, 0);
  ASSERT_TRUE(stretches) << stretches.error().message;
  ASSERT_EQ(stretches->size(), 3U);
  EXPECT_EQ((*stretches)[0].high_z, 0);
  EXPECT_EQ((*stretches)[1].high_z, -1);
  EXPECT_EQ((*stretches)[2].high_z, -2);
}

/// Half a million samples, and 64 more for each line that cuts.
TEST(VerifySmallCuts, AFarWayHasAsManySamplesAsItMayHave) {
  // One line more would make a sample more of the first way, and one less a sample less of the second.
  for (const double way : {100014.0, 100000.0}) {
    CutPath path;
    for (const auto& [from, to, number] :
         {std::tuple{0.0, 5e6, 1}, {5e6, 1e7, 1}, {1e7, 1e7 + way, 2}, {1e7 + way, 1e7 + 2 * way, 2}}) {
      Cut one;
      one.stroke.from = {from, 0}, one.stroke.to = {to, 0};
      one.from_z = one.to_z = -1, one.radius = 1, one.line = static_cast<std::size_t>(number);
      path.cuts.push_back(one);
    }
    SimulateOptions options;
    options.tool_diameter = 2;
    SimulateReport report;
    measure_engagement_on(path, Air(), options, {{2, 2}}, report);
    const double spacing = (1e7 + 2 * way) / (5e5 + 64 * 2);
    EXPECT_EQ(report.samples.size(), 2 * static_cast<std::size_t>(std::ceil(way / spacing)));
  }
}

TEST(VerifySmallCuts, CornersAreLookedForInAtMostTwoThousandRows) {
  // Where a tool of 1 mm cannot get to in the corners is less than the millimetre between two rows.
  const auto found = [](int length) {
    const std::string room = fmt::format("L {} 0", length), up = fmt::format("L {} 3", length);
    const auto made = PocketReach::make({"pocket.json", pocket({"0, 0", room, up, "L 0 3", "L 0 0"})}, 1, 4);
    SimulateReport report;
    if (made) find_unreachable(*made, 1, report);
    return report.unreachable.size();
  };
  EXPECT_EQ(found(20), 4U);
  EXPECT_EQ(found(1000), 4U);  // of one place each
  EXPECT_EQ(found(2000), 0U);
}

TEST(VerifySmallCuts, APathTooLongForItsToolIsRefused) {
  SimulateOptions options;
  options.tool_diameter = 0.001;
  const auto report =
      simulate({"p", "G21 G90 G17\n" + kDown + "G1 X9000 F9\n"}, {"pocket.json", kBox}, options);
  ASSERT_FALSE(report);
  EXPECT_TRUE(report.error().message.starts_with("p:4: the path in the stock is longer than"));
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
