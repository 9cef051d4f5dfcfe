#include "elastic.hpp"

#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::heat {
namespace {

constexpr int kIterations = 500;
constexpr int kSmoothings = 3;
constexpr double kRange = 8;           // of eigenvalues that a cycle's smoothing is for
constexpr std::size_t kCoarsest = 64;  // nodes; three unknowns each are solved for directly
/// This part of the diagonal is added on the coarsest level: a free body has a matrix without inverse.
constexpr double kShift = 1e-9;
constexpr std::size_t kCost = 60, kCostOfNumbers = 6;  // nanoseconds a node
constexpr std::size_t kWide = Lattice::kWide;

/// The largest eigenvalue of one element's matrix scaled by its diagonal. That of the whole matrix is not
/// larger, whatever the shares: x K x is the sum of the elements' and x D x, too.
double largest_eigenvalue(const Hexahedron& h) {
  std::array<double, kUnknowns> v{}, image{};
  for (std::size_t i = 0; i < kUnknowns; ++i) v[i] = 1 + 0.37 * static_cast<double>(i * i % 7);
  double value = 0;
  for (int step = 0; step < 200; ++step) {
    double norm = 0;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      image[i] = 0;
      for (std::size_t j = 0; j < kUnknowns; ++j)
        image[i] += h.stiffness[i][j] * v[j] / std::sqrt(h.stiffness[i][i] * h.stiffness[j][j]);
      norm += image[i] * image[i];
    }
    value = std::sqrt(norm);
    for (std::size_t i = 0; i < kUnknowns; ++i) v[i] = image[i] / value;
  }
  return 1.02 * value;
}

void set_shape(ElasticLevel& level) {
  const Hexahedron& h = level.element;
  for (std::size_t c = 0; c < kComponents; ++c) level.diagonal[c] = h.stiffness[c][c];
  level.most = largest_eigenvalue(h);
  for (std::size_t own = 0; own < kCorners; ++own)
    for (std::size_t other = 0; other < kCorners; ++other) {
      std::size_t to = 0;
      for (std::size_t axis = 3; axis-- > 0;) to = 3 * to + 1 + (other >> axis & 1U) - (own >> axis & 1U);
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t c = 0; c < kComponents; ++c)
          level.whole[to][r][c] += h.stiffness[3 * own + r][3 * other + c];
    }
}

using Run = std::array<std::array<double, kWide>, kComponents>;

/// Forces on kWide nodes in a row, of which the first has this index.
Run forces_on(const ElasticLevel& level, const Field& x, std::size_t at) {
  const std::size_t row = level.nodes.row, layer = level.nodes.layer;
  Run forces{};
  std::array<const double*, kCorners> share{};
  for (std::size_t e = 0; e < kCorners; ++e)  // bits of e: 0 below the node along an axis, 1 above
    share[e] =
        &level.share[at - ((e & 1U) != 0 ? 0 : 1) - ((e & 2U) != 0 ? 0 : row) - ((e & 4U) != 0 ? 0 : layer)];
  const double one = *share[0];
  bool same = true;
  for (std::size_t e = 0; e < kCorners; ++e)
    for (std::size_t w = 0; w < kWide; ++w) same = same && share[e][w] == one;
  if (same && one == 0) return forces;
  if (same) {
    for (std::size_t n = 0; n < 27; ++n) {
      const std::size_t from = at + n % 3 + n / 3 % 3 * row + n / 9 * layer - 1 - row - layer;
      for (std::size_t c = 0; c < kComponents; ++c) {
        const double* v = &x[c][from];
        for (std::size_t r = 0; r < kComponents; ++r) {
          const double k = level.whole[n][r][c];
          for (std::size_t w = 0; w < kWide; ++w) forces[r][w] += k * v[w];
        }
      }
    }
    for (auto& force : forces)
      for (double& f : force) f *= one;
    return forces;
  }
  for (std::size_t e = 0; e < kCorners; ++e) {
    bool any = false;
    for (std::size_t w = 0; w < kWide; ++w) any = any || share[e][w] > 0;
    if (!any) continue;
    const std::size_t own = 7 - e;
    const std::size_t low = static_cast<std::size_t>(share[e] - level.share.data());
    Run by{};
    for (std::size_t n = 0; n < kCorners; ++n) {
      const std::size_t from = low + (n & 1U) + (n >> 1U & 1U) * row + (n >> 2U) * layer;
      for (std::size_t c = 0; c < kComponents; ++c) {
        const double* v = &x[c][from];
        for (std::size_t r = 0; r < kComponents; ++r) {
          const double k = level.element.stiffness[3 * own + r][3 * n + c];
          for (std::size_t w = 0; w < kWide; ++w) by[r][w] += k * v[w];
        }
      }
    }
    for (std::size_t r = 0; r < kComponents; ++r)
      for (std::size_t w = 0; w < kWide; ++w) forces[r][w] += share[e][w] * by[r][w];
  }
  return forces;
}

