#include "elastic.hpp"

#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::heat {
namespace {

constexpr int kIterations = 500;
constexpr int kSmoothings = 2;
constexpr double kRange = 8;           // of eigenvalues that a cycle's smoothing is for
constexpr std::size_t kCoarsest = 64;  // nodes; three unknowns each are solved for directly
/// This part of the diagonal is added on the coarsest level: a free body has a matrix without inverse.
constexpr double kShift = 1e-6;
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

template <class Real>
void set_shape(Hexahedra<Real>& hexahedra, const std::array<std::size_t, 3>& elements, const Hexahedron& h) {
  hexahedra.elements = elements;
  hexahedra.nodes = Lattice({elements[0] + 1, elements[1] + 1, elements[2] + 1});
  hexahedra.share.assign(hexahedra.nodes.size, 0);
  hexahedra.inverse.assign(hexahedra.nodes.size, 0);
  for (std::size_t own = 0; own < kCorners; ++own)
    for (std::size_t other = 0; other < kCorners; ++other) {
      std::size_t to = 0;
      for (std::size_t axis = 3; axis-- > 0;) to = 3 * to + 1 + (other >> axis & 1U) - (own >> axis & 1U);
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t c = 0; c < kComponents; ++c) {
          const auto k = static_cast<Real>(h.stiffness[3 * own + r][3 * other + c]);
          hexahedra.stiffness[3 * own + r][3 * other + c] = k;
          hexahedra.whole[to][r][c] += k;
        }
    }
}

template <class Real>
using Run = std::array<std::array<Real, kWide>, kComponents>;

/// Forces on kWide nodes in a row, of which the first has this index.
template <class Real>
Run<Real> forces_on(const Hexahedra<Real>& level, const FieldOf<Real>& x, std::size_t at) {
  const std::size_t row = level.nodes.row, layer = level.nodes.layer;
  Run<Real> forces{};
  std::array<const Real*, kCorners> share{};
  for (std::size_t e = 0; e < kCorners; ++e)  // bits of e: 0 below the node along an axis, 1 above
    share[e] =
        &level.share[at - ((e & 1U) != 0 ? 0 : 1) - ((e & 2U) != 0 ? 0 : row) - ((e & 4U) != 0 ? 0 : layer)];
  const Real one = *share[0];
  bool same = true;
  for (std::size_t e = 0; e < kCorners; ++e)
    for (std::size_t w = 0; w < kWide; ++w) same = same && share[e][w] == one;
  if (same && one == 0) return forces;
  if (same) {
    for (std::size_t n = 0; n < 27; ++n) {
      const std::size_t from = at + n % 3 + n / 3 % 3 * row + n / 9 * layer - 1 - row - layer;
      for (std::size_t c = 0; c < kComponents; ++c) {
        const Real* v = &x[c][from];
        for (std::size_t r = 0; r < kComponents; ++r) {
          const Real k = level.whole[n][r][c];
          for (std::size_t w = 0; w < kWide; ++w) forces[r][w] += k * v[w];
        }
      }
    }
    for (auto& force : forces)
      for (Real& f : force) f *= one;
    return forces;
  }
  for (std::size_t e = 0; e < kCorners; ++e) {
    bool any = false;
    for (std::size_t w = 0; w < kWide; ++w) any = any || share[e][w] > 0;
    if (!any) continue;
    const std::size_t own = 7 - e;
    const auto low = static_cast<std::size_t>(share[e] - level.share.data());
    Run<Real> by{};
    for (std::size_t n = 0; n < kCorners; ++n) {
      const std::size_t from = low + (n & 1U) + (n >> 1U & 1U) * row + (n >> 2U) * layer;
      for (std::size_t c = 0; c < kComponents; ++c) {
        const Real* v = &x[c][from];
        for (std::size_t r = 0; r < kComponents; ++r) {
          const Real k = level.stiffness[3 * own + r][3 * n + c];
          for (std::size_t w = 0; w < kWide; ++w) by[r][w] += k * v[w];
        }
      }
    }
    for (std::size_t r = 0; r < kComponents; ++r)
      for (std::size_t w = 0; w < kWide; ++w) forces[r][w] += share[e][w] * by[r][w];
  }
  return forces;
}

