#include "solid_form.hpp"

#include <cmath>

namespace lekalo::locate {
namespace {

using solid::Vector;

/// A coefficient is a sum of some forty products, each within a few roundings of 2^-53 of what it is made of:
/// 2^-46 of the size in all. What it is made of is off the numbers of the certificate by 2^-47 of itself: the
/// rotation of the start, points turned by it, the shortest decimals of doubles, and the sides of the window,
/// which are rounded outwards (SolidSearch::proof).
constexpr double kFormRounding = 0x1p-43;

/// A function of x for one shift.
struct Quadratic {
  double constant = 0;
  Vector linear, squares;
  double yz = 0, zx = 0, xy = 0;
};

Quadratic at_shift(const PoseForm& form, Vector t) {
  const double along = form.constant + dot(form.linear, t) + form.square * dot(t, t);
  const std::array<Vector, 3> w{form.turned[0] + t.x * form.lever, form.turned[1] + t.y * form.lever,
                                form.turned[2] + t.z * form.lever};
  const double trace = w[0].x + w[1].y + w[2].z, all = along - trace;
  return {along + trace,
          {2 * (w[2].y - w[1].z), 2 * (w[0].z - w[2].x), 2 * (w[1].x - w[0].y)},
          {all + 2 * w[0].x, all + 2 * w[1].y, all + 2 * w[2].z},
          2 * (w[1].z + w[2].y),
          2 * (w[2].x + w[0].z),
          2 * (w[0].y + w[1].x)};
}

/// Calls each(coefficient, that of D, corner of the shifts, index along each turn).
template <class Each>
void coefficients(const PoseForm& form, const CellView& cell, const Each& each) {
  for (const Vector t : cell.corners) {
    const Quadratic q = at_shift(form, t);
    for (std::size_t i = 0; i < cell.count[0]; ++i) {
      const double x = cell.x[0][i], of_x = q.constant + q.linear.x * x + q.squares.x * cell.square[0][i];
      const double d_x = 1 + cell.square[0][i];
      for (std::size_t j = 0; j < cell.count[1]; ++j) {
        const double y = cell.x[1][j],
                     of_y = of_x + q.linear.y * y + q.squares.y * cell.square[1][j] + q.xy * x * y;
        const double d_y = d_x + cell.square[1][j], by_z = q.linear.z + q.zx * x + q.yz * y;
        for (std::size_t k = 0; k < cell.count[2]; ++k)
          each(of_y + by_z * cell.x[2][k] + q.squares.z * cell.square[2][k], d_y + cell.square[2][k], t,
               std::array<std::size_t, 3>{i, j, k});
      }
    }
  }
}

}  // namespace

CellView::CellView(const SolidMeter& meter, const SolidCell& cell)
    : middle(cell.middle()),
      turned(motion_of({{1, middle.x.x, middle.x.y, middle.x.z}, {}})),
      far(meter.far()),
      reach(meter.frame().reach) {
  const FramedPose wide = cell.half();
  slide = wide.at;
  const Vector h = wide.x, m = middle.x;
  // The rotation from the middle is y = (d + m cross d) / (1 + m . m + m . d) for the step d, so |y| is
  // |d| sqrt(1 + |m|^2) / (1 + m . m + m . d) at most.
  const double whole = 1 + dot(m, m),
               nearer = std::abs(m.x) * h.x + std::abs(m.y) * h.y + std::abs(m.z) * h.z;
  turn = nearer < whole ? norm(h) * std::sqrt(whole) / (whole - nearer) : kInfinity;
  half = {slide.x, slide.y, slide.z, 2 * reach * h.x, 2 * reach * h.y, 2 * reach * h.z};
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector corner{(k & 1) != 0 ? slide.x : -slide.x, (k & 2) != 0 ? slide.y : -slide.y,
                        (k & 4) != 0 ? slide.z : -slide.z};
    if (std::find(corners.begin(), corners.end(), corner) == corners.end()) corners.push_back(corner);
  }
  least_scale = 1;
  const auto along = [&](std::size_t axis, double low, double high) {
    count[axis] = low < high ? 3 : 1;
    x[axis] = {low, 0.5 * (low + high), high};
    square[axis] = {low * low, low * high, high * high};
    least_scale += std::min({square[axis][0], square[axis][1], square[axis][2]});
  };
  along(0, cell.low.x.x, cell.high.x.x);
  along(1, cell.low.x.y, cell.high.x.y);
  along(2, cell.low.x.z, cell.high.x.z);
}

