#include "pens.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "text.hpp"

namespace lekalo::io {
namespace {

std::optional<std::uint32_t> whole(std::string_view text) {
  std::uint32_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

using Rgb = std::array<int, 3>;

/// The colour index in its usual colours: 1 to 9 by name, greys from 250, and between them 24 hues in five
/// strengths, odd numbers half as saturated.
Rgb rgb_of_index(std::uint32_t index) {
  constexpr Rgb kNamed[] = {{0, 0, 0},   {255, 0, 0},   {255, 255, 0}, {0, 255, 0},     {0, 255, 255},
                            {0, 0, 255}, {255, 0, 255}, {0, 0, 0},     {128, 128, 128}, {192, 192, 192}};
  constexpr int kGreys[] = {51, 80, 105, 130, 190, 255};
  constexpr int kStrengths[] = {255, 165, 127, 76, 38};
  if (index < std::size(kNamed)) return kNamed[index];
  if (index >= 250) return {kGreys[index - 250], kGreys[index - 250], kGreys[index - 250]};
  const int strength = kStrengths[index % 10 / 2];
  // Hues go round by 15 degrees, that is 4 to a side of the hexagon of pure colours.
  const int hue = static_cast<int>(index) / 10 - 1;
  Rgb rgb{};
  for (int channel = 0; channel < 3; ++channel) {
    const int from_peak = (hue + 24 - 8 * channel) % 24;
    const int around = std::min(from_peak, 24 - from_peak);
    const int share = std::clamp(8 - around, 0, 4);  // quarters of the full colour
    const int pure = strength * share / 4;
    rgb[static_cast<std::size_t>(channel)] = index % 2 == 1 ? (pure + strength) / 2 : pure;
  }
  return rgb;
}

}  // namespace

DxfColour DxfColour::of_index(std::string_view text) {
  // A layer that is switched off has its colour below 0.
  if (text.substr(0, 1) == "-") text.remove_prefix(1);
  const auto value = whole(text);
  return value && *value < kByLayer ? DxfColour(*value) : by_layer();
}

DxfColour DxfColour::of_rgb(std::string_view text) {
  const auto value = whole(text);
  return value ? DxfColour(kTrue | (*value & (kTrue - 1))) : by_layer();
}

std::string DxfColour::word() const {
  if ((said_ & kTrue) != 0) return fmt::format("#{:06x}", said_ & (kTrue - 1));
  const Rgb rgb = rgb_of_index(said_);
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::uint32_t DxfPens::index(const DxfPen& pen) {
  // Neighbours in a file are mostly drawn with the same pen.
  if (last_ < pens_.size() && pens_[last_] == pen) return last_;
  const auto [found, is_new] = index_.try_emplace(pen, static_cast<std::uint32_t>(pens_.size()));
  if (is_new) pens_.push_back(pen);
  return last_ = found->second;
}

std::uint32_t DxfPens::inserted(std::uint32_t pen, std::uint32_t outer) {
  DxfPen worn = pens_[pen];
  const bool by_block = worn.colour.is_by_block() || folded(worn.line_type) == "BYBLOCK";
  if (worn.layer != DxfLayers::kZero && !by_block) return pen;
  const DxfPen holder = pens_[outer];
  if (worn.layer == DxfLayers::kZero) worn.layer = holder.layer;
  if (worn.colour.is_by_block()) worn.colour = holder.colour;
  if (folded(worn.line_type) == "BYBLOCK") worn.line_type = holder.line_type;
  return index(worn);
}

}  // namespace lekalo::io
