#include "lekalo/nc/work_offset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/nc/decimal.hpp"

namespace lekalo::nc {
namespace {

using Quaternion = std::array<double, 4>;

/// The largest of I, J and K of a tilt, so that decimals of a length say the axis well.
constexpr double kAxisLength = 1000;  // mm

double power_of_ten(int exponent) {
  double power = 1;
  for (int k = 0; k < exponent; ++k) power *= 10;
  return power;
}

/// Returns q of u q: turned first by q and then by u.
Quaternion after(const Quaternion& u, const Quaternion& q) {
  return {u[0] * q[0] - u[1] * q[1] - u[2] * q[2] - u[3] * q[3],
          u[0] * q[1] + u[1] * q[0] + u[2] * q[3] - u[3] * q[2],
          u[0] * q[2] - u[1] * q[3] + u[2] * q[0] + u[3] * q[1],
          u[0] * q[3] + u[1] * q[2] - u[2] * q[1] + u[3] * q[0]};
}

/// Takes the sign off zeros, which would be written.
Quaternion plain_zeros(Quaternion q) {
  for (double& part : q) part += 0.0;
  return q;
}

/// The turn by so many degrees about an axis of length 1.
Quaternion turn_about(const std::array<double, 3>& axis, double degrees) {
  const geom::SinCos half = geom::sincos(0.5 * degrees * kDegree);
  return {half.cosine, half.sine * axis[0], half.sine * axis[1], half.sine * axis[2]};
}

/// Both counts of the last decimal beside an angle; one where it is such a count.
std::vector<long long> beside(double degrees, double power) {
  const double count = degrees * power, low = std::floor(count);
  if (low == count) return {static_cast<long long>(low)};
  return {static_cast<long long>(low), static_cast<long long>(low) + 1};
}

/// Turns about one axis. The vertical is written as 0 0 1.
std::vector<OffsetTurn> turns_about_axis(const Quaternion& q, const OffsetForm& form) {
  const double power = power_of_ten(form.angle_decimals), grid = power_of_ten(form.length_decimals);
  const auto [w, x, y, z] = q;
  const bool upright = x == 0 && y == 0;
  OffsetTurn turn;
  std::array<double, 3> axis{0, 0, 1};
  double degrees = 2 * geom::direction_angle(w, z) * kDegreesPerRadian;
  if (!upright) {
    const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      turn.axis[k] = std::llround(q[k + 1] / largest * kAxisLength * grid);
      axis[k] = static_cast<double>(turn.axis[k]);
      square += axis[k] * axis[k];
    }
    for (double& part : axis) part /= std::sqrt(square);
    degrees = 2 * geom::direction_angle(w, std::sqrt(x * x + y * y + z * z)) * kDegreesPerRadian;
  } else {
    turn.axis = {0, 0, static_cast<long long>(grid)};
  }
  if (degrees > 180) degrees -= 360;
  if (degrees <= -180) degrees += 360;
  std::vector<OffsetTurn> turns;
  for (const long long count : beside(degrees, power)) {
    turn.angles = {count, 0, 0};
    turn.quaternion = plain_zeros(turn_about(axis, static_cast<double>(count) / power));
    turns.push_back(turn);
  }
  return turns;
}

/// Turns about Z, then about the new Y, then about the new X.
std::vector<OffsetTurn> turns_by_rpy(const Quaternion& q, const OffsetForm& form) {
  const double power = power_of_ten(form.angle_decimals);
  const auto [w, x, y, z] = q;
  // The rotation's first column, and the rest of its last row.
  const double xx = w * w + x * x - y * y - z * z, yx = 2 * (x * y + w * z), zx = 2 * (x * z - w * y),
               zy = 2 * (y * z + w * x), zz = w * w - x * x - y * y + z * z;
  const std::array<double, 3> radians{geom::direction_angle(zz, zy),
                                      geom::direction_angle(std::sqrt(xx * xx + yx * yx), -zx),
                                      geom::direction_angle(xx, yx)};
  std::array<std::vector<long long>, 3> counts;
  for (std::size_t k = 0; k < 3; ++k) counts[k] = beside(radians[k] * kDegreesPerRadian, power);
  std::vector<OffsetTurn> turns;
  for (const long long a : counts[0])
    for (const long long b : counts[1])
      for (const long long c : counts[2]) {
        const auto degrees = [&](long long count) { return static_cast<double>(count) / power; };
        const Quaternion made =
            after(turn_about({0, 0, 1}, degrees(c)),
                  after(turn_about({0, 1, 0}, degrees(b)), turn_about({1, 0, 0}, degrees(a))));
        turns.push_back({plain_zeros(made), {a, b, c}});
      }
  return turns;
}

/// Letters, digits, points and dashes: what every control takes in a comment.
std::string plain(std::string_view words) {
  std::string text;
  for (const char c : words) {
    const auto letter = static_cast<unsigned char>(c);
    const bool kept = letter < 128 && (std::isalnum(letter) != 0 || c == '.' || c == '-');
    if (kept) text += static_cast<char>(std::toupper(letter));
    if (!kept && !text.empty() && text.back() != ' ') text += ' ';
  }
  return text;
}

}  // namespace

std::vector<OffsetTurn> written_turns(const std::array<double, 4>& quaternion, const OffsetForm& form) {
  const bool tilted = quaternion[1] != 0 || quaternion[2] != 0;
  if (form.control == OffsetControl::siemens) return turns_by_rpy(quaternion, form);
  if (form.control == OffsetControl::linuxcnc && tilted) return {};
  return turns_about_axis(quaternion, form);
}

std::string offset_lines(const OffsetTurn& turn, const std::array<long long, 3>& shift,
                         const OffsetForm& form, const std::vector<std::string>& sentences) {
  const auto length = [&](long long count) { return format_decimal(count, form.length_decimals); };
  const auto angle = [&](long long count) { return format_decimal(count, form.angle_decimals); };
  const std::string at = fmt::format("X{} Y{} Z{}", length(shift[0]), length(shift[1]), length(shift[2]));
  const bool siemens = form.control == OffsetControl::siemens;
  std::string text;
  for (const std::string& sentence : sentences)
    text += (siemens ? "; " : "(") + plain(sentence) + (siemens ? "\n" : ")\n");
  switch (form.control) {
    case OffsetControl::linuxcnc:
      return text + fmt::format("G21\nG10 L2 P{} {} R{}\n", form.work_offset, at, angle(turn.angles[0]));
    case OffsetControl::fanuc:
      return text + fmt::format("G21 G90 G{}\nG68 {} I{} J{} K{} R{}\n", 53 + form.work_offset, at,
                                length(turn.axis[0]), length(turn.axis[1]), length(turn.axis[2]),
                                angle(turn.angles[0]));
    case OffsetControl::siemens:
      break;
  }
  return text + fmt::format("G71 G{}\nTRANS {}\nAROT X{} Y{} Z{}\n", 53 + form.work_offset, at,
                            angle(turn.angles[0]), angle(turn.angles[1]), angle(turn.angles[2]));
}

}  // namespace lekalo::nc
