// The words of controls for a work offset, held against what their manuals say: every rule here is read anew
// from the section that is quoted.

#include "lekalo/nc/work_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

namespace lekalo::nc::nc_work_offset_test {
namespace {

using Real = long double;
using Rows = std::array<std::array<Real, 3>, 3>;

constexpr Real kDegrees = 0.017453292519943295769236907684886127L;

Rows times(const Rows& a, const Rows& b) {
  Rows made{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) made[i][j] += a[i][k] * b[k][j];
  return made;
}

/// The matrix of FANUC Series 16i/18i, Three dimensional coordinate conversion, A-60545-E, 2.3: a turn by
/// `degrees` about the vector (i, j, k).
Rows fanuc_matrix(Real i, Real j, Real k, Real degrees) {
  const Real p = std::sqrt(i * i + j * j + k * k), n1 = i / p, n2 = j / p, n3 = k / p;
  const Real c = std::cos(degrees * kDegrees), s = std::sin(degrees * kDegrees);
  return {{{n1 * n1 + (1 - n1 * n1) * c, n1 * n2 * (1 - c) - n3 * s, n1 * n3 * (1 - c) + n2 * s},
           {n1 * n2 * (1 - c) + n3 * s, n2 * n2 + (1 - n2 * n2) * c, n2 * n3 * (1 - c) - n1 * s},
           {n1 * n3 * (1 - c) - n2 * s, n2 * n3 * (1 - c) + n1 * s, n3 * n3 + (1 - n3 * n3) * c}}};
}

/// SINUMERIK 840D sl / 828D Programming Manual Fundamentals 09/2011, 12.4, page 357: about the 3rd geometry
/// axis, then about the 2nd as it lies then, then about the 1st.
Rows siemens_matrix(Real x, Real y, Real z) {
  return times(fanuc_matrix(0, 0, 1, z), times(fanuc_matrix(0, 1, 0, y), fanuc_matrix(1, 0, 0, x)));
}

Rows rows_of(const std::array<double, 4>& q) {
  const Real w = q[0], x = q[1], y = q[2], z = q[3], k = 2 / (w * w + x * x + y * y + z * z);
  return {{{1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)},
           {k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)},
           {k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)}}};
}

double apart(const Rows& a, const Rows& b) {
  Real most = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(a[i][j] - b[i][j]));
  return static_cast<double>(most);
}

/// The numbers of the lines behind these letters, from the first one that begins with `word`.
std::vector<Real> numbers_of(const std::string& lines, const std::string& word, const std::string& letters) {
  std::vector<Real> numbers;
  std::size_t at = lines.find(word);
  for (const char letter : letters) {
    at = lines.find(letter, lines.find(' ', at));
    numbers.push_back(std::strtold(lines.c_str() + at + 1, nullptr));
  }
  return numbers;
}

/// The rotation that the lines make, by the manual.
Rows read(const std::string& lines, OffsetControl control) {
  if (control == OffsetControl::siemens) {
    const auto n = numbers_of(lines, "AROT", "XYZ");
    return siemens_matrix(n[0], n[1], n[2]);
  }
  if (control == OffsetControl::linuxcnc) return fanuc_matrix(0, 0, 1, numbers_of(lines, "G10 L2", "R")[0]);
  const auto n = numbers_of(lines, "G68", "IJKR");
  return fanuc_matrix(n[0], n[1], n[2], n[3]);
}

std::array<double, 4> turned(double x, double y, double z, double degrees) {
  const double half = 0.5 * degrees * static_cast<double>(kDegrees), p = std::sqrt(x * x + y * y + z * z),
               s = std::sin(half) / p;
  return {std::cos(half), s * x, s * y, s * z};
}

std::array<double, 4> after(const std::array<double, 4>& u, const std::array<double, 4>& q) {
  return {u[0] * q[0] - u[1] * q[1] - u[2] * q[2] - u[3] * q[3],
          u[0] * q[1] + u[1] * q[0] + u[2] * q[3] - u[3] * q[2],
          u[0] * q[2] - u[1] * q[3] + u[2] * q[0] + u[3] * q[1],
          u[0] * q[3] + u[1] * q[2] - u[2] * q[1] + u[3] * q[0]};
}

std::string nearest_lines(const std::array<double, 4>& q, const OffsetForm& form,
                          std::array<long long, 3> shift = {}) {
  const auto turns = written_turns(q, form);
  const OffsetTurn* best = nullptr;
  double least = 9;
  for (const OffsetTurn& turn : turns) {
    const double off = apart(rows_of(turn.quaternion), rows_of(q));
    if (off < least) least = off, best = &turn;
  }
  return best == nullptr ? "" : offset_lines(*best, shift, form, {});
}

TEST(NcWorkOffset, LinuxcncSetsAnOriginAndATurnAboutZ) {
  // G-code reference, G10 L2, its example line: G10 L2 P1 X3.5 Y17.2.
  EXPECT_EQ(nearest_lines({1, 0, 0, 0}, {.length_decimals = 1}, {35, 172, 0}),
            "G21\nG10 L2 P1 X3.5 Y17.2 Z0.0 R0.000\n");
  EXPECT_EQ(nearest_lines(turned(0, 0, 1, -30), {.work_offset = 9}, {-1, 0, 2500}),
            "G21\nG10 L2 P9 X-0.001 Y0.000 Z2.500 R-30.000\n");
  EXPECT_TRUE(written_turns(turned(1, 0, 0, 1), {}).empty());
}

