#pragma once

#include <cstdint>
#include <string>

#include "io/text/json_tree.hpp"
#include "lekalo/io/layout/layout_json.hpp"

namespace lekalo::io::detail {

/// read_layout of bytes that are a tree already.
[[nodiscard]] Result<LayoutFile> read_layout_tree(const JsonTree& tree, const std::string& name);

/// A rectangle from (0, 0), in steps.
[[nodiscard]] geom::GridRegion rectangle(std::int64_t along, std::int64_t across);

}  // namespace lekalo::io::detail
