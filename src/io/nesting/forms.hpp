#pragma once

#include <optional>
#include <string>

#include "io/text/json_tree.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"

namespace lekalo::io::detail {

/// Returns nothing for other JSON.
[[nodiscard]] std::optional<NestingForm> form_of(const JsonTree& tree);

/// read_nesting and read_placements of bytes that are a tree already. \pre its form is not placements
[[nodiscard]] Result<LayoutFile> read_nesting_tree(const JsonTree& tree, const std::string& name,
                                                   NestingForm form, std::optional<LengthUnit> unit);
[[nodiscard]] Result<LayoutFile> read_placements_tree(const JsonTree& tree, const std::string& name,
                                                      layout::Document instance,
                                                      std::optional<LengthUnit> unit);
[[nodiscard]] Result<std::string> instance_of_tree(const JsonTree& tree, const std::string& name);

}  // namespace lekalo::io::detail
