#include "inner_lines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/drawing/curve_edges.hpp"
#include "io/drawing/layers.hpp"
#include "io/layout/mark_words.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/layout/layout_export.hpp"

namespace lekalo::io {
namespace {

layout::MarkRole mark_role(LayerRole role) {
  switch (role) {
    case LayerRole::cut:
      return layout::MarkRole::cut;
    case LayerRole::engrave:
      return layout::MarkRole::engrave;
    case LayerRole::bend:
      return layout::MarkRole::bend;
    case LayerRole::mark:
    case LayerRole::ignore:
      break;
  }
  return layout::MarkRole::mark;
}

layout::TextAnchor anchor_of(ReadText::Anchor anchor) {
  return anchor == ReadText::Anchor::left     ? layout::TextAnchor::left
         : anchor == ReadText::Anchor::middle ? layout::TextAnchor::middle
                                              : layout::TextAnchor::right;
}

bool is_among(const std::vector<std::string>& words, const Layer& layer) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return means_layer(word, layer); });
}

}  // namespace

InnerLines::InnerLines(const LayerRules& rules, const DrawingOptions& how, bool is_export)
    : rules_(rules), how_(how), is_export_(is_export) {}

std::optional<LayerRole> InnerLines::role(const Layer& layer) const {
  if (is_export_ && std::any_of(std::begin(kExportLayers), std::end(kExportLayers),
                                [&](const char* own) { return layer.name == own; }))
    return layer.name == "CUT" ? LayerRole::cut : LayerRole::ignore;
  if (const auto said = role_of(rules_, layer)) return said;
  return is_export_ ? std::optional(LayerRole::mark) : std::nullopt;
}

/// Says whether the lines of a layer are there, like choose_layers, but that what a rule makes marks need not
/// be named among the layers of parts.
bool InnerLines::counts(const Layer& layer) const {
  if (is_among(how_.leave, layer)) return false;
  if (is_among(how_.take, layer)) return true;
  const auto said = role(layer);
  return !layer.hidden && (how_.take.empty() || (said && *said != LayerRole::cut));
}

Result<std::vector<RuledLine>> InnerLines::take_lines(Drawing& drawing) {
  std::vector<std::optional<LayerRole>> roles;
  std::vector<bool> taken;
  for (const Layer& layer : drawing.layers) roles.push_back(role(layer)), taken.push_back(counts(layer));
  std::vector<RuledLine> lines;
  std::vector<DrawnCurve> left;
  std::uint32_t entity_before = 0;
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) {
    ask();
    DrawnCurve& curve = drawing.curves[i];
    const auto said = roles[curve.layer];
    if (!said || *said == LayerRole::cut) {
      left.push_back(std::move(curve));
      continue;
    }
    if (!taken[curve.layer]) continue;
    if (*said == LayerRole::ignore) {
      ignored_curves_ += is_export_ ? 0 : 1;
      continue;
    }
    auto made = edges_of(curve.shape, how_.curve_tolerance);
    if (!made)
      return failure(made.error().code,
                     fmt::format("{}: {} {}", drawing.name, curve_name(drawing, i), made.error().message));
    if (made->edges.empty()) continue;
    const bool goes_on = !lines.empty() && entity_before == curve.entity &&
                         lines.back().layer == curve.layer &&
                         lines.back().edges.back().to == made->edges.front().from;
    if (!goes_on) lines.push_back({{}, curve.layer, mark_role(*said)});
    geom::Contour& edges = lines.back().edges;
    edges.insert(edges.end(), made->edges.begin(), made->edges.end());
    entity_before = curve.entity;
  }
  drawing.curves = std::move(left);
  return lines;
}

std::vector<layout::PartText> InnerLines::take_texts(Drawing& drawing) {
  std::vector<layout::PartText> texts;
  for (ReadText& one : drawing.texts) {
    if (!counts(one.layer)) continue;
    const auto said = role(one.layer);
    if (said == LayerRole::ignore) {
      ignored_texts_ += is_export_ ? 0 : 1;
      continue;
    }
    layout::PartText text;
    text.text = std::move(one.text);
    text.at = one.at;
    text.height = one.height, text.degrees = one.degrees, text.width_factor = one.width_factor;
    text.mirrored = one.mirrored;
    text.anchor = anchor_of(one.anchor);
    text.layer = one.layer.name, text.colour = colour_of(one.layer);
    if (said) text.role = mark_role(*said);
    texts.push_back(std::move(text));
  }
  drawing.texts.clear();
  return texts;
}

std::vector<bool> InnerLines::said_to_be_cut(const Drawing& drawing) const {
  std::vector<bool> said;
  for (const Layer& layer : drawing.layers) said.push_back(role_of(rules_, layer) == LayerRole::cut);
  return said;
}

layout::MarkRole InnerLines::role_of_open_line(const Layer& layer) const {
  return role_of(rules_, layer) == LayerRole::cut ? layout::MarkRole::cut : layout::MarkRole::mark;
}

std::string InnerLines::ignored(const Drawing& drawing) const {
  if (ignored_curves_ + ignored_texts_ == 0) return "";
  return fmt::format("{}: {} and {} are on layers that {} says to ignore", drawing.name,
                     counted(ignored_curves_, "line"), counted(ignored_texts_, "text"), rules_.name);
}

std::string colour_of(const Layer& layer) {
  std::string colour = layer.colour;
  for (char& c : colour)
    if (c >= 'A' && c <= 'F') c = static_cast<char>(c - 'A' + 'a');
  return detail::is_colour(colour) ? colour : "";
}

}  // namespace lekalo::io
