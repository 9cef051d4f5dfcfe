#include "flow.hpp"

#include <cmath>

#include "flow_rows.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::heat {
namespace {

constexpr int kIterations = 400;
// Eigenvalues of the matrix scaled by its diagonal that smoothing is for. All lie below 2, since no row's
// other entries add up to more than its diagonal; what changes from voxel to voxel along an axis lies above a
// third with six neighbours, and from 1/2 to 4/3 with eighteen.
struct Range {
  float least, most;
};
constexpr Range kSix{1.0F / 3, 2}, kEighteen{0.5F, 1.8F};
constexpr int kSmoothings = 2;
/// Each neighbour has this part of a whole voxel's capacity, so that the mass matrix is of fourth order.
constexpr double kShared = 1.0 / 12;
constexpr std::size_t kCost = 4;  // nanoseconds a voxel

/// Joints of a coarse face: the four fine ones side by side, over twice the way.
constexpr float kLongerWay = 0.5F;

template <class Real>
void make_room(Flow<Real>& flow, const std::array<std::size_t, 3>& count) {
  flow.lattice = Lattice(count);
  for (auto* numbers :
       {&flow.capacity, &flow.loss, &flow.joint[0], &flow.joint[1], &flow.joint[2], &flow.diagonal})
    numbers->assign(flow.lattice.size, 0);
}

}  // namespace

FlowSystem::FlowSystem(const std::array<std::size_t, 3>& count, unsigned threads) : threads_(threads) {
  make_room(finest_, count);
  for (std::array<std::size_t, 3> n = count;; n = {halved(n[0]), halved(n[1]), halved(n[2])}) {
    FlowLevel level;
    make_room(level.flow, n);
    for (auto* numbers : {&level.inverse, &level.right, &level.x, &level.way, &level.rest})
      numbers->assign(level.flow.lattice.size, 0.0F);
    levels_.push_back(std::move(level));
    if (n[0] * n[1] * n[2] == 1) break;
  }
  finest_.wholes = levels_.front().flow.wholes = wholes_.get();
  set_wholes(std::vector<float>(finest_.lattice.size, 0.0F), {}, {1, 1, 1}, 0);
}

void FlowSystem::set_wholes(std::vector<float> voxels, const std::array<double, 3>& links,
                            const std::array<double, 3>& pitch, double capacity) {
  wholes_->voxel = std::move(voxels);
  whole_capacity_ = capacity;
  Flow<float>& first = levels_.front().flow;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t one = (axis + 1) % 3, other = (axis + 2) % 3;
    const double ratio = pitch[one] / pitch[other];
    // Each side has four squares, and no joint may fall below 0.
    finest_.link[axis] = links[axis];
    finest_.bend[axis] = std::min({links[one] * (ratio * ratio + 1) / 12, links[one] / 4, links[other] / 4});
    first.link[axis] = static_cast<float>(links[axis]);
    first.bend[axis] = static_cast<float>(finest_.bend[axis]);
  }
  const Lattice& lattice = finest_.lattice;
  const std::size_t runs = runs_of(lattice);
  wholes_->stretches.assign(lattice.rows() * runs, Stretch::six);
  for (std::size_t r = 0; r < lattice.rows(); ++r) {
    const Ways ways = ways_of(lattice, r);
    for (std::size_t run = 0; run < runs; ++run) {
      const std::size_t begin = run * Lattice::kWide,
                        end = std::min(begin + Lattice::kWide, lattice.count[0]);
      const float* row = &wholes_->voxel[lattice.begin_of_row(r)];
      if (std::all_of(row + begin, row + end, [](float whole) { return whole == 0; })) continue;
      const std::size_t from = begin - (run > 0 ? 1 : 0), to = end + (run + 1 < runs ? 1 : 0);
      bool all = true;
      for (const std::ptrdiff_t y : {-ways[0], std::ptrdiff_t{0}, ways[1]})
        for (const std::ptrdiff_t z : {-ways[2], std::ptrdiff_t{0}, ways[3]})
          all =
              all && std::all_of(row + y + z + from, row + y + z + to, [](float whole) { return whole > 0; });
      wholes_->stretches[r * runs + run] = all ? Stretch::eighteen : Stretch::mixed;
    }
  }
}

