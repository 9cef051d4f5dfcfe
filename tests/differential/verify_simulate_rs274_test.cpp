// LinuxCNC's own interpreter, rs274, runs programs of right and strange words: where the checker reads a
// program, its motions are the interpreter's, which accepts it; everything else is refused.

#include "support/rs274.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "verify/pocket/nc_moves.hpp"

namespace lekalo::verify {
namespace {

constexpr double kTolerance = 1e-4;  ///< in the program's unit, of which rs274 prints four decimals

const rs274::Oracle& oracle() {
  static const rs274::Oracle instance(cases::source_dir() + "/tests/support/rs274.sh");
  return instance;
}

/// Follows the interpreter's calls along the moves that were read.
class Comparison {
 public:
  explicit Comparison(const std::vector<Move>& moves, const std::string& program = "")
      : moves_(moves), homes_(std::ranges::any_of(std::array{"G28", "G30", "G53"}, [&](const char* word) {
          return program.find(word) != std::string::npos;
        })) {}

  /// What differs first; empty when nothing does.
  std::string difference(const rs274::Run& run) {
    // A program without an end is judged up to where it ends.
    if (!run.accepted && run.errors.find("File ended with no percent sign") == std::string::npos)
      return "rs274 does not accept it: " + run.errors;
    for (const rs274::Call& call : run.calls) {
      unit_ = call.unit;
      if (call.name == "CHANGE_TOOL") lost_ = true;
      if (call.name == "SELECT_PLANE") plane_ = call.arguments;
      if (call.name == "SET_FEED_RATE") feed_ = call.numbers.at(0) * unit_;
      if ((call.straight() || call.arc()) && !follow(call)) return call.name + call.arguments;
    }
    return next_ == moves_.size() ? "" : fmt::format("only line {} moves", moves_[next_].line);
  }

 private:
  using Spot = std::array<double, 3>;

  /// Before a change of the unit the numbers were printed in the other one.
  [[nodiscard]] bool near(double a, double b) const {
    return std::abs(a - b) <= kTolerance * std::max(unit_, unit_before_);
  }
  [[nodiscard]] bool near(const Spot& a, Place p, double z) const {
    return near(a[0], p.x) && near(a[1], p.y) && near(a[2], z);
  }

  [[nodiscard]] bool is_next(const rs274::Call& call, const Spot& to) const {
    if (next_ == moves_.size()) return false;
    const Move& move = moves_[next_];
    if (!near(at_, move.from, move.from_z) || !near(to, move.to, move.to_z)) return false;
    if (move.arc != call.arc() || move.rapid != (call.name == "STRAIGHT_TRAVERSE")) return false;
    if (!move.rapid && !near(feed_, move.feed)) return false;
    if (!move.arc) return true;
    return near(call.numbers.at(2) * unit_, move.centre.x) &&
           near(call.numbers.at(3) * unit_, move.centre.y) &&
           call.numbers.at(4) == (move.ccw ? move.turns : -move.turns);
  }

  /// An arc outside the XY plane was read as chords of one line, each end of which lies on it.
  bool follow_upright(const rs274::Call& call) {
    const bool zx = plane_.find("XZ") != std::string::npos;
    const auto number = [&](std::size_t k) { return call.numbers.at(k) * unit_; };
    const Spot to = zx ? Spot{number(1), number(5), number(0)} : Spot{number(5), number(0), number(1)};
    const std::size_t first = next_, a = zx ? 2 : 1, b = zx ? 0 : 2;
    const double r0 = std::hypot(at_[a] - number(2), at_[b] - number(3));
    while (next_ < moves_.size() && moves_[next_].line == moves_[first].line) {
      const Move& move = moves_[next_++];
      const Spot end{move.to.x, move.to.y, move.to_z};
      if (move.arc || move.rapid || !near(feed_, move.feed)) return false;
      if (!(std::abs(std::hypot(end[a] - number(2), end[b] - number(3)) - r0) <= 6e-3)) return false;
    }
    if (next_ == first || !near(to, moves_[next_ - 1].to, moves_[next_ - 1].to_z)) return false;
    at_ = to, unit_before_ = unit_;
    return true;
  }

  /// A motion of the interpreter is the next that was read, or none, or a rapid to the first place or to one
  /// of the machine.
  bool follow(const rs274::Call& call) {
    if (call.arc() && plane_.find("XY") == std::string::npos) return follow_upright(call);
    const std::size_t z = call.arc() ? 5 : 2;
    const Spot to{call.numbers.at(0) * unit_, call.numbers.at(1) * unit_, call.numbers.at(z) * unit_};
    const bool same = is_next(call, to), still = call.straight() && near(to, {at_[0], at_[1]}, at_[2]);
    const bool upright = near(at_[0], to[0]) && near(at_[1], to[1]);
    const bool arrives = call.name == "STRAIGHT_TRAVERSE" &&
                         ((lost_ && std::min(at_[2], to[2]) >= 0) || (homes_ && (lost_ || upright)));
    if (homes_ && arrives && !same) lost_ = true;
    if (same) ++next_, lost_ = false;
    at_ = to, unit_before_ = unit_;
    return same || still || arrives;
  }

