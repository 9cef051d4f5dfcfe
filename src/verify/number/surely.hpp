#pragma once

#include "span.hpp"

namespace lekalo::verify {

/// Says whether a number is surely above another, or above 0. Nothing is above what is no number.
[[nodiscard]] inline bool surely_above(Span a, Span b) { return a.low > b.high; }
[[nodiscard]] inline bool is_positive(Span a) { return surely_above(a, just(0)); }

}  // namespace lekalo::verify
