#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "lekalo/heat/body.hpp"
#include "lekalo/heat/expansion.hpp"
#include "lekalo/jobs/heat_record.hpp"

namespace lekalo::jobs {

/// Keeps what pictures show of a run.
class HeatRecorder {
 public:
  /// \param steps  of the run
  HeatRecorder(const heat::Grid& grid, std::size_t steps);

  /// \param temperatures  of each voxel at the end of a step, K
  void step(const heat::Body& body, const std::vector<double>& temperatures, double seconds);
  /// \param stress  of each voxel, MPa
  void stress(const std::vector<double>& stress);
  /// \pre the displacements at the end of the program are solved for
  void end(const heat::Body& body, const std::vector<double>& temperatures, const heat::Expansion& expansion);

  [[nodiscard]] HeatRecord take() && { return std::move(record_); }

 private:
  void add_frame(const heat::Body& body, const std::vector<double>& temperatures, double seconds);

  heat::Grid grid_;
  std::size_t every_, steps_, done_ = 0;
  HeatRecord record_;
};

}  // namespace lekalo::jobs
