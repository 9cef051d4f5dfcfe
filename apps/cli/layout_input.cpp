#include "layout_input.hpp"

#include <fmt/core.h>

#include <utility>

#include "lekalo/disk/files.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/show.hpp"

namespace lekalo::cli {
namespace {

std::string label_of(const layout::Document& document, layout::Sheet sheet) {
  const layout::Stock& stock = document.stocks[sheet.stock];
  return stock.count > 1 ? fmt::format("{} #{}", stock.id, sheet.copy + 1) : stock.id;
}

std::string missing_text(const layout::Document& document, const std::vector<layout::MissingPiece>& missing) {
  std::string text;
  for (const layout::MissingPiece& piece : missing)
    text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", piece.count, document.parts[piece.part].id,
                        piece.mirrored ? (*piece.mirrored ? " (mirrored)" : " (upright)") : "");
  return text;
}

}  // namespace

std::string notes(const std::vector<std::string>& notices) {
  std::string text;
  for (const std::string& notice : notices) text += "note: " + notice + "\n";
  return text;
}

Result<io::LayerRules> layer_rules_of(const std::string& path) {
  if (path.empty()) return io::LayerRules{};
  LEKALO_TRY(const std::string bytes, disk::read_file(path));
  return io::read_layer_rules(bytes, io::as_utf8(path));
}

Result<jobs::Layout> read_layout_input(const LayoutSource& source, const std::vector<NamedPath>& outputs,
                                       std::vector<NamedPath> others) {
  others.insert(
      others.begin(),
      {{"the layout", source.path}, {"--instance", source.instance}, {"--layer-rules", source.layer_rules}});
  LEKALO_CHECK(check_outputs(outputs, others));
  LEKALO_TRY(std::string bytes, disk::read_file(source.path));
  io::PartOptions parts = source.parts;
  LEKALO_TRY(parts.layer_rules, layer_rules_of(source.layer_rules));
  LEKALO_TRY(jobs::Layout layout, jobs::open_layout({source.path, std::move(bytes)}, parts,
                                                    disk::items_near(source.path, source.instance)));
  if (!source.instance.empty() && layout.form != io::NestingForm::placements)
    layout.notices.push_back(
        fmt::format("--instance has no effect: {} is no file of placements", io::as_utf8(source.path)));
  if (!source.layer_rules.empty() && (!layout.bytes.empty() || layout.form))
    layout.notices.push_back(
        fmt::format("--layer-rules has no effect: {} is no drawing", io::as_utf8(source.path)));
  return layout;
}

Result<std::string> picture_bytes(const std::string& path, const std::string& name,
                                  const layout::Document& document,
                                  const std::vector<layout::Violation>& violations) {
  return jobs::layout_picture(document, document.name.empty() ? name : document.name, violations,
                              jobs::picture_form(path).value_or(jobs::PictureForm::svg));
}

std::string completeness_text(const layout::Document& document, const layout::Completeness& c) {
  std::string text;
  for (const layout::SheetUse& use : c.sheets) {
    const layout::Stock& stock = document.stocks[use.sheet.stock];
    text += fmt::format("  {:<18} {}, density {:.3f} %", label_of(document, use.sheet),
                        counted(use.parts, "part"), 100 * use.density());
    if (stock.kind == layout::StockKind::strip) text += fmt::format(", length {:.6f} mm", use.used_length_mm);
    if (use.defect_area > 0) text += fmt::format(", {:.1f} mm2 lost to defects", use.defect_area);
    const geom::Point left = geom::mm_from_grid(use.remnant.high - use.remnant.low);
    if (left.x > 0) text += fmt::format(", largest rectangle left {:.1f} x {:.1f} mm", left.x, left.y);
    text += '\n';
  }
  if (c.sheets.size() > 1)
    text += fmt::format("  {:<18} {} sheets, density {:.3f} %, cost {:g}\n", "all", c.sheets.size(),
                        100 * c.density, c.cost);
  for (std::size_t i = 0; i < document.kits.size(); ++i) {
    const layout::Kit& kit = document.kits[i];
    text += fmt::format("  kit {:<14} {} of {} complete", kit.id, c.kits[i].complete, kit.demand);
    if (!c.kits[i].missing.empty()) text += "; missing " + missing_text(document, c.kits[i].missing);
    text += '\n';
  }
  for (std::size_t i = 0; i < document.parts.size(); ++i) {
    text += fmt::format("  part {:<13} {} placed", document.parts[i].id, c.placed[i].total());
    if (c.placed[i].mirrored > 0) text += fmt::format(" ({} mirrored)", c.placed[i].mirrored);
    if (c.missing[i] > 0) text += fmt::format(", {} missing", c.missing[i]);
    if (c.surplus[i] > 0) text += fmt::format(", {} more than wanted", c.surplus[i]);
    text += '\n';
  }
  return text;
}

}  // namespace lekalo::cli
