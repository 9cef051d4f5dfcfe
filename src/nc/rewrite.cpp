#include "lekalo/nc/rewrite.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/geom/trig.hpp"
#include "modes.hpp"

namespace lekalo::nc {
namespace {

constexpr double kLargestShift = 1e6;  // mm

Result<void> check_request(const std::string& name, double x, double y, double theta,
                           const RewriteOptions& options) {
  const auto wrong = [&](const std::string& what) {
    return failure(ErrorCode::usage, fmt::format("{}: {}", name, what));
  };
  if (!(std::abs(x) <= kLargestShift && std::abs(y) <= kLargestShift))
    return wrong(fmt::format("the shift ({}, {}) is not within {} mm", x, y, kLargestShift));
  if (!(std::abs(theta) <= geom::kMaxAngle))
    return wrong(fmt::format("the angle {} is not within {} rad", theta, geom::kMaxAngle));
  if (options.work_offset < 1 || options.work_offset > 9)
    return wrong(fmt::format("work offset {} is none of 1 (G54) to 9 (G59.3)", options.work_offset));
  if (options.g68_angle_decimals < 0 || options.g68_angle_decimals > 9)
    return wrong(fmt::format("{} decimals of a degree are not 0 to 9", options.g68_angle_decimals));
  return {};
}

Result<Rewritten> run_mode(const RewriteJob& job) {
  switch (job.options.mode) {
    case RewriteMode::coordinates:
      return rewrite_coordinates(job);
    case RewriteMode::offset:
      return insert_offset(job);
    case RewriteMode::g68:
      return insert_g68(job);
  }
  return failure(ErrorCode::usage, job.name + ": no such rewrite mode");
}

}  // namespace

std::string apply_edits(std::string_view text, std::vector<Edit> edits) {
  std::ranges::stable_sort(edits, {}, [](const Edit& edit) { return std::pair(edit.at, edit.length); });
  std::string result;
  std::size_t done = 0;
  for (const Edit& edit : edits) {
    result += text.substr(done, edit.at - done);
    result += edit.text;
    done = edit.at + edit.length;
  }
  result += text.substr(done);
  return result;
}

Result<Rewritten> rewrite_program(std::string_view text, const std::string& name, double x, double y,
                                  double theta, const RewriteOptions& options) {
  // The steps of docs/design/nc-rewrite.md.
  LEKALO_CHECK(check_request(name, x, y, theta, options));                             // 1
  LEKALO_TRY(const Program program, parse_program(text, name));                        // 2
  LEKALO_TRY(const Interpretation interpretation, interpret(program, name, options));  // 3
  const RigidMotion machine_from_part(x, y, theta);                                    // 4
  const RewriteJob job{text, name, program, interpretation, machine_from_part, theta, options};
  LEKALO_TRY(Rewritten result, run_mode(job));  // 5
  // 6. What the mode has to say comes first.
  result.notes.insert(result.notes.end(), interpretation.notes.begin(), interpretation.notes.end());
  return result;
}

}  // namespace lekalo::nc
