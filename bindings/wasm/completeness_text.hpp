#pragma once

#include <string>

#include "lekalo/layout/completeness.hpp"

namespace lekalo::wasm {

/// The JSON of `lekalo show --json`'s kits, parts and sheets, on one line.
[[nodiscard]] std::string completeness_text(const layout::Document& document, const layout::Completeness& c);

}  // namespace lekalo::wasm
