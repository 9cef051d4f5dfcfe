#include "nets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lekalo::step {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The shares of the Bernstein polynomials of each count (a, b, c) of a degree, in the order of TriangleNet:
/// the coefficients of the product of ((1 - t) + t x) over a times t_0, b times t_1 and c times t_2.
std::vector<std::vector<double>> blossoms(std::size_t degree, const std::array<double, 3>& t) {
  std::vector<std::vector<double>> made;
  for (std::size_t not_first = 0; not_first <= degree; ++not_first)
    for (std::size_t third = 0; third <= not_first; ++third) {
      std::vector<double>& shares = made.emplace_back(degree + 1, 0.0);
      shares[0] = 1;
      std::size_t factors = 0;
      const auto times = [&](double x, std::size_t count) {
        for (; count > 0; --count, ++factors) {
          shares[factors + 1] = shares[factors] * x;
          for (std::size_t i = factors; i > 0; --i) shares[i] = shares[i] * (1 - x) + shares[i - 1] * x;
          shares[0] *= 1 - x;
        }
      };
      times(t[0], degree - not_first);
      times(t[1], not_first - third);
      times(t[2], third);
    }
  return made;
}

/// Powers of the sum of three numbers: degree! / (i! j! k!), in the order of TriangleNet.
std::vector<double> multinomials(std::size_t degree) {
  std::vector<double> factorial(degree + 1, 1.0);
  for (std::size_t k = 1; k <= degree; ++k) factorial[k] = factorial[k - 1] * static_cast<double>(k);
  std::vector<double> made;
  for (std::size_t not_first = 0; not_first <= degree; ++not_first)
    for (std::size_t third = 0; third <= not_first; ++third)
      made.push_back(factorial[degree] /
                     (factorial[degree - not_first] * factorial[not_first - third] * factorial[third]));
  return made;
}

void add(NetPoint& to, double share, const NetPoint& p) {
  for (std::size_t axis = 0; axis < 4; ++axis) to[axis] += share * p[axis];
}

NetPoint less(const NetPoint& p, const gp_XYZ& flat) {
  return {p[0] - p[3] * flat.X(), p[1] - p[3] * flat.Y(), p[2] - p[3] * flat.Z(), p[3]};
}

double length(const NetPoint& p) {
  return p[3] > 0 ? std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / p[3] : kInfinite;
}

double longest(const std::vector<NetPoint>& points) {
  double most = 0;
  for (const NetPoint& p : points) most = std::max(most, length(p));
  return most;
}

// ---- triangles -------------------------------------------------------------------------------------------

/// The longest of the corners, which are points of the patch.
double met(const TriangleNet& net) {
  const std::size_t n = net.degree;
  return std::max({length(net.points[0]), length(net.points[TriangleNet::place(n, 0)]),
                   length(net.points[TriangleNet::place(n, n)])});
}

/// The same with the corners in another order: the second becomes the first.
TriangleNet turned(const TriangleNet& net) {
  TriangleNet made{net.degree, {}};
  made.points.resize(net.points.size());
  for (std::size_t not_first = 0; not_first <= net.degree; ++not_first)
    for (std::size_t k = 0; k <= not_first; ++k) {
      const std::size_t i = net.degree - not_first;
      // (i, j, k) is (j, k, i) there.
      made.points[TriangleNet::place(k + i, i)] = net.points[TriangleNet::place(not_first, k)];
    }
  return made;
}

/// How much the net bends along the side from the first corner to the second.
double bend(const TriangleNet& net) {
  double most = 0;
  for (std::size_t not_first = 0; not_first + 2 <= net.degree; ++not_first)
    for (std::size_t k = 0; k <= not_first; ++k) {
      const NetPoint &a = net.points[TriangleNet::place(not_first, k)],
                     &b = net.points[TriangleNet::place(not_first + 1, k)],
                     &c = net.points[TriangleNet::place(not_first + 2, k)];
      double square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = a[axis] - 2 * b[axis] + c[axis];
        square += d * d;
      }
      most = std::max(most, square);
    }
  return most;
}

