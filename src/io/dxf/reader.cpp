#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "binary.hpp"
#include "blocks.hpp"
#include "entities.hpp"
#include "header.hpp"
#include "io/text/refusal.hpp"
#include "layers.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "stated_arcs.hpp"
#include "text.hpp"
#include "texts.hpp"

namespace lekalo::io {
namespace {

/// The sections of a file, one after the other.
class DxfDrawing {
 public:
  DxfDrawing(std::string_view bytes, const std::string& name, std::optional<LengthUnit> user_says)
      : at_(bytes, name), user_says_(user_says) {
    drawing_.name = name;
  }

  Result<Drawing> read() {
    LEKALO_CHECK(read_sections());
    if (!seen_entities_) {
      return refuse(at_.name(), "there is no section ENTITIES; this is not a complete DXF file");
    }
    LEKALO_TRY(auto model, expanded(std::move(model_), blocks_, layers_, pens_, entities_->entities(),
                                    at_.name(), entities_->damaged()));
    take(std::move(model));
    return std::move(drawing_);
  }

 private:
  Result<void> read_sections() {
    for (bool more = at_.next(); more; more = at_.next()) {
      ask();
      // Some programs close the header too early; what comes of it then says nothing about curves.
      while (at_.code() == 9 && at_.next())
        while (at_.code() != 0 && at_.code() != 9 && at_.next()) {
        }
      if (!at_.ok()) break;
      if (at_.at(0, "EOF")) return {};
      if (at_.code() == 999 || at_.at(0, "ENDSEC")) continue;
      if (!at_.at(0, "SECTION")) {
        return refuse_line(at_.name(), at_.line(),
                           fmt::format("a section is wanted here, not {}", excerpt(at_.value())));
      }
      LEKALO_CHECK(read_section());
    }
    // The word EOF is often missing where sections are not.
    if (at_.fault()) return tl::unexpected(*at_.fault());
    return {};
  }

  Result<void> read_section() {
    const std::size_t begin = at_.line();
    do {
      if (!at_.next()) return tl::unexpected(at_.broken_off(begin, "this section"));
    } while (at_.code() == 999);
    if (at_.code() != 2 || at_.value().empty()) {
      return refuse_line(at_.name(), at_.line(), "a section without a name");
    }
    const std::string_view section = at_.value();
    const std::string what = fmt::format("the section {}", excerpt(section));
    if (!at_.next()) return tl::unexpected(at_.broken_off(begin, what));
    if (section == "HEADER") LEKALO_CHECK(read_header());
    if (section == "TABLES") LEKALO_CHECK(read_tables());
    if (section == "OBJECTS") read_objects();
    if (section == "BLOCKS" || section == "ENTITIES") {
      LEKALO_CHECK(begin_entities());
      LEKALO_CHECK(section == "BLOCKS" ? read_blocks() : read_entities());
    }
    while (at_.ok() && !at_.at(0, "ENDSEC")) at_.next();
    if (!at_.ok()) return tl::unexpected(at_.broken_off(begin, what));
    return {};
  }

  Result<void> read_header() {
    std::string_view variable;
    for (; at_.ok() && at_.code() != 0; at_.next()) {
      if (at_.code() == 9) variable = at_.value();
      if (variable == "$DWGCODEPAGE" && at_.code() == 3) header_.code_page = at_.value();
      if (variable == "$MEASUREMENT" && at_.code() == 70) header_.english = at_.value() == "0";
      if (variable == "$INSUNITS" && at_.code() == 70) {
        header_.unit = at_.value();
        header_.unit_line = at_.line();
        if (entities_) {
          return refuse_line(at_.name(), at_.line(),
                             "$INSUNITS stands behind the entities; save the drawing again");
        }
      }
    }
    return {};
  }

  Result<void> read_tables() {
    while (at_.ok() && !at_.at(0, "ENDSEC")) {
      if (at_.at(0, "LAYER")) {
        LEKALO_CHECK(read_layer());
      } else {
        at_.next();
      }
    }
    return {};
  }

  void read_objects() {
    while (at_.ok() && !at_.at(0, "ENDSEC")) {
      if (!at_.at(0, "XRECORD")) {
        at_.next();
        continue;
      }
      bool first = true, ours = false;
      while (at_.next() && at_.code() != 0) {
        if (at_.code() != 1) continue;
        if (ours) exact_arcs_.add(at_.value());
        ours = ours || (first && at_.value() == kExactArcsName);
        first = false;
      }
    }
  }

