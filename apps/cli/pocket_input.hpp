#pragma once

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/pocket.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Reads the outlines of the pockets, those on the layers of islands and open edges among them. bad_input
/// for what read_outline refuses.
[[nodiscard]] Result<jobs::PocketOutline> read_pocket_outline(const PocketOptions& options);

}  // namespace lekalo::cli