  const std::vector<Move>& moves_;
  std::size_t next_ = 0;
  Spot at_{};
  double unit_ = 1, unit_before_ = 1, feed_ = 0;
  bool lost_ = true;
  bool homes_;  ///< the program goes to places of the machine, which it does not say
  std::string plane_ = "CANON_PLANE_XY";
};

/// A program that is mostly right, with a strange block or two in most of them.
class StrangeProgram {
 public:
  explicit StrangeProgram(Random& random) : random_(random) {}

  std::string write() {
    const bool marks = chance(6);
    if (marks) line("%");
    if (chance(3)) line("(a program; of words)");
    if (!chance(12)) line(chance(3) ? "G20 G17 G90 G40 G49 G80 G94" : "G21 G90 G17");
    if (chance(3))
      line(pick({"G54", "G61", "G64 P0.01", "T3 M6", "S1000 M3", "G43 H2", "G91.1", "M7", "G59.3"}));
    if (!chance(40)) line("F" + number(50, 900));
    if (chance(30)) strange();
    if (!chance(30)) line("G0 Z5");
    if (chance(8)) line(pick({"G43 H1 Z4", "G55", "T2 M6", "G49", "M8"}));
    if (!chance(30)) to(place(), place(), "G0");
    const std::uint64_t blocks = 2 + random_.below(10), odd = random_.below(2 * blocks);
    for (std::uint64_t k = 0; k < blocks; ++k) {
      usual();
      if (k == odd) strange();
    }
    if (marks && chance(3)) return text_ + "%\n";
    if (!chance(20)) line(chance(2) ? "M2" : "M30");
    return text_ + (marks ? "%\n" : "");
  }

 private:
  bool chance(std::uint64_t of) { return random_.below(of) == 0; }
  std::string pick(std::initializer_list<const char*> words) {
    return std::data(words)[random_.below(words.size())];
  }
  void line(const std::string& words) { text_ += words + (chance(30) ? "\r\n" : "\n"); }
  double place() { return static_cast<double>(random_.below(4000)) / 100 - 20; }
  std::string number(int low, int high) {
    return std::to_string(low + static_cast<int>(random_.below(static_cast<std::uint64_t>(high - low + 1))));
  }

  /// A step to a place, as its words; the program's own count of the place goes on.
  void to(double x, double y, const std::string& code) {
    const double dx = x - x_, dy = y - y_;
    line(fmt::format("{} X{:.4f} Y{:.4f}", code, incremental_ ? dx : x, incremental_ ? dy : y));
    x_ = x, y_ = y;
  }

  void arc() {
    const double r = 0.5 + static_cast<double>(random_.below(2000)) / 100;
    const std::string code = chance(2) ? "G2" : "G3";
    const std::string more = (chance(5) ? " Z-" + number(0, 3) : "") + (chance(6) ? " P" + number(1, 3) : "");
    after_arc_ = true;
    switch (chance(12) ? 4 : random_.below(4)) {
      case 0:
        return line(fmt::format("{} I{:.4f}{}", code, r, more));
      case 1:
        return line(fmt::format("{} X{:.4f} Y{:.4f} I{:.4f}{}", code, (incremental_ ? 0 : x_),
                                (incremental_ ? 0 : y_), -r, more));
      case 2: {  // a quarter or three
        const double i = r, x = x_ + r, y = y_ + r;
        line(fmt::format("{} X{:.4f} Y{:.4f} I{:.4f}{}", code, incremental_ ? x - x_ : x,
                         incremental_ ? y - y_ : y, i, more));
        x_ = x, y_ = y;
        return;
      }
      case 3: {
        const double x = x_ + r, y = y_ - 0.3 * r;
        line(fmt::format("{} X{:.4f} Y{:.4f} R{:.4f}{}", code, incremental_ ? x - x_ : x,
                         incremental_ ? y - y_ : y, (chance(3) ? -1 : 1) * r, more));
        x_ = x, y_ = y;
        return;
      }
      default: {  // nearly no turn, and radii that nearly agree
        constexpr std::array kOff{0.00001, 0.0001, 0.001, 0.004, 0.006, 0.05};
        const double off = kOff[random_.below(kOff.size())];
        return line(fmt::format("{} X{:.5f} I{:.4f}{}", code, incremental_ ? off : x_ + off,
                                chance(3) ? 0.001 : r, more));
      }
    }
  }

