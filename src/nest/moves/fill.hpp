#pragma once

#include "move.hpp"
#include "rooms.hpp"

namespace lekalo::nest {

/// Brings pieces that lie nowhere onto the sheets: first in rooms made for one piece at a time, then by a
/// rearrangement in which some are thrown in at once. docs/design/nest-sheets.md, steps 2 to 4.
class Fill : public Move {
 public:
  bool begin(Search& search) override;
  Outcome attempt(Search& search) override;
  Outcome step(Search& search) override;
  Outcome on_valid(Search& search) override;
  Outcome on_failure(Search& search) override;

 protected:
  /// Begins a turn with so many pieces missing.
  void begin_with(std::size_t missing);
  /// True if rooms are worth their time now.
  virtual bool tries_rooms(const Search&) const { return true; }
  virtual int most_failures() const { return tuning::kFailuresToFill; }

 private:
  void throw_in(Search& search);
  /// Throws the pieces of a kit in, or those of a plan; false where there are none.
  bool throw_in_kits(Search& search, const std::vector<std::uint32_t>& missing);

  Rooms rooms_;
  std::size_t batch_ = 1;  ///< pieces thrown in at once
  int failures_ = 0;
  int vain_turns_ = 0;  ///< turns since one brought something in
  int fuller_ = 0;      ///< search.fuller when that was counted
};

}  // namespace lekalo::nest
