#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "layers.hpp"

namespace lekalo::io {

/// A colour of a DXF entity or layer as the file states it: a number of the colour index, 1 to 255, a true
/// colour, or that of the layer or of the insertion.
class DxfColour {
 public:
  constexpr DxfColour() = default;
  [[nodiscard]] static constexpr DxfColour by_layer() { return DxfColour(kByLayer); }
  [[nodiscard]] static constexpr DxfColour by_block() { return DxfColour(kByBlock); }
  /// The colour of a group 62; numbers that mean none count as by layer.
  [[nodiscard]] static DxfColour of_index(std::string_view text);
  /// The colour of a group 420.
  [[nodiscard]] static DxfColour of_rgb(std::string_view text);

  [[nodiscard]] constexpr bool is_by_layer() const { return said_ == kByLayer; }
  [[nodiscard]] constexpr bool is_by_block() const { return said_ == kByBlock; }
  /// The word for it, "#ff0000"; 7 is black, as on paper. \pre neither by layer nor by block
  [[nodiscard]] std::string word() const;

  friend constexpr auto operator<=>(const DxfColour&, const DxfColour&) = default;

 private:
  static constexpr std::uint32_t kByBlock = 0, kByLayer = 256, kTrue = 1U << 24U;
  explicit constexpr DxfColour(std::uint32_t said) : said_(said) {}
  std::uint32_t said_ = kByLayer;
};

/// A pen is what an entity is drawn with: its layer, colour and line type.
struct DxfPen {
  std::uint32_t layer = DxfLayers::kZero;  ///< into DxfLayers
  DxfColour colour;
  std::string_view line_type;  ///< as the file spells it; empty: that of the layer

  friend auto operator<=>(const DxfPen&, const DxfPen&) = default;
};

/// The pens of a file, each once. Curves of blocks name theirs by number.
class DxfPens {
 public:
  [[nodiscard]] std::uint32_t index(const DxfPen& pen);
  [[nodiscard]] const DxfPen& operator[](std::uint32_t index) const { return pens_[index]; }
  [[nodiscard]] std::size_t size() const { return pens_.size(); }
  /// The pen of a block's content in an insertion that is drawn with `outer`: layer 0, and what is by block,
  /// are those of the insertion.
  [[nodiscard]] std::uint32_t inserted(std::uint32_t pen, std::uint32_t outer);

 private:
  std::vector<DxfPen> pens_;
  std::map<DxfPen, std::uint32_t> index_;
  std::uint32_t last_ = 0;
};

}  // namespace lekalo::io
