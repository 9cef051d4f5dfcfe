// The modes that a program leaves to the control.

#include "verify/pocket/unsaid_modes.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "lekalo/verify/simulate.hpp"

namespace lekalo::verify::verify_unsaid_modes_test {
namespace {

using words::Control;

/// The words of modes, each with the letter that tells it is not said, in the order of the sentences.
constexpr std::array<std::pair<const char*, char>, 9> kSaid{{{"G21", 'u'},
                                                             {"G90", 'd'},
                                                             {"G17", 'p'},
                                                             {"G54", 'o'},
                                                             {"G94", 'f'},
                                                             {"G40", 'c'},
                                                             {"G49", 't'},
                                                             {"G91.1", 'm'},
                                                             {"G61", 'e'}}};

/// For each sentence its letter and line.
std::string unsaid(const std::string& program, Control control = Control::linuxcnc) {
  SimulateOptions options;
  options.control = control;
  const auto found = unsaid_modes({"p", program}, options, {});
  if (!found) return found.error().message;
  const std::pair<const char*, char> names[] = {{"its unit", 'u'},     {"from where it counts (", 'd'},
                                                {"the plane", 'p'},    {"its work offset", 'o'},
                                                {"that F is", 'f'},    {"that no radius", 'c'},
                                                {"the length", 't'},   {"from where it counts centres", 'm'},
                                                {"that its path", 'e'}};
  std::string text;
  for (const std::string& sentence : *found)
    for (const auto& [name, letter] : names) {
      if (sentence.find(fmt::format("does not say {}", name)) == std::string::npos) continue;
      text += letter + sentence.substr(14, sentence.find(' ', 14) - 14);
      EXPECT_EQ(sentence.ends_with("(--control says whose words these are, if not LinuxCNC's)"),
                letter == 'm' || letter == 'e');
    }
  return text;
}

/// A head that says all modes but one.
std::string without(std::string_view code) {
  std::string text;
  for (const auto& [word, letter] : kSaid)
    if (word != code)
      text += std::string(word) + "\n";
    else
      text += "\n";
  return text;
}

TEST(VerifyUnsaidModes, EachIsToldWithTheFirstMotionThatDependsOnIt) {
  // Lines 10 to 13: a way to the first place, a rapid, a motion with feed, an arc.
  const std::string moves = "G0 X1. Y1. Z5.\nX2.\nG1 X3. F99.\nG2 I5.\n";
  EXPECT_EQ(unsaid(without("") + moves), "");
  for (const auto& [word, letter] : kSaid) {
    const int line = letter == 'f' ? 12 : letter == 'p' || letter == 'm' ? 13 : 10;
    EXPECT_EQ(unsaid(without(word) + moves), fmt::format("{}{}", letter, line)) << word;
  }
  EXPECT_EQ(unsaid(moves), "u1d1o1c1t1e1f3p4m4");
  EXPECT_EQ(unsaid("M3 S9\nG4 P1\nM30\n"), "");
}

TEST(VerifyUnsaidModes, AnArcOfAnotherPlaneTurnsAndFeeds) {
  EXPECT_EQ(unsaid(without("G91.1") + "G0 X1 Y1 Z5\nG18 G2 X3 I1 K0 F9\n"), "m11");
  EXPECT_EQ(unsaid(without("G94") + "G0 X1 Y1 Z5\nG18 G2 X3 I1 K0 F9\n"), "f11");
  EXPECT_EQ(unsaid(without("G91.1") + "G0 X1 Y1 Z5\nG1 X3 F9\n"), "");
}

TEST(VerifyUnsaidModes, TheExactPathIsTakenBackByBlending) {
  EXPECT_EQ(unsaid(without("") + "G64 P1\nG0 X1 Y1 Z5\n"), "e11");
  EXPECT_EQ(unsaid(without("") + "G64\nG61.1\nG0 X1 Y1 Z5\n"), "");
  EXPECT_EQ(unsaid(without("G61") + "G61.1\nG0 X1 Y1 Z5\n"), "");
  EXPECT_EQ(unsaid(without("") + "M64 P1\nG0 X1 Y1 Z5\n"), "");
}

TEST(VerifyUnsaidModes, AControlThatHasOneValueAloneKeepsNone) {
  const std::string moves = "G0 X1. Y1. Z5.\nX2.\nG1 X3. F99.\nG2 I5.\n";
  EXPECT_EQ(unsaid(moves, Control::haas), "u1d1o1c1t1f3p4");
  EXPECT_EQ(unsaid(moves, Control::fanuc), "u1d1o1c1t1f3p4");
  EXPECT_EQ(unsaid(moves, Control::grbl), "u1d1o1t1f3p4");
}

}  // namespace
}  // namespace lekalo::verify::verify_unsaid_modes_test
