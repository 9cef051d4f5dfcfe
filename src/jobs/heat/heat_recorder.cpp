#include "heat_recorder.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::jobs {
namespace {

/// A view of a frame has at most so many places.
constexpr std::size_t kMostPlaces = 8000;
constexpr float kAir = -1;

float warmth(double kelvin) { return static_cast<float>(std::max(0.0, kelvin)); }

/// The least number of voxels each way that leaves few enough places.
std::size_t fold_of(const heat::Grid& grid) {
  const auto places = [&](std::size_t fold) {
    const auto of = [&](std::size_t axis) { return (grid.count[axis] + fold - 1) / fold; };
    return of(0) * std::max(of(1), of(2));
  };
  std::size_t fold = 1;
  while (places(fold) > kMostPlaces) ++fold;
  return fold;
}

}  // namespace

HeatRecorder::HeatRecorder(const heat::Grid& grid, std::size_t steps)
    : grid_(grid), every_((steps + kMostHeatFrames - 1) / kMostHeatFrames), steps_(steps) {
  record_.warmest_k.resize(grid.size(), kAir);
  record_.stress_mpa.resize(grid.size(), kAir);
  record_.fold = fold_of(grid);
  for (std::size_t axis = 0; axis < 3; ++axis)
    record_.count[axis] = (grid.count[axis] + record_.fold - 1) / record_.fold;
}

void HeatRecorder::step(const heat::Body& body, const std::vector<double>& temperatures, double seconds) {
  for (std::size_t cell = 0; cell < temperatures.size(); ++cell)
    if (body.share(cell) > 0)
      record_.warmest_k[cell] = std::max(record_.warmest_k[cell], warmth(temperatures[cell]));
  ++done_;
  if (done_ % every_ == 0 || done_ == steps_) add_frame(body, temperatures, seconds);
}

void HeatRecorder::add_frame(const heat::Body& body, const std::vector<double>& temperatures,
                             double seconds) {
  const auto [nx, ny, nz] = record_.count;
  HeatFrame frame{seconds, std::vector<float>(nx * ny, kAir), std::vector<float>(nx * nz, kAir)};
  std::size_t cell = 0;
  for (std::size_t k = 0; k < grid_.count[2]; ++k)
    for (std::size_t j = 0; j < grid_.count[1]; ++j)
      for (std::size_t i = 0; i < grid_.count[0]; ++i, ++cell) {
        if (!(body.share(cell) > 0)) continue;
        const std::size_t x = i / record_.fold, y = j / record_.fold, z = k / record_.fold;
        for (float* place : {&frame.from_above[y * nx + x], &frame.from_front[z * nx + x]})
          *place = std::max(*place, warmth(temperatures[cell]));
      }
  record_.frames.push_back(std::move(frame));
}

void HeatRecorder::stress(const std::vector<double>& stress) {
  for (std::size_t cell = 0; cell < stress.size(); ++cell)
    if (stress[cell] > 0)
      record_.stress_mpa[cell] = std::max(record_.stress_mpa[cell], static_cast<float>(stress[cell]));
}

void HeatRecorder::end(const heat::Body& body, const std::vector<double>& temperatures,
                       const heat::Expansion& expansion) {
  record_.at_end_k.resize(grid_.size(), kAir);
  for (std::size_t cell = 0; cell < temperatures.size(); ++cell)
    if (body.share(cell) > 0) record_.at_end_k[cell] = warmth(temperatures[cell]);
  const double top = grid_.low.z + static_cast<double>(grid_.count[2]) * grid_.pitch.z;
  for (std::size_t j = 0; j <= grid_.count[1]; ++j)
    for (std::size_t i = 0; i <= grid_.count[0]; ++i)
      record_.moved.push_back(expansion.moved({grid_.low.x + static_cast<double>(i) * grid_.pitch.x,
                                               grid_.low.y + static_cast<double>(j) * grid_.pitch.y, top}));
}

void HeatRecord::scale(double by) {
  const auto scaled = [&](std::vector<float>& values) {
    for (float& value : values)
      if (value > 0) value = static_cast<float>(by * value);
  };
  for (std::vector<float>* values : {&warmest_k, &at_end_k, &stress_mpa}) scaled(*values);
  for (heat::Place& place : moved) place = {by * place.x, by * place.y, by * place.z};
  for (HeatFrame& frame : frames) scaled(frame.from_above), scaled(frame.from_front);
}

}  // namespace lekalo::jobs
