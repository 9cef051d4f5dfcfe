// A layout document as JSON text.

#include <fmt/core.h>

#include <optional>

#include "io/shape/region_reader.hpp"
#include "io/text/grid_decimal.hpp"
#include "layout_outline.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

using namespace layout;
using detail::append_gap;
using detail::append_mm;
using detail::append_number;
using detail::append_outline;

/// Fields of one object, on one line.
class Fields {
 public:
  explicit Fields(std::string& text) : text_(text) { text_ += '{'; }
  /// The text that the field's value is to be appended to.
  std::string& field(const char* key) {
    if (!first_) text_ += ", ";
    first_ = false;
    text_ += '"';
    text_ += key;
    text_ += "\": ";
    return text_;
  }
  void text(const char* key, const std::string& value) { field(key) += json_string(value); }
  void name(const std::string& value) {
    if (!value.empty()) text("name", value);
  }
  template <class Integer>
  void integer(const char* key, Integer value) {
    field(key) += fmt::format("{}", value);
  }
  template <class Integer>
  void integer(const char* key, Integer value, Integer usual) {
    if (value != usual) integer(key, value);
  }
  void number(const char* key, double value) { append_number(field(key), value); }
  void number(const char* key, double value, double usual) {
    if (value != usual) number(key, value);
  }
  void truth(const char* key, bool value) {
    if (value) field(key) += "true";
  }
  void quality(int value) { value == kBestQuality ? text("quality", "best") : integer("quality", value); }
  void gap(const char* key, std::optional<std::int64_t> value) {
    if (value) append_gap(field(key), *value);
  }
  void outline(const Outline& outline) { append_outline(field("outline"), outline); }
  void close() { text_ += '}'; }

 private:
  std::string& text_;
  bool first_ = true;
};

/// Items on lines of their own, or on one where `before` is empty.
template <class Item, class Write>
void append_list(std::string& text, const std::vector<Item>& items, const char* before, const Write& write) {
  text += '[';
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += *before == '\0' ? ", " : ",";
    text += before;
    write(items[i]);
  }
  text += ']';
}

/// \param part, stock  their ids, quoted
void append_placement(std::string& text, const Placement& placement, const std::string& part,
                      const std::string& stock) {
  Fields fields(text);
  fields.integer("id", placement.id);
  fields.field("part") += part;
  fields.field("stock") += stock;
  fields.integer("copy", placement.copy, std::int64_t{0});
  detail::append_rotation_step(fields.field("c"), placement.rotation.c);
  detail::append_rotation_step(fields.field("s"), placement.rotation.s);
  append_mm(fields.field("x"), placement.at.x);
  append_mm(fields.field("y"), placement.at.y);
  fields.truth("mirrored", placement.mirrored);
  fields.truth("locked", placement.locked);
  fields.close();
}

void append_defect(std::string& text, const std::string& id, int severity, const Outline& outline) {
  Fields fields(text);
  fields.text("id", id);
  fields.integer("severity", severity);
  fields.outline(outline);
  fields.close();
}

void append_zone(std::string& text, const std::string& id, int quality, const Outline& outline) {
  Fields fields(text);
  fields.text("id", id);
  fields.integer("quality", quality);
  fields.outline(outline);
  fields.close();
}

class Writer {
 public:
  explicit Writer(const Document& document) : document_(document) {
    for (const Part& part : document.parts) part_ids_.push_back(json_string(part.id));
    for (const Stock& stock : document.stocks) stock_ids_.push_back(json_string(stock.id));
  }

  std::string write() {
    text_ = "{\"format\": \"lekalo-layout/1\", \"units\": \"mm\"";
    if (!document_.name.empty()) text_ += ", \"name\": " + json_string(document_.name);
    rules(document_.rules);
    list("stocks", document_.stocks, [this](const Stock& s) { stock(s); });
    list("parts", document_.parts, [this](const Part& p) { part(p); });
    list("kits", document_.kits, [this](const Kit& k) { kit(k); });
    list("placements", document_.placements, [this](const Placement& p) { placement(p); });
    text_ += fmt::format(",\n\"next_id\": {}}}\n", document_.next_id);
    return std::move(text_);
  }

 private:
  template <class Item, class Write>
  void list(const char* key, const std::vector<Item>& items, const Write& write) {
    text_ += fmt::format(",\n\"{}\": ", key);
    append_list(text_, items, "\n ", write);
  }

  void rules(const Rules& rules) {
    text_ += ",\n\"rules\": ";
    Fields fields(text_);
    fields.gap("gap", rules.gap);
    fields.gap("border_gap", rules.border_gap);
    fields.gap("defect_gap", rules.defect_gap);
    fields.close();
  }