/// Sets the inverse sums of shares at all nodes.
template <class Real>
void set_inverse(Hexahedra<Real>& level, const std::array<bool, 6>& held_sides) {
  const Lattice& nodes = level.nodes;
  for (std::size_t k = 0; k < nodes.count[2]; ++k)
    for (std::size_t j = 0; j < nodes.count[1]; ++j)
      for (std::size_t i = 0; i < nodes.count[0]; ++i) {
        const std::size_t a = nodes.index(i, j, k);
        Real sum = 0;
        for (std::size_t e = 0; e < kCorners; ++e)
          sum += level.share[a - (e & 1U) - (e >> 1U & 1U) * nodes.row - (e >> 2U) * nodes.layer];
        const std::array<std::size_t, 3> place{i, j, k};
        bool held = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
          held = held || (held_sides[2 * axis] && place[axis] == 0) ||
                 (held_sides[2 * axis + 1] && place[axis] == level.elements[axis]);
        level.inverse[a] = held || !(sum > 0) ? 0 : 1 / sum;
      }
}

/// How a node along an axis hangs between nodes of the coarser level.
struct Parents {
  std::size_t first, count;
  float weight;
};
Parents parents_of(std::size_t i, bool halved_axis) {
  if (!halved_axis) return {i, 1, 1};
  return i % 2 == 0 ? Parents{i / 2, 1, 1} : Parents{i / 2, 2, 0.5F};
}

}  // namespace

ElasticSystem::ElasticSystem(const std::array<std::size_t, 3>& elements, const std::array<double, 3>& pitch,
                             double youngs, double poisson, const std::array<bool, 6>& held, unsigned threads)
    : held_(held), threads_(threads) {
  element_ = hexahedron_of(pitch, youngs, poisson);
  set_shape(finest_, elements, element_);
  std::array<std::size_t, 3> n = elements;
  std::array<double, 3> size = pitch;
  for (;;) {
    ElasticLevel level;
    const Hexahedron element = hexahedron_of(size, youngs, poisson);
    set_shape(level.hexahedra, n, element);
    for (std::size_t c = 0; c < kComponents; ++c) level.diagonal[c] = element.stiffness[c][c];
    level.most = largest_eigenvalue(element);
    for (auto* field : {&level.right, &level.x, &level.way, &level.rest})
      for (auto& numbers : *field) numbers.assign(level.hexahedra.nodes.size, 0.0F);
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
  auto& first = levels_.front().hexahedra.share;
  for (std::size_t a = 0; a < first.size(); ++a) first[a] = static_cast<float>(finest_.share[a]);
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    const Hexahedra<float>& fine = levels_[n - 1].hexahedra;
    Hexahedra<float>& level = levels_[n].hexahedra;
    std::fill(level.share.begin(), level.share.end(), 0.0F);
    std::array<std::size_t, 3> by{};
    float part = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      by[axis] = fine.elements[axis] == 1 ? 1 : 2;
      part /= static_cast<float>(by[axis]);
    }
    for (std::size_t k = 0; k < fine.elements[2]; ++k)
      for (std::size_t j = 0; j < fine.elements[1]; ++j)
        for (std::size_t i = 0; i < fine.elements[0]; ++i)
          level.share[level.nodes.index(i / by[0], j / by[1], k / by[2])] +=
              part * fine.share[fine.nodes.index(i, j, k)];
  }
  set_inverse(finest_, held_);
  for (ElasticLevel& level : levels_) set_inverse(level.hexahedra, held_);
  factor();
}

template <class Act>
void ElasticSystem::each_run(const Lattice& nodes, const Act& act) const {
  each_rows(nodes, threads_, kCostOfNumbers, [&](std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = nodes.begin_of_row(r);
      act(begin, begin + nodes.count[0]);
    }
  });
}

