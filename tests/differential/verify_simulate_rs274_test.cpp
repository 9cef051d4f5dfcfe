// LinuxCNC's own interpreter, rs274, runs programs of right and strange words: where the checker reads a
// program, its motions are the interpreter's, which accepts it; everything else is refused.

#include "support/rs274.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/rs274_strange.hpp"
#include "verify/pocket/nc_moves.hpp"

namespace lekalo::verify::verify_simulate_rs274_test {
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
      : moves_(moves),
        homes_(
            std::ranges::any_of(std::array{"G28", "G30", "G53", "g28", "g30", "g53"},
                                [&](const char* word) { return program.find(word) != std::string::npos; })) {}

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
  const std::size_t count = std::min<std::size_t>(cases::case_count(400), 10000);
  std::size_t judged = 0, motions = 0;
  std::array<std::size_t, rs274::kFamilies.size()> drawn{}, read{};
  for (std::size_t index = 0; index < count; ++index) {
    rs274::StrangeProgram strange(cases::seed(), 88000 + index);
    const std::string program = strange.write();
    const auto moves = read_moves({"p.ngc", program}, 0);
    for (const std::size_t family : strange.families()) ++drawn[family], read[family] += moves ? 1 : 0;
    if (!moves) continue;
    ++judged, motions += moves->size();
    EXPECT_EQ(Comparison(*moves, program).difference(oracle().run(program)), "")
        << "seed " << cases::seed() << " case " << index << "\n"
        << program;
  }
  EXPECT_GE(judged, count / 4);
  EXPECT_GE(motions, 3 * judged);
  for (std::size_t family = 0; family < rs274::kFamilies.size(); ++family) {
    fmt::print("{:14} {:5} drawn, {:5} read\n", rs274::kFamilies[family], drawn[family], read[family]);
    EXPECT_GE(drawn[family], count / 100) << rs274::kFamilies[family];
    // Of two words that exclude each other nothing can be read, and of few programs perhaps none.
    const bool excluded = std::string(rs274::kFamilies[family]) == "two modes" || drawn[family] < 200;
    EXPECT_TRUE(read[family] > 0 || excluded) << rs274::kFamilies[family];
  }
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
}  // namespace lekalo::verify::verify_simulate_rs274_test
