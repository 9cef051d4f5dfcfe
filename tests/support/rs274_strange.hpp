#pragma once

// Programs for LinuxCNC that are mostly right, with a block or two in most of them that few readers agree
// about. Each such block is of a family, and a program says which ones it has, so that a test can hold that
// every family is drawn and that of every one programs are read.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"

namespace rs274 {

inline constexpr std::array kFamilies{
    "tape mark", "block delete", "N and O",       "comment",   "line end",  "spelling",   "tool change",
    "offset",    "dwell",        "unknown place", "arc's end", "two modes", "expression", "subprogram",
    "cycle",     "feed",         "order",         "plane",     "any word",
};

class StrangeProgram {
 public:
  StrangeProgram(std::uint64_t seed, std::uint64_t stream) : random_(seed, stream) {}

  std::string write() {
    const bool marks = chance(6);
    if (marks) line("%");
    if (chance(3)) line("(a program; of words)");
    if (!chance(12)) line(chance(3) ? "G20 G17 G90 G40 G49 G80 G94" : "G21 G90 G17");
    if (chance(3))
      line(pick({"G54", "G61", "G64 P0.01", "T3 M6", "S1000 M3", "G43 H2", "G91.1", "M7", "G59.3"}));
    if (!chance(40)) line("F" + number(50, 900));
    if (chance(10)) strange();
    if (!chance(30)) line("G0 Z5");
    if (chance(8)) line(pick({"G43 H1 Z4", "G55", "T2 M6", "G49", "M8"}));
    if (!chance(30)) to(place(), place(), "G0");
    const std::uint64_t blocks = 2 + random_.below(10), odd = random_.below(2 * blocks);
    for (std::uint64_t k = 0; k < blocks; ++k) {
      usual();
      if (k == odd) strange();
      if (over_) return text_;
    }
    if (marks && chance(3)) return text_ + tail_ + "%\n";
    if (!chance(20)) line(chance(2) ? "M2" : "M30");
    text_ += tail_;
    if (marks) text_ += "%\n";
    if (chance(30)) text_.pop_back();
    return text_;
  }

  /// Indices into kFamilies, in the order in which they were drawn.
  [[nodiscard]] const std::vector<std::size_t>& families() const { return families_; }

 private:
  using Words = std::initializer_list<const char*>;

  bool chance(std::uint64_t of) { return random_.below(of) == 0; }
  std::string pick(Words words) { return std::data(words)[random_.below(words.size())]; }
  void line(std::string words) {
    if (chance(20)) std::ranges::transform(words, words.begin(), [](char c) { return lower(c); });
    text_ += words + (chance(30) ? "\r\n" : "\n");
  }
  static char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
  double place() { return static_cast<double>(random_.below(4000)) / 100 - 20; }
  std::string number(int low, int high) {
    return std::to_string(low + static_cast<int>(random_.below(static_cast<std::uint64_t>(high - low + 1))));
  }
  double one_of(std::initializer_list<double> values) {
    return std::data(values)[random_.below(values.size())];
  }

  /// A step to a place, as its words; the program's own count of the place goes on.
  void to(double x, double y, const std::string& code) {
    line(fmt::format("{} X{:.4f} Y{:.4f}", code, incremental_ ? x - x_ : x, incremental_ ? y - y_ : y));
    x_ = x, y_ = y;
  }
  /// The words of an end, with so many decimals.
  std::string end(double x, double y, int decimals) {
    const double dx = incremental_ ? x - x_ : x, dy = incremental_ ? y - y_ : y;
    x_ = x, y_ = y;
    return fmt::format("X{:.{}f} Y{:.{}f}", dx, decimals, dy, decimals);
  }

  void arc() {
    const double r = 0.5 + static_cast<double>(random_.below(2000)) / 100;
    const std::string code = chance(2) ? "G2" : "G3";
    const std::string more = (chance(5) ? " Z-" + number(0, 3) : "") + (chance(6) ? " P" + number(1, 3) : "");
    after_arc_ = true;
    switch (random_.below(4)) {
      case 0:
        return line(fmt::format("{} I{:.4f}{}", code, r, more));
      case 1:
        return line(fmt::format("{} {} I{:.4f}{}", code, end(x_, y_, 4), -r, more));
      case 2:  // a quarter or three
        return line(fmt::format("{} {} I{:.4f}{}", code, end(x_ + r, y_ + r, 4), r, more));
      default:
        return line(fmt::format("{} {} R{:.4f}{}", code, end(x_ + r, y_ - 0.3 * r, 4),
                                (chance(3) ? -1 : 1) * r, more));
    }
  }

