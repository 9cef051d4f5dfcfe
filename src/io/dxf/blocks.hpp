#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/drawing/drawn_shapes.hpp"
#include "layers.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "pens.hpp"

namespace lekalo::io {

/// The most damaged entities that are told one by one; the rest is counted.
inline constexpr std::size_t kMostDamagedTold = 1000;

/// An INSERT: a block, placed once or in columns and rows.
struct Insertion {
  std::size_t before = 0;            ///< curves of its own block that stand before it in the file
  std::string_view name;             ///< of the block, as spelled
  struct DxfBlock* block = nullptr;  ///< set by expanded(); null: nothing to place
  bool damaged = false;              ///< set by expanded(): it cannot be placed
  std::size_t line = 0;              ///< of the INSERT
  std::uint32_t pen = 0;             ///< into DxfPens
  Affine world;                      ///< from the plane that the extrusion direction says
  BoundedPoint at;
  Millimetres scale_x{1, 0}, scale_y{1, 0};  ///< factors; never 0
  Direction rotation{{1, 0}, true};
  double rotation_error = 0;  ///< of its sine and cosine
  std::uint32_t columns = 1, rows = 1;
  Millimetres column_step, row_step;
};

/// A TEXT, MTEXT or ATTRIB as it stands in a block: bytes of the file, to be read when the drawing is whole.
struct DxfText {
  std::string text;         ///< undecoded
  bool has_markup = false;  ///< of an MTEXT, which is perhaps several lines
  BoundedPoint at;          ///< on the baseline; of an MTEXT the point to which it is attached
  geom::Point along, up;    ///< of the baseline's direction and upwards, as long as capitals are high
  double width_factor = 1;
  double column = 0;        ///< the width in which an MTEXT is broken into lines, in its heights; 0: nowhere
  double line_spacing = 1;  ///< of an MTEXT, of 5/3 of its height
  int across = 0, upward = 0;  ///< 0, 1, 2: left, middle, right; above, middle, below the point (MTEXT)
  std::uint32_t pen = 0;
  std::size_t line = 0;
};

struct UnreadTally {
  std::size_t count = 0, line = 0;
};

/// A block, or the model space itself. Curves are DrawnCurve with `layer` into DxfPens.
struct DxfBlock {
  BoundedPoint base;
  std::vector<DrawnCurve> curves;
  std::vector<Insertion> insertions;  ///< in file order
  std::vector<DxfText> texts;         ///< in file order
  std::map<std::string, UnreadTally> unread;
  std::vector<geom::Box> fills;  ///< the boxes of what solid hatches fill, path by path
  std::size_t cost = 0;          ///< of the curves, in curves (curve_cost)
  std::size_t line = 0;
  bool external = false;  ///< a reference to another file
  bool repeated = false;  ///< the file holds a second block of this name

  void count_unread(const std::string& what, std::size_t at, std::size_t copies = 1);
};

using DxfBlocks = std::map<std::string, DxfBlock>;  ///< by folded name

/// The share of a curve in kMostCurves: 1, and for a spline 1 more for every 8 poles.
[[nodiscard]] std::size_t curve_cost(const Shape& shape);

/// True for shapes that leave nothing to cut: a line or arc of no length, a circle lost in rounding, a spline
/// in one point.
[[nodiscard]] bool is_point(const Shape& shape);

/// The model space with every insertion replaced by what it shows; layers are still pens: contents on the
/// layer "0" take the layer of the insertion, colours and line types by block those of the insertion, and
/// contents of an insertion on a frozen layer that layer, which hides them. Set aside, with a sentence in
/// `damaged`: insertions of blocks that hold themselves or of which the file has two, and what an insertion
/// makes too large. Refused: nesting and copies beyond the limits of drawing.hpp.
[[nodiscard]] Result<DxfBlock> expanded(DxfBlock model, DxfBlocks& blocks, const DxfLayers& layers,
                                        DxfPens& pens, const std::vector<DrawnEntity>& entities,
                                        const std::string& file, std::vector<std::string>& damaged);

}  // namespace lekalo::io
