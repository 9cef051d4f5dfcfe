#include "lekalo/verify/offset.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "solid_document.hpp"
#include "verify/number/interval.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

constexpr double kSameRotation = 4e-14;

using Rows = std::array<std::array<double, 3>, 3>;

Rows product(const Rows& a, const Rows& b) {
  Rows made{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) made[i][j] += a[i][k] * b[k][j];
  return made;
}

/// Turns by so many degrees about an axis of any length, counter-clockwise for who sees it come.
Rows turn_about(const std::array<double, 3>& axis, double degrees) {
  const RoundedTurn turn = rounded_turn(degrees * kPi / 180);
  const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const std::array<double, 3> n{axis[0] / length, axis[1] / length, axis[2] / length};
  Rows made{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) made[i][j] = (1 - turn.cosine) * n[i] * n[j];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    made[i][i] += turn.cosine;
    made[k][j] += turn.sine * n[i];
    made[j][k] -= turn.sine * n[i];
  }
  return made;
}

Rows rows_of(const std::array<Decimal, 4>& quaternion) {
  const double w = approximate(quaternion[0]), x = approximate(quaternion[1]), y = approximate(quaternion[2]),
               z = approximate(quaternion[3]), k = 2 / (w * w + x * x + y * y + z * z);
  return {{{1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)},
           {k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)},
           {k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)}}};
}

/// The numbers of lines that are these words, in which `#` stands for a number; comments do not count.
std::optional<std::vector<Decimal>> numbers_of(std::string_view text, std::string_view wanted, bool siemens) {
  std::string code;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const bool comment =
        siemens ? line.starts_with(';') : line.starts_with('(') && line.find(')') == line.size() - 1;
    if (!comment) code += std::string(line) + "\n";
  }
  std::vector<Decimal> numbers;
  std::string_view rest = code;
  for (const char c : wanted) {
    if (c != '#') {
      if (!rest.starts_with(c)) return std::nullopt;
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t end = std::min(rest.find_first_not_of("0123456789.-"), rest.size());
    auto number = parse_decimal(rest.substr(0, end));
    if (!number) return std::nullopt;
    numbers.push_back(*std::move(number));
    rest.remove_prefix(end);
  }
  if (!rest.empty()) return std::nullopt;
  return numbers;
}

/// The claims of a result about its lines.
struct Claim {
  std::string control;
  std::size_t axes = 0, work_offset = 0;
  OffsetFile file;
};

std::optional<Claim> claim_of(Json result, std::string& complaint) {
  const Json written = Fields(result, "", complaint).get("offset");
  if (!written.is_object()) return std::nullopt;
  Fields fields(written, "offset", complaint);
  Claim claim{fields.text("control"), fields.index("axes"), fields.index("work_offset"), {}};
  Fields file(fields.get("output"), "offset.output", complaint);
  claim.file = {file.text("path"), file.text("sha256")};
  return claim;
}

Result<std::optional<Claim>> claim_of(const Document& result) {
  LEKALO_TRY(const Json root, parse_json(result.bytes, result.name));
  std::string complaint;
  std::optional<Claim> claim = claim_of(root, complaint);
  if (!complaint.empty()) return failure(ErrorCode::bad_input, fmt::format("{}: {}", result.name, complaint));
  return claim;
}

std::optional<std::string> fault_of(std::string_view lines, const Claim& claim, const SolidPose& pose) {
  const auto& q = pose.quaternion;
  const bool linuxcnc = claim.control == "linuxcnc", fanuc = claim.control == "fanuc",
             siemens = claim.control == "siemens";
  if (!linuxcnc && !fanuc && !siemens) return "there is no such control";
  if (claim.axes != 3 && claim.axes != 5) return "a machine has 3 axes or 5";
  if (claim.work_offset < 1 || claim.work_offset > (linuxcnc ? 9U : fanuc ? 6U : 4U))
    return "the control has no such work offset";
  if ((claim.axes == 3 || linuxcnc) && (sgn(q[1].digits) != 0 || sgn(q[2].digits) != 0))
    return "the part lies tilted, which its axes, or its words, cannot follow";
  const std::size_t code = 53 + claim.work_offset;
  const std::string wanted = linuxcnc ? fmt::format("G21\nG10 L2 P{} X# Y# Z# R#\n", claim.work_offset)
                             : fanuc  ? fmt::format("G21 G90 G{}\nG68 X# Y# Z# I# J# K# R#\n", code)
                                      : fmt::format("G71 G{}\nTRANS X# Y# Z#\nAROT X# Y# Z#\n", code);
  const auto n = numbers_of(lines, wanted, siemens);
  if (!n) return fmt::format("its lines are not the words of {} for it", claim.control);
  for (std::size_t k = 0; k < 3; ++k)
    if (compare((*n)[k], pose.shift[k]) != 0)
      return fmt::format("it shifts by {} along {}, and the part lies at {}", approximate((*n)[k]), "xyz"[k],
                         approximate(pose.shift[k]));
  const auto number = [&](std::size_t k) { return approximate((*n)[k]); };
  Rows made{};
  if (linuxcnc) made = turn_about({0, 0, 1}, number(3));
  if (fanuc) made = turn_about({number(3), number(4), number(5)}, number(6));
  // Siemens turns about Z first, then about the new Y, then about the new X.
  if (siemens)
    made = product(turn_about({0, 0, 1}, number(5)),
                   product(turn_about({0, 1, 0}, number(4)), turn_about({1, 0, 0}, number(3))));
  const Rows wanted_rows = rows_of(q);
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double apart = std::abs(made[i][j] - wanted_rows[i][j]);
      off = apart <= off ? off : apart;
    }
  if (!(off <= kSameRotation)) return fmt::format("its rotation is {:.3g} off that of the part", off);
  return std::nullopt;
}

}  // namespace

Result<std::optional<OffsetFile>> offset_file(const Document& result) {
  LEKALO_TRY(const std::optional<Claim> claim, claim_of(result));
  return claim ? std::optional(claim->file) : std::nullopt;
}

Result<std::optional<std::string>> fault_of_offset(const Document& result, const Document& lines) {
  LEKALO_TRY(const std::optional<Claim> claim, claim_of(result));
  LEKALO_TRY(const Json root, parse_json(result.bytes, result.name));
  LEKALO_TRY(const SolidDocument document, read_solid_document(root, result.name));
  return fault_of(lines.bytes, *claim, document.pose);
}

}  // namespace lekalo::verify
