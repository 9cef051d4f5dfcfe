#include "solid_form.hpp"

#include <cmath>
#include <span>

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

/// D along + sum of w_ij (D R)_ij.
Quadratic quadratic(double along, const std::array<Vector, 3>& w) {
  const double trace = w[0].x + w[1].y + w[2].z, all = along - trace;
  return {along + trace,
          {2 * (w[2].y - w[1].z), 2 * (w[0].z - w[2].x), 2 * (w[1].x - w[0].y)},
          {all + 2 * w[0].x, all + 2 * w[1].y, all + 2 * w[2].z},
          2 * (w[1].z + w[2].y),
          2 * (w[2].x + w[0].z),
          2 * (w[0].y + w[1].x)};
}

Quadratic at_shift(const PoseForm& form, Vector t) {
  const auto& across = form.across;
  return quadratic(form.constant + dot(form.linear, t) + form.square * dot(t, t),
                   {form.turned[0] + t.x * form.lever + t.z * across[1] - t.y * across[2],
                    form.turned[1] + t.y * form.lever + t.x * across[2] - t.z * across[0],
                    form.turned[2] + t.z * form.lever + t.y * across[0] - t.x * across[1]});
}

/// Calls each(coefficient, index along each turn).
template <class Each>
void coefficients(const Quadratic& q, const CellView& cell, const Each& each) {
  for (std::size_t i = 0; i < cell.count[0]; ++i) {
    const double x = cell.x[0][i], of_x = q.constant + q.linear.x * x + q.squares.x * cell.square[0][i];
    for (std::size_t j = 0; j < cell.count[1]; ++j) {
      const double y = cell.x[1][j],
                   of_y = of_x + q.linear.y * y + q.squares.y * cell.square[1][j] + q.xy * x * y;
      const double by_z = q.linear.z + q.zx * x + q.yz * y;
      for (std::size_t k = 0; k < cell.count[2]; ++k)
        each(of_y + by_z * cell.x[2][k] + q.squares.z * cell.square[2][k],
             std::array<std::size_t, 3>{i, j, k});
    }
  }
}

/// Calls each(coefficient, that of what the bound is taken times, one of the shifts, index along each turn).
template <class Each>
void coefficients(const PoseForm& form, const CellView& cell, std::span<const Vector> shifts,
                  const Each& each) {
  std::array<std::array<std::array<double, 3>, 3>, 3> scale{};
  coefficients(quadratic(form.whole, form.whole_turned), cell,
               [&](double value, const auto& k) { scale[k[0]][k[1]][k[2]] = value; });
  for (const Vector t : shifts)
    coefficients(at_shift(form, t), cell,
                 [&](double value, const auto& k) { each(value, scale[k[0]][k[1]][k[2]], t, k); });
}

double value_at(const Quadratic& q, Vector x) {
  return q.constant + dot(q.linear, x) + q.squares.x * x.x * x.x + q.squares.y * x.y * x.y +
         q.squares.z * x.z * x.z + q.yz * x.y * x.z + q.zx * x.z * x.x + q.xy * x.x * x.y;
}
Vector gradient_at(const Quadratic& q, Vector x) {
  return q.linear + Vector{2 * q.squares.x * x.x + q.xy * x.y + q.zx * x.z,
                           2 * q.squares.y * x.y + q.xy * x.x + q.yz * x.z,
                           2 * q.squares.z * x.z + q.zx * x.x + q.yz * x.y};
}

std::array<Vector, 3> product(Vector a, Vector b) { return {a.x * b, a.y * b, a.z * b}; }

}  // namespace

CellView::CellView(const SolidCell& cell, double longest, double lever)
    : middle(cell.middle()),
      turned(motion_of({{1, middle.x.x, middle.x.y, middle.x.z}, {}})),
      far(longest),
      reach(lever) {
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
  whole += factor * other.whole;
  linear = linear + factor * other.linear;
  lever = lever + factor * other.lever;
  for (std::size_t i = 0; i < 3; ++i) {
    turned[i] = turned[i] + factor * other.turned[i];
    across[i] = across[i] + factor * other.across[i];
    whole_turned[i] = whole_turned[i] + factor * other.whole_turned[i];
  }
  size += factor * other.size;
}

void PoseForm::take_off(const SolidDemand& demand) noexcept {
  if (demand == SolidDemand{}) return;
  constant -= demand.minimum * whole;
  size += demand.minimum * whole;
  whole *= demand.scale;
  for (std::size_t i = 0; i < 3; ++i) {
    turned[i] = turned[i] - demand.minimum * whole_turned[i];
    size += demand.minimum * norm(whole_turned[i]);
    whole_turned[i] = demand.scale * whole_turned[i];
  }
}

double PoseForm::most(const CellView& cell) const {
  double most = -kInfinity;
  coefficients(*this, cell, cell.corners, [&](double value, double scale, Vector, const auto&) {
    const double raised = value + kFormRounding * size;
    // A sum in which the bound has no part proves any bound, or none.
    const double bound = scale == 0 && raised < 0 ? -kInfinity : kInfinity;
    most = std::max(most, scale > 0 ? raised / scale : bound);
  });
  return most;
}

