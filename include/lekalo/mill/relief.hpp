#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/path_way.hpp"
#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// Puts shallower passes ahead of stretches that meet more of the rim than 1.25 times what a straight pass
/// does: such a pass runs beside the stretch, farther from the material, and back through what it has cut.
/// The caller measures (lekalo/verify/simulate.hpp), and a pass that does not make its stretch better is left
/// out again:
///
///     LEKALO_TRY(Relief relief, Relief::make(path, pockets, options));
///     while (relief.improve(loads)) loads = those of relief.path() that relief.wanted() names;
///
/// Stretches are level and without a cusp. Slots and the points of corners stay as they are, because they
/// have no side to be entered from. Cost: n log n, and a distance to the walls for each 0.02 radii of a pass.
class Relief {
 public:
  /// A run of moves of path(), both ends among them.
  struct Moves {
    std::size_t first = 0, last = 0;
  };

  /// \param pockets, options  of the path
  [[nodiscard]] static Result<Relief> make(PocketPath path, const std::vector<geom::Region>& pockets,
                                           const PocketOptions& options);

  [[nodiscard]] const PocketPath& path() const { return path_; }
  /// True when path() is another one now, which is to be measured.
  /// \param loads  of each move of path() in wanted(), along it; at first of all moves
  bool improve(const std::vector<std::vector<MoveLoad>>& loads);
  /// The moves to be measured, in ascending runs that do not touch.
  [[nodiscard]] std::vector<Moves> wanted() const;

 private:
  /// A stretch that is too hot. Its places are mm along the path given.
  struct Site {
    /// Moves of the path given: level, of some length each, without a cusp.
    Moves run;
    /// The places where the tool may leave the path and come back to it.
    double begin = 0, end = 0;
    /// The part of the stretch that is too hot.
    double hot_begin = 0, hot_end = 0;
    /// The side of the material: 1 for the left.
    double side = 1;
    double largest = 0;  ///< degrees
    /// The sum of degrees above what is held, times mm.
    double given_excess = 0;
    /// The same sum with the best pass.
    double excess = 0;
    int trials = 0;
    bool settled = false;
    /// The passes there and back.
    std::vector<PathMove> best, tried;
    /// The moves of path_ that belong to the stretch.
    Moves moves;
  };

  Relief(PocketPath path, const std::vector<geom::Region>& places, const PocketOptions& options);
  void find_sites(const std::vector<std::vector<MoveLoad>>& loads);
  [[nodiscard]] double excess_of(const Site& site, const std::vector<std::vector<MoveLoad>>& loads) const;
  void judge_trials(const std::vector<std::vector<MoveLoad>>& loads);
  bool leave_out(const std::vector<std::vector<MoveLoad>>& loads);
  void try_next(Site& site);
  [[nodiscard]] bool is_inside(const geom::Edge& edge) const;
  [[nodiscard]] std::vector<PathMove> pass_beside(const Site& site, double depth) const;
  void compose();

  PathWay given_;
  PocketPath path_;
  /// The limit of the tool's middle.
  geom::RegionIndex limit_;
  /// The tool's radius (mm), the rim's angle on a straight pass (rad), and the angle that is held (degrees).
  double radius_, straight_, held_;
  double fit_tolerance_;
  std::vector<Site> sites_;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// The source of a move of path_: the site it was added for, or where along the path given it begins.
  struct Origin {
    std::size_t site = kNone;
    double begin = 0;
  };
  std::vector<Origin> origins_;
  enum class Stage { begin, trials, confirmation } stage_ = Stage::begin;
};

}  // namespace lekalo::mill
