#pragma once

#include <array>
#include <optional>
#include <string>

#include "solid_document.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {

/// A box of poses (t, x): the place t of the pivot in the blank's frame, and the rotation, which is that of
/// the quaternion (1, x) after another one. The order of the six is x, y, z of t, then of x.
struct PoseBox {
  std::array<Both, 6> low, high;
};

/// The charts of the window: a tree each covers one of them. The rotations of chart 0 are counted from the
/// start's, those of chart 1, 2 or 3 from it and half a turn about x, y or z after it. All rotations take
/// four charts with |x_i| <= 1, and all turns about z take 0 and 3: a rotation is in that of the largest part
/// of its quaternion after the start's.
[[nodiscard]] std::vector<std::size_t> charts_of(const SolidWindow& window);

/// Says what of a chart is not within a box of poses whose rotations are counted from `start`, or nothing
/// where it is all there. Exact, but for the tangent, which is rounded up.
[[nodiscard]] std::optional<std::string> beyond_box(const SolidWindow& window, std::size_t chart,
                                                    const PoseBox& box, const std::array<Decimal, 4>& start);

/// Says how a pose leaves the window, or nothing. What is rounded by whoever writes it may be off by 4e-15 of
/// the numbers that it comes from; without a turn the rotation is exactly that of the start.
[[nodiscard]] std::optional<std::string> off_window(const SolidWindow& window, const SolidPose& pose);

}  // namespace lekalo::verify