/// B-62764EN/01, section 14, page 243: the system of `G68 Xx0 Yy0 Zz0 I0 J0 K1 Ra` and then `G68 I1 J0 K0 Rb`
/// has its origin at (x0, y0, z0) and is turned about Z by a, and then about the new X by b.
TEST(NcWorkOffset, FanucTurnsAboutAVectorAsTheExampleOfItsManualDoes) {
  const OffsetForm form{.control = OffsetControl::fanuc};
  EXPECT_EQ(nearest_lines(turned(0, 0, 1, 40), form, {1000, 2000, 3000}),
            "G21 G90 G54\nG68 X1.000 Y2.000 Z3.000 I0.000 J0.000 K1.000 R40.000\n");
  EXPECT_EQ(nearest_lines(turned(1, 0, 0, 25), form),
            "G21 G90 G54\nG68 X0.000 Y0.000 Z0.000 I1000.000 J0.000 "
            "K0.000 R25.000\n");
  for (const auto& [alpha, beta] : {std::pair{30.0, 15.0}, {-120.0, 4.0}, {90.0, 90.0}}) {
    const Rows example = times(fanuc_matrix(0, 0, 1, alpha), fanuc_matrix(1, 0, 0, beta));
    const std::string lines = nearest_lines(after(turned(0, 0, 1, alpha), turned(1, 0, 0, beta)), form);
    EXPECT_LE(apart(read(lines, form.control), example), 1e-5) << lines;
  }
}

/// 12.4, page 357, and SINUMERIK 840D Programming Guide Advanced 04.00, 7.1, Programming in RPY angles, whose
/// picture has C2 = 90 about Z, then B2 = +45 about the turned Y, then A2 = 30 about the turned X.
TEST(NcWorkOffset, SiemensTurnsAboutZThenYThenX) {
  const OffsetForm form{.control = OffsetControl::siemens, .work_offset = 2};
  const auto q = after(turned(0, 0, 1, 90), after(turned(0, 1, 0, 45), turned(1, 0, 0, 30)));
  const std::string lines = nearest_lines(q, form, {10000, 10000, 10000});
  // Programming Manual NC programming 12/2019, 2.12, its example: N50 TRANS X10 Y10 Z10.
  EXPECT_EQ(lines, "G71 G55\nTRANS X10.000 Y10.000 Z10.000\nAROT X30.000 Y45.000 Z90.000\n");
  EXPECT_LE(apart(siemens_matrix(30, 45, 90), rows_of(q)), 1e-14);
}

TEST(NcWorkOffset, RotationsOfAllControlsComeBackWithinTheWrittenDecimals) {
  Random random(cases::seed(), 7700);
  for (std::size_t k = 0; k < cases::case_count(400); ++k) {
    OffsetForm form{.control = static_cast<OffsetControl>(k % 3)};
    form.angle_decimals = static_cast<int>(random.below(6)),
    form.length_decimals = static_cast<int>(random.below(6));
    const bool upright = form.control == OffsetControl::linuxcnc || random.below(4) == 0;
    const double x = upright ? 0 : random.uniform(-1, 1), y = upright ? 0 : random.uniform(-1, 1);
    const double angle = random.below(3) == 0 ? random.uniform(-1e-3, 1e-3) : random.uniform(-180, 180);
    const auto q = turned(x, y, upright ? 1 : random.uniform(-1, 1), angle);
    const auto turns = written_turns(q, form);
    ASSERT_FALSE(turns.empty());
    ASSERT_LE(turns.size(), 8U);
    const double step = std::pow(10, -form.angle_decimals) * static_cast<double>(kDegrees);
    for (const OffsetTurn& turn : turns) {
      const std::string lines = offset_lines(turn, {1, -2, 3}, form, {"A (strange) name; 1.5"});
      EXPECT_LE(apart(read(lines, form.control), rows_of(turn.quaternion)), 4e-15) << lines;
      // Three angles are off by less than a step each, and an axis by half its last decimal of 1000 mm.
      const double axis = 1e-3 * std::pow(10, -form.length_decimals) * 4;
      EXPECT_LE(apart(rows_of(turn.quaternion), rows_of(q)), 3 * step + axis) << lines;
    }
  }
}

TEST(NcWorkOffset, ACommentHoldsNothingThatActs) {
  const OffsetTurn none;
  EXPECT_EQ(offset_lines(none, {}, {.length_decimals = 0}, {"a)b;c\n(d"}).substr(0, 12), "(A B C D)\nG2");
  EXPECT_EQ(offset_lines(none, {}, {.control = OffsetControl::siemens}, {"x\ny"}).substr(0, 6), "; X Y\n");
}

}  // namespace
}  // namespace lekalo::nc::nc_work_offset_test
