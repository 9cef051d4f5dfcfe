#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lekalo/jobs/heat.hpp"

namespace lekalo::jobs {

/// The place of the way at which the tool is nearest to a place of a wall, by lines and arcs and not by their
/// pieces' chords.
struct BesideWall {
  double distance = 0;              ///< mm
  std::array<double, 2> towards{};  ///< from there to the place, of length 1
  std::size_t piece = 0;            ///< in HeatSource::pieces
  double share = 0;                 ///< of that piece
};

/// \pre a visit of that place
[[nodiscard]] BesideWall beside(const HeatSource& source, const WallPoint& wall, const WallVisit& visit);

/// Returns the distance of the nearest of all pieces that are as deep as a place, mm.
[[nodiscard]] double nearest_of_all(const HeatSource& source, const WallPoint& wall);

/// Finds the places of one run in another, which may have one more or less at the limit of what is cut.
class SamePlaces {
 public:
  explicit SamePlaces(const std::vector<WallPoint>& walls);
  /// The number of the place, or walls.size().
  [[nodiscard]] std::size_t find(const WallPoint& wall) const;

 private:
  const std::vector<WallPoint>* walls_;
  std::vector<std::size_t> order_;
};

}  // namespace lekalo::jobs