template <class Real, class Write>
void ElasticSystem::product(const Hexahedra<Real>& hexahedra, const FieldOf<Real>& x,
                            const Write& write) const {
  const Lattice& nodes = hexahedra.nodes;
  each_rows(nodes, threads_, kCost, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) {
      const std::size_t begin = nodes.begin_of_row(n);
      for (std::size_t i = 0; i < nodes.count[0]; i += kWide) {
        const Run<Real> forces = forces_on(hexahedra, x, begin + i);
        const std::size_t last = std::min(kWide, nodes.count[0] - i);
        for (std::size_t w = 0; w < last; ++w) {
          const std::size_t a = begin + i + w;
          const bool solved = hexahedra.inverse[a] > 0;
          for (std::size_t r = 0; r < kComponents; ++r) write(a, r, solved ? forces[r][w] : Real{0});
        }
      }
    }
  });
}

void ElasticSystem::residual(const ElasticLevel& level, FieldOf<float>& out) const {
  product(level.hexahedra, level.x,
          [&](std::size_t a, std::size_t r, float force) { out[r][a] = level.right[r][a] - force; });
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
    if (!zero) residual(level, level.rest);
    each_run(level.hexahedra.nodes, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r) {
        const auto factor = static_cast<float>(of_rest / level.diagonal[r]),
                   keep = static_cast<float>(of_way);
        const float* rest = (zero ? level.right : level.rest)[r].data();
        const float* inverse = level.hexahedra.inverse.data();
        float *way = level.way[r].data(), *x = level.x[r].data();
        for (std::size_t a = begin; a < end; ++a) {
          const float change = factor * inverse[a] * rest[a];
          way[a] = first ? change : keep * way[a] + change;
          x[a] = zero ? way[a] : x[a] + way[a];
        }
      }
    });
  }
}

