#include "lekalo/heat/expansion.hpp"

#include <algorithm>
#include <cmath>

#include "elastic.hpp"

namespace lekalo::heat {
namespace {

/// Thinner parts of a voxel are as stiff as this: a node that hangs on next to nothing would cost iterations.
constexpr double kLeastShare = 1e-3;

using Three = std::array<double, 3>;

Three cross(const Three& a, const Three& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A small motion of a rigid body, about a place.
struct Rigid {
  Three about{}, shift{}, turn{};
  [[nodiscard]] Three at(const Three& p) const {
    const Three turned = cross(turn, {p[0] - about[0], p[1] - about[1], p[2] - about[2]});
    return {shift[0] + turned[0], shift[1] + turned[1], shift[2] + turned[2]};
  }
};

struct Moved {
  Three at, by;
};

/// The rigid motion that is nearest to displacements; without a turn where the places lie on a line.
Rigid nearest_rigid(const std::vector<Moved>& all) {
  Rigid rigid;
  for (const Moved& m : all)
    for (std::size_t c = 0; c < 3; ++c) {
      rigid.about[c] += m.at[c] / static_cast<double>(all.size());
      rigid.shift[c] += m.by[c] / static_cast<double>(all.size());
    }
  std::array<Three, 3> matrix{};
  Three right{};
  for (const Moved& m : all) {
    const Three q{m.at[0] - rigid.about[0], m.at[1] - rigid.about[1], m.at[2] - rigid.about[2]};
    const Three moment = cross(q, m.by);
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    for (std::size_t r = 0; r < 3; ++r) {
      right[r] += moment[r];
      for (std::size_t c = 0; c < 3; ++c) matrix[r][c] += (r == c ? square : 0) - q[r] * q[c];
    }
  }
  // By Cramer's rule.
  const Three minors = cross(matrix[1], matrix[2]);
  const double determinant = matrix[0][0] * minors[0] + matrix[0][1] * minors[1] + matrix[0][2] * minors[2];
  const double scale = matrix[0][0] + matrix[1][1] + matrix[2][2];
  if (!(determinant > 1e-9 * scale * scale * scale)) return rigid;
  for (std::size_t c = 0; c < 3; ++c) {
    auto with = matrix;
    for (std::size_t r = 0; r < 3; ++r) with[r][c] = right[r];
    const Three m = cross(with[1], with[2]);
    rigid.turn[c] = (with[0][0] * m[0] + with[0][1] * m[1] + with[0][2] * m[2]) / determinant;
  }
  return rigid;
}

}  // namespace

struct Expansion::Model {
  Grid grid;
  Elastic elastic;
  Holding holding;
  unsigned threads;
  ElasticSystem system;
  Field moved;             // at the nodes of the finest level
  std::vector<char> half;  // of each voxel: at least half is material
  Numbers temperature;     // of each voxel