/// Both halves, cut in the middle of the side along which the net bends most (de Casteljau).
std::array<TriangleNet, 2> halves(const TriangleNet& net) {
  TriangleNet from = net;
  double most = bend(from);
  TriangleNet next = net;
  for (int turn = 0; turn < 2; ++turn) {
    next = turned(next);
    if (const double bent = bend(next); bent > most) most = bent, from = next;
  }
  const std::size_t n = from.degree;
  std::array<TriangleNet, 2> made{TriangleNet{n, {}}, TriangleNet{n, {}}};
  for (TriangleNet& half : made) half.points.resize(from.points.size());
  for (std::size_t round = 0; round <= n; ++round) {
    // (i, 0, k) with the middle `round` times in place of j, and (0, j, k) with it in place of i.
    for (std::size_t k = 0; k + round <= n; ++k) {
      made[0].points[TriangleNet::place(round + k, k)] = from.points[TriangleNet::place(k, k)];
      made[1].points[TriangleNet::place(n - round, k)] = from.points[TriangleNet::place(n - round, k)];
    }
    for (std::size_t not_first = 0; not_first + round + 1 <= n; ++not_first)
      for (std::size_t k = 0; k <= not_first; ++k) {
        NetPoint& at = from.points[TriangleNet::place(not_first, k)];
        const NetPoint& beside = from.points[TriangleNet::place(not_first + 1, k)];
        for (std::size_t axis = 0; axis < 4; ++axis) at[axis] = 0.5 * (at[axis] + beside[axis]);
      }
  }
  return made;
}

// ---- boxes -----------------------------------------------------------------------------------------------

double met(const BoxNet& net) {
  return std::max({length(net.points.front()), length(net.points[net.columns - 1]),
                   length(net.points[net.points.size() - net.columns]), length(net.points.back())});
}

std::array<BoxNet, 2> halves(const BoxNet& net) {
  const auto bent = [&](std::size_t step, std::size_t lines, std::size_t across, std::size_t count) {
    double most = 0;
    for (std::size_t line = 0; line < lines; ++line)
      for (std::size_t k = 0; k + 2 < count; ++k) {
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double d = net.points[line * across + k * step][axis] -
                           2 * net.points[line * across + (k + 1) * step][axis] +
                           net.points[line * across + (k + 2) * step][axis];
          square += d * d;
        }
        most = std::max(most, square);
      }
    return most;
  };
  const bool along_rows =
      bent(net.columns, net.columns, 1, net.rows) >= bent(1, net.rows, net.columns, net.columns);
  const std::size_t step = along_rows ? net.columns : 1, across = along_rows ? 1 : net.columns,
                    lines = along_rows ? net.columns : net.rows, count = along_rows ? net.rows : net.columns;
  std::array<BoxNet, 2> made{net, net};
  for (std::size_t line = 0; line < lines; ++line)
    for (std::size_t round = 0; round < count; ++round) {
      const auto at = [&](std::size_t k) { return line * across + k * step; };
      // The second half ends as the first one's rounds do.
      made[0].points[at(round)] = made[1].points[at(0)];
      for (std::size_t k = 0; k + round + 1 < count; ++k)
        for (std::size_t axis = 0; axis < 4; ++axis)
          made[1].points[at(k)][axis] = 0.5 * (made[1].points[at(k)][axis] + made[1].points[at(k + 1)][axis]);
    }
  return made;
}

template <class Net>
double farthest_of(std::vector<Net> nets, double enough) {
  /// A bound this near to a vector that was met is left as it is.
  constexpr double kNear = 1.05;
  constexpr int kMostHalvings = 400;
  struct Open {
    double bound = 0;
    Net net;
  };
  std::vector<Open> open;
  const auto nearer = [](const Open& a, const Open& b) { return a.bound < b.bound; };
  double reached = 0;
  const auto put = [&](Net&& net) {
    const double bound = longest(net.points);
    reached = std::max(reached, met(net));
    open.push_back({bound, std::move(net)});
    std::push_heap(open.begin(), open.end(), nearer);
  };
  for (Net& net : nets) put(std::move(net));
  for (int k = 0; k < kMostHalvings && !open.empty(); ++k) {
    const double most = open.front().bound;
    if (most <= enough || most <= kNear * reached || !std::isfinite(most)) break;
    std::pop_heap(open.begin(), open.end(), nearer);
    const Net widest = std::move(open.back().net);
    open.pop_back();
    for (Net& half : halves(widest)) put(std::move(half));
  }
  return open.empty() ? 0 : open.front().bound;
}

}  // namespace

