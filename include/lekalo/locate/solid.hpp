#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/locate/placement.hpp"
#include "lekalo/locate/solid_proof.hpp"
#include "lekalo/solid/mesh.hpp"
#include "lekalo/solid/motion.hpp"

namespace lekalo::locate {

/// Localisation of a solid part in a solid blank, both closed meshes:
///   maximise the least signed distance of the placed part's material from the blank's surface
/// over the rigid motions in a window about a start. Triangles of the blank may have widths, which are taken
/// off the distances from them. docs/design/locate-solid.md has the method, its bounds and what failed.

/// The place of the part: p goes to R p + shift in the blank's frame, where R is the rotation of the
/// quaternion w + x i + y j + z k, whatever its length.
struct SolidPose {
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< w, x, y, z; not all 0
  solid::Vector shift;                           ///< mm
};
[[nodiscard]] solid::Motion motion_of(const SolidPose& pose) noexcept;

/// The freedoms of the part: its place; also its turn about the z axis of the blank's frame; or all six.
enum class SolidFreedom { xyz, c_xyz, six };

/// The demand of a triangle of the part: what its points have more than the minimum is their margin, in units
/// of the scale.
struct SolidDemand {
  double minimum = 0;  ///< mm, >= 0
  double scale = 1;    ///< > 0
  friend bool operator==(const SolidDemand&, const SolidDemand&) = default;
};

/// A demand on the place of the part: none of some points of it is farther from a plane, a line or a point of
/// the blank's frame than a tolerance. All between the points keeps it, too.
struct SolidDatum {
  enum class On : std::uint8_t { plane, axis, point };
  struct Point {
    solid::Vector place;       ///< part coordinates
    std::uint32_t number = 0;  ///< by which a certificate names it
  };
  On on = On::plane;
  solid::Vector at;         ///< a point of the plane or the line, or the point; blank coordinates
  solid::Vector direction;  ///< the plane's normal, or along the line, of length 1
  double within = 0;        ///< mm, > 0
  std::vector<Point> points;
};

/// A demand on the place of triangles of the part: no point of them is farther from the blank's surface, as
/// its mesh has it, than `within`. So a face has no more allowance than that.
struct SolidNear {
  std::vector<std::uint32_t> triangles;
  double within = 0;  ///< mm, > 0
  /// Points of other triangles that are nearer than this to these demand nothing, mm, >= 0: the rim of a
  /// finished face, which may stick out as the face does.
  double rim = 0;
  /// Measurements may say this much more than is there; poses are looked for that leave four times that, mm.
  [[nodiscard]] double slack() const noexcept { return std::min(0x1p-12 * within, 0x1p-10); }
};

struct SolidProblem {
  solid::Mesh part, blank;  ///< closed (solid::closed_mesh)
  SolidPose start;
  SolidFreedom freedom = SolidFreedom::six;
  /// The middle of the part's box may move by this along each axis, mm.
  double shift = 5;
  /// With `six` the window has every rotation by up to this from the start, and some by more: those with each
  /// part of tan(angle / 2) times the axis up to tan(turn / 2). With `c_xyz` it has the turns about z by up
  /// to this. rad, at most a quarter turn; or kAllTurns, which stands for every rotation, or turn about z.
  static constexpr double kAllTurns = kPi;
  double turn = 0.0872664625997165;
  /// Every coordinate may differ from the true one (the decimal in the file) by up to this, mm. The errors
  /// are taken off the clearance and added to the upper bound.
  double part_coordinate_error = 0, blank_coordinate_error = 0;
  /// The material may begin so far inside each triangle of the blank, mm, >= 0 (GuaranteedSolid::widths);
  /// empty for a blank taken as drawn. None is below the true one, or above it by more than the error.
  std::vector<double> blank_widths = {};
  double blank_width_error = 0;
  /// The demand of each triangle of the part; one that is as cast has none and may stick out of the blank.
  /// Then the least margin is maximised. Empty: the allowance counts, everywhere alike.
  std::vector<std::optional<SolidDemand>> demands = {};
  /// The allowance that each triangle of the part should have where it does not matter otherwise, mm, >= 0
  /// (most_even). Empty: none has one.
  std::vector<std::optional<double>> targets = {};
  /// Poses that do not keep these count for nothing.
  std::vector<SolidDatum> datums = {};
  /// So do poses that do not keep these.
  std::vector<SolidNear> nears = {};
};

struct SolidOptions {
  /// The search stops when upper bound - margin is this small, mm, > 0.
  double gap = 1e-2;
  /// The status is infeasible when this margin is provably not reachable, mm.
  double min_allowance = 0;
  /// They change the time and nothing else.
  unsigned threads = kUsualThreads;
  /// One unit of work is one box bounded, one program solved or one pose measured.
  RunControl run;
};

/// A place that holds a placement: where the part is nearest to the blank's surface.
struct SolidTouch {
  std::uint32_t part_triangle = 0, blank_triangle = 0;
  solid::Vector part, blank;  ///< the two points, each in its own frame, mm
  double distance = 0;        ///< mm, at the placement, less the width of the blank's triangle
  /// The contact's share in what holds the placement; all shares sum to 1.
  double multiplier = 0;
};

struct SolidPlacement {
  SolidPose pose;
  /// True if the part lies inside the blank there; else there is no clearance. With demands it is true if the
  /// triangles that have one do so, and no surface of the blank lies in the part as a whole; and if all
  /// datums and distances are kept, too.
  bool inside = false;
  /// The least allowance at that very pose, of triangles that have a demand, mm, never above the exact one;
  /// above 0 where it is inside.
  double clearance = 0;
  std::vector<SolidTouch> contacts;
  std::uint64_t work = 0;
  /// The least margin there, mm, never above the exact one; the clearance, where there are no demands.
  double margin = 0;
  /// No point of each datum is farther off there, mm.
  std::vector<double> off = {};
  /// No point of the triangles of each SolidNear is farther from the blank's surface there, mm; above it by
  /// no more than a few times its slack, unless the meshes are very fine.
  std::vector<double> far = {};
};

struct SolidResult {
  /// It is `stopped`, too, where no pose was found inside and none has more than the gap.
  Status status = Status::stopped;
  SolidPlacement best;
  /// No placement of the window that keeps datums and distances has more margin, which is the clearance
  /// without demands; rounded up. Where none keeps them it is below all margins of poses inside.
  double upper_bound = 0;
  /// The reason why, also of a search that was stopped. Triangles are numbered as in the problem.
  SolidProof proof;
  std::uint64_t boxes = 0;
};

/// A start for a part that may lie anywhere: the best place that climbs from rotations all over find, which
/// are those that the freedom has, counted from the start of the problem; its window does not matter. From
/// the work limit on no further climb begins. Refuses what place_solid refuses. Deterministic;
/// single-threaded.
[[nodiscard]] Result<SolidPlacement> find_start(const SolidProblem& problem, const SolidOptions& options);

/// A quick placement without a bound: climbs from the start to a place that no small motion makes better, and
/// where the window has all turns from other rotations, too. It need not be the best one of the window.
/// ErrorCode::usage for a window or numbers that make no sense, bad_input for meshes without triangles.
/// Deterministic, and the same result for any number of threads.
[[nodiscard]] Result<SolidPlacement> place_solid(const SolidProblem& problem, const SolidOptions& options);

/// Searches the whole window. Refuses what place_solid refuses. The same result for any number of threads.
[[nodiscard]] Result<SolidResult> locate_solid(const SolidProblem& problem, const SolidOptions& options);

}  // namespace lekalo::locate