  Model(const Grid& g, const Elastic& e, const Holding& h, unsigned t)
      : grid(g),
        elastic(e),
        holding(h),
        threads(t),
        system(g.count, g.pitches(), e.youngs_mpa, e.poisson, h.held, t),
        half(g.size(), 0) {
    for (Numbers& numbers : moved) numbers.assign(system.finest().nodes.size, 0.0);
  }
  [[nodiscard]] bool is_free() const {
    return std::none_of(holding.held.begin(), holding.held.end(), [](bool held) { return held; });
  }
  [[nodiscard]] std::array<double, 4> coefficients(std::size_t i, std::size_t j, std::size_t k) const;
  [[nodiscard]] Field load() const;
  [[nodiscard]] Three displacement(Place p) const;
  void take_rigid_motion_out();
  [[nodiscard]] Three place(std::size_t i, std::size_t j, std::size_t k) const {
    return {grid.low.x + static_cast<double>(i) * grid.pitch.x,
            grid.low.y + static_cast<double>(j) * grid.pitch.y,
            grid.low.z + static_cast<double>(k) * grid.pitch.z};
  }
};

/// Expansion at a voxel's middle, and how it grows along each axis: to its faces, by neighbours with
/// material.
std::array<double, 4> Expansion::Model::coefficients(std::size_t i, std::size_t j, std::size_t k) const {
  const auto& level = system.finest();
  const std::array<std::size_t, 3> at{i, j, k}, cells{1, grid.count[0], grid.count[0] * grid.count[1]};
  const std::size_t cell = grid.cell(i, j, k), node = level.nodes.index(i, j, k);
  std::array<double, 4> by{elastic.expansion_per_k * temperature[cell], 0, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = level.nodes.steps()[axis];
    const bool low = at[axis] > 0 && level.share[node - step] > 0;
    const bool high = at[axis] + 1 < grid.count[axis] && level.share[node + step] > 0;
    if (!low && !high) continue;
    const double below = temperature[low ? cell - cells[axis] : cell];
    const double above = temperature[high ? cell + cells[axis] : cell];
    by[axis + 1] = elastic.expansion_per_k * (above - below) / (low && high ? 4 : 2);
  }
  return by;
}

Field Expansion::Model::load() const {
  const auto& level = system.finest();
  const Lattice& nodes = level.nodes;
  Field load;
  for (Numbers& numbers : load) numbers.assign(nodes.size, 0.0);
  for (std::size_t k = 0; k < grid.count[2]; ++k)
    for (std::size_t j = 0; j < grid.count[1]; ++j)
      for (std::size_t i = 0; i < grid.count[0]; ++i) {
        const std::size_t low = nodes.index(i, j, k);
        const double share = level.share[low];
        if (!(share > 0)) continue;
        const auto by = coefficients(i, j, k);
        for (std::size_t n = 0; n < kCorners; ++n) {
          const std::size_t a = low + (n & 1U) + (n >> 1U & 1U) * nodes.row + (n >> 2U) * nodes.layer;
          if (!(level.inverse[a] > 0)) continue;
          for (std::size_t c = 0; c < kComponents; ++c) {
            const auto& row = system.element().load[3 * n + c];
            load[c][a] += share * (row[0] * by[0] + row[1] * by[1] + row[2] * by[2] + row[3] * by[3]);
          }
        }
      }
  return load;
}

Three Expansion::Model::displacement(Place p) const {
  const auto& level = system.finest();
  const auto voxel = grid.voxel_of(p);
  const Three low = place(voxel[0], voxel[1], voxel[2]), at{p.x, p.y, p.z};
  const std::size_t base = level.nodes.index(voxel[0], voxel[1], voxel[2]);
  Three sum{};
  double weights = 0;
  for (std::size_t n = 0; n < kCorners; ++n) {
    const std::size_t a = base + (n & 1U) + (n >> 1U & 1U) * level.nodes.row + (n >> 2U) * level.nodes.layer;
    double weight = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double part = std::clamp((at[axis] - low[axis]) / grid.pitches()[axis], 0.0, 1.0);
      weight *= (n >> axis & 1U) != 0 ? part : 1 - part;
    }
    bool material = false;
    for (std::size_t e = 0; e < kCorners; ++e)
      material =
          material ||
          level.share[a - (e & 1U) - (e >> 1U & 1U) * level.nodes.row - (e >> 2U) * level.nodes.layer] > 0;
    if (!material) continue;
    weights += weight;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * moved[c][a];
  }
  if (weights > 0)
    for (double& s : sum) s /= weights;
  return sum;
}

void Expansion::Model::take_rigid_motion_out() {
  const auto& level = system.finest();
  const Lattice& nodes = level.nodes;
  const auto all_of = [&](std::size_t layers) {
    std::vector<Moved> all;
    for (std::size_t k = 0; k < layers; ++k)
      for (std::size_t j = 0; j < nodes.count[1]; ++j)
        for (std::size_t i = 0; i < nodes.count[0]; ++i)
          if (const std::size_t a = nodes.index(i, j, k); level.inverse[a] > 0)
            all.push_back({place(i, j, k), {moved[0][a], moved[1][a], moved[2][a]}});
    return all;
  };
  auto all = all_of(1);
  if (all.size() < 3) all = all_of(nodes.count[2]);
  if (all.empty()) return;
  Rigid rigid = nearest_rigid(all);
  if (holding.datum) {
    const Three by = displacement(*holding.datum);
    const Three taken = rigid.at({holding.datum->x, holding.datum->y, holding.datum->z});
    for (std::size_t c = 0; c < 3; ++c) rigid.shift[c] += by[c] - taken[c];
  }
  for (std::size_t k = 0; k < nodes.count[2]; ++k)
    for (std::size_t j = 0; j < nodes.count[1]; ++j)
      for (std::size_t i = 0; i < nodes.count[0]; ++i) {
        const std::size_t a = nodes.index(i, j, k);
        if (!(level.inverse[a] > 0)) continue;
        const Three taken = rigid.at(place(i, j, k));
        for (std::size_t c = 0; c < 3; ++c) moved[c][a] -= taken[c];
      }
}

Expansion::Expansion(const Grid& grid, const Elastic& elastic, const Holding& holding, unsigned threads)
    : model_(std::make_unique<Model>(grid, elastic, holding, threads)) {}
Expansion::~Expansion() = default;
Expansion::Expansion(Expansion&&) noexcept = default;
Expansion& Expansion::operator=(Expansion&&) noexcept = default;

void Expansion::follow(const Body& body) {
  Model& m = *model_;
  auto& level = m.system.finest();
  for (std::size_t k = 0; k < m.grid.count[2]; ++k)
    for (std::size_t j = 0; j < m.grid.count[1]; ++j)
      for (std::size_t i = 0; i < m.grid.count[0]; ++i) {
        const std::size_t cell = m.grid.cell(i, j, k);
        const double share = body.share(cell);
        level.share[level.nodes.index(i, j, k)] = share > 0 ? std::max(share, kLeastShare) : 0;
        m.half[cell] = share >= 0.5 ? 1 : 0;
      }
  m.system.coarsen();
  for (Numbers& numbers : m.moved)
    for (std::size_t a = 0; a < numbers.size(); ++a)
      if (!(level.inverse[a] > 0)) numbers[a] = 0;
}

Result<void> Expansion::solve(std::span<const double> temperature, double part) {
  Model& m = *model_;
  m.temperature.assign(temperature.begin(), temperature.end());
  if (!m.system.solve(m.load(), m.moved, part))
    return failure(ErrorCode::refuted,
                   "the displacement of the workpiece is not found; a part of it may hang on a corner alone");
  if (m.is_free()) m.take_rigid_motion_out();
  return {};
}

Place Expansion::moved(Place place) const {
  const Three by = model_->displacement(place);
  return {by[0], by[1], by[2]};
}

std::vector<double> Expansion::mises() const {
  const Model& m = *model_;
  const auto& level = m.system.finest();
  std::vector<double> all(m.grid.size(), 0);
  if (m.temperature.empty()) return all;
  for (std::size_t k = 0; k < m.grid.count[2]; ++k)
    for (std::size_t j = 0; j < m.grid.count[1]; ++j)
      for (std::size_t i = 0; i < m.grid.count[0]; ++i) {
        const std::size_t cell = m.grid.cell(i, j, k), low = level.nodes.index(i, j, k);
        if (m.half[cell] == 0) continue;
        std::array<double, 6> strain{};
        for (std::size_t n = 0; n < kCorners; ++n) {
          const std::size_t a =
              low + (n & 1U) + (n >> 1U & 1U) * level.nodes.row + (n >> 2U) * level.nodes.layer;
          for (std::size_t c = 0; c < kComponents; ++c)
            for (std::size_t s = 0; s < 6; ++s)
              strain[s] += m.system.element().strain[s][3 * n + c] * m.moved[c][a];
        }
        for (std::size_t s = 0; s < 3; ++s) strain[s] -= m.elastic.expansion_per_k * m.temperature[cell];
        all[cell] = m.system.element().mises(strain);
      }
  return all;
}

std::uint64_t Expansion::work() const noexcept { return model_->system.work(); }

}  // namespace lekalo::heat