  void usual() {
    if (chance(20)) line((incremental_ = !incremental_) ? "G91" : "G90");
    if (chance(60)) line(pick({"G20", "G21", "G90.1", "G91.1", "G80", "F120", "G20 F60", "G21 F60"}));
    if (chance(12))
      line(pick({"", "(nothing)", "; nothing", "G4 P0.1", "M8", "M9", "M3", "M5", "N10", "S800", "M1",
                 "G17 G40", "M64 P1", "M48", "G98", "G97", "G94 G90"}));
    if (chance(25)) return cycle("");
    if (chance(30)) return upright_arc();
    if (chance(60)) return line(pick({"G28 Z6", "G53 G0 Z9", "G91 G28 Z0\nG90", "G30 Z4", "G0 A0 Z5"}));
    if (chance(3)) return arc();
    if (chance(4))
      return line(fmt::format("{} Z{}", chance(3) ? "G0" : "G1", static_cast<int>(random_.below(6)) - 3));
    const bool modal = chance(after_arc_ ? 20 : 5);
    const std::string code = modal ? "" : pick({"G0", "G1", "G1", "N20 G01", "g1"});
    after_arc_ = false;
    if (chance(3)) {
      const double x = place();
      line(fmt::format("{} X{:.4f}{}", code, incremental_ ? x - x_ : x,
                       chance(3) ? " F" + number(50, 900) : ""));
      x_ = x;
    } else {
      to(place(), place(), code);
    }
  }

  /// Holes by a canned cycle, absolute or in steps, with the words of its first block or without some.
  void cycle(const std::string& odd_letters) {
    line("G0 Z" + number(1, 9));
    const std::string code = pick({"G81", "G82", "G83", "G73", "G84", "G74", "G85", "G86", "G89"});
    line(chance(15) ? "M5" : code == "G74" ? "M4" : "M3");
    std::string words = pick({"G98 ", "G99 ", "G98 ", "G99 ", "G98 ", "G99 ", ""}) + code;
    const bool waits = code == "G82" || code == "G86" || code == "G89" || code == "G84" || code == "G74";
    words += fmt::format(" X{} Y{}", number(-9, 9), number(-9, 9));
    if (!chance(30)) words += " Z-" + number(0, 4);
    if (!chance(30)) words += " R" + number(-2, 8);
    if ((code == "G83" || code == "G73") != chance(30)) words += " Q" + number(1, 3) + ".3";
    if (waits != chance(30)) words += " P0.1";
    line(words + odd_letters + (chance(4) ? " L" + number(chance(9) ? 0 : 1, 3) : ""));
    for (std::uint64_t more = random_.below(3); more > 0; --more)
      line(pick(
          {"X3", "Y4", "X5 Y-2", "X2 Z-1.5", "Y1 R2", "G98 X1", "G99 X-3 Y2", "X4 L2", "Z-2", "G82 X1 P1"}));
    line(chance(4) ? "G90 G0 Z9" : "G80\nG90 G0 Z9");
    incremental_ = false;
    to(place(), place(), "G0");
  }

  void upright_arc() {
    line(pick({"G18 G2 ", "G18 G3 ", "G19 G2 ", "G19 G3 ", "G18 ", "G19 G2 F90 "}) +
         pick({"X3 Z2 I1 K0", "X3 Z2 R9", "Y3 Z2 J1 K1", "Y4 Z1 R-8 P2", "K2", "I1 K1", "J1 K-1", "Z4 J1",
               "X1 I2 J1", "X2 Y1 Z3 R12", "G91 X2 I1", "G91 Y2 J1 X1"}));
    line("G17 G90 G1");
    incremental_ = false;
    to(place(), place(), "G1");
  }

