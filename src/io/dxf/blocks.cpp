#include "blocks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "io/drawing/copies.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "text.hpp"
#include "texts.hpp"

namespace lekalo::io {
namespace {

constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();

std::size_t product(std::size_t a, std::size_t b) { return b != 0 && a > kMost / b ? kMost : a * b; }
std::size_t sum(std::size_t a, std::size_t b) { return a > kMost - b ? kMost : a + b; }

std::size_t copies_of(const Insertion& insertion) {
  return product(std::size_t{insertion.columns}, std::size_t{insertion.rows});
}

/// The map from the block's coordinates to those of the block that holds the insertion.
Affine placement(const Insertion& insertion, const BoundedPoint& base, std::uint32_t column,
                 std::uint32_t row) {
  Affine to_base;
  to_base.shift = -base.at;
  to_base.shift_error = base.error;
  Affine scale;
  scale.xx = insertion.scale_x.value;
  scale.yy = insertion.scale_y.value;
  scale.linear_error = std::max(insertion.scale_x.error, insertion.scale_y.error);
  const BoundedPoint step = image({insertion.column_step.value,
                                   0,
                                   0,
                                   insertion.row_step.value,
                                   {},
                                   std::max(insertion.column_step.error, insertion.row_step.error),
                                   0},
                                  {{static_cast<double>(column), static_cast<double>(row)}, 0});
  Affine to_cell;
  to_cell.shift = step.at;
  to_cell.shift_error = step.error;
  const auto [unit, exact] = insertion.rotation;
  Affine turn{unit.x, -unit.y, unit.y, unit.x, insertion.at.at, 0, insertion.at.error};
  turn.linear_error = insertion.rotation_error + (exact ? 0 : kDegreesError);
  // The steps of an array run along the turned axes and are not scaled.
  return composed(insertion.world, composed(turn, composed(to_cell, composed(scale, to_base))));
}

class Expansion {
 public:
  Expansion(DxfBlocks& blocks, const DxfLayers& layers, DxfPens& pens,
            const std::vector<DrawnEntity>& entities, const std::string& file,
            std::vector<std::string>& damaged)
      : blocks_(blocks), layers_(layers), pens_(pens), entities_(entities), file_(file), damaged_(damaged) {}

