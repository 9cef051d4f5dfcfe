#pragma once

#include "search.hpp"

namespace lekalo::nest {

/// The first part of an attempt of fill and reduce: it gathers the small gaps of a bin at one point and
/// puts a missing piece there. docs/design/nest-sheets.md, step 3.
class Rooms {
 public:
  /// Rooms to be tried in this attempt; fewer where many items would have to slide.
  void begin(const Search& search);
  void end() noexcept { left_ = 0; }
  bool are_left() const noexcept { return left_ > 0; }
  /// Slides what lies on a bin away from a point anywhere and puts a missing piece there. True if all that
  /// overlaps then can be shifted apart. Else everything stays as it has slid, and the next try begins with
  /// that.
  bool try_one(Search& search);

 private:
  std::size_t left_ = 0;
};

}  // namespace lekalo::nest