void FlowSystem::coarsen() {
  const auto rounded = [](const Numbers& from, std::vector<float>& to) {
    std::transform(from.begin(), from.end(), to.begin(), [](double v) { return static_cast<float>(v); });
  };
  Flow<float>& first = levels_.front().flow;
  rounded(finest_.capacity, first.capacity);
  rounded(finest_.loss, first.loss);
  for (std::size_t axis = 0; axis < 3; ++axis) rounded(finest_.joint[axis], first.joint[axis]);
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    const Flow<float>& fine = levels_[n - 1].flow;
    Flow<float>& level = levels_[n].flow;
    const Lattice &from = fine.lattice, &to = level.lattice;
    for (auto* numbers : {&level.capacity, &level.loss, &level.joint[0], &level.joint[1], &level.joint[2]})
      std::fill(numbers->begin(), numbers->end(), 0.0F);
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

template <class Real>
void FlowSystem::set_diagonal(Flow<Real>& flow, Real per_second) const {
  const Lattice& lattice = flow.lattice;
  const auto steps = lattice.steps();
  each_rows(lattice, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r)
      for (std::size_t a = lattice.begin_of_row(r), last = a + lattice.count[0]; a < last; ++a) {
        Real sum = per_second * flow.capacity[a] + flow.loss[a];
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum += flow.joint[axis][a] + flow.joint[axis][a + steps[axis]];
        if (flow.wholes != nullptr && flow.wholes->voxel[a] > 0) {
          const float* whole = &flow.wholes->voxel[a];
          for (const std::size_t s : steps) sum -= flow.shared * static_cast<Real>(*(whole - s) + whole[s]);
          each_square(lattice, [&](std::size_t axis, std::ptrdiff_t s, std::ptrdiff_t t) {
            sum -= flow.bend[axis] * static_cast<Real>(whole[s] * whole[t] * whole[s + t]);
          });
        }
        flow.diagonal[a] = sum;
      }
  });
}

void FlowSystem::scale(double per_second) {
  Flow<double>& own = finest_;
  own.held = per_second * whole_capacity_;
  // Short steps share less, so that no joint falls below 0, and nothing becomes colder than all about it.
  own.shared = kShared * own.held;
  for (std::size_t axis = 0; axis < 3; ++axis)
    own.shared =
        std::min(own.shared, own.link[axis] - 2 * (own.bend[(axis + 1) % 3] + own.bend[(axis + 2) % 3]));
  levels_.front().flow.held = static_cast<float>(own.held);
  levels_.front().flow.shared = static_cast<float>(own.shared);
  set_diagonal(finest_, per_second);
  for (FlowLevel& level : levels_) {
    set_diagonal(level.flow, static_cast<float>(per_second));
    std::transform(level.flow.diagonal.begin(), level.flow.diagonal.end(), level.inverse.begin(),
                   [](float sum) { return sum > 0 ? 1 / sum : 0; });
  }
}

template <class Real, class Write>
void FlowSystem::product(const Flow<Real>& level, const std::vector<Real>& x, const Write& write) const {
  const Lattice& lattice = level.lattice;
  const std::size_t runs = runs_of(lattice);
  const Stencil<Real> stencil(level, level.held, level.shared);
  each_rows(lattice, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = lattice.begin_of_row(r);
      const Ways ways = ways_of(lattice, r);
      for (std::size_t run = 0; run < runs; ++run) {
        const std::size_t at = begin + run * Lattice::kWide, left = lattice.count[0] - run * Lattice::kWide;
        const Stretch stretch =
            level.wholes != nullptr ? level.wholes->stretches[r * runs + run] : Stretch::six;
        Run<Real> sum = stretch == Stretch::eighteen
                            ? by_eighteen(stencil, &level.loss[at], &x[at], ways, run == 0, left)
                            : by_six(level, &x[at], at);
        if (stretch == Stretch::mixed) add_wholes(level, &x[at], at, sum);
        for (std::size_t i = 0; i < std::min(Lattice::kWide, left); ++i) write(at + i, sum[i]);
      }
    }
  });
}

void FlowSystem::residual(FlowLevel& level) const {
  const float* right = level.right.data();
  float* left = level.rest.data();
  product(level.flow, level.x, [right, left](std::size_t n, float of_x) { left[n] = right[n] - of_x; });
}

void FlowSystem::flow(const Numbers& t, Numbers& out) const {
  const Flow<double>& level = finest_;
  const Lattice& lattice = level.lattice;
  const auto steps = lattice.steps();
  const std::size_t runs = runs_of(lattice);
  const Stencil<double> stencil(level, 0, 0);
  const auto by_differences = [&](std::size_t a) {
    double sum = level.loss[a] * t[a];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t s = steps[axis];
      sum += level.joint[axis][a] * (t[a] - t[a - s]) + level.joint[axis][a + s] * (t[a] - t[a + s]);
    }
    if (!(wholes_->voxel[a] > 0)) return sum;
    const float* whole = &wholes_->voxel[a];
    const double* own = &t[a];
    each_square(lattice, [&](std::size_t axis, std::ptrdiff_t u, std::ptrdiff_t v) {
      sum -= level.bend[axis] * static_cast<double>(whole[u] * whole[v] * whole[u + v]) *
             ((own[0] - own[u]) - (own[v] - own[u + v]));
    });
    return sum;
  };
  each_rows(lattice, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r) {
      const Ways ways = ways_of(lattice, r);
      for (std::size_t run = 0; run < runs; ++run) {
        const std::size_t at = lattice.begin_of_row(r) + run * Lattice::kWide,
                          left = lattice.count[0] - run * Lattice::kWide,
                          count = std::min(Lattice::kWide, left);
        if (wholes_->stretches[r * runs + run] == Stretch::eighteen) {
          const Run<double> sum = by_eighteen(stencil, &level.loss[at], &t[at], ways, run == 0, left);
          std::copy_n(sum.begin(), count, &out[at]);
        } else {
          for (std::size_t a = at; a < at + count; ++a) out[a] = by_differences(a);
        }
      }
    }
  });
}

