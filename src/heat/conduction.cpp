#include "lekalo/heat/conduction.hpp"

#include <cmath>
#include <numbers>

#include "flow.hpp"
#include "lekalo/base/assert.hpp"

namespace lekalo::heat {
namespace {

/// The diagonally implicit method of Runge and Kutta of two stages that damps what is stiff (R. Alexander,
/// SIAM J. Numer. Anal. 14, 1977): each stage solves with the same matrix.
constexpr double kGamma = 1 - 1 / std::numbers::sqrt2;
constexpr double kSolved = 1e-7;

/// W/K through a surface: a film, and the way from the voxel's middle to it, one behind the other.
double passage(double area, double film, double way, double conductivity) {
  if (!(area > 0) || !(film > 0)) return 0;
  const double resistance = (std::isinf(film) ? 0 : 1 / film) + way / conductivity;
  // A wall through a voxel's middle, held at a temperature, is met after a tenth of a way that cannot be
  // told.
  return area / std::max(resistance, 1e-9 / conductivity);
}

}  // namespace

double HeatBook::balance() const noexcept {
  const double moved = std::max({std::abs(in), std::abs(stored), std::abs(lost), std::abs(removed)});
  return moved > 0 ? std::abs(in - stored - lost - removed) / moved : 0;
}

struct Conduction::Model {
  Grid grid;
  Conductor conductor;
  Films films;
  unsigned threads;
  FlowSystem system;
  Numbers temperature;          // on the lattice
  std::array<Numbers, 2> rate;  // of the two stages of the last step, K/s; where the next begins to look
  HeatBook book;

