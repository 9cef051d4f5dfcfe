// Any bytes as a program, in any mode, at a pose taken from the first bytes. What is not refused must keep
// its lines, be accepted again, and come back within the stated bounds under the inverse pose.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "lekalo/nc/rewrite.hpp"
#include "nc/unfold.hpp"
#include "require.hpp"
#include "support/rs274_reader.hpp"

namespace {

using namespace lekalo::nc;

std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

struct Pose {
  double x = 0, y = 0, theta = 0;
};

Pose pose_of(const std::uint8_t* bytes) {
  const auto number = [&](int at) {
    return static_cast<double>(bytes[at]) + static_cast<double>(bytes[at + 1]) / 256;
  };
  Pose pose{number(0) - 128, number(2) - 128, (number(4) - 128) / 20};
  if (bytes[4] % 8 == 0) pose.theta = 0;
  return pose;
}

void check_refusal(const lekalo::Error& error) {
  require(error.code == lekalo::ErrorCode::program_refused || error.code == lekalo::ErrorCode::usage);
  if (error.code == lekalo::ErrorCode::usage) return;
  require(error.message.rfind("f:", 0) == 0 && std::atoi(error.message.c_str() + 2) > 0);
}

/// Points of the path carried by the pose, those of the first program against those of the second.
void check_path(const std::string& before, const std::string& after, const Pose& pose, double bound) {
  const auto original = rs274::Reader().read(before), written = rs274::Reader().read(after);
  rs274::Real largest = 1;
  for (const rs274::Step& step : original)
    for (const rs274::Point p : {step.to, step.centre})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const rs274::Real off =
      rs274::deviation(original, written, rs274::Motion::turned(pose.x, pose.y, pose.theta));
  require(off >= 0);
  // The reader sums in long double; a centre by radius loses half of its digits near the half circle.
  require(off <= bound + 1e-8L * largest);
}

void check_coordinates(const std::string& program, const Pose& pose) {
  const auto there = rewrite_program(program, "f", pose.x, pose.y, pose.theta, {});
  if (!there) return check_refusal(there.error());
  require(there->rounding_mm >= 0 && std::isfinite(there->rounding_mm));
  require(lines(there->program) == lines(program));
  check_path(program, there->program, pose, there->rounding_mm);

  const double cosine = std::cos(pose.theta), sine = std::sin(pose.theta);
  const Pose inverse{-(cosine * pose.x + sine * pose.y), sine * pose.x - cosine * pose.y, -pose.theta};
  const auto back = rewrite_program(there->program, "f", inverse.x, inverse.y, inverse.theta, {});
  if (!back) return check_refusal(back.error());  // at the edge of what is accepted, as radii that just agree
  check_path(program, back->program, {}, there->rounding_mm + back->rounding_mm);
}

void check_inserting(const std::string& program, const Pose& pose, RewriteMode mode) {
  RewriteOptions options;
  options.mode = mode;
  const auto result = rewrite_program(program, "f", pose.x, pose.y, pose.theta, options);
  if (!result) return check_refusal(result.error());
  const std::ptrdiff_t added = lines(result->program) - lines(program);
  require(added == (result->motions == 0 ? 0 : mode == RewriteMode::offset ? 1 : 4));
  check_path(program, result->program, result->motions == 0 ? Pose{} : pose, result->rounding_mm);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHead = 7;
  if (size < kHead) return 0;
  const Pose pose = pose_of(data);
  const std::string program(reinterpret_cast<const char*>(data) + kHead, size - kHead);
  // Subprograms and expressions are written out first, and what stands behind the end goes then.
  const auto flat = unfold(program);
  if (!flat) return 0;
  switch (data[6] % 4) {
    case 0:
      check_inserting(flat->text, pose, RewriteMode::offset);
      break;
    case 1:
      check_inserting(flat->text, pose, RewriteMode::g68);
      break;
    default:
      check_coordinates(flat->text, pose);
      break;
  }
  return 0;
}
