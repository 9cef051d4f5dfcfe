#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// Tables of layers, "lekalo-layers/1": what the lines and texts on the layers of a shop's drawings are.
/// docs/formats.md, "Layers of drawings", has the form.

enum class LayerRole {
  cut,      ///< closed lines are outlines of parts and their holes
  mark,     ///< no line is an outline; lines and texts lie on the part around them
  engrave,  ///< likewise, and they are said to be engraved
  bend,     ///< likewise, and they are folds
  ignore    ///< nothing of the layer counts
};

/// A row: what is empty fits any layer.
struct LayerRule {
  std::string name;       ///< compared without the case of A to Z
  std::string colour;     ///< "#0000ff"
  std::string line_type;  ///< compared without the case of A to Z
  LayerRole role = LayerRole::mark;
};

struct LayerRules {
  std::string name;             ///< of the file, for sentences
  std::vector<LayerRule> rows;  ///< of the rows that fit a layer the first counts
};

/// Fails with ErrorCode::bad_input: bytes that are no JSON, or one sentence that lists everything that is
/// wrong, each with the number of its row. Cost: O(bytes), but for a logarithm.
[[nodiscard]] Result<LayerRules> read_layer_rules(std::string_view bytes, const std::string& name);

/// Returns the role of the first row that fits; nothing where none does. Cost: O(rows).
[[nodiscard]] std::optional<LayerRole> role_of(const LayerRules& rules, const Layer& layer);

}  // namespace lekalo::io
