#include "layers.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "io/text/decimal.hpp"

namespace lekalo::io {
namespace {

/// Layers named in a message; a drawing may have thousands.
constexpr std::size_t kMostNamed = 12;

char folded(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const auto& n) { return same_layer(name, n); });
}

std::string names_of(const std::vector<Layer>& layers) {
  std::string text;
  for (std::size_t i = 0; i < layers.size() && i < kMostNamed; ++i)
    text += (i > 0 ? ", " : "") + excerpt(layers[i].name);
  if (layers.size() > kMostNamed) text += fmt::format(" and {} more", layers.size() - kMostNamed);
  return text;
}

}  // namespace

bool same_layer(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return folded(x) == folded(y); });
}

Result<LayerChoice> choose_layers(const Drawing& drawing, const DrawingOptions& options) {
  for (const auto* names : {&options.take, &options.leave}) {
    for (const std::string& name : *names) {
      if (std::any_of(drawing.layers.begin(), drawing.layers.end(),
                      [&](const Layer& layer) { return same_layer(layer.name, name); }))
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
    const bool wanted = options.take.empty() ? !layer.hidden : is_among(layer.name, options.take);
    choice.taken.push_back(wanted && !is_among(layer.name, options.leave));
    if (choice.taken.back() || ++named > kMostNamed) continue;
    left += fmt::format("{}{} ({} curves{})", left.empty() ? "" : ", ", excerpt(layer.name), curves[i],
                        layer.hidden ? ", hidden" : "");
  }
  if (named > kMostNamed) left += fmt::format(" and {} more", named - kMostNamed);
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
