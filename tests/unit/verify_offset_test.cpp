// The lines of a work offset, held against the pose of their result: by the words of each control, one thing
// wrong at a time.

#include "lekalo/verify/offset.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <tuple>

#include "support/solid_results.hpp"

namespace lekalo::verify::verify_offset_test {
namespace {

using cases::Json;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// A result whose part lies at (1, -2, 3), and the offset that it says was written.
struct Claimed {
  std::array<double, 4> quaternion{1, 0, 0, 0};
  std::string control = "linuxcnc";
  int axes = 5, work_offset = 1;

  [[nodiscard]] std::string result() const {
    Json made = cases::cube_in_cube().result;
    made["quaternion"] = {quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
    made["x"] = 1, made["y"] = -2, made["z"] = 3;
    made["offset"] = {{"control", control},
                      {"axes", axes},
                      {"work_offset", work_offset},
                      {"output", {{"path", "lines.ngc"}, {"sha256", "ab"}}}};
    return made.dump();
  }
  /// The fault of the lines, nothing, or "bad input".
  [[nodiscard]] std::string told(const std::string& lines) const {
    const std::string text = result();
    const auto fault = fault_of_offset({"result.json", text}, {"lines.ngc", lines});
    return !fault ? "bad input: " + fault.error().message : fault->value_or("");
  }
};

const std::string kLinuxcnc = "G21\nG10 L2 P1 X1 Y-2 Z3 R0\n";
const std::string kFanuc = "G21 G90 G54\nG68 X1 Y-2 Z3 I0 J0 K1 R0\n";
const std::string kSiemens = "G71 G54\nTRANS X1 Y-2 Z3\nAROT X0 Y0 Z0\n";

TEST(VerifyOffset, TheFileIsNamedInTheResult) {
  const std::string text = Claimed{}.result();
  const auto file = offset_file({"result.json", text});
  ASSERT_TRUE(file && *file);
  EXPECT_EQ((*file)->path, "lines.ngc");
  EXPECT_EQ((*file)->sha256, "ab");
  const std::string none = cases::cube_in_cube().result.dump();
  const auto without = offset_file({"result.json", none});
  ASSERT_TRUE(without);
  EXPECT_FALSE(*without);
  const auto bad = offset_file({"result.json", R"({"offset": {"control": 1}})"});
  ASSERT_FALSE(bad);
  EXPECT_TRUE(says(bad.error().message, "result.json: ")) << bad.error().message;
}

TEST(VerifyOffset, EachControlHasItsWords) {
  for (const auto& [control, lines] :
       {std::pair{"linuxcnc", kLinuxcnc}, {"fanuc", kFanuc}, {"siemens", kSiemens}}) {
    const Claimed claim{.control = control};
    EXPECT_EQ(claim.told(lines), "");
    // The last line may lack its end.
    EXPECT_EQ(claim.told(lines.substr(0, lines.size() - 1)), "");
    for (const std::string& other :
         {std::string(), "\n" + lines, lines + "\n", lines + "M2\n", " " + lines, lines.substr(4)})
      EXPECT_EQ(claim.told(other), std::string("its lines are not the words of ") + control + " for it");
    for (const std::string& other : {kLinuxcnc, kFanuc, kSiemens})
      EXPECT_EQ(claim.told(other).empty(), other == lines);
  }
  EXPECT_EQ(Claimed{.control = "other"}.told(kLinuxcnc), "there is no such control");
  for (const char* number : {"", "1-", "1.2.3", "#", "x"})
    EXPECT_TRUE(says(Claimed{}.told(std::string("G21\nG10 L2 P1 X") + number + " Y-2 Z3 R0\n"),
                     "are not the words of linuxcnc"))
        << number;
}

TEST(VerifyOffset, CommentsAreWholeLines) {
  const Claimed linuxcnc, siemens{.control = "siemens"};
  EXPECT_EQ(linuxcnc.told("(A PART)\n" + kLinuxcnc + "()\n"), "");
  EXPECT_EQ(siemens.told("; A PART\n" + kSiemens + ";"), "");
  for (const char* other : {"; A PART\n", "(A) G92 X5 (B)\n", "(A) G92 X5\n", "(A\n", "G92 X5)\n", "(A) \n"})
    EXPECT_TRUE(says(linuxcnc.told(other + kLinuxcnc), "are not the words of linuxcnc")) << other;
  for (const char* other : {"(A PART)\n", "G0 ; A PART\n"})
    EXPECT_TRUE(says(siemens.told(other + kSiemens), "are not the words of siemens")) << other;
}

TEST(VerifyOffset, WorkOffsetsEndWhereTheControlHasNoMore) {
  const auto lines = [](const std::string& control, int number) {
    const std::string code = std::to_string(53 + number);
    return control == "linuxcnc" ? "G21\nG10 L2 P" + std::to_string(number) + " X1 Y-2 Z3 R0\n"
           : control == "fanuc"  ? "G21 G90 G" + code + "\nG68 X1 Y-2 Z3 I0 J0 K1 R0\n"
                                 : "G71 G" + code + "\nTRANS X1 Y-2 Z3\nAROT X0 Y0 Z0\n";
  };
  for (const auto& [name, most] : {std::pair{"linuxcnc", 9}, {"fanuc", 6}, {"siemens", 4}}) {
    const std::string control = name;
    const auto told = [&](int number, int of_lines) {
      return Claimed{.control = control, .work_offset = number}.told(lines(control, of_lines));
    };
    EXPECT_EQ(told(1, 1), "");
    EXPECT_EQ(told(most, most), "");
    EXPECT_TRUE(says(told(1, 2), "are not the words"));
    EXPECT_EQ(told(0, 0), "the control has no such work offset");
    EXPECT_EQ(told(most + 1, most + 1), "the control has no such work offset");
  }
}

TEST(VerifyOffset, APartThatLiesTiltedNeedsFiveAxesAndTheWordsForIt) {
  constexpr const char* kTilted = "the part lies tilted, which its axes, or its words, cannot follow";
  for (const int axes : {2, 4, 6})
    EXPECT_EQ((Claimed{.axes = axes}.told(kLinuxcnc)), "a machine has 3 axes or 5");
  for (const char* control : {"linuxcnc", "fanuc", "siemens"})
    for (const int axes : {3, 5}) {
      const bool may = axes == 5 && std::string(control) != "linuxcnc";
      const std::string& lines = std::string(control) == "fanuc" ? kFanuc : kSiemens;
      for (const auto& [x, y] : {std::pair{1.0, 0.0}, {0.0, 1.0}})
        EXPECT_EQ((Claimed{{1, x, y, 0}, control, axes}.told(lines) == kTilted), !may) << control << axes;
      EXPECT_NE((Claimed{{1, 0, 0, 1}, control, axes}.told(lines)), kTilted);
    }
}

TEST(VerifyOffset, TheShiftIsThatOfThePoseToTheLastDigit) {
  for (const auto& [lines, words] :
       {std::pair{"G21\nG10 L2 P1 X1.0000000000000000001 Y-2 Z3 R0\n",
                  "it shifts by 1 along x, and the part lies at 1"},
        {"G21\nG10 L2 P1 X1 Y2 Z3 R0\n", "it shifts by 2 along y, and the part lies at -2"},
        {"G21\nG10 L2 P1 X1 Y-2 Z2.5 R0\n", "it shifts by 2.5 along z, and the part lies at 3"}})
    EXPECT_EQ(Claimed{}.told(lines), words);
  EXPECT_EQ(Claimed{}.told("G21\nG10 L2 P1 X1.0 Y-2.000 Z3.00 R0.0\n"), "");
}

TEST(VerifyOffset, TheRotationIsThatOfThePose) {
  // With sine 2 e the rotation is 2 e off that of R0.
  EXPECT_EQ((Claimed{{1, 0, 0, 2e-14}}.told(kLinuxcnc)), "");
  EXPECT_EQ((Claimed{{1, 0, 0, -2e-14}}.told(kLinuxcnc)), "");
  EXPECT_TRUE(
      says((Claimed{{1, 0, 0, 2.001e-14}}.told(kLinuxcnc)), "its rotation is 4e-14 off that of the part"));
  // The quaternions of a quarter turn about each axis.
  EXPECT_EQ((Claimed{{1, 0, 0, 1}}.told("G21\nG10 L2 P1 X1 Y-2 Z3 R90\n")), "");
  EXPECT_TRUE(says((Claimed{{1, 0, 0, 1}}.told("G21\nG10 L2 P1 X1 Y-2 Z3 R-90\n")), "its rotation is 2 off"));
  for (const auto& [q, turn] : {std::pair{std::array<double, 4>{1, 1, 0, 0}, "I2 J0 K0 R90"},
                                {{1, 0, 1, 0}, "I0 J-3 K0 R-90"},
                                {{1, 1, 1, 1}, "I5 J5 K5 R120"},
                                {{1, 1, 1, -1}, "I-1 J-1 K1 R-120"}})
    EXPECT_EQ((Claimed{q, "fanuc"}.told(std::string("G21 G90 G54\nG68 X1 Y-2 Z3 ") + turn + "\n")), "")
        << turn;
  // No axis, and so no rotation.
  EXPECT_TRUE(says((Claimed{{1, 0, 0, 0}, "fanuc"}.told("G21 G90 G54\nG68 X1 Y-2 Z3 I0 J0 K0 R0\n")),
                   "its rotation is "));
  // About Z first, then about the new Y, then about the new X: the products of the quarter turns.
  for (const auto& [q, turn] : {std::pair{std::array<double, 4>{1, 0, 0, 1}, "X0 Y0 Z90"},
                                {{1, 0, 1, 0}, "X0 Y90 Z0"},
                                {{1, 1, 0, 0}, "X90 Y0 Z0"},
                                {{1, 1, 1, 1}, "X90 Y0 Z90"},
                                {{1, -1, 1, 1}, "X0 Y90 Z90"},
                                {{1, 1, 1, -1}, "X90 Y90 Z0"}})
    EXPECT_EQ((Claimed{q, "siemens"}.told(std::string("G71 G54\nTRANS X1 Y-2 Z3\nAROT ") + turn + "\n")), "")
        << turn;
}

}  // namespace
}  // namespace lekalo::verify::verify_offset_test