/// How a node along an axis hangs between nodes of the coarser level.
struct Parents {
  std::size_t first, count;
  double weight;
};
Parents parents_of(std::size_t i, bool halved_axis) {
  if (!halved_axis) return {i, 1, 1};
  return i % 2 == 0 ? Parents{i / 2, 1, 1} : Parents{i / 2, 2, 0.5};
}

}  // namespace

ElasticSystem::ElasticSystem(const std::array<std::size_t, 3>& elements, const std::array<double, 3>& pitch,
                             double youngs, double poisson, const std::array<bool, 6>& held, unsigned threads)
    : held_(held), threads_(threads) {
  std::array<std::size_t, 3> n = elements;
  std::array<double, 3> size = pitch;
  for (;;) {
    ElasticLevel level;
    level.elements = n;
    level.nodes = Lattice({n[0] + 1, n[1] + 1, n[2] + 1});
    level.element = hexahedron_of(size, youngs, poisson);
    set_shape(level);
    level.share.assign(level.nodes.size, 0.0);
    level.inverse.assign(level.nodes.size, 0.0);
    for (Field* field : {&level.right, &level.x, &level.way, &level.rest})
      for (Numbers& numbers : *field) numbers.assign(level.nodes.size, 0.0);
    levels_.push_back(std::move(level));
    if ((n[0] + 1) * (n[1] + 1) * (n[2] + 1) <= kCoarsest) break;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (n[axis] == 1) continue;
      n[axis] = halved(n[axis]);
      size[axis] *= 2;
    }
  }
}

void ElasticSystem::coarsen() {
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    const ElasticLevel& fine = levels_[n - 1];
    ElasticLevel& level = levels_[n];
    std::fill(level.share.begin(), level.share.end(), 0.0);
    std::array<std::size_t, 3> by{};
    double part = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      by[axis] = fine.elements[axis] == 1 ? 1 : 2;
      part /= static_cast<double>(by[axis]);
    }
    for (std::size_t k = 0; k < fine.elements[2]; ++k)
      for (std::size_t j = 0; j < fine.elements[1]; ++j)
        for (std::size_t i = 0; i < fine.elements[0]; ++i)
          level.share[level.nodes.index(i / by[0], j / by[1], k / by[2])] +=
              part * fine.share[fine.nodes.index(i, j, k)];
  }
  for (ElasticLevel& level : levels_) {
    const Lattice& nodes = level.nodes;
    for (std::size_t k = 0; k < nodes.count[2]; ++k)
      for (std::size_t j = 0; j < nodes.count[1]; ++j)
        for (std::size_t i = 0; i < nodes.count[0]; ++i) {
          const std::size_t a = nodes.index(i, j, k);
          double sum = 0;
          for (std::size_t e = 0; e < kCorners; ++e)
            sum += level.share[a - (e & 1U) - (e >> 1U & 1U) * nodes.row - (e >> 2U) * nodes.layer];
          const std::array<std::size_t, 3> place{i, j, k};
          bool held = false;
          for (std::size_t axis = 0; axis < 3; ++axis)
            held = held || (held_[2 * axis] && place[axis] == 0) ||
                   (held_[2 * axis + 1] && place[axis] == level.elements[axis]);
          level.inverse[a] = held || !(sum > 0) ? 0 : 1 / sum;
        }
  }
  factor();
}

template <class Act>
void ElasticSystem::each_run(const ElasticLevel& level, const Act& act) const {
  each_rows(level.nodes, threads_, kCostOfNumbers, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = level.nodes.begin_of_row(r);
      act(begin, begin + level.nodes.count[0]);
    }
  });
}

template <class Write>
void ElasticSystem::product(const ElasticLevel& level, const Field& x, const Write& write) const {
  const Lattice& nodes = level.nodes;
  each_rows(nodes, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) {
      const std::size_t begin = nodes.begin_of_row(n);
      for (std::size_t i = 0; i < nodes.count[0]; i += kWide) {
        const Run forces = forces_on(level, x, begin + i);
        const std::size_t last = std::min(kWide, nodes.count[0] - i);
        for (std::size_t w = 0; w < last; ++w) {
          const std::size_t a = begin + i + w;
          const bool solved = level.inverse[a] > 0;
          for (std::size_t r = 0; r < kComponents; ++r) write(a, r, solved ? forces[r][w] : 0.0);
        }
      }
    }
  });
}

