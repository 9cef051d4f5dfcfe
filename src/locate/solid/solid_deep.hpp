#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "solid_near.hpp"
#include "solid_rows.hpp"

namespace lekalo::locate {

// Poses that keep a margin, and how deep they lie: what the criteria after the largest margin go over.

/// The triangles that have a demand. How near they are to be says how well their distances are looked for.
[[nodiscard]] SolidNear demanded(const SolidProblem& problem, double within);

/// Refuses, with ErrorCode::usage, a placement that is not inside, or has less margin.
[[nodiscard]] Result<void> check_kept(const SolidPlacement& from, double least_margin);

/// So much more margin than what is kept is aimed at by steps up to `reach`, of `spare` that there is, mm: a
/// turn bends by that what is linear in a step. The other way round: the longest turn for which that is
/// enough, mm at the part's ends.
[[nodiscard]] double room_for_turns(const SolidFrame& frame, double spare, double reach);
[[nodiscard]] double most_turn_in(const SolidFrame& frame, double room);

/// A pose that is allowed, and how deep it lies.
struct DeepPose {
  MeasuredSolid at;
  double deepest = 0;
  std::vector<SolidContact> contacts;
};

/// The rows of a pose: what holds the place, as contacts count it; margins; and how deep points lie, as
/// numbers below 0.
struct DeepRows {
  std::vector<LinearBound<6>> places, margins, depths;
};

/// Measures poses, and keeps what they meet.
class DeepPoses {
 public:
  DeepPoses(const SolidProblem& problem, const SolidMeter& meter, double least_margin,
            const SolidOptions& options);

  /// Measures at a pose, and learns what a step up to `reach` may meet there. Nothing where the pose is not
  /// allowed, or a stop was asked for.
  [[nodiscard]] std::optional<DeepPose> looked_at(const FramedPose& pose, double reach);
  [[nodiscard]] DeepRows rows(const DeepPose& here) const;
  /// Says if no further pose is to be looked at.
  [[nodiscard]] bool ended() const;
  /// Counts what was new, and what was done.
  [[nodiscard]] std::size_t met() const noexcept { return met_; }
  [[nodiscard]] std::uint64_t work() const noexcept { return work_; }
  /// Depths are measured to this, mm.
  [[nodiscard]] double slack() const noexcept { return near_.slack(); }

 private:
  void keep_deepest(const Farthest& found);

  const SolidMeter& meter_;
  const SolidOptions& options_;
  double least_;
  SolidNear near_;
  NearFace face_;
  ContactPool pool_;
  std::vector<FarPoint> deep_;
  std::size_t met_ = 0;
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::locate