  Result<void> read_layer() {
    std::string_view name, flags = "0", colour = "7", true_colour, line_type;
    while (at_.next() && at_.code() != 0) {
      if (at_.code() == 2) name = at_.value();
      if (at_.code() == 6) line_type = at_.value();
      if (at_.code() == 70) flags = at_.value();
      if (at_.code() == 62) colour = at_.value();
      if (at_.code() == 420) true_colour = at_.value();
    }
    if (!at_.ok() || name.empty()) return {};
    const auto number = read_millimetres(flags, DecimalFactor{});
    if (!number || !(number->value >= 0)) {
      return refuse_line(
          at_.name(), at_.line(),
          fmt::format("the layer {} has flags that are no number: {}", excerpt(name), excerpt(flags)));
    }
    DxfLayers::Entry& layer = layers_[layers_.index(name)];
    layer.name = name;
    layer.off = colour.substr(0, 1) == "-";
    layer.frozen = (static_cast<unsigned>(number->value) & 1U) != 0;
    layer.colour = colour;
    layer.true_colour = true_colour;
    layer.line_type = line_type;
    return {};
  }

  /// Fixes the unit before the first numbers are read.
  Result<void> begin_entities() {
    if (entities_) return {};
    LEKALO_TRY(const auto unit, drawing_unit(header_, user_says_, at_.name()));
    drawing_.unit = unit.name;
    drawing_.millimetres_per_unit = unit.millimetres();
    unit_is_said_ = unit.said;
    entities_.emplace(at_, layers_, pens_, unit.factor);
    return {};
  }

  Result<void> read_blocks() {
    while (at_.ok() && !at_.at(0, "ENDSEC")) {
      if (!at_.at(0, "BLOCK")) {
        at_.next();
        continue;
      }
      LEKALO_CHECK(read_block());
    }
    return {};
  }

  Result<void> read_block() {
    DxfBlock block;
    block.line = at_.line();
    std::string_view name;
    unsigned flags = 0;
    while (at_.next() && at_.code() != 0) {
      const bool is_number = at_.code() == 10 || at_.code() == 20 || at_.code() == 70;
      if (at_.code() == 2) name = at_.value();
      if (!is_number) continue;
      LEKALO_TRY(const auto value, entities_->number(at_.code() != 70));
      if (at_.code() == 70) flags = static_cast<unsigned>(std::max(value.value, 0.0));
      if (at_.code() == 10) block.base.at.x = value.value;
      if (at_.code() == 20) block.base.at.y = value.value;
      if (at_.code() != 70) block.base.error = std::max(block.base.error, value.error);
    }
    block.external = (flags & kExternal) != 0;
    while (at_.ok() && at_.code() == 0 && !at_.at(0, "ENDBLK") && !at_.at(0, "ENDSEC")) {
      if (at_.at(0, "BLOCK")) {
        return refuse_line(at_.name(), at_.line(),
                           fmt::format("a BLOCK begins here before the one of line {} ends", block.line));
      }
      LEKALO_CHECK(entities_->read(block));
    }
    if (!at_.ok()) return {};
    if (!at_.at(0, "ENDBLK")) {
      return refuse_line(at_.name(), block.line, fmt::format("the block {} does not end", excerpt(name)));
    }
    while (at_.next() && at_.code() != 0) {
    }
    entities_->note_fills(block);
    const auto [known, is_new] = blocks_.try_emplace(folded(name), std::move(block));
    if (!is_new) known->second.repeated = true;
    return {};
  }

  Result<void> read_entities() {
    if (std::exchange(seen_entities_, true)) {
      return refuse_line(at_.name(), at_.line(), "a second section ENTITIES");
    }
    while (at_.ok() && at_.code() == 999) at_.next();
    if (at_.ok() && at_.code() != 0) {
      return refuse_line(at_.name(), at_.line(), "an entity is wanted here (group code 0)");
    }
    while (at_.ok() && !at_.at(0, "ENDSEC")) {
      LEKALO_CHECK(entities_->read(model_));
    }
    entities_->note_fills(model_);
    return {};
  }

