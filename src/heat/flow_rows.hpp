#pragma once

#include <array>
#include <cstddef>

#include "flow.hpp"

namespace lekalo::heat {

/// Numbers at Lattice::kWide places that follow one another in a row.
template <class Real>
using Run = std::array<Real, Lattice::kWide>;

/// How many runs a row has.
[[nodiscard]] inline std::size_t runs_of(const Lattice& lattice) noexcept {
  return (lattice.count[0] + Lattice::kWide - 1) / Lattice::kWide;
}

/// Calls act(axis, s, t) for the twelve squares that a place is a corner of: s and t lead to its neighbours
/// in one across that axis.
template <class Act>
void each_square(const Lattice& lattice, const Act& act) {
  const auto steps = lattice.steps();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto s = static_cast<std::ptrdiff_t>(steps[(axis + 1) % 3]),
               t = static_cast<std::ptrdiff_t>(steps[(axis + 2) % 3]);
    act(axis, s, t);
    act(axis, -s, t);
    act(axis, s, -t);
    act(axis, -s, -t);
  }
}

/// Rows of the system times x with six neighbours; x and all else at the run's first place.
template <class Real>
Run<Real> by_six(const Flow<Real>& level, const Real* x, std::size_t at) {
  const auto row = static_cast<std::ptrdiff_t>(level.lattice.row),
             layer = static_cast<std::ptrdiff_t>(level.lattice.layer);
  const Real *d = &level.diagonal[at], *gx = &level.joint[0][at], *gy = &level.joint[1][at],
             *gz = &level.joint[2][at];
  Run<Real> sum;
  for (std::size_t n = 0; n < Lattice::kWide; ++n) {
    const auto i = static_cast<std::ptrdiff_t>(n);
    sum[n] = d[i] * x[i] - gx[i] * x[i - 1] - gx[i + 1] * x[i + 1] - gy[i] * x[i - row] -
             gy[i + row] * x[i + row] - gz[i] * x[i - layer] - gz[i + layer] * x[i + layer];
  }
  return sum;
}

/// Adds to rows with six neighbours what whole ones change of them.
template <class Real>
void add_wholes(const Flow<Real>& level, const Real* x, std::size_t at, Run<Real>& sum) {
  const float* whole = &level.wholes->voxel[at];
  const auto is = [](float part) { return static_cast<Real>(part); };
  for (const std::size_t step : level.lattice.steps()) {
    const auto s = static_cast<std::ptrdiff_t>(step);
    const float *below = whole - s, *above = whole + s;
    const Real *lower = x - s, *upper = x + s;
    for (std::size_t i = 0; i < Lattice::kWide; ++i)
      sum[i] += level.shared * is(whole[i]) * (is(below[i]) * lower[i] + is(above[i]) * upper[i]);
  }
  each_square(level.lattice, [&](std::size_t axis, std::ptrdiff_t s, std::ptrdiff_t t) {
    const float *ws = whole + s, *wt = whole + t, *both = whole + s + t;
    const Real bend = level.bend[axis], *xs = x + s, *xt = x + t, *xst = x + s + t;
    for (std::size_t i = 0; i < Lattice::kWide; ++i)
      sum[i] += bend * is(whole[i] * ws[i] * wt[i] * both[i]) * (xs[i] + xt[i] - xst[i]);
  });
}

/// A whole voxel among whole ones passes this on, W/K, and has `own` on the diagonal. A neighbour that the
/// box has not is as warm as the place beside it, since nothing flows out there.
template <class Real>
struct Stencil {
  Real fx, fy, fz, exy, exz, eyz, own;

  Stencil(const Flow<Real>& level, Real held, Real shared)
      : exy(level.bend[2]), exz(level.bend[1]), eyz(level.bend[0]) {
    fx = level.link[0] - shared - 2 * (exy + exz);
    fy = level.link[1] - shared - 2 * (exy + eyz);
    fz = level.link[2] - shared - 2 * (exz + eyz);
    own = held + 2 * (fx + fy + fz) + 4 * (exy + exz + eyz);
  }
};

/// The ways to the rows beside a row: below and above along y, then along z; 0 where the box ends.
using Ways = std::array<std::ptrdiff_t, 4>;
[[nodiscard]] inline Ways ways_of(const Lattice& lattice, std::size_t row) noexcept {
  const std::size_t j = row % lattice.count[1], k = row / lattice.count[1];
  const auto up = static_cast<std::ptrdiff_t>(lattice.row), over = static_cast<std::ptrdiff_t>(lattice.layer);
  return {j > 0 ? up : 0, j + 1 < lattice.count[1] ? up : 0, k > 0 ? over : 0,
          k + 1 < lattice.count[2] ? over : 0};
}

/// Rows with eighteen neighbours. \param first  whether the run begins the row \param left  places of the row
/// from the run's first one on
template <class Real>
Run<Real> by_eighteen(const Stencil<Real>& by, const Real* loss, const Real* x, const Ways& ways, bool first,
                      std::size_t left) {
  constexpr std::size_t kWide = Lattice::kWide;
  const Real *south = x - ways[0], *north = x + ways[1], *low = x - ways[2], *high = x + ways[3];
  const Real *sl = south - ways[2], *nl = north - ways[2], *sh = south + ways[3], *nh = north + ways[3];
  const auto along = [&](std::ptrdiff_t i) {
    return by.fx * x[i] + by.exy * (south[i] + north[i]) + by.exz * (low[i] + high[i]);
  };
  std::array<Real, kWide + 2> beside;
  for (std::size_t i = 0; i < kWide; ++i) beside[i + 1] = along(static_cast<std::ptrdiff_t>(i));
  beside[0] = first ? beside[1] : along(-1);
  beside[kWide + 1] = left > kWide ? along(kWide) : beside[kWide];
  if (left < kWide) beside[left + 1] = beside[left];
  Run<Real> sum;
  for (std::size_t i = 0; i < kWide; ++i)
    sum[i] = (by.own + loss[i]) * x[i] - (beside[i] + beside[i + 2]) - by.fy * (south[i] + north[i]) -
             by.fz * (low[i] + high[i]) - by.eyz * ((sl[i] + nl[i]) + (sh[i] + nh[i]));
  return sum;
}

}  // namespace lekalo::heat