void ElasticSystem::residual(const ElasticLevel& level, const Field& b, const Field& x, Field& out) const {
  product(level, x, [&](std::size_t a, std::size_t r, double force) { out[r][a] = b[r][a] - force; });
}

/// Chebyshev's polynomial in the scaled matrix, the same before and after the coarser levels, so that the
/// cycle is symmetric.
void ElasticSystem::smooth(ElasticLevel& level, bool from_zero) const {
  const double least = level.most / kRange;
  const double middle = (level.most + least) / 2, half = (level.most - least) / 2;
  double rho = half / middle;
  for (int step = 0; step < kSmoothings; ++step) {
    const bool first = step == 0, zero = first && from_zero;
    double of_way = 0, of_rest = 1 / middle;
    if (!first) {
      const double next = 1 / (2 * middle / half - rho);
      of_way = next * rho, of_rest = 2 * next / half;
      rho = next;
    }
    if (!zero) residual(level, level.right, level.x, level.rest);
    each_run(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r) {
        const double factor = of_rest / level.diagonal[r];
        const double* rest = (zero ? level.right : level.rest)[r].data();
        const double* inverse = level.inverse.data();
        double *way = level.way[r].data(), *x = level.x[r].data();
        for (std::size_t a = begin; a < end; ++a) {
          const double change = factor * inverse[a] * rest[a];
          way[a] = first ? change : of_way * way[a] + change;
          x[a] = zero ? way[a] : x[a] + way[a];
        }
      }
    });
  }
}

/// Gathers for each coarse node what its fine neighbours have, in one order.
void ElasticSystem::restrict_to(const ElasticLevel& level, ElasticLevel& coarse) const {
  const Lattice &from = level.nodes, &to = coarse.nodes;
  struct Children {
    std::size_t first, end;
    bool halved;
    std::size_t middle;
  };
  const auto children = [&](std::size_t i, std::size_t axis) {
    if (level.elements[axis] == 1) return Children{i, i + 1, false, i};
    const std::size_t middle = 2 * i;
    return Children{middle > 0 ? middle - 1 : 0, std::min(middle + 2, from.count[axis]), true, middle};
  };
  each_rows(to, threads_, 8 * kCostOfNumbers, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) {
      const std::size_t begin = to.begin_of_row(n);
      const Children y = children(n % to.count[1], 1), z = children(n / to.count[1], 2);
      for (std::size_t i = 0; i < to.count[0]; ++i) {
        std::array<double, kComponents> sum{};
        if (coarse.inverse[begin + i] > 0) {
          const Children x = children(i, 0);
          for (std::size_t c = z.first; c < z.end; ++c)
            for (std::size_t b = y.first; b < y.end; ++b)
              for (std::size_t a = x.first; a < x.end; ++a) {
                const double weight =
                    (a == x.middle ? 1 : 0.5) * (b == y.middle ? 1 : 0.5) * (c == z.middle ? 1 : 0.5);
                const std::size_t at = from.index(a, b, c);
                for (std::size_t r = 0; r < kComponents; ++r) sum[r] += weight * level.rest[r][at];
              }
        }
        for (std::size_t r = 0; r < kComponents; ++r) coarse.right[r][begin + i] = sum[r];
      }
    }
  });
}

void ElasticSystem::add_from(const ElasticLevel& coarse, ElasticLevel& level) const {
  const Lattice &from = coarse.nodes, &to = level.nodes;
  each_rows(to, threads_, 4 * kCostOfNumbers, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) {
      const std::size_t begin = to.begin_of_row(n);
      const Parents y = parents_of(n % to.count[1], level.elements[1] > 1);
      const Parents z = parents_of(n / to.count[1], level.elements[2] > 1);
      for (std::size_t i = 0; i < to.count[0]; ++i) {
        if (!(level.inverse[begin + i] > 0)) continue;
        const Parents x = parents_of(i, level.elements[0] > 1);
        const double weight = x.weight * y.weight * z.weight;
        for (std::size_t c = 0; c < z.count; ++c)
          for (std::size_t b = 0; b < y.count; ++b) {
            const std::size_t at = from.index(x.first, y.first + b, z.first + c);
            for (std::size_t r = 0; r < kComponents; ++r)
              for (std::size_t a = 0; a < x.count; ++a) level.x[r][begin + i] += weight * coarse.x[r][at + a];
          }
      }
    }
  });
}

