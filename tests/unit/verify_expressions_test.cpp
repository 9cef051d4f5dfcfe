#include <fmt/core.h>
#include <gtest/gtest.h>

#include "verify/pocket/nc_expression.hpp"
#include "verify/pocket/nc_flow.hpp"

/// What the checker computes of an expression in a program, and in which order it runs lines.
namespace lekalo::verify::verify_expressions_test {
namespace {

const NcVariables kSet{{"1", 5}, {"100", 7}, {"<A>", 3}, {"<_B>", 4}, {"3", 1}};

/// The number with six digits and what is left behind it, or the complaint.
std::string value(const std::string& text, bool globals_only = false) {
  std::size_t at = 0;
  std::string complaint;
  const auto number = computed(text, at, kSet, globals_only, complaint);
  if (!number) return complaint;
  return fmt::format("{:.6g}{}", *number, at < text.size() ? " " + text.substr(at) : "");
}

TEST(VerifyExpressions, OperatorsBindAsTheControlSays) {
  EXPECT_EQ(value("[1+2]"), "3");
  EXPECT_EQ(value("[7-2-3]"), "2");
  EXPECT_EQ(value("[1+2*3]"), "7");
  EXPECT_EQ(value("[2*3+1]"), "7");
  EXPECT_EQ(value("[12/3/2]"), "2");
  EXPECT_EQ(value("[12/3*2]"), "8");
  EXPECT_EQ(value("[7 mod 4]"), "3");
  EXPECT_EQ(value("[7MOD4*2]"), "6");
  EXPECT_EQ(value("[[1+2]*3]"), "9");
  EXPECT_EQ(value("[ 1\t+ 2 ]x"), "3 x");
  EXPECT_EQ(value("[-3]"), "-3");
  EXPECT_EQ(value("[+3]"), "3");
  EXPECT_EQ(value("-[3]"), "-3");
  EXPECT_EQ(value("[2*-3]"), "-6");
  EXPECT_EQ(value("[1--2]"), "3");
  EXPECT_EQ(value("[1.5+.25]"), "1.75");
  EXPECT_EQ(value("[0 mod 3]"), "0");
  EXPECT_EQ(value("12X3"), "12 X3");
}

TEST(VerifyExpressions, FunctionsAreInDegrees) {
  EXPECT_EQ(value("SIN[30]"), "0.5");
  EXPECT_EQ(value("COS[60]"), "0.5");
  EXPECT_EQ(value("TAN[45]"), "1");
  EXPECT_EQ(value("ASIN[0.5]"), "30");
  EXPECT_EQ(value("ASIN[1]"), "90");
  EXPECT_EQ(value("ACOS[0.5]"), "60");
  EXPECT_EQ(value("ATAN[1]/[1]"), "45");
  EXPECT_EQ(value("ATAN[0]/[2]"), "0");
  EXPECT_EQ(value("ATAN[2]/[0]"), "90");
  EXPECT_EQ(value("ATAN[1]/[-1]"), "135");
  EXPECT_EQ(value("SQRT[9]"), "3");
  EXPECT_EQ(value("SQRT[0]"), "0");
  EXPECT_EQ(value("ABS[-2]"), "2");
  EXPECT_EQ(value("FIX[2.7]"), "2");
  EXPECT_EQ(value("FUP[2.1]"), "3");
  EXPECT_EQ(value("sin[ 36000 ]"), "0");
  EXPECT_EQ(value("COS[-36000]"), "1");
  EXPECT_EQ(value("SIN[36030]"), "an angle beyond 100 turns");
  EXPECT_EQ(value("TAN[90]"), "TAN of a right angle");
  EXPECT_EQ(value("TAN[89.9]"), "572.957");
  EXPECT_EQ(value("ATAN[0]/[0]"), "ATAN of nothing");
  EXPECT_EQ(value("ATAN[1]"), "ATAN without a second number");
  for (const char* function : {"SQRT", "FIX", "FUP", "ATAN", "ASIN", "ACOS"})
    EXPECT_EQ(value(std::string(function) + "[-1]"), std::string(function) + " of a number below 0");
  EXPECT_EQ(value("ASIN[1.1]"), "ASIN of a number above 1");
  EXPECT_EQ(value("ACOS[1.1]"), "ACOS of a number above 1");
}

TEST(VerifyExpressions, VariablesAreReadWhereTheyWereSet) {
  EXPECT_EQ(value("#1"), "5");
  EXPECT_EQ(value("#100X"), "7 X");
  EXPECT_EQ(value("#<a>"), "3");
  EXPECT_EQ(value("#< _b >"), "4");
  EXPECT_EQ(value("#<\t_b>"), "4");
  EXPECT_EQ(value("##3"), "5");
  EXPECT_EQ(value("#[2+1]"), "1");
  EXPECT_EQ(value("[#1+1]"), "6");
  EXPECT_EQ(value("#2"), "variable #2 is read and was not set");
  EXPECT_EQ(value("#<c>"), "variable #<C> is read and was not set");
  for (const char* number : {"0", "1000", "[1.5]", "[-1]"})
    EXPECT_NE(value("#" + std::string(number)).find("is not one of a program's own"), std::string::npos)
        << number;
  EXPECT_EQ(value("#999"), "variable #999 is read and was not set");
  EXPECT_EQ(value("#<a"), "the name of a variable is not closed");
  EXPECT_EQ(value("#1", true), "a local variable in a subprogram");
  EXPECT_EQ(value("#<a>", true), "a local variable in a subprogram");
  EXPECT_EQ(value("#100", true), "7");
  EXPECT_EQ(value("#<_b>", true), "4");
  EXPECT_EQ(value("#99", true), "a local variable in a subprogram");
}

TEST(VerifyExpressions, WhatIsNotComputedIsSaid) {
  EXPECT_EQ(value("[2**3]"), "powers are not computed");
  EXPECT_EQ(value("[1/0]"), "a division by 0");
  EXPECT_EQ(value("[2000000+1/0]"), "a division by 0");
  EXPECT_EQ(value("[6/*2]"), "an expression without a number");
  EXPECT_EQ(value("SIN"), "an expression without brackets");
  EXPECT_EQ(value("XIN[30]"), "an expression that is not understood");
  EXPECT_EQ(value("[1 MOD"), "an expression without a number");
  EXPECT_EQ(value("[1 MOD 0]"), "a division by 0");
  EXPECT_EQ(value("[-1 MOD 2]"), "MOD of numbers below 0");
  EXPECT_EQ(value("[1 MOD -2]"), "MOD of numbers below 0");
  EXPECT_EQ(value("[1+]"), "an expression without a number");
  EXPECT_EQ(value("[1"), "an expression that is not understood");
  EXPECT_EQ(value("[1 2]"), "an expression that is not understood");
  EXPECT_EQ(value("[X]"), "an expression that is not understood");
  EXPECT_EQ(value("SIN 3"), "an expression without brackets");
  EXPECT_EQ(value("[1.2.3]"), "an expression without a number");
  EXPECT_EQ(value("1000000"), "1e+06");
  EXPECT_EQ(value("[1000000+1]"), "an expression is beyond 1000000");
  EXPECT_EQ(value("[-1000000-1]"), "an expression is beyond 1000000");
  EXPECT_EQ(value("[2*1000000-1000000]"), "1e+06");
}

TEST(VerifyExpressions, TheyNestTo40Deep) {
  const auto times = [](const std::string& open, const std::string& close, int count,
                        const std::string& core) {
    std::string text = core;
    for (int k = 0; k < count; ++k) text = open + text + close;
    return value(text);
  };
  const std::string deep = "an expression is nested too deeply";
  EXPECT_EQ(times("[", "]", 20, "1"), "1");
  EXPECT_EQ(times("[", "]", 21, "1"), deep);
  EXPECT_EQ(times("-", "", 40, "1"), "1");
  EXPECT_EQ(times("-", "", 41, "1"), deep);
  EXPECT_EQ(times("#", "", 40, "3").find("deeply"), std::string::npos);
  EXPECT_EQ(times("#", "", 41, "3"), deep);
  // What was deep before does not count any more.
  std::string sum = "[0";
  for (int k = 0; k < 50; ++k) sum += "+[1]+-1+#3";
  EXPECT_EQ(value(sum + "]"), "50");
}

TEST(VerifyExpressions, AnAssignmentStandsAlone) {
  const auto set = [](const std::string& text, bool globals_only = false) {
    NcVariables variables = kSet;
    std::string complaint;
    const bool done = assign(text, variables, globals_only, complaint);
    EXPECT_EQ(done, complaint.empty());
    std::string all = complaint;
    for (const auto& [key, number] : variables)
      if (!kSet.contains(key) || kSet.at(key) != number) all += key + "=" + fmt::format("{:g}", number);
    return all;
  };
  EXPECT_EQ(set("#2=3"), "2=3");
  EXPECT_EQ(set(" #2 = #1 + 3 "), "2=8");
  EXPECT_EQ(set("#<n> = 2*3"), "<N>=6");
  EXPECT_EQ(set("#1=6"), "1=6");
  EXPECT_EQ(set("##3=9"), "1=9");
  const std::string alone = "a variable that is neither set alone nor used as a number";
  EXPECT_EQ(set("#2"), alone);
  EXPECT_EQ(set("#2=3 X1"), alone);
  EXPECT_EQ(set("#2=3]"), alone);
  EXPECT_EQ(set("#2=[1/0]"), "a division by 0");
  EXPECT_EQ(set("#2=[1/0] X1"), "a division by 0");
  EXPECT_EQ(set("#<n = 3"), "the name of a variable is not closed");
  EXPECT_EQ(set("#<_feed> = 3"), "the control alone sets <_FEED>");
  EXPECT_EQ(set("#2=1000001"), "an expression is beyond 1000000");
  EXPECT_EQ(set("#2=3", true), "a local variable in a subprogram");
  EXPECT_EQ(set("#102=3", true), "102=3");
}

// ---- the order of lines -----------------------------------------------------------------------------------

/// The numbers of the lines as they run, "s" in subprograms, "-" for a call; or the complaint.
std::string run(const std::string& program, words::Control control = words::Control::linuxcnc) {
  const auto lines = lines_in_order({"p.nc", program}, control);
  if (!lines) return lines.error().message;
  std::string text;
  for (const NcLine& line : *lines)
    text +=
        std::to_string(line.number) + (line.in_subprogram ? "s" : "") + (line.text.empty() ? "-" : "") + " ";
  return text;
}

TEST(VerifyFlow, WithoutCallsLinesStandAsTheyAre) {
  EXPECT_EQ(run("G0 X1\nG1 X2\nM2\nX3"), "1 2 3 4 ");
  EXPECT_EQ(run("O1 SUB\nX1\nO1 ENDSUB\n"), "1 2 3 ");
  EXPECT_EQ(run(""), "");
}

TEST(VerifyFlow, SubprogramsRunWhereTheyAreCalled) {
  EXPECT_EQ(run("G0 X1\nM98 P7\nX2\nM30\nO7\nX3\nX4\nM99\n"), "1 2- 6s 7s 3 4 ");
  EXPECT_EQ(run("G0 X1\nm98 p07 l2\nM2\nO0007\nX3\nM99\n%\n"), "1 2- 5s 5s 3 7 ");
  EXPECT_EQ(run("G0 X1\nN5 M98 P7 (call)\nM2\nN9 O7\nX3\nN10 M99\n"), "1 2 5s 3 ");
  EXPECT_EQ(run("G0 X1\nM97 P50 L2\nM30\nN050 X3\nX4\nM99\n", words::Control::haas), "1 2- 4s 5s 4s 5s 3 ");
  EXPECT_EQ(run("o100 sub\nX1\no100 endsub\nG0 X9\no100 call\nM2\n"), "4 5- 2s 6 ");
  EXPECT_EQ(run("o<in> sub\nX1\no<in> endsub\nG0 X9\no<in> call\nM2\n"), "4 5- 2s 6 ");
  EXPECT_EQ(run("%\nO1 (main)\nM98 P2\nM30\nO2\nM98 P3\nX5\nM99\nO3\nX6\nM99\n%"), "1 2 3- 6- 10s 7s 4 12 ");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM30\nX9\nX10\nO7\nX3\nM99\n"), "1 2- 7s 3 ");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM02\nX9\nO7\nX3\nM99\n"), "1 2- 6s 3 ");
  EXPECT_EQ(run("G0 X1\nM98\tP7\nM30\n\nO7\nX3\nM99\n"), "1 2- 6s 3 ");
  // The number of the program itself opens no subprogram, and a word that ends as one does opens none.
  EXPECT_EQ(run("\nO1\nG0 X1\nM98 P7\nM30\nO7\nX3\nM99\n"), "1- 2 3 4- 7s 5 ");
  EXPECT_EQ(run("O7 ENDSUB\nG0 SUB\nM98 P7\nM30\nO7\nX3\nM99\n"), "1 2 3- 6s 4 ");
  EXPECT_EQ(run("G0 CALL\n"), "1 ");
}

