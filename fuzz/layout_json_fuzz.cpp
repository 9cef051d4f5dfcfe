#include "io_contour_check.hpp"
#include "lekalo/io/layout/layout_json.hpp"

// read_layout on any bytes: a sentence, or a document that keeps its rules and is the same again when it is
// written and read.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  using fuzz::must;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto file = io::read_layout(bytes, "fuzz.json");
  if (!file) {
    must(file.error().code == ErrorCode::bad_input && file.error().message.rfind("fuzz.json", 0) == 0);
    must(file.error().message.find('\n') == std::string::npos);
    return 0;
  }
  const layout::Document& document = file->document;
  for (const layout::Placement& placement : document.placements) {
    must(placement.part < document.parts.size() && placement.stock < document.stocks.size());
    must(placement.id > 0 && placement.id < document.next_id && geom::is_rotation(placement.rotation));
    must(layout::placed_outline(document.parts[placement.part], placement).points.size() ==
         document.parts[placement.part].outline.polygon.points.size());
  }
  for (const layout::Part& part : document.parts) must(geom::twice_area(part.outline.polygon) > 0);
  for (const layout::Kit& kit : document.kits)
    for (const layout::KitPiece& piece : kit.pieces) must(layout::wanted(document, piece.part) >= 0);
  const std::string text = io::write_layout(document);
  const auto again = io::read_layout(text, "again.json");
  must(again.has_value() && again->notices.empty() && again->document == document);
  must(io::write_layout(again->document) == text);
  return 0;
}