  Result<DxfBlock> run(DxfBlock model) {
    find_blocks(model);
    for (auto& [name, block] : blocks_) find_blocks(block);
    LEKALO_CHECK(weigh(model, 0));
    const std::size_t total = weights_.at(&model).cost;
    std::size_t drawn = model.cost;
    for (const auto& [name, block] : blocks_) drawn = sum(drawn, block.cost);
    if (const std::size_t most = std::min(kMostCurves, sum(drawn, kMostCopies)); total > most)
      return refuse(file_,
                    fmt::format("with its blocks and arrays this drawing has {} curves, more than {}; keep "
                                "what is to be cut",
                                total, most));
    count_unread(model);
    drop_empty_insertions(model);
    if (model.insertions.empty()) return model;
    for (auto& [name, block] : blocks_) drop_empty_insertions(block);
    out_.unread = std::move(model.unread);
    out_.curves.reserve(total);
    const std::vector<DrawnCurve> own = std::exchange(model.curves, {});
    out_.texts = std::move(model.texts);
    LEKALO_CHECK(place(own, model.insertions, nullptr, kNoPen, kNotFrozen));
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t kNotFrozen = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kNoPen = kNotFrozen;  ///< of the model space, which stands in no insertion

  struct Weight {
    std::size_t cost = 0;   ///< curves it shows, blocks in it expanded
    std::size_t depth = 0;  ///< of the blocks in it
    bool done = false;      ///< false while its own contents are weighed
  };

  void find_blocks(DxfBlock& block) {
    for (Insertion& insertion : block.insertions) {
      const auto found = blocks_.find(folded(insertion.name));
      insertion.block = found == blocks_.end() || found->second.external ? nullptr : &found->second;
    }
  }

  /// Step 3 of docs/design/drawing.md: leaves out insertions that show nothing, so that every step of the
  /// expansion makes a curve.
  void drop_empty_insertions(DxfBlock& block) {
    const auto is_empty = [this](const Insertion& insertion) {
      const auto weight = weights_.find(insertion.block);
      return weight == weights_.end() || weight->second.cost == 0;
    };
    block.insertions.erase(std::remove_if(block.insertions.begin(), block.insertions.end(), is_empty),
                           block.insertions.end());
  }

  /// Sets an insertion aside that cannot be expanded.
  void set_aside(DxfBlock& holder, Insertion& insertion, const std::string& why) {
    insertion.block = nullptr;
    insertion.damaged = true;
    holder.count_unread("INSERT (damaged)", insertion.line);
    tell(insertion.line, why);
  }

  void tell(std::size_t line, const std::string& why) {
    if (damaged_.size() < kMostDamagedTold) damaged_.push_back(refuse_line(file_, line, why).value().message);
  }

  Result<void> weigh(DxfBlock& block, std::size_t depth) {
    Weight weight{block.cost, 0, false};
    weights_[&block] = weight;
    for (Insertion& insertion : block.insertions) {
      DxfBlock* inner = insertion.block;
      if (inner == nullptr) continue;
      if (inner->repeated) {
        set_aside(block, insertion,
                  fmt::format("this INSERT names the block {}, of which the file holds two; rename one",
                              excerpt(insertion.name)));
        continue;
      }
      auto known = weights_.find(inner);
      if (known != weights_.end() && !known->second.done) {
        set_aside(block, insertion,
                  fmt::format("the block {} is inserted in itself here; the file is damaged",
                              excerpt(insertion.name)));
        continue;
      }
      if (depth + 1 + (known == weights_.end() ? 0 : known->second.depth) > kDeepestNesting) {
        return refuse_line(file_, insertion.line,
                           fmt::format("blocks are nested more than {} deep; explode them", kDeepestNesting));
      }
      if (known == weights_.end()) {
        LEKALO_CHECK(weigh(*inner, depth + 1));
        known = weights_.find(inner);
      }
      weight.cost = sum(weight.cost, product(copies_of(insertion), known->second.cost));
      weight.depth = std::max(weight.depth, known->second.depth + 1);
    }
    weight.done = true;
    weights_[&block] = weight;
    by_depth_.push_back(&block);
    return {};
  }

  /// Adds to the model's own counts those of the blocks, as often as they are shown. In by_depth_ a block
  /// comes before the blocks that hold it.
  void count_unread(DxfBlock& model) {
    std::map<const DxfBlock*, std::size_t> shown_times{{&model, 1}};
    for (auto block = by_depth_.rbegin(); block != by_depth_.rend(); ++block) {
      const std::size_t times = shown_times[*block];
      const bool is_model = *block == &model;
      for (const Insertion& insertion : (*block)->insertions) {
        const std::size_t copies = product(times, copies_of(insertion));
        if (const DxfBlock* inner = insertion.block) {
          shown_times[inner] = sum(shown_times[inner], copies);
        } else if (!insertion.damaged) {
          const bool external = blocks_.count(folded(insertion.name)) != 0;
          model.count_unread(
              external ? "INSERT (of another file)" : "INSERT (of a block that is not in the file)",
              insertion.line, copies);
        }
      }
      if (is_model) continue;
      for (const auto& [name, tally] : (*block)->unread) {
        model.count_unread(name, tally.line, product(tally.count, times));
      }
    }
  }

  /// Step 4: places the curves and insertions of one block in file order; the map is null in the model space.
  Result<void> place(const std::vector<DrawnCurve>& curves, const std::vector<Insertion>& insertions,
                     const Affine* map, std::uint32_t inherited, std::uint32_t frozen) {
    std::size_t next = 0;
    for (const DrawnCurve& curve : curves) {
      for (; next < insertions.size() &&
             insertions[next].before <= static_cast<std::size_t>(&curve - curves.data());
           ++next) {
        LEKALO_CHECK(insert(insertions[next], map, inherited, frozen));
      }
      LEKALO_CHECK(add(curve, map, inherited, frozen));
    }
    for (; next < insertions.size(); ++next) {
      LEKALO_CHECK(insert(insertions[next], map, inherited, frozen));
    }
    return {};
  }

  Result<void> add(const DrawnCurve& curve, const Affine* map, std::uint32_t inherited,
                   std::uint32_t frozen) {
    DrawnCurve placed = curve;
    if (inherited != kNoPen) placed.layer = pens_.inserted(placed.layer, inherited);
    if (frozen != kNotFrozen) placed.layer = with_layer(placed.layer, frozen);
    if (map == nullptr) {
      out_.curves.push_back(std::move(placed));
      return {};
    }
    auto shape = image(*map, {std::move(placed.shape), curve.error});
    const DrawnEntity& entity = entities_[curve.entity];
    if (!shape) {
      out_.count_unread(entity.type + " (damaged)", entity.line);
      tell(entity.line, fmt::format("a block's INSERT puts this {} beyond {:g} mm or makes it flat",
                                    shown(entity.type), kLargestMillimetres));
      return {};
    }
    if (is_point(shape->shape)) {
      out_.count_unread(entity.type + " (of no length)", entity.line);
      return {};
    }
    placed.shape = std::move(shape->shape);
    placed.error = shape->error;
    out_.curves.push_back(std::move(placed));
    return {};
  }

  void add(DxfText text, const Affine& map, std::uint32_t inherited, std::uint32_t frozen) {
    text.pen = pens_.inserted(text.pen, inherited);
    if (frozen != kNotFrozen) text.pen = with_layer(text.pen, frozen);
    place_text(text, map);
    out_.texts.push_back(std::move(text));
  }

  Result<void> insert(const Insertion& insertion, const Affine* map, std::uint32_t inherited,
                      std::uint32_t frozen) {
    const DxfBlock& block = *insertion.block;
    const std::uint32_t pen = inherited == kNoPen ? insertion.pen : pens_.inserted(insertion.pen, inherited);
    const std::uint32_t layer = pens_[pen].layer;
    const std::uint32_t hides = frozen == kNotFrozen && layers_[layer].frozen ? layer : frozen;
    for (std::uint32_t row = 0; row < insertion.rows; ++row) {
      ask(1 + insertion.columns);
      for (std::uint32_t column = 0; column < insertion.columns; ++column) {
        const Affine local = placement(insertion, block.base, column, row);
        const Affine all = map == nullptr ? local : composed(*map, local);
        LEKALO_CHECK(place(block.curves, block.insertions, &all, pen, hides));
        for (const DxfText& text : block.texts) add(text, all, pen, hides);
      }
    }
    return {};
  }

  std::uint32_t with_layer(std::uint32_t pen, std::uint32_t layer) {
    DxfPen other = pens_[pen];
    other.layer = layer;
    return pens_.index(other);
  }

  DxfBlocks& blocks_;
  const DxfLayers& layers_;
  DxfPens& pens_;
  const std::vector<DrawnEntity>& entities_;
  const std::string& file_;
  std::vector<std::string>& damaged_;
  std::map<const DxfBlock*, Weight>
      weights_;  // looked up, never walked: addresses have no order that is the same again
  std::vector<const DxfBlock*> by_depth_;
  DxfBlock out_;
};

}  // namespace

void DxfBlock::count_unread(const std::string& what, std::size_t at, std::size_t copies) {
  if (copies == 0) return;
  const auto [tally, is_new] = unread.try_emplace(what, UnreadTally{0, at});
  tally->second.count = sum(tally->second.count, copies);
  tally->second.line = std::min(tally->second.line, at);
}

std::size_t curve_cost(const Shape& shape) {
  const auto* spline = std::get_if<Spline>(&shape);
  return spline == nullptr ? 1 : 1 + spline->poles.size() / 8;
}

bool is_point(const Shape& shape) {
  if (const auto* edge = std::get_if<geom::Edge>(&shape)) {
    if (edge->kind == geom::EdgeKind::line) return edge->from == edge->to;
    return edge->from == edge->centre || edge->to == edge->centre;
  }
  if (const auto* spline = std::get_if<Spline>(&shape)) {
    return std::all_of(spline->poles.begin(), spline->poles.end(),
                       [&](geom::Point pole) { return pole == spline->poles.front(); });
  }
  return false;
}

Result<DxfBlock> expanded(DxfBlock model, DxfBlocks& blocks, const DxfLayers& layers, DxfPens& pens,
                          const std::vector<DrawnEntity>& entities, const std::string& file,
                          std::vector<std::string>& damaged) {
  return Expansion(blocks, layers, pens, entities, file, damaged).run(std::move(model));
}

}  // namespace lekalo::io
