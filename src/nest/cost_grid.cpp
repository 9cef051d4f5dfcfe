#include "cost_grid.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::nest {
namespace {

constexpr double kMostNodes = 16e6;  ///< of all rasters

}  // namespace

Box CostGrid::shifts(const Form& fixed, const Form& moved) const {
  const double gap = problem_.widest_gap();
  return {fixed.box.x0 - moved.box.x1 - gap, fixed.box.y0 - moved.box.y1 - gap,
          fixed.box.x1 - moved.box.x0 + gap, fixed.box.y1 - moved.box.y0 + gap};
}

bool CostGrid::pays(const Problem& problem, double pitch) {
  const auto& forms = problem.forms();
  if (forms.size() > 4000) return false;
  double sum_w = 0, sum_h = 0;
  for (const Form& f : forms) {
    sum_w += (f.box.x1 - f.box.x0) / pitch + 1;
    sum_h += (f.box.y1 - f.box.y0) / pitch + 1;
  }
  return 4 * sum_w * sum_h <= kMostNodes;
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
  made.stride = (made.columns + kBlock - 1) / kBlock * kBlock + kBlock;
  made.values.assign(std::size_t{made.stride} * made.rows, 0);
  for (std::uint32_t r = 0; r < made.rows; ++r)
    for (std::uint32_t c = 0; c < made.columns; ++c)
      made.values[std::size_t{r} * made.stride + c] =
          cost_(a, b, (made.column + static_cast<std::int32_t>(c)) * pitch_,
                (made.row + static_cast<std::int32_t>(r)) * pitch_);
  added_ += std::uint64_t{made.columns} * made.rows * 128;
  return made;
}

void CostGrid::begin(double x0, double y0, std::uint32_t columns, std::uint32_t rows) {
  x0_ = x0;
  y0_ = y0;
  columns_ = columns;
  rows_ = rows;
  stride_ = (columns + kBlock - 1) / kBlock * kBlock + kBlock;
  sums_.assign(std::size_t{stride_} * rows_, 0);
}

void CostGrid::add(std::uint32_t fixed, std::uint32_t moved, double x, double y, float weight) {
  const Raster& from = raster(fixed, moved);
  const auto left = static_cast<std::int64_t>(std::lround((x - x0_) / pitch_)) + from.column;
  const auto low = static_cast<std::int64_t>(std::lround((y - y0_) / pitch_)) + from.row;
  const std::int64_t c0 = std::max<std::int64_t>(left, 0),
                     c1 = std::min<std::int64_t>(left + from.columns, columns_),
                     r0 = std::max<std::int64_t>(low, 0), r1 = std::min<std::int64_t>(low + from.rows, rows_);
  if (c0 >= c1 || r0 >= r1) return;
  const auto blocks = static_cast<std::uint32_t>((c1 - c0 + kBlock - 1) / kBlock);
  for (std::int64_t r = r0; r < r1; ++r) {
    float* to = &sums_[static_cast<std::size_t>(r) * stride_ + static_cast<std::size_t>(c0)];
    const float* add =
        &from.values[static_cast<std::size_t>(r - low) * from.stride + static_cast<std::size_t>(c0 - left)];
    for (std::uint32_t k = 0; k < blocks; ++k, to += kBlock, add += kBlock)
      for (std::uint32_t n = 0; n < kBlock; ++n) to[n] += weight * add[n];
  }
  added_ += static_cast<std::uint64_t>(r1 - r0) * blocks * kBlock;
}

}  // namespace lekalo::nest
