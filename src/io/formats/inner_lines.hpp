#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/layer_rules.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

/// Lines and texts inside the parts of a drawing, sorted by their layers: docs/design/marks.md.

/// A line that a rule takes from the outlines.
struct RuledLine {
  geom::Contour edges;  ///< each begins exactly where the one before ends
  std::uint32_t layer = 0;
  layout::MarkRole role = layout::MarkRole::mark;
};

class InnerLines {
 public:
  /// \param is_export  the drawing is one of lekalo's exports: all that is not on a layer of its own is a
  /// mark
  InnerLines(const LayerRules& rules, const DrawingOptions& how, bool is_export);

  /// Takes the curves out of the drawing that are no outlines. Fails like make_regions for a curve that
  /// cannot be read.
  [[nodiscard]] Result<std::vector<RuledLine>> take_lines(Drawing& drawing);
  /// Takes the texts out of the drawing, in the form of layouts.
  [[nodiscard]] std::vector<layout::PartText> take_texts(Drawing& drawing);
  /// Says for every layer whether a rule says that it is cut.
  [[nodiscard]] std::vector<bool> said_to_be_cut(const Drawing& drawing) const;
  /// The role of an open line on a layer.
  [[nodiscard]] layout::MarkRole role_of_open_line(const Layer& layer) const;
  /// A sentence about what rules made be ignored; empty where that is nothing.
  [[nodiscard]] std::string ignored(const Drawing& drawing) const;

 private:
  [[nodiscard]] std::optional<LayerRole> role(const Layer& layer) const;
  [[nodiscard]] bool counts(const Layer& layer) const;

  const LayerRules& rules_;
  const DrawingOptions& how_;
  bool is_export_;
  std::size_t ignored_curves_ = 0, ignored_texts_ = 0;
};

/// The colour of a layer as layouts have it; empty where the file says none or has its own word for it.
[[nodiscard]] std::string colour_of(const Layer& layer);

}  // namespace lekalo::io
