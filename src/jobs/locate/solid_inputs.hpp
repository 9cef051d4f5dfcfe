#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/locate_solid.hpp"
#include "lekalo/jobs/phases.hpp"

namespace lekalo::jobs {

/// A file of a solid has this beside its triangles.
struct ReadSolid {
  io::SolidUnit unit = io::SolidUnit::millimetre;
  std::size_t triangles = 0;        ///< of the file
  std::optional<double> deviation;  ///< of a mesh by lekalo-step, mm
  std::optional<double> volume;     ///< mm3, if the depths of all shells are known
  /// The number in the file of each triangle of the mesh, and which are turned round.
  std::vector<std::uint32_t> numbers;
  std::vector<bool> turned;
};

/// The mesh that was made of a blank's points, or moved to them.
struct MeshedPoints {
  File mesh;
  io::SolidUnit unit = io::SolidUnit::millimetre;  ///< of the points
  std::size_t points = 0;
};

/// The files of a job, read.
struct SolidInputs {
  locate::SolidProblem problem;
  solid::Vector pivot;  ///< of its window
  double turn_deg = 0;  ///< the half width of its turns; 180 for all of them
  ReadSolid part, blank;
  /// The mesh that was moved to touches; `meshed` is what became of it.
  std::optional<ReadSolid> nominal;
  /// Counts as the blank instead of a file of points.
  std::optional<MeshedPoints> meshed;
  /// Its points but for those that were left out, and the numbers of these until the scan is read.
  std::vector<solid::Vector> points;
  std::vector<std::uint32_t> left_out;
  std::optional<io::SolidScanRecord> scan;
  std::vector<std::uint32_t> unknown;  ///< triangles of the scan that no assumption covers
  /// The demands of a file of features, without what comes of them.
  std::optional<io::SolidDemandRecord> demands;
  /// The features of problem.nears, by their places.
  std::vector<std::size_t> near_features;
  /// The bodies that the meshes stand for differ from them by no more than this together, mm: it is taken off
  /// clearances and added to bounds.
  [[nodiscard]] double deviation() const noexcept;
  /// The smallest scale of a demand, 1 at most: lengths that are lost are so many margins the more.
  [[nodiscard]] double least_scale() const noexcept;
  std::vector<std::string> notices;
};

/// Reads each file once and closes the meshes. The window is still to be set.
[[nodiscard]] Result<SolidInputs> read_inputs(const SolidLocateJob& job, const PhaseListener& phases);

/// Sets the window about the start, which is turned to the middle of the turns looked at.
void set_window(const SolidLocateOptions& options, SolidInputs& in);

}  // namespace lekalo::jobs
