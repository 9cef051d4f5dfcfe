#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/verify/simulate.hpp"
#include "nc_moves.hpp"

namespace lekalo::verify {

/// Step 11 of docs/design/simulate.md: when a machine is where on its way.
class MachineClock {
 public:
  MachineClock(const std::vector<Move>& moves, const SimulateOptions& options);

  /// Returns the seconds that the machine takes for all moves.
  [[nodiscard]] double seconds() const { return begins_.back(); }
  /// Returns the seconds from the beginning of the first move to a share of the way of one, in [0, 1].
  /// Cost: the pieces of the move.
  [[nodiscard]] double seconds_at(std::size_t move, double share) const;

  struct Direction {
    double x, y, z;
  };
  struct Piece {
    double length, feed;    ///< mm, mm/s
    Direction first, last;  ///< of travel
    double square_limit;    ///< the square of the speed is at most this, (mm/s)^2
  };

 private:
  /// The square of the largest speed on a piece.
  [[nodiscard]] double top_square(std::size_t piece) const;
  [[nodiscard]] double seconds_of(std::size_t piece) const;

  double acceleration_;
  std::vector<std::size_t> first_piece_;  ///< by move, and one behind the last
  std::vector<Piece> pieces_;
  /// The square of the speed at the beginning of each piece and at the end of the last.
  std::vector<double> square_;
  std::vector<double> begins_{0.0};  ///< seconds, by piece, and the end of the last
};

/// Returns the seconds that a machine takes for all moves.
[[nodiscard]] double machine_seconds(const std::vector<Move>& moves, const SimulateOptions& options);

}  // namespace lekalo::verify