/// Cholesky's factor of the coarsest matrix.
void ElasticSystem::factor() {
  const ElasticLevel& level = levels_.back();
  const Lattice& nodes = level.nodes;
  coarse_nodes_.clear();
  std::vector<std::size_t> number(nodes.size, nodes.size);
  for (std::size_t r = 0; r < nodes.rows(); ++r)
    for (std::size_t a = nodes.begin_of_row(r), end = a + nodes.count[0]; a < end; ++a)
      if (level.inverse[a] > 0) number[a] = coarse_nodes_.size(), coarse_nodes_.push_back(a);
  const std::size_t size = 3 * coarse_nodes_.size();
  factor_.assign(size * size, 0.0);
  for (std::size_t r = 0; r < nodes.rows(); ++r)
    for (std::size_t a = nodes.begin_of_row(r), end = a + nodes.count[0]; a < end; ++a) {
      if (!(level.share[a] > 0)) continue;
      for (std::size_t p = 0; p < kCorners; ++p)
        for (std::size_t q = 0; q < kCorners; ++q) {
          const auto at = [&](std::size_t n) {
            return number[a + (n & 1U) + (n >> 1U & 1U) * nodes.row + (n >> 2U) * nodes.layer];
          };
          if (at(p) == nodes.size || at(q) == nodes.size) continue;
          for (std::size_t u = 0; u < 3; ++u)
            for (std::size_t v = 0; v < 3; ++v)
              factor_[(3 * at(p) + u) * size + 3 * at(q) + v] +=
                  level.share[a] * level.element.stiffness[3 * p + u][3 * q + v];
        }
    }
  for (std::size_t i = 0; i < size; ++i) {
    factor_[i * size + i] *= 1 + kShift;
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = factor_[i * size + j];
      for (std::size_t k = 0; k < j; ++k) sum -= factor_[i * size + k] * factor_[j * size + k];
      factor_[i * size + j] =
          j < i ? sum / factor_[j * size + j] : std::sqrt(std::max(sum, 1e-12 * factor_[i * size + i]));
    }
  }
}

void ElasticSystem::solve_coarsest(ElasticLevel& level) const {
  const std::size_t size = 3 * coarse_nodes_.size();
  Numbers v(size);
  for (std::size_t i = 0; i < size; ++i) {
    v[i] = level.right[i % 3][coarse_nodes_[i / 3]];
    for (std::size_t j = 0; j < i; ++j) v[i] -= factor_[i * size + j] * v[j];
    v[i] /= factor_[i * size + i];
  }
  for (std::size_t i = size; i-- > 0;) {
    v[i] /= factor_[i * size + i];
    for (std::size_t j = 0; j < i; ++j) v[j] -= factor_[i * size + j] * v[i];
    level.x[i % 3][coarse_nodes_[i / 3]] = v[i];
  }
}

void ElasticSystem::cycle(std::size_t n) {
  ElasticLevel& level = levels_[n];
  if (n + 1 == levels_.size()) return solve_coarsest(level);
  smooth(level, true);
  residual(level, level.right, level.x, level.rest);
  restrict_to(level, levels_[n + 1]);
  cycle(n + 1);
  add_from(levels_[n + 1], level);
  smooth(level, false);
}

double ElasticSystem::dot(const Field& a, const Field& b) const {
  const Lattice& nodes = levels_.front().nodes;
  return sum_of_rows(nodes, threads_, [&](std::size_t first, std::size_t end) {
    double sum = 0;
    for (std::size_t n = first; n < end; ++n)
      for (std::size_t r = 0; r < kComponents; ++r) {
        const std::size_t begin = nodes.begin_of_row(n);
        for (std::size_t i = begin; i < begin + nodes.count[0]; ++i) sum += a[r][i] * b[r][i];
      }
    return sum;
  });
}

bool ElasticSystem::solve(const Field& b, Field& x, double part) {
  ElasticLevel& finest = levels_.front();
  const double aim = part * part * dot(b, b);
  Field left, way, image;
  for (Field* field : {&left, &way, &image})
    for (Numbers& numbers : *field) numbers.assign(finest.nodes.size, 0.0);
  residual(finest, b, x, left);
  double before = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (dot(left, left) <= aim) return true;
    const std::uint64_t unknowns = 3 * finest.nodes.rows() * finest.nodes.count[0];
    work_ += unknowns;
    ask(unknowns / 4);
    finest.right = left;
    cycle(0);
    const double now = dot(left, finest.x);
    const double keep = iteration == 0 ? 0 : now / before;
    each_run(finest, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t a = begin; a < end; ++a) way[r][a] = finest.x[r][a] + keep * way[r][a];
    });
    product(finest, way, [&](std::size_t a, std::size_t r, double force) { image[r][a] = force; });
    const double curvature = dot(way, image);
    if (!(curvature > 0)) return false;
    const double length = now / curvature;
    each_run(finest, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t a = begin; a < end; ++a)
          x[r][a] += length * way[r][a], left[r][a] -= length * image[r][a];
    });
    before = now;
  }
  return false;
}

}  // namespace lekalo::heat