Numbers FlowSystem::spread(const Numbers& heat) const {
  const Lattice& lattice = finest_.lattice;
  const std::vector<float>& whole = wholes_->voxel;
  const double part = finest_.held > 0 ? finest_.shared / finest_.held : 0;
  Numbers out = heat;
  for (std::size_t r = 0; r < lattice.rows(); ++r)
    for (std::size_t a = lattice.begin_of_row(r), last = a + lattice.count[0]; a < last; ++a) {
      if (heat[a] == 0 || !(whole[a] > 0)) continue;
      for (const std::size_t s : lattice.steps())
        for (const std::size_t b : {a - s, a + s}) {
          const double given = part * static_cast<double>(whole[b]) * heat[a];
          out[a] -= given, out[b] += given;
        }
    }
  return out;
}

/// Chebyshev's polynomial of the second degree in the scaled matrix, the same before and after the coarser
/// levels, so that the cycle is symmetric.
void FlowSystem::smooth(FlowLevel& level, bool from_zero) const {
  const Range range = level.flow.wholes != nullptr ? kEighteen : kSix;
  const float middle = (range.most + range.least) / 2, half = (range.most - range.least) / 2;
  float rho = half / middle;
  const std::size_t size = level.flow.lattice.size;
  for (int step = 0; step < kSmoothings; ++step) {
    const bool first = step == 0, zero = first && from_zero;
    float of_way = 0, of_rest = 1 / middle;
    if (!first) {
      const float next = 1 / (2 * middle / half - rho);
      of_way = next * rho, of_rest = 2 * next / half;
      rho = next;
    }
    if (!zero) residual(level);
    const float *rest = (zero ? level.right : level.rest).data(), *inverse = level.inverse.data();
    float *way = level.way.data(), *x = level.x.data();
    for (std::size_t n = 0; n < size; ++n) {
      const float change = of_rest * inverse[n] * rest[n];
      way[n] = first ? change : of_way * way[n] + change;
      x[n] = zero ? way[n] : x[n] + way[n];
    }
  }
}

void FlowSystem::cycle(std::size_t n) {
  FlowLevel& level = levels_[n];
  if (n + 1 == levels_.size()) {  // one voxel
    for (std::size_t a = 0; a < level.x.size(); ++a) level.x[a] = level.inverse[a] * level.right[a];
    return;
  }
  smooth(level, true);
  residual(level);
  FlowLevel& coarse = levels_[n + 1];
  const Lattice &from = level.flow.lattice, &to = coarse.flow.lattice;
  std::fill(coarse.right.begin(), coarse.right.end(), 0.0F);
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

template <class Real>
double FlowSystem::dot(const Numbers& a, const std::vector<Real>& b) const {
  const Lattice& lattice = finest_.lattice;
  return sum_of_rows(lattice, threads_, [&](std::size_t first, std::size_t end) {
    double sum = 0;
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = lattice.begin_of_row(r);
      for (std::size_t i = begin; i < begin + lattice.count[0]; ++i) sum += a[i] * static_cast<double>(b[i]);
    }
    return sum;
  });
}

bool FlowSystem::solve(const Numbers& b, Numbers& x, double part) {
  FlowLevel& first = levels_.front();
  const std::size_t size = finest_.lattice.size;
  const double aim = part * part * dot(b, b);
  Numbers left(size, 0.0), way(size, 0.0), image(size, 0.0);
  product(finest_, x, [&](std::size_t n, double of_x) { left[n] = b[n] - of_x; });
  double before = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const double square = dot(left, left);
    if (square <= aim) return true;
    const std::uint64_t unknowns = finest_.lattice.rows() * finest_.lattice.count[0];
    work_ += unknowns;
    ask(unknowns / 16);
    // Single precision knows no number below 1e-38, so the cycle is given what is left as a part of itself.
    const double scale = std::sqrt(square), inverse = 1 / scale;
    for (std::size_t n = 0; n < size; ++n) first.right[n] = static_cast<float>(inverse * left[n]);
    cycle(0);
    const double now = scale * dot(left, first.x);
    const double keep = iteration == 0 ? 0 : now / before;
    for (std::size_t n = 0; n < size; ++n) way[n] = scale * static_cast<double>(first.x[n]) + keep * way[n];
    product(finest_, way, [to = image.data()](std::size_t n, double of_way) { to[n] = of_way; });
    const double curvature = dot(way, image);
    if (!(curvature > 0)) return false;
    const double length = now / curvature;
    for (std::size_t n = 0; n < size; ++n) x[n] += length * way[n], left[n] -= length * image[n];
    before = now;
  }
  return false;
}

}  // namespace lekalo::heat