bool PoseForm::never_negative(const CellView& cell) const {
  double least = kInfinity;
  for (const Vector t : cell.corners)
    coefficients(at_shift(*this, t), cell,
                 [&](double value, const auto&) { least = std::min(least, value); });
  return least >= kFormRounding * size;
}

LinearBound<6> PoseForm::tangent(const CellView& cell) const {
  const Vector x = cell.middle.x;
  const Quadratic q = at_shift(*this, {}), of_bound = quadratic(whole, whole_turned);
  const double scale = value_at(of_bound, x), value = value_at(q, x) / scale;
  const Vector by_x = 1 / scale * (gradient_at(q, x) - value * gradient_at(of_bound, x));
  // The rotation is the one after the start's.
  const auto& rows = cell.turned.rotation;
  const auto around = [&](std::size_t i, std::size_t j) {
    return dot(rows[i], across[j]) - dot(rows[j], across[i]);
  };
  const Vector by_t = (1 + dot(x, x)) / scale *
                      (linear + cell.turned.turned(lever) + Vector{around(1, 2), around(2, 0), around(0, 1)});
  // A height over a plane is as far above its tangent at any shift.
  const bool of_plane = square == 0 && lever == Vector{} && across == std::array<Vector, 3>{} &&
                        whole_turned == std::array<Vector, 3>{};
  const Vector no_shift;
  double lift = -kInfinity;
  coefficients(*this, cell, of_plane ? std::span(&no_shift, 1) : std::span(cell.corners),
               [&](double coefficient, double d, Vector t, const std::array<std::size_t, 3>& k) {
                 const Vector step{cell.x[0][k[0]] - x.x, cell.x[1][k[1]] - x.y, cell.x[2][k[2]] - x.z};
                 lift = std::max(lift, coefficient / d - dot(by_t, t) - dot(by_x, step));
               });
  const Vector g = 0.5 / cell.reach * by_x;
  return {{by_t.x, by_t.y, by_t.z, g.x, g.y, g.z}, lift};
}

Steps PoseForm::effects(const CellView& cell) const {
  const Vector x = cell.middle.x;
  const Quadratic q = at_shift(*this, {});
  const double scale = 1 + dot(x, x), value = value_at(q, x) / scale;
  const LinearBound<6> slopes = tangent(cell);
  const double bends[] = {square, square, square, q.squares.x, q.squares.y, q.squares.z};
  Steps made{};
  for (std::size_t k = 0; k < 6; ++k) {
    const double step = k < 3 ? cell.half[k] : 0.5 / cell.reach * cell.half[k],
                 bend = k < 3 ? bends[k] : (bends[k] - value) / scale;
    made[k] = std::abs(slopes.slope[k]) * cell.half[k] + std::abs(bend) * step * step;
  }
  return made;
}

PoseForm height(Vector n, Vector p, double least, const CellView& cell) {
  PoseForm made;
  made.constant = dot(n, cell.middle.at) - least;
  made.linear = n;
  made.turned = product(n, p);
  made.whole = 1;
  made.size = norm(p) + std::abs(least) + cell.far;
  return made;
}

PoseForm height_seen(Vector n, Vector c, double least, const CellView& cell) {
  const Vector off = c - cell.middle.at;
  PoseForm made;
  made.constant = -least;
  made.lever = -n;
  made.turned = product(off, n);
  made.whole = 1;
  made.size = norm(off) + std::abs(least) + cell.far;
  return made;
}

PoseForm distance(Vector p, Vector c, double l, double radii, const CellView& cell) {
  const Vector off = c - cell.middle.at, q = -1 / l * off;
  const double reaches = norm(p) + norm(off) + norm(cell.slide);
  PoseForm made;
  made.constant = 0.5 / l * (dot(p, p) + dot(off, off) + l * l) - radii;
  made.square = 0.5 / l;
  made.linear = q;
  made.lever = 1 / l * p;
  made.turned = product(q, p);
  made.whole = 1;
  made.size = 0.5 / l * (reaches * reaches + l * l) + radii + cell.far;
  return made;
}

PoseForm passing(Vector p, Vector d, Vector q, Vector g, double least, const CellView& cell) {
  // (R d) x g . R p = g . R (p x d), and the rest of it is (R d) . (g x (t - q)).
  const Vector off = q - cell.middle.at;
  const std::array<Vector, 3> of_p = product(g, cross(p, d)), of_q = product(-cross(g, off), d);
  PoseForm made;
  made.constant = -least;
  for (std::size_t i = 0; i < 3; ++i) made.turned[i] = of_p[i] + of_q[i];
  made.across = product(g, d);
  made.size = norm(d) * norm(g) * (norm(p) + norm(off) + cell.far) + std::abs(least);
  return made;
}

}  // namespace lekalo::locate