TriangleNet net_over(const std::vector<NetPoint>& patch, std::size_t columns, const std::array<double, 3>& u,
                     const std::array<double, 3>& v, const std::array<gp_XYZ, 3>& flat) {
  const std::size_t rows = patch.size() / columns, p = rows - 1, q = columns - 1, n = p + q;
  const std::vector<std::vector<double>> of_u = blossoms(p, u), of_v = blossoms(q, v);
  const std::vector<double> shares_u = multinomials(p), shares_v = multinomials(q), shares = multinomials(n);
  // The rows of the patch at each count of v.
  std::vector<NetPoint> lines(rows * of_v.size(), NetPoint{});
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t b = 0; b < of_v.size(); ++b)
      for (std::size_t j = 0; j < columns; ++j)
        add(lines[i * of_v.size() + b], of_v[b][j], patch[i * columns + j]);
  std::vector<NetPoint> points((n + 1) * (n + 2) / 2, NetPoint{});
  std::size_t a = 0;
  for (std::size_t m = 0; m <= p; ++m)
    for (std::size_t k = 0; k <= m; ++k, ++a) {
      std::size_t b = 0;
      for (std::size_t o = 0; o <= q; ++o)
        for (std::size_t l = 0; l <= o; ++l, ++b) {
          NetPoint value{};
          for (std::size_t i = 0; i < rows; ++i) add(value, of_u[a][i], lines[i * of_v.size() + b]);
          const std::size_t to = TriangleNet::place(m + o, k + l);
          add(points[to], shares_u[a] * shares_v[b] / shares[to], value);
        }
    }
  // One degree higher, for what is flat is linear and multiplied by the weight.
  TriangleNet made{n + 1, {}};
  made.points.assign((n + 2) * (n + 3) / 2, NetPoint{});
  const double whole = static_cast<double>(n + 1);
  for (std::size_t m = 0; m <= n; ++m)
    for (std::size_t k = 0; k <= m; ++k) {
      const NetPoint& from = points[TriangleNet::place(m, k)];
      const std::size_t i = n - m, j = m - k;
      add(made.points[TriangleNet::place(m, k)], static_cast<double>(i + 1) / whole, less(from, flat[0]));
      add(made.points[TriangleNet::place(m + 1, k)], static_cast<double>(j + 1) / whole, less(from, flat[1]));
      add(made.points[TriangleNet::place(m + 1, k + 1)], static_cast<double>(k + 1) / whole,
          less(from, flat[2]));
    }
  return made;
}

BoxNet net_over(const std::vector<NetPoint>& patch, std::size_t columns,
                const std::array<gp_XYZ, 4>& corners) {
  const std::size_t rows = patch.size() / columns;
  BoxNet made{rows + 1, columns + 1, std::vector<NetPoint>((rows + 1) * (columns + 1), NetPoint{})};
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
          const double share = static_cast<double>(a == 0 ? rows - i : i + 1) / static_cast<double>(rows) *
                               static_cast<double>(b == 0 ? columns - j : j + 1) /
                               static_cast<double>(columns);
          add(made.points[(i + a) * (columns + 1) + j + b], share,
              less(patch[i * columns + j], corners[2 * a + b]));
        }
  return made;
}

double farthest(std::vector<TriangleNet> nets, double enough) { return farthest_of(std::move(nets), enough); }
double farthest(std::vector<BoxNet> nets, double enough) { return farthest_of(std::move(nets), enough); }

}  // namespace lekalo::step
