#include <nlohmann/json.hpp>

#include "lekalo/io/layout/layout_messages.hpp"

namespace lekalo::io {

using Json = nlohmann::ordered_json;
using namespace layout;

namespace {

Json kits_array(const Document& document, const std::vector<KitCount>& counts) {
  Json kits = Json::array();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    Json missing = Json::array();
    for (const MissingPiece& piece : counts[i].missing) {
      Json one{{"part", document.parts[piece.part].id}, {"count", piece.count}};
      if (piece.mirrored) one["mirrored"] = *piece.mirrored;
      missing.push_back(std::move(one));
    }
    kits.push_back({{"kit", document.kits[i].id},
                    {"wanted", document.kits[i].demand},
                    {"complete", counts[i].complete},
                    {"missing", std::move(missing)}});
  }
  return kits;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string kits_json(const Document& document, const std::vector<KitCount>& kits) {
  return text_of(kits_array(document, kits));
}

std::string completeness_json(const Document& document, const Completeness& c) {
  Json sheets = Json::array(), parts = Json::array();
  for (const SheetUse& use : c.sheets) {
    Json remnant = nullptr;
    if (use.remnant.low != use.remnant.high) {
      const geom::Point low = geom::mm_from_grid(use.remnant.low),
                        size = geom::mm_from_grid(use.remnant.high - use.remnant.low);
      remnant = {{"x", low.x}, {"y", low.y}, {"width", size.x}, {"height", size.y}};
    }
    sheets.push_back({{"stock", document.stocks[use.sheet.stock].id},
                      {"copy", use.sheet.copy},
                      {"parts", static_cast<std::uint64_t>(use.parts)},
                      {"density", use.density()},
                      {"parts_area_mm2", use.parts_area},
                      {"material_area_mm2", use.material_area},
                      {"defect_area_mm2", use.defect_area},
                      {"length_mm", use.used_length_mm},
                      {"remnant", std::move(remnant)}});
  }
  for (std::size_t i = 0; i < c.placed.size(); ++i)
    parts.push_back({{"part", document.parts[i].id},
                     {"wanted", wanted(document, static_cast<std::uint32_t>(i))},
                     {"placed", c.placed[i].total()},
                     {"mirrored", c.placed[i].mirrored},
                     {"missing", c.missing[i]},
                     {"surplus", c.surplus[i]}});
  const Json all{{"density", c.density},
                 {"cost", c.cost},
                 {"sheets", std::move(sheets)},
                 {"kits", kits_array(document, c.kits)},
                 {"parts", std::move(parts)}};
  return text_of(all);
}

}  // namespace lekalo::io