TEST(VerifyFlow, CallsThatAreNotUnderstoodAreRefusedWithTheirLine) {
  const std::string tail = "\nM30\nO7\nX3\nM99\n", none = "a subprogram that is not in this file";
  EXPECT_EQ(run("G0 X1\nM98 P8" + tail), "p.nc:2: " + none);
  EXPECT_EQ(run("G0 X1\nM98" + tail), "p.nc:2: " + none);
  EXPECT_EQ(run("G0 X1\nM97" + tail, words::Control::haas), "p.nc:2: a call without P");
  EXPECT_EQ(run("G0 X1\nM97 P8\nM30\nN8 X1\n", words::Control::haas), "p.nc:2: a subprogram without an end");
  EXPECT_EQ(run("G0 X1\nM97 P8" + tail), "p.nc:2: M97 is no word of this control");
  EXPECT_EQ(run("G0 X1\nO9 CALL" + tail), "p.nc:2: " + none);
  EXPECT_EQ(run("G0 X1\nM98 P7 X2" + tail), "p.nc:2: a call beside other words");
  EXPECT_EQ(run("G0 X1\nG1 M98 P7" + tail), "p.nc:2: a call beside other words");
  EXPECT_EQ(run("G0 X1\n) M98 P7" + tail), "p.nc:2: a call beside other words");
  EXPECT_EQ(run("G0 X1\nM98 (a; b) P7" + tail), "p.nc:2: a comment before the words of a call");
  EXPECT_EQ(run("G0 X1\nO<7 CALL" + tail), "p.nc:2: " + none);
  const std::string times = "p.nc:2: a call that is repeated L times is not understood";
  for (const char* l : {"L0", "L10000", "L99999", "L99999999999999999999", "L"})
    EXPECT_EQ(run("G0 X1\nM98 P7 " + std::string(l) + tail), times) << l;
  EXPECT_EQ(run("G0 X1\nM98 P7 L9999" + tail).substr(0, 12), "1 2- 5s 5s 5");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM99" + tail), "p.nc:3: M99 outside a subprogram");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM30\nO7\nX3\n"), "p.nc:4: a subprogram without an end");
  EXPECT_EQ(run("O7 SUB\nX1\nO8 ENDSUB\nO7 CALL\n"), "p.nc:1: a subprogram without an end");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM30\nO7\nX3\nM2\nM99\n"), "p.nc:6: the program ends in a subprogram");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM30\nO7\nX3\nM30\nM99\n"), "p.nc:6: the program ends in a subprogram");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM30\nO7\nM98 P7\nM99\n").substr(0, 6), "p.nc:5");
  EXPECT_NE(run("G0 X1\nM98 P7\nM30\nO7\nM98 P7\nM99\n").find("subprograms call each other too deeply"),
            std::string::npos);
}

