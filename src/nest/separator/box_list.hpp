#pragma once

#include <cstdint>
#include <vector>

#include "nest/table/nofit.hpp"

namespace lekalo::nest {

/// Boxes one after the other, in floats. With up to some hundred items a look at all of them is quicker
/// than finding cells (NeighbourGrid).
class BoxList {
 public:
  explicit BoxList(std::size_t items);

  /// Puts an item there in place of where it was.
  void set(std::uint32_t item, std::uint32_t bin, const Box& box) noexcept;
  /// Finds the items of a bin whose boxes meet this one, ascending, and maybe some that miss it by a
  /// millionth.
  void find(std::uint32_t bin, const Box& box, std::vector<std::uint32_t>& into);

 private:
  std::vector<float> x0_, y0_, x1_, y1_;
  std::vector<std::uint32_t> bins_, meets_;
};

}  // namespace lekalo::nest
