#include "cost_grid.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/base/wide.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

constexpr float kCostsPerUnit = 1u << 14;  ///< costs are multiples of one over this

constexpr std::uint32_t kBlock = CostGrid::kBlock;

LEKALO_WIDE void add_scaled(float* to, std::size_t to_stride, const float* from, std::size_t from_stride,
                            std::size_t rows, std::size_t blocks, float weight) {
  for (std::size_t r = 0; r < rows; ++r, to += to_stride, from += from_stride)
    for (std::size_t k = 0; k < blocks * kBlock; k += kBlock)
      for (std::size_t n = k; n < k + kBlock; ++n) to[n] += weight * from[n];
}

/// The first of so many blocks with a number below the limit. Eight blocks are looked at together first,
/// because most have none.
LEKALO_WIDE std::uint32_t first_below(const float* row, std::uint32_t block, std::uint32_t blocks,
                                      float limit) {
  constexpr std::uint32_t kTogether = 8;
  for (; block + kTogether <= blocks; block += kTogether) {
    const float* at = row + std::size_t{block} * kBlock;
    float least[kBlock];
    for (std::uint32_t n = 0; n < kBlock; ++n) least[n] = at[n];
    for (std::uint32_t k = kBlock; k < kTogether * kBlock; k += kBlock)
      for (std::uint32_t n = 0; n < kBlock; ++n) least[n] = at[k + n] < least[n] ? at[k + n] : least[n];
    bool below = false;
    for (std::uint32_t n = 0; n < kBlock; ++n) below |= least[n] < limit;
    if (below) break;
  }
  for (; block < blocks; ++block) {
    const float* at = row + std::size_t{block} * kBlock;
    bool below = false;
    for (std::uint32_t n = 0; n < kBlock; ++n) below |= at[n] < limit;
    if (below) break;
  }
  return block;
}

float rounded(float cost) { return std::round(kCostsPerUnit * cost) / kCostsPerUnit; }

std::uint32_t blocks_of(std::size_t columns) {
  return static_cast<std::uint32_t>((columns + kBlock - 1) / kBlock);
}

}  // namespace

void NodeGrid::begin(double from_x, double from_y, std::uint32_t column_count, std::uint32_t row_count) {
  x0 = from_x;
  y0 = from_y;
  columns = column_count;
  rows = row_count;
  stride = (blocks_of(columns) + 1) * kBlock;
  sums.assign(std::size_t{stride} * rows, 0);
}

void NodeGrid::add(const NodeGrid& from, std::uint32_t column, std::uint32_t row, float weight) {
  add_scaled(sums.data(), stride, from.row(row) + column, from.stride, rows, blocks_of(columns), weight);
}

std::uint32_t NodeGrid::block_below(std::uint32_t r, std::uint32_t block, float limit) const noexcept {
  return first_below(row(r), block, blocks_of(columns), limit);
}

Box CostGrid::shifts(const Form& fixed, const Form& moved) const {
  const double gap = problem_.widest_gap();
  return {fixed.box.x0 - moved.box.x1 - gap, fixed.box.y0 - moved.box.y1 - gap,
          fixed.box.x1 - moved.box.x0 + gap, fixed.box.y1 - moved.box.y0 + gap};
}

bool CostGrid::pays(const Problem& problem, double pitch, bool parts_only) {
  const auto& forms = problem.forms();
  if (forms.size() > tuning::kMostRasterForms) return false;
  double sum_w = 0, sum_h = 0;
  for (const Form& f : forms) {
    if (parts_only && problem.kind_of(f) != SearchShape::Kind::part) continue;
    sum_w += (f.box.x1 - f.box.x0) / pitch + 1;
    sum_h += (f.box.y1 - f.box.y0) / pitch + 1;
  }
  return 4 * sum_w * sum_h <= tuning::kMostRasterNodes;
}

CostGrid::CostGrid(const Problem& problem, double pitch, PairCost cost)
    : problem_(problem), pitch_(pitch), cost_(std::move(cost)) {
  rasters_.resize(problem.forms().size() * problem.forms().size());
}

const CostGrid::Raster& CostGrid::raster(std::uint32_t fixed, std::uint32_t moved) {
  Raster& made = rasters_[fixed * problem_.forms().size() + moved];
  if (made.rows > 0) return made;
  const Form& a = problem_.forms()[fixed];
  const Form& b = problem_.forms()[moved];
  const Box range = shifts(a, b);
  made.column = static_cast<std::int32_t>(std::floor(range.x0 / pitch_));
  made.row = static_cast<std::int32_t>(std::floor(range.y0 / pitch_));
  made.columns = static_cast<std::uint32_t>(std::ceil(range.x1 / pitch_) - made.column + 1);
  made.rows = static_cast<std::uint32_t>(std::ceil(range.y1 / pitch_) - made.row + 1);
  made.stride = (blocks_of(made.columns) + 1) * kBlock;
  made.values.assign(std::size_t{made.stride} * made.rows, 0);
  for (std::uint32_t r = 0; r < made.rows; ++r) {
    ask(1 + made.columns / 8);
    for (std::uint32_t c = 0; c < made.columns; ++c)
      made.values[std::size_t{r} * made.stride + c] =
          rounded(cost_(a, b, (made.column + static_cast<std::int32_t>(c)) * pitch_,
                        (made.row + static_cast<std::int32_t>(r)) * pitch_));
  }
  added_ += std::uint64_t{made.columns} * made.rows * tuning::kMadeNode;
  return made;
}

void CostGrid::add_obstacles(NodeGrid& to, const std::vector<Obstacle>& obstacles, std::uint32_t moved) {
  const Form& form = problem_.forms()[moved];
  for (const Obstacle& o : obstacles)
    for (std::uint32_t r = 0; r < to.rows; ++r) {
      ask(1 + to.columns / 8);
      for (std::uint32_t c = 0; c < to.columns; ++c)
        to.sums[std::size_t{r} * to.stride + c] += rounded(
            cost_(problem_.forms()[o.form], form, to.x0 + c * pitch_ - o.x, to.y0 + r * pitch_ - o.y));
    }
  added_ += std::uint64_t{to.columns} * to.rows * obstacles.size() * tuning::kMadeNode;
}

void CostGrid::add(NodeGrid& to, std::uint32_t fixed, std::uint32_t moved, double x, double y, float weight) {
  const Raster& from = raster(fixed, moved);
  const auto left = static_cast<std::int64_t>(std::lround((x - to.x0) / pitch_)) + from.column;
  const auto low = static_cast<std::int64_t>(std::lround((y - to.y0) / pitch_)) + from.row;
  const std::int64_t c0 = std::max<std::int64_t>(left, 0),
                     c1 = std::min<std::int64_t>(left + from.columns, to.columns),
                     r0 = std::max<std::int64_t>(low, 0),
                     r1 = std::min<std::int64_t>(low + from.rows, to.rows);
  if (c0 >= c1 || r0 >= r1) return;
  const auto rows = static_cast<std::size_t>(r1 - r0);
  const std::size_t blocks = blocks_of(static_cast<std::size_t>(c1 - c0));
  add_scaled(
      &to.sums[static_cast<std::size_t>(r0) * to.stride + static_cast<std::size_t>(c0)], to.stride,
      &from.values[static_cast<std::size_t>(r0 - low) * from.stride + static_cast<std::size_t>(c0 - left)],
      from.stride, rows, blocks, weight);
  added_ += rows * blocks * kBlock;
}

}  // namespace lekalo::nest