  /// Takes the curves into the drawing; its layers and entities are those of the curves, in their order.
  void take(DxfBlock model) {
    constexpr std::uint32_t kNew = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> layer_of_pen(pens_.size(), kNew), entity(entities_->entities().size(), kNew);
    std::map<std::tuple<std::uint32_t, std::string, std::string>, std::uint32_t> layers;
    drawing_.curves = std::move(model.curves);
    const std::size_t unfit = exact_arcs_.restore(drawing_.curves, entities_->entities());
    for (DrawnCurve& curve : drawing_.curves) {
      if (layer_of_pen[curve.layer] == kNew) {
        Layer layer = layer_of(pens_[curve.layer]);
        const auto [found, is_new] =
            layers.try_emplace({pens_[curve.layer].layer, layer.colour, layer.line_type},
                               static_cast<std::uint32_t>(drawing_.layers.size()));
        if (is_new) drawing_.layers.push_back(std::move(layer));
        layer_of_pen[curve.layer] = found->second;
      }
      if (entity[curve.entity] == kNew) {
        entity[curve.entity] = static_cast<std::uint32_t>(drawing_.entities.size());
        drawing_.entities.push_back(std::move(entities_->entities()[curve.entity]));
      }
      curve.layer = layer_of_pen[curve.layer];
      curve.entity = entity[curve.entity];
    }
    for (const DxfText& text : model.texts)
      for (ReadText& line : lines_of_text(text, header_.code_page)) {
        line.layer = layer_of(pens_[text.pen]);
        drawing_.texts.push_back(std::move(line));
      }
    drawing_.damaged = std::move(entities_->damaged());
    for (const auto& [what, tally] : model.unread) drawing_.unread.push_back({what, tally.count, tally.line});
    if (!unit_is_said_) {
      drawing_.notices.push_back(fmt::format(
          "{}: the file does not say its unit; it is read as mm{}", at_.name(),
          suggests_inches(drawing_.curves, header_) ? "; its sizes suggest inches: --units inch reads it so"
                                                    : ""));
    }
    if (unfit > 0) drawing_.notices.push_back(unfit_arcs_sentence(unfit, at_.name()));
    if (entities_->has_heights()) {
      drawing_.notices.push_back(fmt::format("{}: z coordinates are ignored", at_.name()));
    }
  }

  /// The layer of what is drawn with a pen, with its colour and line type.
  [[nodiscard]] Layer layer_of(const DxfPen& pen) const {
    const DxfLayers::Entry& entry = layers_[pen.layer];
    Layer layer{text_of_name(entry.name, header_.code_page), entry.off || entry.frozen};
    DxfColour colour = pen.colour;
    if (colour.is_by_layer() && !entry.true_colour.empty()) colour = DxfColour::of_rgb(entry.true_colour);
    if (colour.is_by_layer()) colour = DxfColour::of_index(entry.colour);
    if (!colour.is_by_layer() && !colour.is_by_block()) layer.colour = colour.word();
    std::string_view line = pen.line_type;
    if (line.empty() || folded(line) == "BYLAYER") line = entry.line_type;
    if (folded(line) != "CONTINUOUS" && folded(line) != "BYBLOCK")
      layer.line_type = text_of_name(line, header_.code_page);
    return layer;
  }

  static constexpr unsigned kExternal = 4;

  DxfCursor at_;
  std::optional<LengthUnit> user_says_;
  DxfHeader header_;
  DxfLayers layers_;
  DxfPens pens_;
  std::optional<DxfEntities> entities_;  ///< from the first section that holds some
  DxfBlocks blocks_;
  DxfBlock model_;
  DxfExactArcs exact_arcs_;
  Drawing drawing_;
  bool seen_entities_ = false, unit_is_said_ = false;
};

}  // namespace

Result<Drawing> parse_dxf(std::string_view bytes, const std::string& name, std::optional<LengthUnit> unit) {
  if (bytes.starts_with(kBinaryDxf)) {
    LEKALO_TRY(const std::string text, text_of_binary_dxf(bytes, name));
    return DxfDrawing(text, name, unit).read();
  }
  if (const std::string fault = wrong_encoding(bytes); !fault.empty()) return refuse(name, fault);
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  if (bytes.empty()) return refuse(name, "the file is empty");
  return DxfDrawing(bytes, name, unit).read();
}

DrawingFormat drawing_dxf() {
  return {.file = {.name = "DXF", .endings = {".dxf"}, .first_bytes = "0123456789", .signature = kBinaryDxf},
          .parse = parse_dxf};
}

}  // namespace lekalo::io