  /// An arc of nearly no turn or nearly a full one, radii that nearly agree, a chord that is nearly the
  /// diameter, and odd numbers of turns.
  void arc_end() {
    const std::string code = chance(2) ? "G2" : "G3";
    const double r =
        chance(4) ? one_of({0.0011, 0.00125, 0.0013, 0.01, 300}) : 0.5 + 0.01 * random_.below(2000);
    const double towards = 0.001 * static_cast<double>(random_.below(6283));
    const double i = r * std::cos(towards), j = r * std::sin(towards);
    const std::string turns =
        chance(3) ? " P" + pick({"0", "1", "2", "3", "-1", "1.5", "1.0004", "1.002"}) : "";
    switch (random_.below(4)) {
      case 0: {
        const double turn =
            (chance(2) ? -1 : 1) * one_of({1e-7, 9e-7, 1.1e-6, 1.9e-6, 2.1e-6, 5e-6, 1e-5, 1e-4, 1e-3, 0.05});
        const double x = x_ + i - r * std::cos(towards + turn), y = y_ + j - r * std::sin(towards + turn);
        return line(fmt::format("{} {} I{:.12f} J{:.12f}{}", code, end(x, y, 12), i, j, turns));
      }
      case 1: {
        const double off = one_of({0, 1e-5, 1e-4, 1e-3, 0.004, 0.006, 0.02, 0.03, 0.05});
        return line(fmt::format("{} X{:.5f} I{:.4f}{}", code, (incremental_ ? 0 : x_) + off, r, turns));
      }
      case 2: {
        const double chord =
            2 * r * (1 + one_of({0, 1e-13, -1e-13, 1e-11, -1e-11, 1e-7, -1e-7, 1e-5, -1e-5, 1e-3, -1e-3}));
        const double x = x_ + chord * std::cos(towards), y = y_ + chord * std::sin(towards);
        return line(fmt::format("{} {} R{}{:.12f}{}", code, end(x, y, 12), chance(3) ? "-" : "", r, turns));
      }
      default: {
        const double x = x_ + one_of({0, 1e-7, 1e-5, 1e-3}), y = y_ + one_of({0, 0, 1e-6});
        return line(fmt::format("{} {} R{:.6f}{}", code, end(x, y, 9), (chance(3) ? -1 : 1) * r, turns));
      }
    }
  }

  /// Two words of one modal group, or the same word twice, some beside words that move.
  void two_modes() {
    static const std::vector<std::vector<const char*>> groups{
        {"G0", "G1", "G2", "G3", "G80", "G81", "G38.2", "G33"},
        {"G17", "G18", "G19", "G17.1"},
        {"G20", "G21"},
        {"G90", "G91"},
        {"G90.1", "G91.1"},
        {"G93", "G94", "G95"},
        {"G40", "G41", "G42"},
        {"G43", "G43.1", "G49"},
        {"G54", "G55", "G59.3"},
        {"G61", "G61.1", "G64"},
        {"G98", "G99"},
        {"G96", "G97"},
        {"G4", "G28", "G53", "G92"},
        {"M0", "M1", "M2", "M30", "M60"},
        {"M3", "M4", "M5"},
        {"M7", "M8", "M9"},
        {"M48", "M49"},
        {"M62", "M65"},
        {"M6", "M61"},
    };
    const auto& group = groups[random_.below(groups.size())];
    const std::string a = group[random_.below(group.size())], b = group[random_.below(group.size())];
    line(a + pick({" ", " X3 ", " F90 ", " Z2 "}) + b + pick({"", "", " Y2", " P1", " I1"}));
  }

  std::string any_word() {
    switch (random_.below(6)) {
      case 0:
        return fmt::format("G{:g}", static_cast<double>(random_.below(1000)) / 10);
      case 1:
        return "G" + number(0, 99);
      case 2:
        return "M" + number(0, chance(3) ? 199 : 66);
      case 3:
        return pick({"G4 P1",  "G10 L2 P1 X1", "G28",      "G53",       "G92 X1", "G52 X1",    "G55",
                     "G58.9",  "G59.1",        "G43 H1",   "G43.1 Z1",  "G49",    "G41 D1",    "G40",
                     "G93",    "G95",          "G18",      "G68 R30",   "G5.1",   "G38.2 Z-1", "G81 Z-1 R1",
                     "G80",    "G61.1",        "G64 Q0.1", "G64 P1 Q1", "G7",     "G8",        "G50",
                     "G69",    "G96 D1 S1",    "G97 S9",   "M6",        "T4",     "M61 Q3",    "M62 P1",
                     "M98 P1", "M2",           "M30",      "M0",        "M60",    "M19",       "M50 P0",
                     "M70",    "M101"});
      default:
        return std::string(1, static_cast<char>('A' + random_.below(26))) + (chance(4) ? "-" : "") +
               number(0, 12) + (chance(4) ? ".5" : "");
    }
  }
  void any_block() {
    if (chance(3)) return line(any_word() + (chance(2) ? " " + any_word() : ""));
    std::string words = pick({"G0 ", "G1 ", "G2 ", ""});
    if (chance(2)) words += "X" + number(-9, 9) + " ";
    if (chance(3)) words += "Z" + number(-2, 4) + " ";
    line(words + any_word() + (chance(4) ? " " + any_word() : ""));
  }

