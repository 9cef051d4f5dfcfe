#pragma once

#include "lekalo/layout/document.hpp"

namespace lekalo::nest {

/// The document with parts of very many corners inside outlines of fewer (outer_outline), so that a layout of
/// those is one of the parts themselves but for some steps of rounding. Parts that lie somewhere already keep
/// their own, because what lies there may fit exactly.
[[nodiscard]] layout::Document with_outer_outlines(const layout::Document& document, bool from_given);

}  // namespace lekalo::nest