  Model(const Body& body, const Conductor& c, const Films& f, unsigned t)
      : grid(body.grid()), conductor(c), films(f), threads(t), system(grid.count, t) {
    for (Numbers* numbers : {&temperature, &rate[0], &rate[1]}) numbers->assign(lattice().size, 0.0);
    shape(body);
  }
  [[nodiscard]] const Lattice& lattice() const noexcept { return system.finest().lattice; }
  [[nodiscard]] std::size_t at(std::size_t cell) const noexcept {
    const auto [nx, ny, nz] = grid.count;
    return lattice().index(cell % nx, cell / nx % ny, cell / nx / ny);
  }
  void shape(const Body& body);
  [[nodiscard]] double stored() const;
  Result<void> stage(const Numbers& heat, const Numbers& base, Numbers& rates, double seconds, double part);
};

void Conduction::Model::shape(const Body& body) {
  Flow<double>& level = system.finest();
  const auto [nx, ny, nz] = grid.count;
  const std::array<double, 3> pitch = grid.pitches();
  const double volume = grid.volume();
  std::vector<float> whole(level.lattice.size, 0.0F);
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const std::size_t cell = grid.cell(i, j, k), a = level.lattice.index(i, j, k);
        level.capacity[a] = conductor.heat_capacity * body.share(cell) * volume;
        double loss = passage(body.wall(cell), films.cut, body.depth(cell), conductor.conductivity);
        const std::array<std::size_t, 3> place{i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double area = volume / pitch[axis];
          const double open = area * body.open(axis, i, j, k);
          if (place[axis] > 0)
            level.joint[axis][a] = conductor.conductivity * open / pitch[axis];
          else
            loss += passage(open, films.sides[2 * axis], pitch[axis] / 2, conductor.conductivity);
          if (place[axis] + 1 == grid.count[axis])
            loss += passage(area * body.open(axis, i + (axis == 0 ? 1 : 0), j + (axis == 1 ? 1 : 0),
                                             k + (axis == 2 ? 1 : 0)),
                            films.sides[2 * axis + 1], pitch[axis] / 2, conductor.conductivity);
        }
        level.loss[a] = loss;
        whole[a] = body.share(cell) == 1 ? 1.0F : 0.0F;
        if (level.capacity[a] > 0) continue;
        level.loss[a] = 0;
        temperature[a] = rate[0][a] = rate[1][a] = 0;
      }
  std::array<double, 3> links{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    links[axis] = conductor.conductivity * volume / (pitch[axis] * pitch[axis]);
  system.set_wholes(std::move(whole), links, pitch, conductor.heat_capacity * volume);
  system.coarsen();
}

double Conduction::Model::stored() const {
  const Flow<double>& level = system.finest();
  return sum_of_rows(level.lattice, threads, [&](std::size_t first, std::size_t end) {
    double sum = 0;
    for (std::size_t r = first; r < end; ++r) {
      const std::size_t begin = level.lattice.begin_of_row(r);
      for (std::size_t a = begin; a < begin + level.lattice.count[0]; ++a)
        sum += level.capacity[a] * temperature[a];
    }
    return sum;
  });
}

/// Finds the rates at which (capacity + gamma seconds flow) rate = heat - flow(base), and books what the
/// surroundings get meanwhile.
Result<void> Conduction::Model::stage(const Numbers& heat, const Numbers& base, Numbers& rates,
                                      double seconds, double part) {
  const Flow<double>& level = system.finest();
  const double per_second = 1 / (kGamma * seconds);
  Numbers b(base.size(), 0.0);
  system.flow(base, b);
  for (std::size_t a = 0; a < b.size(); ++a) b[a] = per_second * (heat[a] - b[a]);
  if (!system.solve(b, rates, kSolved))
    return failure(ErrorCode::refuted, "the equations of conduction are not solved; choose larger voxels");
  double lost = 0;
  for (std::size_t a = 0; a < base.size(); ++a)
    lost += level.loss[a] * (base[a] + kGamma * seconds * rates[a]);
  book.lost += part * seconds * lost;
  return {};
}

Conduction::Conduction(const Body& body, const Conductor& conductor, const Films& films, unsigned threads)
    : model_(std::make_unique<Model>(body, conductor, films, threads)) {}
Conduction::~Conduction() = default;
Conduction::Conduction(Conduction&&) noexcept = default;
Conduction& Conduction::operator=(Conduction&&) noexcept = default;

void Conduction::set(std::span<const double> temperature) {
  Model& m = *model_;
  for (std::size_t cell = 0; cell < temperature.size(); ++cell) {
    const std::size_t a = m.at(cell);
    m.temperature[a] = m.system.finest().capacity[a] > 0 ? temperature[cell] : 0;
  }
  const double stored = m.stored();
  m.book.in += stored - m.book.stored;
  m.book.stored = stored;
}

void Conduction::follow(const Body& body, std::span<const Changed> changed) {
  Model& m = *model_;
  const double capacity = m.conductor.heat_capacity * m.grid.volume();
  for (const Changed& c : changed)
    m.book.removed += capacity * (c.before - c.after) * m.temperature[m.at(c.cell)];
  m.shape(body);
  m.book.stored = m.stored();
}

void Conduction::surround(const Body& body, const Films& films) {
  model_->films = films;
  model_->shape(body);
}

Result<void> Conduction::step(double seconds, std::span<const Source> sources) {
  Model& m = *model_;
  const std::size_t size = m.lattice().size;
  Numbers heat(size, 0.0), base = m.temperature;
  for (const Source& source : sources) {
    const std::size_t a = m.at(source.cell);
    LEKALO_ASSERT(m.system.finest().capacity[a] > 0);
    heat[a] += source.watts;
    m.book.in += seconds * source.watts;
  }
  m.system.scale(1 / (kGamma * seconds));
  heat = m.system.spread(heat);
  LEKALO_CHECK(m.stage(heat, base, m.rate[0], seconds, 1 - kGamma));
  for (std::size_t a = 0; a < size; ++a) base[a] += (1 - kGamma) * seconds * m.rate[0][a];
  LEKALO_CHECK(m.stage(heat, base, m.rate[1], seconds, kGamma));
  for (std::size_t a = 0; a < size; ++a) m.temperature[a] = base[a] + kGamma * seconds * m.rate[1][a];
  m.book.stored = m.stored();
  return {};
}

std::vector<double> Conduction::temperatures() const {
  std::vector<double> all(model_->grid.size());
  for (std::size_t cell = 0; cell < all.size(); ++cell) all[cell] = model_->temperature[model_->at(cell)];
  return all;
}
double Conduction::temperature(std::size_t cell) const { return model_->temperature[model_->at(cell)]; }
const HeatBook& Conduction::book() const noexcept { return model_->book; }
std::uint64_t Conduction::work() const noexcept { return model_->system.work(); }

}  // namespace lekalo::heat
