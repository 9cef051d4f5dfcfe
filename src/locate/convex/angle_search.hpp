#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "contact_program.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/locate/placement.hpp"
#include "locate/search/sinusoid.hpp"

namespace lekalo::locate {

/// An interval of angles with a bound that holds at its left end and one that holds at its right end; both
/// hold everywhere, so the smaller of them does. `upper` is the largest value of that smaller one, reached at
/// `split`.
struct AngleInterval {
  Angle lo, hi;
  Basis left, right;
  double upper = 0;
  double split = 0;
};

/// A piece of the cover: `basis.bound` is at most the upper bound of the search over [from, to].
struct CoverPiece {
  Angle from, to;
  Basis basis;
};

/// Global maximum over the angle of the best clearance at that angle, by branch and bound.
///
/// At each end of an interval a linear program has been solved. The two bounds meet at an angle that is found
/// in closed form; the next program is solved there. Where the maximum is a peak between two such bounds this
/// converges like a secant method, in a handful of steps. Best interval first, as long as the open ones fit
/// in kMostOpen; then in order of angle, depth first, so that memory stays bounded where the clearance is
/// flat in the angle.
class AngleSearch {
 public:
  static constexpr std::size_t kMostOpen = 512;

  struct Incumbent {
    Angle angle;
    geom::Point shift;
    double value = 0;
    std::vector<Basis> holders;  ///< the bounds known there: of the angle itself and of both sides
  };

  /// \param gap  an interval whose upper bound is at most the incumbent plus this is closed.
  AngleSearch(ContactProgram& program, AngleWindow window, double gap, const RunControl& run);

  /// Runs to the end, the budget or the stop request. `cover` receives, in ascending order, pieces that cover
  /// the window, each bounded by upper().
  void run(const std::function<void(const CoverPiece&)>& cover);

  /// Goes on after run(): all angles whose clearance is at least `threshold` and a local maximum, at most
  /// `limit` programs more. Two maxima are told apart when the clearance between them falls by more than the
  /// gap.
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
  /// Solves at interval.split; the two halves replace the interval.
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

/// Cuts an interval where its two bounds cross: pieces of one bound each.
void for_pieces(const AngleInterval& interval, const std::function<void(const CoverPiece&)>& emit);

}  // namespace lekalo::locate