  void stock(const Stock& stock) {
    Fields fields(text_);
    fields.text("id", stock.id);
    fields.name(stock.name);
    fields.text("kind", stock.kind == StockKind::strip   ? "strip"
                        : stock.kind == StockKind::sheet ? "sheet"
                                                         : "hide");
    fields.integer("count", stock.count, std::int64_t{1});
    fields.number("cost", stock.cost, 1);
    if (stock.grain_degrees) fields.number("grain_deg", *stock.grain_degrees);
    if (stock.kind == StockKind::strip) {
      const geom::GridBox box = geom::bounds(stock.outline.polygon);
      append_mm(fields.field("height"), box.high.y);
      if (!stock.open_length) append_mm(fields.field("length"), box.high.x);
    } else {
      fields.outline(stock.outline);
    }
    if (!stock.defects.empty())
      append_list(fields.field("defects"), stock.defects, "\n  ",
                  [this](const Defect& d) { append_defect(text_, d.id, d.severity, d.outline); });
    if (!stock.zones.empty())
      append_list(fields.field("zones"), stock.zones, "\n  ",
                  [this](const QualityZone& z) { append_zone(text_, z.id, z.quality, z.outline); });
    fields.close();
  }

  void part(const Part& part) {
    Fields fields(text_);
    fields.text("id", part.id);
    fields.name(part.name);
    fields.integer("demand", part.demand);
    if (part.quality != kAnyQuality) fields.quality(part.quality);
    if (!part.rotations.empty())
      append_list(fields.field("rotations"), part.rotations, "", [this](const AngleRange& r) { range(r); });
    fields.truth("mirror", part.may_mirror);
    if (part.grain) {
      Fields grain(fields.field("grain"));
      grain.number("deg", part.grain->degrees);
      grain.number("tolerance_deg", part.grain->tolerance_degrees);
      grain.close();
    }
    fields.integer("tolerated_severity", part.tolerated_severity, 0);
    fields.integer("priority", part.priority, 0);
    fields.gap("gap", part.gap);
    fields.gap("border_gap", part.border_gap);
    fields.gap("defect_gap", part.defect_gap);
    fields.outline(part.outline);
    if (!part.areas.empty())
      append_list(fields.field("areas"), part.areas, "\n  ", [this](const PartArea& a) { area(a); });
    fields.close();
  }

  void range(const AngleRange& range) {
    if (range.from == range.to) return append_number(text_, range.from);
    Fields fields(text_);
    fields.number("from", range.from);
    fields.number("to", range.to);
    fields.close();
  }

  void area(const PartArea& area) {
    Fields fields(text_);
    fields.quality(area.quality);
    fields.outline(area.outline);
    fields.close();
  }

  void kit(const Kit& kit) {
    Fields fields(text_);
    fields.text("id", kit.id);
    fields.name(kit.name);
    fields.integer("demand", kit.demand);
    fields.number("value", kit.value, 1);
    append_list(fields.field("pieces"), kit.pieces, "", [this](const KitPiece& p) { piece(p); });
    fields.close();
  }

  void piece(const KitPiece& piece) {
    Fields fields(text_);
    fields.field("part") += part_ids_[piece.part];
    fields.integer("count", piece.count, std::int64_t{1});
    if (piece.mirrored) fields.field("mirrored") += *piece.mirrored ? "true" : "false";
    fields.close();
  }

  void placement(const Placement& p) { append_placement(text_, p, part_ids_[p.part], stock_ids_[p.stock]); }

  const Document& document_;
  std::vector<std::string> part_ids_, stock_ids_;
  std::string text_;
};

}  // namespace

std::string write_layout(const Document& document) { return Writer(document).write(); }

std::string placement_json(const Document& document, const Placement& placement) {
  std::string text;
  append_placement(text, placement, json_string(document.parts[placement.part].id),
                   json_string(document.stocks[placement.stock].id));
  return text;
}

std::string feature_json(const Feature& feature) {
  std::string text;
  (feature.kind == FeatureKind::defect ? append_defect : append_zone)(text, feature.id, feature.grade,
                                                                      feature.outline);
  return text;
}

std::string features_json(const Document& document, const std::vector<FeatureChange>& changes) {
  std::string text;
  append_list(text, changes, "", [&](const FeatureChange& one) {
    Fields fields(text);
    fields.text("stock", document.stocks[one.stock].id);
    fields.text("kind", std::string(name_of(one.either().kind)));
    fields.text("id", one.either().id);
    fields.integer("index", one.index);
    fields.field("after") += one.after ? feature_json(*one.after) : "null";
    fields.close();
  });
  return text;
}

}  // namespace lekalo::io
