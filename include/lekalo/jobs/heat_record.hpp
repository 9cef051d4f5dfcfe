#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lekalo/heat/body.hpp"

namespace lekalo::jobs {

/// Temperatures at a moment, seen along an axis: the warmest voxel behind each place, K above the
/// surroundings; below 0 where there is no material.
struct HeatFrame {
  double seconds = 0;
  std::vector<float> from_above;  ///< x first, then y
  std::vector<float> from_front;  ///< x first, then z
};

/// All voxels of a run with the middle film and the middle heat, for pictures. Of a voxel only moments count
/// in which it was material; values are below 0 where it never was.
struct HeatRecord {
  std::vector<float> warmest_k;   ///< of each voxel, the warmest at any end of a step
  std::vector<float> at_end_k;    ///< at the end of the program; below 0 where there is no material
  std::vector<float> stress_mpa;  ///< of each voxel, the largest by von Mises, as HeatFound has it
  /// Displacement of the corners of voxels at the upper face at the end of the program, mm, x first; as many
  /// as there are corners.
  std::vector<heat::Place> moved;
  /// At most kMostHeatFrames and one. A place of a frame is a square of `fold` voxels each way.
  std::vector<HeatFrame> frames;
  std::size_t fold = 1;
  std::array<std::size_t, 3> count{};  ///< places of frames along x, y and z

  /// Multiplies all temperatures, stresses and displacements.
  void scale(double by);
};
inline constexpr std::size_t kMostHeatFrames = 120;

}  // namespace lekalo::jobs
