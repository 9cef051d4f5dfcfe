#pragma once

#include <array>
#include <cstddef>
#include <gp_XYZ.hxx>
#include <vector>

namespace lekalo::step {

/// Control points of w (S - L): a rational patch S less what is flat, times its weight w, and w itself as the
/// last number. Its points are weighed means of these, so none is farther off than the farthest of them.
using NetPoint = std::array<double, 4>;

/// Over a triangle, of degree n: the point of i, j, k (i + j + k = n) at place(j + k, k).
struct TriangleNet {
  std::size_t degree = 0;
  std::vector<NetPoint> points;
  [[nodiscard]] static std::size_t place(std::size_t not_first, std::size_t third) noexcept {
    return not_first * (not_first + 1) / 2 + third;
  }
};

/// Over a box, row by row.
struct BoxNet {
  std::size_t rows = 0, columns = 0;
  std::vector<NetPoint> points;
};

/// The net of a patch over a triangle less its flat one.
/// \param patch    (p + 1) rows of (q + 1) control points times their weights, and the weights
/// \param u, v     the triangle's corners in the parameters of the patch
/// \param flat     what is taken off at the corners
[[nodiscard]] TriangleNet net_over(const std::vector<NetPoint>& patch, std::size_t columns,
                                   const std::array<double, 3>& u, const std::array<double, 3>& v,
                                   const std::array<gp_XYZ, 3>& flat);

/// The net of a patch less what is bilinear.
/// \param corners  what is taken off at the first and the last of the first row, and of the last one
[[nodiscard]] BoxNet net_over(const std::vector<NetPoint>& patch, std::size_t columns,
                              const std::array<gp_XYZ, 4>& corners);

/// No vector of the nets is longer than this. They are halved until it is not above `enough`, or near to the
/// longest that was met, or nothing is gained. Infinite where a weight is not above 0.
[[nodiscard]] double farthest(std::vector<TriangleNet> nets, double enough);
[[nodiscard]] double farthest(std::vector<BoxNet> nets, double enough);

}  // namespace lekalo::step