  /// A subprogram of numbers stands behind the end of the program.
  void subprogram() {
    if (chance(3)) {
      tail_ =
          pick({"O200\nG91 G1 X2 Y-.5\nG90\nM99\n", "O200\nG0 Z3\nM99\n", "O200 (a name)\nG1 X3\nN5 M99\n",
                "O200\nG1 X1\nM98 P300\nM99\nO300\nG1 Y4\nM99\n", "O200\nG1 X1\n", "O200\nX#1\nM99\n"});
      return line(pick({"M98 P200", "M98 P200 L2", "N7 M98 P200", "G1 X3 M98 P200", "M98 P200 L0", "M98 P201",
                        "M98 P0200", "M98 P200 (a)", "M98 P200 (a(b))", "M98 P200 (py,x)", "(a) M98 P200",
                        "M98 P200 ; a", "M98 (a) P200", "M98 P200 (a"}));
    }
    line(pick({"o100 sub\nG91 G1 X1\nG90\no100 endsub\no100 call",
               "o<a b> sub\nG1 X2\no<ab> endsub\no<a b> call\no<ab> call", "o100 call", "M98 P100",
               "M97 P100", "M99", "o100 if [1]\nG1 X3\no100 endif", "o100 repeat [2]\nG1 X1\no100 endrepeat",
               "o100 while [0]\no100 endwhile", "o100 sub\nG1 X#1\no100 endsub\no100 call [3]",
               "o100 sub\nG1 X1\no100 return\nG1 X2\no100 endsub\no100 call",
               "o100 sub\nM2\no100 endsub\no100 call", "G65 P1", "o100 sub\nG1 X2\no100 endsub",
               "#<_wide>=3\no100 sub\nG1 X#<_wide>\n#<_wide>=4\no100 endsub\no100 call\nG1 Y#<_wide>",
               "#1=3\no100 sub\n#1=4\no100 endsub\no100 call\nG1 Y#1"}));
  }