TEST(VerifyFlow, SubprogramsCallEachOtherTo10Deep) {
  const auto chain = [](int depth) {
    std::string program = "G0 X1\nM98 P1\nM30\n";
    for (int k = 1; k <= depth; ++k)
      program += "O" + std::to_string(k) + "\n" +
                 (k < depth ? "M98 P" + std::to_string(k + 1) : std::string("X5")) + "\nM99\n";
    return run(program);
  };
  EXPECT_EQ(chain(10).find("deeply"), std::string::npos);
  EXPECT_NE(chain(11).find("deeply"), std::string::npos);
}

TEST(VerifyFlow, AProgramRunsNoMoreThanAMillionLines) {
  EXPECT_EQ(run("M98 P7 L9999\nM30\nO7\nM98 P8 L9999\nM99\nO8\nX1\nM99\n"),
            "p.nc:7: the program runs more than a million lines");
  // The call, 9999 times another call and 99 lines, the end, and 98 lines are a million.
  const std::string body = "M30\nO7\nM98 P8 L99\nM99\nO8\nX1\nM99\n";
  std::string lines = "M98 P7 L9999\n";
  for (int k = 0; k < 98; ++k) lines += "X1\n";
  EXPECT_TRUE(lines_in_order({"p.nc", lines + body}, words::Control::linuxcnc));
  EXPECT_EQ(run(lines + "X1\n" + body), "p.nc:101: the program runs more than a million lines");
}

TEST(VerifyFlow, CommentsAndBlanksSayNothing) {
  EXPECT_EQ(run("G0 X1\n M 9 8 P 7 ; M2\nM30\n(O5) O7 \r\nX3\n( M2 ) M99\n"), "1 2 5s 3 ");
  EXPECT_EQ(run("G0 X1\nM98 P7\nM30\nO7\n(M30) X3\n;M2\nM99\n"), "1 2- 5s 6s 3 ");
  EXPECT_EQ(run("G0 X1\nM98 P7 (a (b) ; c)\nM30\nO7\nX3\nM99\n"), "1 2 5s 3 ");
}

}  // namespace
}  // namespace lekalo::verify::verify_expressions_test
