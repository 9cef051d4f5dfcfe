#pragma once

#include <fmt/core.h>

#include <string>

#include "io/text/json_tree.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/base/limits.hpp"

namespace lekalo::io::detail {

/// Steps that the readers of features share, of outlines and of solids.

[[nodiscard]] inline bool is_word(JsonValue value) {
  return value.kind() == JsonKind::text && !value.text().empty();
}
[[nodiscard]] inline bool is_index(JsonValue value) {
  return value.kind() == JsonKind::integer && value.integer() >= 0;
}

/// Takes a length that is not negative, in mm; the file has it in units of `scale` mm, or leaves it out.
template <class Take>
Result<void> take_length(JsonValue json, const char* key, double scale, const std::string& where, Take take) {
  const auto said = json.find(key);
  if (!said || said->kind() == JsonKind::null) return {};
  if (!said->is_number() || !(said->number() >= 0))
    return refuse(where, fmt::format("\"{}\" must be a length that is not negative", key));
  const double mm = scale * said->number();
  if (!(mm <= limits::kLargestCoordinate))
    return refuse(
        where, fmt::format("\"{}\" is {} mm; demands go up to {:g} mm", key, mm, limits::kLargestCoordinate));
  take(mm);
  return {};
}

/// Takes the scale of a feature, if it has one.
template <class Take>
Result<void> take_scale(JsonValue json, const std::string& where, Take take) {
  const auto scale = json.find("scale");
  if (!scale) return {};
  constexpr double kMost = limits::kLargestFactor;
  if (!scale->is_number() || !(scale->number() >= 1 / kMost && scale->number() <= kMost))
    return refuse(where, fmt::format("\"scale\" must be a number from {:g} to {:g}", 1 / kMost, kMost));
  take(scale->number());
  return {};
}

}  // namespace lekalo::io::detail
