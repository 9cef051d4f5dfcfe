#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "grid_outline.hpp"

namespace lekalo::verify {

/// Written numbers on the grid of docs/design/layout.md.

enum class ToStep {
  nearest,  ///< ties to even
  up        ///< gaps
};
/// Returns the length in steps, or nothing when |mm| is above `most` mm.
[[nodiscard]] std::optional<std::int64_t> steps_of(double mm, ToStep how, double most);

/// A rotation in multiples of 2^-52.
struct GridTurn {
  std::int64_t c = 0, s = 0;
  friend bool operator==(const GridTurn&, const GridTurn&) = default;
};

/// Returns nothing when c^2 + s^2 is not within 2^-50 of 1.
/// \pre neither is beyond limits::kLargestSine
[[nodiscard]] std::optional<GridTurn> turn_of_pair(double c, double s);
/// Returns the multiples that are proved to be nearest to the cosine and the sine.
/// \pre degrees is finite
[[nodiscard]] GridTurn turn_of_degrees(double degrees);
/// The answer says whether the direction of `turn` lies counter-clockwise from that of `from` to that of
/// `to`, ends included; equal ends are one direction.
[[nodiscard]] bool lies_between(GridTurn turn, GridTurn from, GridTurn to);

/// Returns the place of a part's vertex on the sheet (rule 4 of docs/design/layout.md).
[[nodiscard]] GridPoint placed(GridPoint p, GridTurn turn, bool mirrored, GridPoint at);

}  // namespace lekalo::verify
