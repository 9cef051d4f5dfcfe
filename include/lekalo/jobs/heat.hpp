#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/heat/body.hpp"
#include "lekalo/heat/conduction.hpp"
#include "lekalo/heat/expansion.hpp"
#include "lekalo/heat/material.hpp"
#include "lekalo/jobs/heat_record.hpp"
#include "lekalo/jobs/heat_source.hpp"
#include "lekalo/jobs/phases.hpp"

namespace lekalo::jobs {

/// A thermocouple of type K and class 2 may be so far off, K (IEC 60584-1, up to 333 degrees Celsius).
inline constexpr double kUsualUncertainty = 2.5;

/// A temperature that was measured in the workpiece while the program ran.
struct MeasuredTemperature {
  double celsius = 0;
  heat::Place at;                            ///< mm, in the program's coordinates
  double seconds = 0;                        ///< of the program, from its start
  double uncertainty_k = kUsualUncertainty;  ///< above 0; the true one is surely within this
};

/// A program, and what is needed to say how warm it makes the workpiece and what that does to the walls.
struct HeatJob {
  HeatSourceJob source;     ///< force and share are those of the material
  heat::Material material;  ///< the middles of its figures, but for force and share
  heat::Interval film;      ///< W/(m2 K), of all surfaces but the underside and those that are held
  heat::Holding holding;
  double pitch = 2;       ///< of voxels, mm
  double ambient_c = 20;  ///< degrees Celsius
  std::vector<MeasuredTemperature> measured;
  bool record = false;  ///< keeps what pictures show of all voxels: 12 bytes each, and the frames
  unsigned threads = kUsualThreads;
};

/// A place of a wall that a program has cut.
struct WallPoint {
  double x = 0, y = 0, z = 0;       ///< mm
  std::array<double, 2> outward{};  ///< from the pocket into the workpiece, of length 1
  double seconds = 0;               ///< of the visit that decided
  /// How far the wall lies behind its place when the workpiece is cold again, um: the pocket is larger where
  /// it is above 0. At the middles of all intervals, and over all of them.
  double error_um = 0;
  heat::Interval errors_um;
};

/// The tool beside a place of a wall: one visit.
struct WallVisit {
  double at = 0;                    ///< when it is nearest, s
  std::size_t first = 0, last = 0;  ///< in HeatSource::pieces, while it is there, both ends among them
};

struct WallErrors {
  double least = 0, most = 0, mean = 0;  ///< um

  [[nodiscard]] double largest() const noexcept;  ///< distance from 0
};

/// The scaling and the shift of the program that leave the least squares of errors.
struct UniformScaling {
  double factor = 1;
  std::array<double, 2> centre{};    ///< of the walls, mm, about which is scaled
  std::array<double, 2> shift_um{};  ///< of that centre
  WallErrors left;
};

/// One film of the cooling, with the middle of the heat: that of force and share, or of what measurements
/// leave of their product.
struct HeatCase {
  double film = 0;                ///< W/(m2 K)
  std::vector<double> errors_um;  ///< of each place of a wall
  /// How far each place is displaced along X and Y at each of its visits, um.
  std::vector<std::vector<std::array<double, 2>>> moved_um;
  WallErrors errors;
  UniformScaling scaling;
  double warmest_k = 0, stress_mpa = 0;
  heat::Place stress_at;      ///< of the largest stress, mm
  double stress_seconds = 0;  ///< when it was
  heat::HeatBook book;        ///< at the end of the program
  double not_placed_j = 0;
  /// After the program, until half and until a tenth of its heat is left in the workpiece, s; none where that
  /// takes more than kLongestWait.
  std::optional<double> half_s, tenth_s;
  /// The temperature of each measured place when it was measured, if all of the middle work were heat, K.
  std::vector<double> rises_k;
};
inline constexpr double kLongestWait = 1e5;  // s

/// The largest error where one of the figures is anywhere in its interval and the others are in their
/// middles, um.
struct HeatSensitivity {
  heat::Interval share, force, film;
};

/// The errors of walls over the intervals of film, force and share.
struct WallIntervals {
  heat::Interval least, most, mean, largest;  ///< um; the largest is a distance
};

struct HeatFound {
  HeatSource source;
  heat::Grid grid;
  std::vector<WallPoint> walls;
  std::vector<std::vector<WallVisit>> visits;  ///< of each of them, in their order
  std::size_t uncut = 0;                       ///< places of walls that the program does not cut
  /// For the least film, the middle one and the greatest; one where it is one.
  std::vector<HeatCase> cases;
  /// The heat that goes into the workpiece, J, and the share, as measurements leave them. The heat is less in
  /// doubt than either share or force: it is their product that warms.
  heat::Interval heat_j, share;
  std::vector<heat::Interval> supported_j;  ///< the heat that each of the measurements supports
  /// The least and the greatest heat of the workpiece, as parts of that of the cases.
  heat::Interval heat_parts{1, 1};
  WallErrors errors;  ///< at the middles
  WallIntervals errors_over;
  heat::Interval largest_um;  ///< the largest distance of any wall from its place, over the intervals
  HeatSensitivity sensitivity;
  UniformScaling scaling;  ///< at the middles
  heat::Interval factors;  ///< of the scalings that would be best, over the intervals
  /// The scaling of the middles leaves these, over the intervals.
  WallIntervals scaled_over;
  /// The warmest of all voxels at the ends of steps, above the surroundings. Beside the tool it is too low,
  /// because heat is spread over what the tool passes in a step; so is the stress.
  heat::Interval warmest_k;
  /// Stress by von Mises, when the tool was beside walls.
  heat::Interval stress_mpa;
  heat::HeatBook book;               ///< at the middles, at the end of the program
  double not_placed_j = 0;           ///< heat of cuts about which no material is left, at the middles
  std::optional<HeatRecord> record;  ///< where it was asked for
  std::uint64_t work = 0;

  /// The case of the middle film.
  [[nodiscard]] const HeatCase& middle() const noexcept { return cases[cases.size() / 2]; }
};

/// Follows the program in voxels: heat enters where the tool cuts, material goes away, and the displacement
/// is known whenever the tool is beside a place of a wall. docs/design/heat-walls.md.
///
/// Errors: bad_input for what heat_source() and heat::Grid::divide refuse, for voxels larger than the stock
/// or the pocket, for a datum that is outside of the stock or cut away, where no place of a wall is cut,
/// where the workpiece surely gets warmer than the material's figures hold, and for measurements outside of
/// the stock or of the program, in the air, where no heat has come, and which contradict what is stated or
/// each other; refuted where the equations are not solved. Phases: "following the program", "heating" and,
/// with more than one film, "heating, least cooling" and so on. Cost: about 300 steps in time for each of
/// three films, and a displacement for each in which the tool is beside a wall.
[[nodiscard]] Result<HeatFound> heat(const HeatJob& job, const PhaseListener& phases = {});

}  // namespace lekalo::jobs
