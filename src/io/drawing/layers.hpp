#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"

namespace lekalo::io {

/// Two names mean one layer, in drawings that do not tell the cases of A to Z apart.
[[nodiscard]] bool same_layer(const std::string& a, const std::string& b);

/// Says whether a word means a layer: its name, its colour or its line type, or two or all of these in this
/// order with ":" between them ("CUT:#ff0000").
[[nodiscard]] bool means_layer(const std::string& word, const Layer& layer);

/// The shortest such word that starts with the name and means no other layer.
[[nodiscard]] std::string layer_word(const std::vector<Layer>& layers, std::size_t layer);

/// The layers that count, and a sentence about those that do not.
struct LayerChoice {
  std::vector<bool> taken;  ///< by layer
  std::vector<std::string> notices;
};

/// Fails with ErrorCode::bad_input where `take` or `leave` names a layer that no curve is on.
[[nodiscard]] Result<LayerChoice> choose_layers(const Drawing& drawing, const DrawingOptions& options);

/// "the LINE (handle 1F) at line 120, layer 'CUT'".
[[nodiscard]] std::string curve_name(const Drawing& drawing, std::size_t curve);

}  // namespace lekalo::io
