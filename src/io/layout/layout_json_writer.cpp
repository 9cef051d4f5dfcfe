// A layout document as JSON text.

#include <algorithm>
#include <optional>

#include "io/shape/region_text.hpp"
#include "io/text/grid_decimal.hpp"
#include "layout_outline.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "mark_words.hpp"

namespace lekalo::io {
namespace {

using namespace layout;
using detail::append_gap;
using detail::append_mm;

/// The fields that layouts have, in an object that this opens; those that are as usual are left out.
class Fields {
 public:
  explicit Fields(JsonWriter& json) : json_(json) { json_.begin_object(); }
  JsonWriter& field(const char* key) { return json_.key(key); }
  void text(const char* key, std::string_view value) { json_.field(key, value); }
  void name(const std::string& value) { said("name", value); }
  void said(const char* key, const std::string& value) {
    if (!value.empty()) text(key, value);
  }
  void material(const Material& material) {
    said("material", material.name);
    if (material.thickness != 0) mm("thickness", material.thickness);
  }
  template <class Integer>
  void integer(const char* key, Integer value) {
    json_.field(key, value);
  }
  template <class Integer>
  void integer(const char* key, Integer value, Integer usual) {
    if (value != usual) integer(key, value);
  }
  void number(const char* key, double value) { json_.field(key, value + 0.0); }  // 0 for -0
  void number(const char* key, double value, double usual) {
    if (value != usual) number(key, value);
  }
  void truth(const char* key, bool value) {
    if (value) json_.field(key, true);
  }
  void quality(int value) { value == kBestQuality ? text("quality", "best") : integer("quality", value); }
  void mm(const char* key, std::int64_t steps) { append_mm(field(key).raw(), steps); }
  void gap(const char* key, std::optional<std::int64_t> value) {
    if (value) append_gap(field(key).raw(), *value);
  }
  void turn(const char* key, std::int64_t steps) { detail::append_rotation_step(field(key).raw(), steps); }
  void outline(const Outline& outline) { detail::write_outline(field("outline"), outline); }
  void close() { json_.end(); }

 private:
  JsonWriter& json_;
};

/// A list with a line for each item, after so many blanks; its bracket ends the last of them.
template <class Item, class Write>
void list_of_lines(JsonWriter& json, const std::vector<Item>& items, std::size_t indent, const Write& write) {
  json.list(items, [&](const Item& item) {
    json.line(indent);
    write(item);
  });
}

void write_placement(JsonWriter& json, const Document& document, const Placement& placement) {
  Fields fields(json);
  fields.integer("id", placement.id);
  fields.text("part", document.parts[placement.part].id);
  fields.text("stock", document.stocks[placement.stock].id);
  fields.integer("copy", placement.copy, std::int64_t{0});
  fields.turn("c", placement.rotation.c);
  fields.turn("s", placement.rotation.s);
  fields.mm("x", placement.at.x);
  fields.mm("y", placement.at.y);
  fields.truth("mirrored", placement.mirrored);
  fields.truth("locked", placement.locked);
  fields.close();
}

void write_defect(JsonWriter& json, const std::string& id, int severity, const Outline& outline) {
  Fields fields(json);
  fields.text("id", id);
  fields.integer("severity", severity);
  fields.outline(outline);
  fields.close();
}

void write_zone(JsonWriter& json, const std::string& id, int quality, const Outline& outline) {
  Fields fields(json);
  fields.text("id", id);
  fields.integer("quality", quality);
  fields.outline(outline);
  fields.close();
}

/// Writes parts and stocks.
class ItemWriter {
 public:
  void stock(const Stock& stock) {
    Fields fields(json_);
    fields.text("id", stock.id);
    fields.name(stock.name);
    fields.material(stock.material);
    fields.text("kind", stock.kind == StockKind::strip   ? "strip"
                        : stock.kind == StockKind::sheet ? "sheet"
                                                         : "hide");
    fields.integer("count", stock.count, std::int64_t{1});
    fields.number("cost", stock.cost, 1);
    if (stock.grain_degrees) fields.number("grain_deg", *stock.grain_degrees);
    if (stock.kind == StockKind::strip) {
      const geom::GridBox box = geom::bounds(stock.outline.polygon);
      fields.mm("height", box.high.y);
      if (!stock.open_length) fields.mm("length", box.high.x);
    } else {
      fields.outline(stock.outline);
    }
    if (!stock.defects.empty())
      list_of_lines(fields.field("defects"), stock.defects, 2,
                    [this](const Defect& d) { write_defect(json_, d.id, d.severity, d.outline); });
    if (!stock.zones.empty())
      list_of_lines(fields.field("zones"), stock.zones, 2,
                    [this](const QualityZone& z) { write_zone(json_, z.id, z.quality, z.outline); });
    fields.close();
  }

  void part(const Part& part) {
    Fields fields(json_);
    fields.text("id", part.id);
    fields.name(part.name);
    fields.material(part.material);
    fields.said("customer", part.purpose.customer);
    fields.said("due", part.purpose.due);
    fields.said("label", part.purpose.label);
    fields.integer("demand", part.demand);
    if (part.quality != kAnyQuality) fields.quality(part.quality);
    if (!part.rotations.empty())
      fields.field("rotations").list(part.rotations, [this](const AngleRange& r) { range(r); });
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
      list_of_lines(fields.field("areas"), part.areas, 2, [this](const PartArea& a) { area(a); });
    if (!part.marks.empty())
      list_of_lines(fields.field("marks"), part.marks, 2, [this](const layout::PartMark& m) { mark(m); });
    if (!part.texts.empty())
      list_of_lines(fields.field("texts"), part.texts, 2, [this](const layout::PartText& t) { text(t); });
    fields.close();
  }
  /// \param write_part  writes what a piece calls its part
  template <class WritePart>
  void kit(const Kit& kit, const WritePart& write_part) {
    Fields fields(json_);
    fields.text("id", kit.id);
    fields.name(kit.name);
    fields.integer("demand", kit.demand);
    fields.number("value", kit.value, 1);
    fields.field("pieces").list(kit.pieces, [&](const KitPiece& piece) {
      Fields of(json_);
      write_part(of.field("part"), piece.part);
      of.integer("count", piece.count, std::int64_t{1});
      if (piece.mirrored) of.field("mirrored").value(*piece.mirrored);
      of.close();
    });
    fields.close();
  }
  [[nodiscard]] std::string take() { return json_.take(); }

