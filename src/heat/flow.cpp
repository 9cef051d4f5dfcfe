#include "flow.hpp"

#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::heat {
namespace {

constexpr int kIterations = 400;
// All eigenvalues of the matrix scaled by its diagonal lie below 2, since no row's other entries add up to
// more than its diagonal; what changes from voxel to voxel along an axis lies above a third.
constexpr double kMost = 2, kLeast = 1.0 / 3;
constexpr int kSmoothings = 2;
constexpr std::size_t kCost = 4;  // nanoseconds a voxel

/// Joints of a coarse face: the four fine ones side by side, over twice the way.
constexpr double kLongerWay = 0.5;

}  // namespace

FlowSystem::FlowSystem(const std::array<std::size_t, 3>& count, unsigned threads) : threads_(threads) {
  for (std::array<std::size_t, 3> n = count;; n = {halved(n[0]), halved(n[1]), halved(n[2])}) {
    FlowLevel level;
    level.lattice = Lattice(n);
    for (Numbers* numbers :
         {&level.capacity, &level.loss, &level.joint[0], &level.joint[1], &level.joint[2], &level.diagonal,
          &level.inverse, &level.right, &level.x, &level.way, &level.rest})
      numbers->assign(level.lattice.size, 0.0);
    levels_.push_back(std::move(level));
    if (n[0] * n[1] * n[2] == 1) break;
  }
}

void FlowSystem::coarsen() {
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    const FlowLevel& fine = levels_[n - 1];
    FlowLevel& level = levels_[n];
    const Lattice &from = fine.lattice, &to = level.lattice;
    for (Numbers* numbers : {&level.capacity, &level.loss, &level.joint[0], &level.joint[1], &level.joint[2]})
      std::fill(numbers->begin(), numbers->end(), 0.0);
    for (std::size_t k = 0; k < from.count[2]; ++k)
      for (std::size_t j = 0; j < from.count[1]; ++j)
        for (std::size_t i = 0; i < from.count[0]; ++i) {
          const std::size_t a = from.index(i, j, k), b = to.index(i / 2, j / 2, k / 2);
          level.capacity[b] += fine.capacity[a];
          level.loss[b] += fine.loss[a];
          const std::array<std::size_t, 3> at{i, j, k};
          for (std::size_t axis = 0; axis < 3; ++axis)
            if (at[axis] % 2 == 0) level.joint[axis][b] += kLongerWay * fine.joint[axis][a];
        }
  }
}

void FlowSystem::scale(double per_second) {
  for (FlowLevel& level : levels_) {
    const Lattice& lattice = level.lattice;
    const auto steps = lattice.steps();
    each_rows(lattice, threads_, kCost, [&](std::size_t first, std::size_t end) {
      for (std::size_t r = first; r < end; ++r)
        for (std::size_t a = lattice.begin_of_row(r), last = a + lattice.count[0]; a < last; ++a) {
          double sum = per_second * level.capacity[a] + level.loss[a];
          for (std::size_t axis = 0; axis < 3; ++axis)
            sum += level.joint[axis][a] + level.joint[axis][a + steps[axis]];
          level.diagonal[a] = sum;
          level.inverse[a] = sum > 0 ? 1 / sum : 0;
        }
    });
  }
}

template <class Write>
void FlowSystem::product(const FlowLevel& level, const Numbers& x, const Write& write) const {
  const Lattice& lattice = level.lattice;
  const std::size_t up = lattice.row, over = lattice.layer;
  each_rows(lattice, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = lattice.begin_of_row(r);
      const double *v = &x[begin], *d = &level.diagonal[begin], *gx = &level.joint[0][begin],
                   *gy = &level.joint[1][begin], *gz = &level.joint[2][begin];
      for (std::size_t i = 0; i < lattice.count[0]; ++i)
        write(begin + i, d[i] * v[i] - gx[i] * *(v + i - 1) - gx[i + 1] * v[i + 1] - gy[i] * *(v + i - up) -
                             gy[i + up] * v[i + up] - gz[i] * *(v + i - over) - gz[i + over] * v[i + over]);
    }
  });
}

void FlowSystem::residual(const FlowLevel& level, const Numbers& b, const Numbers& x, Numbers& out) const {
  const double* right = b.data();
  double* left = out.data();
  product(level, x, [right, left](std::size_t n, double of_x) { left[n] = right[n] - of_x; });
}

