#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter.hpp"
#include "plane.hpp"

namespace lekalo::nc {

/// A rewritten number has this many decimals at least, in millimetres and inches alike.
inline constexpr int kLeastDecimals = 5;

/// The program, its meaning and the pose, for each mode (steps 5a to 5c of docs/design/nc-rewrite.md).
struct RewriteJob {
  std::string_view text;
  const std::string& name;
  const Program& program;
  const Interpretation& interpretation;
  const RigidMotion& machine_from_part;
  double theta = 0;
  const RewriteOptions& options;
  words::Control control = words::Control::linuxcnc;
};

[[nodiscard]] Result<Rewritten> rewrite_coordinates(const RewriteJob& job);
[[nodiscard]] Result<Rewritten> insert_offset(const RewriteJob& job);
[[nodiscard]] Result<Rewritten> insert_g68(const RewriteJob& job);

/// The axes along which the pose shifts, for sentences.
[[nodiscard]] inline const char* shifted_axes(const RewriteOptions& options) noexcept {
  return options.z ? "X, Y and Z" : "X and Y";
}

/// The shift along Z as whole steps, and what it loses by that.
struct RoundedHeight {
  Grains shift = 0;
  double lost_mm = 0;
};
[[nodiscard]] RoundedHeight rounded_height(double z_mm, Grains step) noexcept;

/// Bounds the distance that an error in the plane and one along Z make together.
[[nodiscard]] double with_height(double plane_mm, double height_mm) noexcept;

/// `length` bytes at `at` give way to `text`.
struct Edit {
  std::size_t at = 0, length = 0;
  std::string text;
};

/// The text with the edits made. At one place insertions come first, in the order given, then what gives way
/// there.
[[nodiscard]] std::string apply_edits(std::string_view text, std::vector<Edit> edits);

/// Raises a bound, so that it stays one after the few roundings of its own computation.
[[nodiscard]] constexpr double rounded_up(double bound) noexcept { return bound * (1 + 1e-12); }

}  // namespace lekalo::nc
