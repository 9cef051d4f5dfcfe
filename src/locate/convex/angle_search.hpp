#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "contact_program.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/locate/placement.hpp"
#include "locate/search/sinusoid.hpp"

namespace lekalo::locate {

/// An interval of angles with two bounds, of which one belongs to its left end and one to its right end. Both
/// hold in all of the interval, and so does the smaller of them. `upper` is the largest value of that smaller
/// one, reached at `split`.
struct AngleInterval {
  Angle lo, hi;
  Basis left, right;
  double upper = 0;
  double split = 0;
};

/// A piece of the cover: over [from, to] `basis.bound` is at most the upper bound of the search.
struct CoverPiece {
  Angle from, to;
  Basis basis;
};

/// Finds the global maximum over the angle of the best clearance at that angle, by branch and bound.
///
/// At each end of an interval a linear program has been solved. The two bounds meet at an angle that is found
/// in closed form, and the next program is solved there. Where the maximum is a peak between two such bounds,
/// this converges like a secant method in a handful of steps. The search takes the best interval first, as
/// long as the open ones fit in kMostOpen. Then it goes on in order of angle, depth first, so that memory
/// stays bounded where the clearance is flat in the angle.
class AngleSearch {
 public:
  static constexpr std::size_t kMostOpen = 512;

  struct Incumbent {
    Angle angle;
    geom::Point shift;
    double value = 0;
    /// The bounds known there: that of the angle itself and those of both sides.
    std::vector<Basis> holders;
  };

  /// \param gap  an interval whose upper bound is at most the best value found plus this is closed
  AngleSearch(ContactProgram& program, AngleWindow window, double gap, const RunControl& run);

  /// Runs to the end, the budget or the stop request. `cover` receives, in ascending order, pieces that cover
  /// the window, each bounded by upper().
  void run(const std::function<void(const CoverPiece&)>& cover);

  /// All angles that are a local maximum with a clearance of at least `threshold`. Two maxima are told apart
  /// when the clearance between them falls by more than the gap. peaks() goes on after run() and solves at
  /// most `limit` programs more.
  struct Peaks {
    std::vector<Incumbent> found;  ///< ascending angle
    bool complete = true;
  };
  [[nodiscard]] Peaks peaks(double threshold, std::uint64_t limit);

  [[nodiscard]] const Incumbent& best() const { return best_; }
  [[nodiscard]] double upper() const { return upper_; }
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  struct Probe {
    Angle angle;
    Basis basis;
    geom::Point shift;
    double value = 0;
  };

  Probe probe(double theta, const Basis& warm, double of_interest,
              ContactProgram::Effort effort = ContactProgram::Effort::optimum);
  void offer(const Probe& probe, const Basis& left, const Basis& right);
  [[nodiscard]] std::vector<double> first_angles() const;
  std::vector<AngleInterval> first_intervals();
  [[nodiscard]] static AngleInterval join(const Probe& lo, const Probe& hi);
  static void bound(AngleInterval& interval);
  /// Solves at interval.split, and returns the two halves that replace the interval.
  std::pair<AngleInterval, AngleInterval> split(const AngleInterval& interval, ContactProgram::Effort effort);
  [[nodiscard]] bool closed(const AngleInterval& interval) const {
    return interval.upper <= best_.value + gap_;
  }
  [[nodiscard]] bool out_of_budget() const;
  void report_progress(double newly_closed_width);

  void best_first(std::vector<AngleInterval>& open, std::vector<AngleInterval>& done);
  void probe_between(const Probe& from, const Probe& to, double threshold, std::uint64_t last_work,
                     std::vector<Probe>& probes, bool& complete);
  void in_order(AngleInterval interval, const std::function<void(const AngleInterval&)>& emit);

  ContactProgram& program_;
  AngleWindow window_;
  double gap_;
  const RunControl& run_;
  Incumbent best_;
  double upper_ = 0;
  bool finished_ = false;
  std::uint64_t work_ = 0;
  double closed_width_ = 0, reported_ = 0;
  std::uint64_t next_report_ = 0;
};

/// Cuts an interval where its two bounds cross, into pieces of one bound each.
void for_pieces(const AngleInterval& interval, const std::function<void(const CoverPiece&)>& emit);

}  // namespace lekalo::locate