void FlowSystem::flow(const Numbers& t, Numbers& out) const {
  const FlowLevel& level = levels_.front();
  const Lattice& lattice = level.lattice;
  const auto steps = lattice.steps();
  each_rows(lattice, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r)
      for (std::size_t a = lattice.begin_of_row(r), last = a + lattice.count[0]; a < last; ++a) {
        double sum = level.loss[a] * t[a];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t s = steps[axis];
          sum += level.joint[axis][a] * (t[a] - t[a - s]) + level.joint[axis][a + s] * (t[a] - t[a + s]);
        }
        out[a] = sum;
      }
  });
}

/// Chebyshev's polynomial of the second degree in the scaled matrix, the same before and after the coarser
/// levels, so that the cycle is symmetric.
void FlowSystem::smooth(FlowLevel& level, bool from_zero) const {
  const double middle = (kMost + kLeast) / 2, half = (kMost - kLeast) / 2;
  double rho = half / middle;
  if (from_zero)
    level.rest = level.right;
  else
    residual(level, level.right, level.x, level.rest);
  const std::size_t size = level.lattice.size;
  for (int step = 0; step < kSmoothings; ++step) {
    double of_way = 0, of_rest = 1 / middle;
    if (step > 0) {
      const double next = 1 / (2 * middle / half - rho);
      of_way = next * rho, of_rest = 2 * next / half;
      rho = next;
      residual(level, level.right, level.x, level.rest);
    }
    const bool first = step == 0;
    for (std::size_t n = 0; n < size; ++n) {
      const double change = of_rest * level.inverse[n] * level.rest[n];
      level.way[n] = first ? change : of_way * level.way[n] + change;
      level.x[n] = first && from_zero ? level.way[n] : level.x[n] + level.way[n];
    }
  }
}

void FlowSystem::cycle(std::size_t n) {
  FlowLevel& level = levels_[n];
  if (n + 1 == levels_.size()) {  // one voxel
    for (std::size_t a = 0; a < level.lattice.size; ++a) level.x[a] = level.inverse[a] * level.right[a];
    return;
  }
  smooth(level, true);
  residual(level, level.right, level.x, level.rest);
  FlowLevel& coarse = levels_[n + 1];
  const Lattice &from = level.lattice, &to = coarse.lattice;
  std::fill(coarse.right.begin(), coarse.right.end(), 0.0);
  const auto each = [&](const auto& act) {
    for (std::size_t r = 0; r < from.rows(); ++r) {
      const std::size_t begin = from.begin_of_row(r), j = r % from.count[1], k = r / from.count[1];
      const std::size_t target = to.index(0, j / 2, k / 2);
      for (std::size_t i = 0; i < from.count[0]; ++i) act(begin + i, target + i / 2);
    }
  };
  each([&](std::size_t a, std::size_t b) { coarse.right[b] += level.inverse[a] > 0 ? level.rest[a] : 0; });
  cycle(n + 1);
  each([&](std::size_t a, std::size_t b) { level.x[a] += level.inverse[a] > 0 ? coarse.x[b] : 0; });
  smooth(level, false);
}

double FlowSystem::dot(const Numbers& a, const Numbers& b) const {
  const Lattice& lattice = levels_.front().lattice;
  return sum_of_rows(lattice, threads_, [&](std::size_t first, std::size_t end) {
    double sum = 0;
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = lattice.begin_of_row(r);
      for (std::size_t i = begin; i < begin + lattice.count[0]; ++i) sum += a[i] * b[i];
    }
    return sum;
  });
}

bool FlowSystem::solve(const Numbers& b, Numbers& x, double part) {
  FlowLevel& finest = levels_.front();
  const std::size_t size = finest.lattice.size;
  const double aim = part * part * dot(b, b);
  Numbers left(size, 0.0), way(size, 0.0), image(size, 0.0);
  residual(finest, b, x, left);
  double before = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (dot(left, left) <= aim) return true;
    const std::uint64_t unknowns = finest.lattice.rows() * finest.lattice.count[0];
    work_ += unknowns;
    ask(unknowns / 16);
    finest.right = left;
    cycle(0);
    const double now = dot(left, finest.x);
    const double keep = iteration == 0 ? 0 : now / before;
    for (std::size_t n = 0; n < size; ++n) way[n] = finest.x[n] + keep * way[n];
    product(finest, way, [to = image.data()](std::size_t n, double of_way) { to[n] = of_way; });
    const double curvature = dot(way, image);
    if (!(curvature > 0)) return false;
    const double length = now / curvature;
    for (std::size_t n = 0; n < size; ++n) x[n] += length * way[n], left[n] -= length * image[n];
    before = now;
  }
  return false;
}

}  // namespace lekalo::heat
