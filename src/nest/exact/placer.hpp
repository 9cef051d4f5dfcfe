#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/phi/scene.hpp"
#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// Free places for one item after the other, by the exact collision engine: on the grid, without a table of a
/// pair, so that there is a layout at once. What it says is free is so by layout::check().
class Placer {
 public:
  /// What lies on the stock already and counts.
  enum class Counts : std::uint8_t {
    all,
    features,  ///< of the stock: its border, defects and zones, no locked parts
    border     ///< that alone
  };
  Placer(const Problem& problem, const Items& items, Random random, Counts counts = Counts::all);

  /// What lies somewhere stays there. \pre breaks no rule
  void load(const State& state);
  const State& state() const noexcept { return state_; }
  /// Places asked about.
  std::uint64_t work() const noexcept { return work_; }
  /// Puts item i, which lies nowhere, to the free place on a bin found furthest left among so many; false if
  /// none was free.
  bool place_low(std::size_t i, std::uint32_t bin, std::size_t samples);
  /// Whether the box of item i fits in some form.
  bool can_hold(std::uint32_t bin, std::size_t i);
  void open_bin(std::uint32_t bin);
  void close_bin(std::uint32_t bin);
  /// Of a strip: x up to which items may lie, mm.
  void set_end(std::uint32_t bin, double x1) { state_.ends[bin] = x1; }

 private:
  struct Sheet {
    phi::Scene scene;
    std::vector<phi::ShapeIndex> shapes;  ///< by form
    std::vector<std::uint32_t> zones;     ///< by body: index of the zone
  };
  struct Range {
    std::int64_t x0, x1, y0, y1;
  };
  Sheet& sheet(std::uint32_t bin);
  phi::ShapeIndex shape(Sheet& in, std::uint32_t form, std::uint32_t part);
  Range range_of(std::size_t i, std::uint32_t form, std::uint32_t bin);
  bool is_free(std::size_t i, std::uint32_t form, std::uint32_t bin, geom::GridPoint at);
  void put(std::size_t i);

  const Problem& problem_;
  const Items& items_;
  Random random_;
  Counts counts_;
  State state_;
  std::vector<std::optional<Sheet>> sheets_;  ///< by bin; made when first asked about
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::nest
