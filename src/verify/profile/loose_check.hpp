#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contour_ring.hpp"

namespace lekalo::verify {

/// Cuts in the order of the program, and the question whether those before some moment surround a place.
class LooseCheck {
 public:
  explicit LooseCheck(double kerf_mm) : kerf_(kerf_mm) {}

  /// The next cut. \param of  what it follows: cuts of the same are one
  void add(const Strokes& edges, std::size_t of);

  /// After the last add(): true where kerfs of different cuts, or of one, run into each other.
  [[nodiscard]] bool kerfs_meet();

  /// Says whether the kerfs of the first `before` cuts, less those that follow `of`, close round p. A closed
  /// way in them that winds about p is what is looked for: along cuts, and from one to another where they are
  /// nearer than a kerf. Cost: O(pieces before + meetings). \pre p does not lie in a kerf
  [[nodiscard]] bool is_loose(Place p, std::size_t before, std::size_t of);

  /// A moment of the program: a piece of a cut, in the order of the cuts, is there up to this share of it.
  struct Moment {
    std::size_t piece = 0;
    double share = 0;
  };
  /// Returns the moment from which on the kerfs close round p, or between p and q where there is a q; none
  /// where all cuts together do not. Cost: as is_loose. \pre neither place lies in a kerf
  [[nodiscard]] std::optional<Moment> parted_at(Place p, std::optional<Place> q = std::nullopt);

  [[nodiscard]] const Strokes& pieces() const { return pieces_; }
  /// The number of the add() that brought a piece, from 0.
  [[nodiscard]] std::size_t cut_of(std::size_t piece) const { return cut_of_piece_[piece]; }

  /// How many steps is_loose() and parted_at() have taken, so that a check of many cuts can end.
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  struct Cut {
    std::size_t first, last, of;  ///< pieces, and what it follows
  };
  /// Two pieces nearer than a kerf, and the nearest places on them.
  struct Meeting {
    std::uint32_t a, b;
    Place on_a, on_b;
  };
  void find_meetings();
  /// The share of the later piece of a meeting from which on the two meet.
  [[nodiscard]] double begins_at(const Meeting& meeting) const;

  double kerf_;
  Strokes pieces_;
  std::vector<std::size_t> cut_of_piece_;
  std::vector<Cut> cuts_;
  std::vector<Meeting> meetings_;  ///< ascending by b, the later piece
  bool is_ready_ = false;
  std::size_t steps_ = 0;
};

}  // namespace lekalo::verify
