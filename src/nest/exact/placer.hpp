#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/phi/scene.hpp"
#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// Finds free places for one item after the other by the exact collision engine, on the grid. It needs no
/// tables of pairs, so there is a layout at once. A place that it calls free is free by layout::check().
/// docs/design/nest.md, step 11.
class Placer {
 public:
  /// Says which of the things that lie on the stock already count.
  enum class Counts : std::uint8_t {
    all,
    features,  ///< the border, defects and zones of the stock, but no locked parts
    border     ///< the border of the stock alone
  };
  Placer(const Problem& problem, const Items& items, Random random, Counts counts = Counts::all);

  /// Begins with a state, whose items stay where they lie. \pre it breaks no rule
  void load(const State& state);
  const State& state() const noexcept { return state_; }
  /// Work so far: places asked about.
  std::uint64_t work() const noexcept { return work_; }
  /// Puts item i, which lies nowhere, to the free place on a bin found furthest left among so many; false
  /// if none was free.
  bool place_low(std::size_t i, std::uint32_t bin, std::size_t samples);
  /// True if the box of item i fits on the bin in some form.
  bool can_hold(std::uint32_t bin, std::size_t i);
  void open_bin(std::uint32_t bin);
  void close_bin(std::uint32_t bin);
  /// Sets how far a strip may be used: x, mm.
  void set_end(std::uint32_t bin, double x1) { state_.ends[bin] = x1; }

 private:
  struct BinScene {
    phi::Scene scene;
    std::vector<phi::ShapeIndex> shapes;  ///< by form
    std::vector<std::uint32_t> zones;     ///< by body: the index of its zone
  };
  struct Range {
    std::int64_t x0, x1, y0, y1;
  };
  BinScene& scene_of(std::uint32_t bin);
  phi::ShapeIndex shape(BinScene& in, std::uint32_t form, std::uint32_t part);
  Range range_of(std::size_t i, std::uint32_t form, std::uint32_t bin);
  bool is_free(std::size_t i, std::uint32_t form, std::uint32_t bin, geom::GridPoint at);
  void put(std::size_t i);

  const Problem& problem_;
  const Items& items_;
  Random random_;
  Counts counts_;
  State state_;
  std::map<std::uint32_t, std::vector<std::size_t>> loaded_;  ///< by bin: the items that lay there at first
  double area_ = 0;                                           ///< of all items that move, mm^2
  std::vector<std::optional<BinScene>> scenes_;               ///< by bin, made when first asked about
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::nest
