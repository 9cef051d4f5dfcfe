#pragma once

#include <cstddef>
#include <cstdint>
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

  /// How many steps is_loose() has taken, so that a check of many cuts can end.
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

  double kerf_;
  Strokes pieces_;
  std::vector<std::size_t> cut_of_piece_;
  std::vector<Cut> cuts_;
  std::vector<Meeting> meetings_;
  bool is_ready_ = false;
  std::size_t steps_ = 0;
};

}  // namespace lekalo::verify