  void usual() {
    if (chance(20)) line((incremental_ = !incremental_) ? "G91" : "G90");
    if (chance(60)) line(pick({"G20", "G21", "G90.1", "G91.1", "G80", "F120", "G20 F60", "G21 F60"}));
    if (chance(12))
      line(pick({"", "(nothing)", "; nothing", "G4 P0.1", "M8", "M9", "M3", "M5", "N10", "S800", "M1",
                 "G17 G40", "M64 P1", "M48", "G98", "G97", "G94 G90"}));
    if (chance(25)) return cycle();
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
  void cycle() {
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
    line(words + (chance(4) ? " L" + number(chance(9) ? 0 : 1, 3) : ""));
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

  void strange() {
    switch (random_.below(6)) {
      case 0:
        return line(
            pick({"%",         "% ",           "/G1 X3",     "O100",       "O100 sub",  "N5 N6 X1",
                  "X1 N5",     "#1=3",         "X[1+1]",     "G1 X#1",     "(py, x=1)", "(a(b)c)",
                  "(open",     "; fine (open", "G1 X1 2 Y3", "G1 X1\rY3",  "G 1 X 3",   "G1 X--1",
                  "G1 X1.2.3", "G1 X+-3",      "G1 X",       "g01x+3y-.5", "G1 X.",     "G1 X1e2",
                  "G1.0 X3",   "G001 X3",      "N99999 X2",  "N1.5 X2",    "%%",        "G1 X3 (a) Y2 (b)",

                  "@1 ^30",    "E1",           "$1 S3"}));
      case 1:
      case 2:
        return line(any_word());
      case 3:
        return line(any_word() + " " + any_word());
      default: {
        std::string words = pick({"G0 ", "G1 ", "G2 ", ""});
        if (chance(2)) words += "X" + number(-9, 9) + " ";
        if (chance(3)) words += "Z" + number(-2, 4) + " ";
        return line(words + any_word() + (chance(4) ? " " + any_word() : ""));
      }
    }
  }

  Random& random_;
  std::string text_;
  bool incremental_ = false, after_arc_ = false;
  double x_ = 0, y_ = 0;
};

TEST(VerifySimulateRs274, TheComparisonNoticesWhatDiffers) {
  const std::string program = "G21 F100\nG0 X1 Y1 Z5\nG1 X10 Z-1\nG3 X10 Y9 J4\nM2\n";
  const auto moves = read_moves({"p.ngc", program}, 0);
  ASSERT_TRUE(moves) << moves.error().message;
  EXPECT_EQ(Comparison(*moves).difference(oracle().run(program)), "");
  for (const char* other : {"G21 F100\nG0 X1 Y1 Z5\nG1 X10 Z-1\nG2 X10 Y9 J4\nM2\n",
                            "G21 F101\nG0 X1 Y1 Z5\nG1 X10 Z-1\nG3 X10 Y9 J4\nM2\n",
                            "G21 F100\nG0 X1 Y1 Z5\nG1 X10 Z-1\nG3 X10 Y9 J4\nG0 X3\nM2\n",
                            "G21 F100\nG0 X1 Y1 Z5\nG1 X10 Z-1\nM2\n",
                            "G21 F100\nG0 X1 Y1 Z5\nG1 X10 Z-1.001\nG3 X10 Y9 J4\nM2\n",
                            "G21 F100\nG0 X1 Y1 Z-1\nG0 Z5\nG1 X10 Z-1\nG3 X10 Y9 J4\nM2\n"})
    EXPECT_NE(Comparison(*moves).difference(oracle().run(other)), "") << other;
}

TEST(VerifySimulateRs274, WhatIsReadMovesAsTheInterpreterDoes) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(1000), 10000);
  std::size_t judged = 0, motions = 0;
  for (std::size_t index = 0; index < count; ++index) {
    Random random(cases::seed(), 88000 + index);
    const std::string program = StrangeProgram(random).write();
    const auto moves = read_moves({"p.ngc", program}, 0);
    if (!moves) continue;
    ++judged, motions += moves->size();
    const std::string difference = Comparison(*moves, program).difference(oracle().run(program));
    // The interpreter refuses P and L beside some cycles, which the checker passes over: no motion differs.
    if (difference.find("P word with no") != std::string::npos) continue;
    EXPECT_EQ(difference, "") << "seed " << cases::seed() << " case " << index << "\n" << program;
  }
  EXPECT_GE(judged, count / 4);
  EXPECT_GE(motions, 3 * judged);
}

TEST(VerifySimulateRs274, SamplesOfLinuxcncMoveAsTheInterpreterDoesOrAreRefused) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(oracle().root() / "usr/share/linuxcnc/ncfiles")) {
    if (entry.path().extension() != ".ngc") continue;
    ++files;
    const std::string program = rs274::read_file(entry.path());
    const auto moves = read_moves({"sample.ngc", program}, 0);
    if (moves) {
      EXPECT_EQ(Comparison(*moves, program).difference(oracle().run(program)), "") << entry.path();
    }
  }
  EXPECT_GT(files, 100U);
}

}  // namespace
}  // namespace lekalo::verify