/// Gathers for each coarse node what its fine neighbours have, in one order.
void ElasticSystem::restrict_to(const ElasticLevel& level, ElasticLevel& coarse) const {
  const Lattice &from = level.hexahedra.nodes, &to = coarse.hexahedra.nodes;
  struct Children {
    std::size_t first, end;
    bool halved;
    std::size_t middle;
  };
  const auto children = [&](std::size_t i, std::size_t axis) {
    if (level.hexahedra.elements[axis] == 1) return Children{i, i + 1, false, i};
    const std::size_t middle = 2 * i;
    return Children{middle > 0 ? middle - 1 : 0, std::min(middle + 2, from.count[axis]), true, middle};
  };
  each_rows(to, threads_, 8 * kCostOfNumbers, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) {
      const std::size_t begin = to.begin_of_row(n);
      const Children y = children(n % to.count[1], 1), z = children(n / to.count[1], 2);
      for (std::size_t i = 0; i < to.count[0]; ++i) {
        std::array<float, kComponents> sum{};
        if (coarse.hexahedra.inverse[begin + i] > 0) {
          const Children x = children(i, 0);
          for (std::size_t c = z.first; c < z.end; ++c)
            for (std::size_t b = y.first; b < y.end; ++b)
              for (std::size_t a = x.first; a < x.end; ++a) {
                const float weight = (a == x.middle ? 1.0F : 0.5F) * (b == y.middle ? 1.0F : 0.5F) *
                                     (c == z.middle ? 1.0F : 0.5F);
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
  const Lattice &from = coarse.hexahedra.nodes, &to = level.hexahedra.nodes;
  each_rows(to, threads_, 4 * kCostOfNumbers, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) {
      const std::size_t begin = to.begin_of_row(n);
      const Parents y = parents_of(n % to.count[1], level.hexahedra.elements[1] > 1);
      const Parents z = parents_of(n / to.count[1], level.hexahedra.elements[2] > 1);
      for (std::size_t i = 0; i < to.count[0]; ++i) {
        if (!(level.hexahedra.inverse[begin + i] > 0)) continue;
        const Parents x = parents_of(i, level.hexahedra.elements[0] > 1);
        const float weight = x.weight * y.weight * z.weight;
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
  const Hexahedra<float>& level = levels_.back().hexahedra;
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
                  static_cast<double>(level.share[a]) *
                  static_cast<double>(level.stiffness[3 * p + u][3 * q + v]);
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
    v[i] = static_cast<double>(level.right[i % 3][coarse_nodes_[i / 3]]);
    for (std::size_t j = 0; j < i; ++j) v[i] -= factor_[i * size + j] * v[j];
    v[i] /= factor_[i * size + i];
  }
  for (std::size_t i = size; i-- > 0;) {
    v[i] /= factor_[i * size + i];
    for (std::size_t j = 0; j < i; ++j) v[j] -= factor_[i * size + j] * v[i];
    level.x[i % 3][coarse_nodes_[i / 3]] = static_cast<float>(v[i]);
  }
}

void ElasticSystem::cycle(std::size_t n) {
  ElasticLevel& level = levels_[n];
  if (n + 1 == levels_.size()) return solve_coarsest(level);
  smooth(level, true);
  residual(level, level.rest);
  restrict_to(level, levels_[n + 1]);
  cycle(n + 1);
  add_from(levels_[n + 1], level);
  smooth(level, false);
}

template <class A, class B>
double ElasticSystem::dot(const FieldOf<A>& a, const FieldOf<B>& b) const {
  const Lattice& nodes = finest_.nodes;
  return sum_of_rows(nodes, threads_, [&](std::size_t first, std::size_t end) {
    double sum = 0;
    for (std::size_t n = first; n < end; ++n)
      for (std::size_t r = 0; r < kComponents; ++r) {
        const std::size_t begin = nodes.begin_of_row(n);
        for (std::size_t i = begin; i < begin + nodes.count[0]; ++i)
          sum += static_cast<double>(a[r][i]) * static_cast<double>(b[r][i]);
      }
    return sum;
  });
}

bool ElasticSystem::solve(const Field& b, Field& x, double part) {
  ElasticLevel& first = levels_.front();
  const Lattice& nodes = finest_.nodes;
  const double load = dot(b, b), aim = part * part * load;
  if (!(load > 0)) {
    for (Numbers& numbers : x) std::fill(numbers.begin(), numbers.end(), 0.0);
    return true;
  }
  Field left, way, image;
  for (Field* field : {&left, &way, &image})
    for (Numbers& numbers : *field) numbers.assign(nodes.size, 0.0);
  product(finest_, x, [&](std::size_t a, std::size_t r, double force) { left[r][a] = b[r][a] - force; });
  double before = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const double square = dot(left, left);
    if (square <= aim) return true;
    const std::uint64_t unknowns = 3 * nodes.rows() * nodes.count[0];
    work_ += unknowns;
    ask(unknowns / 4);
    // Single precision knows no number below 1e-38, so the cycle is given what is left as a part of itself.
    const double scale = std::sqrt(square), inverse = 1 / scale;
    each_run(nodes, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t a = begin; a < end; ++a)
          first.right[r][a] = static_cast<float>(inverse * left[r][a]);
    });
    cycle(0);
    const double now = scale * dot(left, first.x);
    const double keep = iteration == 0 ? 0 : now / before;
    each_run(nodes, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t a = begin; a < end; ++a)
          way[r][a] = scale * static_cast<double>(first.x[r][a]) + keep * way[r][a];
    });
    product(finest_, way, [&](std::size_t a, std::size_t r, double force) { image[r][a] = force; });
    const double curvature = dot(way, image);
    if (!(curvature > 0)) return false;
    const double length = now / curvature;
    each_run(nodes, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = 0; r < kComponents; ++r)
        for (std::size_t a = begin; a < end; ++a)
          x[r][a] += length * way[r][a], left[r][a] -= length * image[r][a];
    });
    before = now;
  }
  return false;
}

}  // namespace lekalo::heat