  void strange() {
    families_.push_back(random_.below(kFamilies.size()));
    switch (families_.back()) {
      case 0:
        over_ = chance(2);
        return line(over_ ? "%" : pick({"%", "% ", " %", "%%", "%\t", "(a) %", "% (a)", "%\n%"}));
      case 1:
        return line(pick({"/G1 X3", "/M8",    "/N5 M1", "/(nothing)", "/",   "//M8",  "/G4 P0.1", "/S500",
                          "/F100",  "/T2",    "/G91",   "/ M9",       "/%",  "/O100", "/#1=2",    "/M30",
                          "N5 /M8", "G1 /X3", " /M7",   "/M3",        "/P1", "/M8 P1"}));
      case 2:
        return line(pick({"N5 N6 X1",
                          "X1 N5",
                          "N1.5 X2",
                          "N99999 X2",
                          "N123456 X1",
                          "N123456789 X1",
                          "N1234567890 X1",
                          "N-5 X1",
                          "N0 X1",
                          "O100",
                          "O100 sub",
                          "N7 O100",
                          "O0",
                          "O100 X1",
                          "N5 (x) G1 X3",
                          "n 7 x 3",
                          "N",
                          "N5",
                          "N 5 G1 X2",
                          "N5G1X2",
                          "N+5 X1",
                          "N5. X1",
                          "O-1",
                          "O<a>"}));
      case 3:
        return line(pick({"(a(b)c)",
                          "(open",
                          "; fine (open",
                          "G1 X3 (a) Y2 (b)",
                          "(py, x=1)",
                          "(MSG, hi) G1 X2",
                          "(DEBUG, hi)",
                          "(PRINT, #5)",
                          "(LOG, x)",
                          "G1 X2 ; (PROBEOPEN a)",
                          "(probeclose)",
                          "(ABORT, x)",
                          "G1 (x) X3",
                          "()",
                          ")",
                          "G1 X2 )",
                          "(\xC3\xA9)",
                          "; \xC3\xA9 \xE9",
                          "G1 X(a)3",
                          "G1 X3;Y4",
                          "(a;b) X2",
                          ";py,x=1",
                          "(MSG,(a))"}));
      case 4:
        if (chance(8)) return line("(" + std::string(200 + random_.below(100), 'a') + ") G1 X2");
        return line(pick({"G1 X1\rY3", "\rG1 X2", "G1 X2\r", "G1\tX2", "G1 X\t2", "G1 X1\vY2", "G1 X2\f",
                          "  G1 X2  ", "G1 X2\x7f", "\t", "\r", "G1 X2\n\n\n", "G1 X2 \r", "(a\rb) G1 X2"}));
      case 5:
        return line(pick({"G1 X1 2 Y3",
                          "G 1 X 3",
                          "G1 X--1",
                          "G1 X1.2.3",
                          "G1 X+-3",
                          "G1 X",
                          "g01x+3y-.5",
                          "G1 X.",
                          "G1 X1e2",
                          "G1.0 X3",
                          "G001 X3",
                          "G1 X-.5.",
                          "G1 X0x3",
                          "G1 X- 3",
                          "G1 X-0",
                          "G1 X00003",
                          "G1.04 X2",
                          "G0.9999 X3",
                          "G1X3Y4Z1",
                          "X 3",
                          "G1 X3,5",
                          "@1 ^30",
                          "E1",
                          "$1 S3",
                          "G1 X+ 3",
                          "G1 X1234567890123",
                          "G1 X0.00000000000000001",
                          "G1 X3 Y",
                          "G1 X 1 .5",
                          "G1 X3 X4",
                          "G-1 X3",
                          "G1000",
                          "M3.0",
                          "M3.5",
                          "G1 X 4 Y 5 ."}));
      case 6:
        return line(pick({"T4", "M6", "T2 M6", "M6 T2", "T2 M6 G0 X1", "M61 Q3", "T-1", "T1.5", "T19 M6",
                          "T0 M6", "T4 G43 H4", "M6 G43 H1", "T2\nG1 X3", "T2 M6\nG0 X1 Y1 Z5", "M6 M3",
                          "T3 M6\nM3 S100\nG0 X1 Y2 Z6\nG1 X5"}));
      case 7:
        return line(pick({"G54",           "G55",          "G59.1",  "G59.3",        "G55 G0 X1",
                          "G43 H1",        "G43 H2 Z4",    "G43",    "G49",          "G43.1 Z1",
                          "G44 H1",        "G52 X1",       "G92 X1", "G92.1",        "G10 L2 P1 X1",
                          "G10 L20 P1 X0", "G43 H19",      "G43 H0", "G43 G0 Z4 H1", "G43.2 H1",
                          "G54 G0 Z4",     "G10 L1 P1 Z2", "G92.2",  "G92.3",        "G55\nG0 X1 Y1 Z5",
                          "G43 H1.5",      "G43 H-1"}));
      case 8:
        return line(pick({"G4 P1",
                          "G4 P0",
                          "G4 P-1",
                          "G4",
                          "G4 X1",
                          "G4 P0.1 X3",
                          "G4 P1 G1 X3",
                          "G4 P1 G0",
                          "G4 P1 Z3",
                          "G4 P1 F50",
                          "G4 P1 M3 S100",
                          "G4 P1 G2 I1",
                          "G4 P1 G91\nG90",
                          "G4 P1 T2",
                          "G4 P1 G81 Z-1 R1 X2",
                          "G4 P1 I2",
                          "G4 P1 A0",
                          "P1",
                          "G4 Q1",
                          "G4 P1 G80",
                          "G4 P1 G1",
                          "G4 P1 G54",
                          "G4 P1 M30"}));
      case 9:
        return line(pick({"T2 M6\nG1 X3 Y4",
                          "M6\nX2",
                          "G28\nG1 X1",
                          "G30\nG0 X2",
                          "G28 X1\nG1 Z-1",
                          "G28 Z6\nG1 X4",
                          "G28 Z6\nG0 Z4\nG1 X4",
                          "G53 G0 Z9\nG1 X1",
                          "G53 G0 X1 Z3\nX2",
                          "G91 G28 Z0\nG90 X3",
                          "G91 G28 X0 Y0\nG90 G1 X4",
                          "G53 G1 Z3",
                          "G53 X1",
                          "G28.1",
                          "G30.1",
                          "G53",
                          "G91 G53 G0 Z1\nG90",
                          "G53 G0\nX3",
                          "G28 Z6\nG2 I2",
                          "G30 Z3 G1",
                          "G53 G0 Z9\nG0 X1\nG0 Z5\nG1 X3",
                          "G28 G1 Z6\nX3",
                          "G0 G53 Z9 F50"}));
      case 10:
        return arc_end();
      case 11:
        return two_modes();
      case 12:
        return line(pick({"#1=3",
                          "X[1+1]",
                          "G1 X#1",
                          "#1=[2+3]\nG1 X#1",
                          "#<_a>=4\nG1 X[#<_a>/2]",
                          "#<_wide>=4\nG1 X[#<_wide>/2]",
                          "G1 X[2*3-1] Y-[1]",
                          "G1 X[SIN[30]]",
                          "#1=5 X3",
                          "#1=2\n#2=#1\nG1 Y#2",
                          "#1=2\n#2=7\nG1 X##1",
                          "G[1] X3",
                          "M[3]",
                          "F[100/2]",
                          "G1 X[1/0]",
                          "G1 X[1 MOD 2]",
                          "G1 X[-5 MOD 3]",
                          "G1 X[2**3]",
                          "G1 X[ATAN[1]/[2]]",
                          "G1 X[1 GT 0]",
                          "G1 X[EXISTS[#1]]",
                          "#5220=1",
                          "G1 X#5420",
                          "#100=1\n#100=[#100+1] (more)\nG1 X#100",
                          "#1=1#2=2",
                          "G1 X[ROUND[1.5]]",
                          "G1 X[FIX[-1.5]]",
                          "G1 X[FUP[1.5]]",
                          "#1=2\nG1 X-#1",
                          "N#1 X2",
                          "#1=2\n#1=3 Y#1\nG1 X#1",
                          "G1 X[2-3*4+5]",
                          "G1 X[-2+3]",
                          "G1 X[2--3]",
                          "G1 X[1+[2*[3-1]]]",
                          "#1 = 4 ; a\nG1 X #1",
                          "G1 X[10/4/2]",
                          "G1 X[ASIN[.5]/10] Y[ACOS[1]]",
                          "G1 X[ABS[-3]] Y[SQRT[4]]",
                          "G1 X[TAN[45]]",
                          "#1=0.1\nG1 X[#1*3] Y[7 MOD 4]",
                          "G1 X[EXP[1]]",
                          "G1 X[LN[2]]",
                          "G1 X+[3]",
                          "G1 X+#1"}));
      case 13:
        return subprogram();
      case 14:
        return cycle(
            pick({" P0.2", " Q1", " L0",    " K2",    " I1",    " L2.5", " Q-1",  " P-1", " A0", " E1", " H1",
                  " Q0",   " P0", " J2 K1", " L1 Q2", " P1 Q1", " F50",  " S500", " M8",  " D1", " T4"}));
      case 15:
        return line(pick({"F0",         "F-5",         "F120 G20",        "G94",       "G94 F50",  "G95",
                          "G95 F.1",    "G93",         "G93 F2 G1 X3",    "S-1",       "S1.5 M3",  "S0 M3",
                          "F",          "G97 S100 M3", "G96 D100 S50 M3", "F50 F60",   "G21 F70",  "G20\nF9",
                          "G94\nG1 X3", "F0.001",      "G1 F80",          "G1 X2 F80", "G0 F80 X2"}));
      case 16:
        return line(pick({"X3 F100 G1", "Z2 X1 G0", "M5 X3 G1", "F200 Y2 X1 G01 N5", "X2 G91 G1\nG90",
                          "G1 X2 G20\nG21", "X1 G0 M3 S5", "G1 X3 M2", "M30 X2", "Y3 G90 G0 Z6 X1", "I2 G2",
                          "M0 X3", "X3 G53 G0", "G1 X4 M8 M3 S100 M48 M64 P1", "M3 M8 M48 M1 M64 P1 S1"}));
      case 17:
        return chance(2) ? upright_arc()
                         : line(pick({"G18\nG1 X2\nG17", "G19 G1 Y3\nG17", "G18\nG2 I2\nG17", "G17 G2 K1",
                                      "G18 G81 X1 Y2 Z-1 R2\nG17 G80", "G19\nG2 Y3 I1 J1\nG17", "G17.1",
                                      "G18 G2 X1 Z1 I1 K0 J2\nG17", "G18 G2 K1 P2\nG17",
                                      "G18 G3 X2 Z1 R-4\nG17", "G90.1 G18 G2 I1 K2\nG17 G91.1"}));
      default:
        return any_block();
    }
  }

  lekalo::Random random_;
  std::string text_, tail_;
  std::vector<std::size_t> families_;
  bool incremental_ = false, after_arc_ = false, over_ = false;
  double x_ = 0, y_ = 0;
};

}  // namespace rs274