void PoseForm::add(double factor, const PoseForm& other) noexcept {
  constant += factor * other.constant;
  square += factor * other.square;
  linear = linear + factor * other.linear;
  lever = lever + factor * other.lever;
  for (std::size_t i = 0; i < 3; ++i) turned[i] = turned[i] + factor * other.turned[i];
  size += factor * other.size;
}

double PoseForm::most(const CellView& cell) const {
  if (!(cell.least_scale > 0)) return kInfinity;
  double most = -kInfinity;
  coefficients(*this, cell, [&](double value, double scale, Vector, const auto&) {
    most = std::max(most, (value + kFormRounding * size) / scale);
  });
  return most;
}

bool PoseForm::never_negative(const CellView& cell) const {
  double least = kInfinity;
  coefficients(*this, cell,
               [&](double value, double, Vector, const auto&) { least = std::min(least, value); });
  return least >= kFormRounding * size;
}

LinearBound<6> PoseForm::tangent(const CellView& cell) const {
  const Vector x = cell.middle.x;
  const Quadratic q = at_shift(*this, {});
  const double scale = 1 + dot(x, x);
  const Vector bent{q.squares.x * x.x, q.squares.y * x.y, q.squares.z * x.z},
      mixed{q.yz * x.y * x.z, q.zx * x.z * x.x, q.xy * x.x * x.y};
  const double value = (q.constant + dot(q.linear, x) + dot(bent, x) + mixed.x + mixed.y + mixed.z) / scale;
  const Vector crossed{q.xy * x.y + q.zx * x.z, q.xy * x.x + q.yz * x.z, q.zx * x.x + q.yz * x.y};
  const Vector by_x = 1 / scale * (q.linear + 2 * bent + crossed - 2 * value * x);
  // (D R) lever at the middle; the rotation is the one after the start's.
  const Vector turned_lever = (1 - dot(x, x)) * lever + 2 * cross(x, lever) + 2 * dot(x, lever) * x;
  const Vector by_t = linear + 1 / scale * turned_lever;
  double lift = -kInfinity;
  coefficients(*this, cell, [&](double coefficient, double d, Vector t, const std::array<std::size_t, 3>& k) {
    const Vector step{cell.x[0][k[0]] - x.x, cell.x[1][k[1]] - x.y, cell.x[2][k[2]] - x.z};
    lift = std::max(lift, coefficient / d - dot(by_t, t) - dot(by_x, step));
  });
  const Vector g = 0.5 / cell.reach * by_x;
  return {{by_t.x, by_t.y, by_t.z, g.x, g.y, g.z}, lift};
}

PoseForm height(Vector n, Vector p, double least, const CellView& cell) {
  const double along = dot(n, cell.middle.at);
  return {along - least, 0, n, {}, {n.x * p, n.y * p, n.z * p}, norm(p) + std::abs(least) + cell.far};
}

PoseForm height_seen(Vector n, Vector c, double least, const CellView& cell) {
  const Vector off = c - cell.middle.at;
  return {-least, 0, {}, -n, {off.x * n, off.y * n, off.z * n}, norm(off) + std::abs(least) + cell.far};
}

PoseForm distance(Vector p, Vector c, double l, double radii, const CellView& cell) {
  const Vector off = c - cell.middle.at, q = -1 / l * off;
  const double reaches = norm(p) + norm(off) + norm(cell.slide);
  return {0.5 / l * (dot(p, p) + dot(off, off) + l * l) - radii,
          0.5 / l,
          q,
          1 / l * p,
          {q.x * p, q.y * p, q.z * p},
          0.5 / l * (reaches * reaches + l * l) + radii + cell.far};
}

}  // namespace lekalo::locate