 protected:
  JsonWriter json_{JsonLayout::spaced};

 private:
  void mark(const layout::PartMark& mark) {
    Fields fields(json_);
    look(fields, mark);
    detail::write_edges(fields.field("edges"), mark.edges);
    fields.close();
  }

  void text(const layout::PartText& text) {
    Fields fields(json_);
    fields.text("text", text.text);
    fields.field("at").list({text.at.x + 0.0, text.at.y + 0.0});
    fields.number("height", text.height);
    fields.number("deg", text.degrees, 0);
    fields.number("width_factor", text.width_factor, 1);
    fields.truth("mirrored", text.mirrored);
    if (text.anchor != TextAnchor::left)
      fields.text("anchor", detail::word_among(detail::kTextAnchors, text.anchor));
    look(fields, text);
    fields.close();
  }

  /// The layer, the colour and the role of a mark or a text.
  template <class Item>
  static void look(Fields& fields, const Item& item) {
    fields.said("layer", item.layer);
    fields.said("colour", item.colour);
    if (item.role != MarkRole::mark) fields.text("role", detail::word_among(detail::kMarkRoles, item.role));
  }

  void range(const AngleRange& range) {
    if (range.from == range.to) {
      json_.value(range.from + 0.0);
      return;
    }
    Fields fields(json_);
    fields.number("from", range.from);
    fields.number("to", range.to);
    fields.close();
  }

  void area(const PartArea& area) {
    Fields fields(json_);
    fields.quality(area.quality);
    fields.outline(area.outline);
    fields.close();
  }
};

class Writer : private ItemWriter {
 public:
  explicit Writer(const Document& document) : document_(document) {}

  std::string write() {
    json_.begin_object().fields({{"format", "lekalo-layout/1"}, {"units", "mm"}});
    if (!document_.name.empty()) json_.field("name", document_.name);
    json_.line(0);
    rules(document_.rules);
    list("stocks", document_.stocks, [this](const Stock& s) { stock(s); });
    list("parts", document_.parts, [this](const Part& p) { part(p); });
    list("kits", document_.kits, [this](const Kit& k) {
      kit(k, [this](JsonWriter& json, std::uint32_t part) { json.value(document_.parts[part].id); });
    });
    list("placements", document_.placements,
         [this](const Placement& p) { write_placement(json_, document_, p); });
    json_.line(0).field("next_id", document_.next_id).end();
    return json_.take() + "\n";
  }

 private:
  template <class Item, class Write>
  void list(const char* key, const std::vector<Item>& items, const Write& write) {
    list_of_lines(json_.line(0).key(key), items, 1, write);
  }

  void rules(const Rules& rules) {
    Fields fields(json_.key("rules"));
    fields.gap("gap", rules.gap);
    fields.gap("border_gap", rules.border_gap);
    fields.gap("defect_gap", rules.defect_gap);
    if (rules.kerf != 0) fields.gap("kerf", rules.kerf);
    fields.close();
  }

  const Document& document_;
};

/// The text of the item that `write(items)` writes, on one line: a line end is blank space here, as texts
/// hold none.
template <class Write>
std::string line_of(const Write& write) {
  ItemWriter items;
  write(items);
  std::string text = items.take();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void write_feature(JsonWriter& json, const Feature& feature) {
  (feature.kind == FeatureKind::defect ? write_defect : write_zone)(json, feature.id, feature.grade,
                                                                    feature.outline);
}

/// The text of one value that `write(json)` writes.
template <class Write>
std::string text_of(const Write& write) {
  JsonWriter json(JsonLayout::spaced);
  write(json);
  return json.take();
}

}  // namespace

std::string write_layout(const Document& document) { return Writer(document).write(); }

std::string placement_json(const Document& document, const Placement& placement) {
  return text_of([&](JsonWriter& json) { write_placement(json, document, placement); });
}

std::string feature_json(const Feature& feature) {
  return text_of([&](JsonWriter& json) { write_feature(json, feature); });
}

std::string part_json(const Part& part) {
  return line_of([&](ItemWriter& items) { items.part(part); });
}

std::string stock_json(const Stock& stock) {
  return line_of([&](ItemWriter& items) { items.stock(stock); });
}

std::string kit_json(const Kit& kit) {
  return line_of([&](ItemWriter& items) {
    items.kit(kit, [](JsonWriter& json, std::uint32_t part) { json.value(part); });
  });
}

std::string features_json(const Document& document, const std::vector<FeatureChange>& changes) {
  return text_of([&](JsonWriter& json) {
    json.list(changes, [&](const FeatureChange& one) {
      json.begin_object().fields({{"stock", document.stocks[one.stock].id},
                                  {"kind", name_of(one.either().kind)},
                                  {"id", one.either().id},
                                  {"index", one.index}});
      json.key("after");
      one.after ? write_feature(json, *one.after) : void(json.value(nullptr));
      json.end();
    });
  });
}

}  // namespace lekalo::io
