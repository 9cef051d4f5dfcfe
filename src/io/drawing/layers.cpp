#include "layers.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "io/text/decimal.hpp"

namespace lekalo::io {
namespace {

/// Layers named in a message; a drawing may have thousands.
constexpr std::size_t kMostLayersNamed = 12;

char folded(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_among(const Layer& layer, const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [&](const auto& w) { return means_layer(w, layer); });
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? std::string() : a + ":" + b;
}

std::string names_of(const std::vector<Layer>& layers) {
  std::string text;
  for (std::size_t i = 0; i < layers.size() && i < kMostLayersNamed; ++i)
    text += (i > 0 ? ", " : "") + excerpt(layer_word(layers, i));
  if (layers.size() > kMostLayersNamed) text += fmt::format(" and {} more", layers.size() - kMostLayersNamed);
  return text;
}

}  // namespace

bool same_layer(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return folded(x) == folded(y); });
}

bool means_layer(const std::string& word, const Layer& layer) {
  if (same_layer(word, layer.name)) return true;
  const std::string &name = layer.name, &colour = layer.colour, &line = layer.line_type;
  for (const std::string& said : {colour, line, joined(name, colour), joined(name, line),
                                  joined(colour, line), joined(joined(name, colour), line)})
    if (!said.empty() && same_layer(word, said)) return true;
  return false;
}

std::string layer_word(const std::vector<Layer>& layers, std::size_t layer) {
  const Layer& one = layers[layer];
  std::string word = one.name;
  for (const std::string& more : {one.colour, one.line_type}) {
    const auto meant = std::count_if(layers.begin(), layers.end(), [&](const Layer& other) {
      return other.hidden == one.hidden && means_layer(word, other);
    });
    if (meant <= 1) break;
    if (!more.empty()) word += ":" + more;
  }
  return word;
}

Result<LayerChoice> choose_layers(const Drawing& drawing, const DrawingOptions& options) {
  for (const auto* names : {&options.take, &options.leave}) {
    for (const std::string& name : *names) {
      if (std::any_of(drawing.layers.begin(), drawing.layers.end(),
                      [&](const Layer& layer) { return means_layer(name, layer); }))
        continue;
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: no curve is on a layer {}; there are {}", drawing.name, excerpt(name),
                                 names_of(drawing.layers)));
    }
  }
  std::vector<std::size_t> curves(drawing.layers.size(), 0);
  for (const DrawnCurve& curve : drawing.curves) ++curves[curve.layer];
  LayerChoice choice;
  std::string left;
  std::size_t named = 0;
  for (std::size_t i = 0; i < drawing.layers.size(); ++i) {
    const Layer& layer = drawing.layers[i];
    const bool wanted = options.take.empty() ? !layer.hidden : is_among(layer, options.take);
    choice.taken.push_back(wanted && !is_among(layer, options.leave));
    if (choice.taken.back() || ++named > kMostLayersNamed) continue;
    left += fmt::format("{}{} ({} curves{})", left.empty() ? "" : ", ",
                        excerpt(layer_word(drawing.layers, i)), curves[i], layer.hidden ? ", hidden" : "");
  }
  if (named > kMostLayersNamed) left += fmt::format(" and {} more", named - kMostLayersNamed);
  if (named > 0) choice.notices.push_back("layers left out: " + left);
  return choice;
}

std::string curve_name(const Drawing& drawing, std::size_t curve) {
  const DrawnCurve& drawn = drawing.curves[curve];
  const DrawnEntity& entity = drawing.entities[drawn.entity];
  const std::string handle = entity.handle.empty() ? "" : fmt::format(" ({})", excerpt(entity.handle));
  return fmt::format("the {}{} at line {}, layer {}", entity.type, handle, entity.line,
                     excerpt(drawing.layers[drawn.layer].name));
}

}  // namespace lekalo::io
