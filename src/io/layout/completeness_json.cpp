#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/json_writer.hpp"

namespace lekalo::io {

using namespace layout;

namespace {

void write(JsonWriter& json, const SheetUse& use, const Document& document) {
  json.begin_object().fields({{"stock", document.stocks[use.sheet.stock].id},
                              {"copy", use.sheet.copy},
                              {"parts", use.parts},
                              {"density", use.density()},
                              {"parts_area_mm2", use.parts_area},
                              {"material_area_mm2", use.material_area},
                              {"defect_area_mm2", use.defect_area},
                              {"length_mm", use.used_length_mm}});
  json.key("remnant");
  if (use.remnant.low == use.remnant.high) {
    json.value(nullptr);
  } else {
    const geom::Point low = geom::mm_from_grid(use.remnant.low),
                      size = geom::mm_from_grid(use.remnant.high - use.remnant.low);
    json.object({{"x", low.x}, {"y", low.y}, {"width", size.x}, {"height", size.y}});
  }
  json.end();
}

void write_kits(JsonWriter& json, const Document& document, const std::vector<KitCount>& kits) {
  json.begin_list();
  for (std::size_t i = 0; i < kits.size(); ++i) {
    json.begin_object().fields(
        {{"kit", document.kits[i].id}, {"wanted", document.kits[i].demand}, {"complete", kits[i].complete}});
    json.key("missing").list(kits[i].missing, [&](const MissingPiece& piece) {
      json.begin_object().fields({{"part", document.parts[piece.part].id}, {"count", piece.count}});
      if (piece.mirrored) json.field("mirrored", *piece.mirrored);
      json.end();
    });
    json.end();
  }
  json.end();
}

}  // namespace

void write_completeness(JsonWriter& json, const Document& document, const Completeness& c) {
  json.fields({{"density", c.density}, {"cost", c.cost}});
  json.key("sheets").list(c.sheets, [&](const SheetUse& use) { write(json, use, document); });
  write_kits(json.key("kits"), document, c.kits);
  json.key("parts").begin_list();
  for (std::size_t i = 0; i < c.placed.size(); ++i)
    json.object({{"part", document.parts[i].id},
                 {"wanted", wanted(document, static_cast<std::uint32_t>(i))},
                 {"placed", c.placed[i].total()},
                 {"mirrored", c.placed[i].mirrored},
                 {"missing", c.missing[i]},
                 {"surplus", c.surplus[i]}});
  json.end();
}

std::string kits_json(const Document& document, const std::vector<KitCount>& kits) {
  JsonWriter json(JsonLayout::compact);
  write_kits(json, document, kits);
  return json.take();
}

std::string completeness_json(const Document& document, const Completeness& completeness) {
  JsonWriter json(JsonLayout::compact);
  json.begin_object();
  write_completeness(json, document, completeness);
  json.end();
  return json.take();
}

}  // namespace lekalo::io
