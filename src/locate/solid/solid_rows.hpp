#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "locate/search/cell_program.hpp"
#include "solid_meter.hpp"

namespace lekalo::locate {

// Steps from pose to pose: the linear programs of what is known, and how far their solutions are believed.

/// A contact as a row: its margin, and how that changes with the steps from the pose.
[[nodiscard]] LinearBound<6> row_of(const SolidFrame& frame, const solid::Motion& motion,
                                    const SolidContact& contact);

/// The finds of the poses so far.
struct ContactPool {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< of triangles that were near
  std::vector<SolidContact> over_planes;
  /// Points that are to be near the blank's surface and were far from it.
  std::vector<SolidContact> points;

  /// Returns true if any of the contacts was not known.
  bool add(const std::vector<SolidContact>& contacts);
};

/// All known contacts as they are at a pose, where these were met.
[[nodiscard]] std::vector<SolidContact> contacts_at(const SolidMeter& meter, const FramedPose& pose,
                                                    bool inside, const ContactPool& pool,
                                                    const std::vector<SolidContact>& met);

/// How far a step goes, which is as far as the rows have been right.
struct Trust {
  /// A step that found new contacts is tried again with them, so many times, before it is made smaller.
  static constexpr int kMostTries = 3;
  double widest = 0, reach = widest;
  int tries = 0;

  /// A step that was no better is tried again with what it met, and made shorter where it met nothing new.
  void was_no_better(bool met_more) {
    if (met_more && ++tries < kMostTries) return;
    reach *= 0.25;
    tries = 0;
  }
  void was_better(double gained, double hoped, bool met_more) {
    if (gained < 0.25 * hoped && !met_more) reach *= 0.5;
    if (gained > 0.75 * hoped) reach = std::min(widest, 2 * reach);
    tries = 0;
  }
};

/// Does some work that the flag of `run` may end, and returns nothing then.
template <class Found, class Look>
std::optional<Found> unless_stopped(const RunControl& run, const Look& look) {
  RunControl until_stop;
  until_stop.stop = run.stop;
  const Listening listening(until_stop);
  try {
    Listening::look();
    return look();
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace lekalo::locate
