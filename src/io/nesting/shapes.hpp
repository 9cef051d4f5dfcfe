#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/text/json_reader.hpp"
#include "lekalo/geom/grid_region.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io::detail {

using Loops = std::vector<std::vector<geom::GridPoint>>;

/// Outlines of other programs' files, which count as they stand or are repaired without changing their
/// material.
class NestingShapes {
 public:
  NestingShapes(JsonReader& reader, double mm_per_unit) : reader_(reader), mm_per_unit_(mm_per_unit) {}

  /// {"type": "simple_polygon", "data": [[x, y]...]} or {"type": "polygon", "data": {"outer", "inner"}}; the
  /// same words with capitals ("SimplePolygon").
  Loops typed(JsonValue shape);
  /// {"vertices": [{"x", "y"}...], "holes": [{"vertices"}...]}
  Loops vertices(JsonValue shape);

  /// Refused where an outline meets itself.
  layout::Outline outline(JsonValue at, Loops loops);
  /// Says which of two readings of a zone that crosses itself forbids more.
  enum class Stricter : std::uint8_t {
    larger,   ///< everything that it encloses, holes filled
    smaller,  ///< only what it winds around an odd number of times
  };
  /// The outlines of a zone: one, or those of the stricter reading where it meets itself, which a notice
  /// says; none where that holds nothing.
  std::vector<layout::Outline> zone(JsonValue at, Loops loops, Stricter stricter);
  /// Holes that meet the outline or each other become defects.
  void stock(JsonValue at, Loops loops, layout::Stock& stock);

  std::vector<std::string> notices;

 private:
  std::vector<geom::GridPoint> vertex_loop(JsonValue list, std::size_t& points);
  void drop_spikes(JsonValue at, Loops& loops);
  [[nodiscard]] std::string place(JsonValue at) const;

  JsonReader& reader_;
  double mm_per_unit_;
};

/// Stocks that differ in nothing but id, name and count become the first of them.
void merge_alike(std::vector<layout::Stock>& stocks);

}  // namespace lekalo::io::detail
