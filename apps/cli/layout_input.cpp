#include "layout_input.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "lekalo/base/version.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/draw/layout_picture.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using Json = nlohmann::ordered_json;

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

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string notes(const std::vector<std::string>& notices) {
  std::string text;
  for (const std::string& notice : notices) text += "note: " + notice + "\n";
  return text;
}

Result<LayoutInput> read_layout_input(const LayoutSource& source, const std::vector<NamedPath>& outputs,
                                      std::vector<NamedPath> others) {
  others.insert(others.begin(), {{"the layout", source.path}, {"--instance", source.instance}});
  if (Result<void> fine = check_outputs(outputs, others); !fine) return tl::unexpected(fine.error());
  LayoutInput input;
  input.path = source.path;
  Result<std::string> bytes = disk::read_file(source.path);
  if (!bytes) return tl::unexpected(bytes.error());
  input.sha256 = io::sha256(*bytes);
  disk::OpenOptions options;
  options.instance = source.instance;
  options.parts.unit = source.units;
  if (source.chord_tolerance) options.parts.chord_tolerance = *source.chord_tolerance;
  if (source.join) options.parts.drawing.join_tolerance = *source.join;
  options.parts.drawing.take = source.layers;
  Result<io::LayoutFile> file = disk::open_layout(source.path, options);
  if (!file) return tl::unexpected(file.error());
  input.document = std::move(file->document);
  input.notices = std::move(file->notices);
  input.form = io::nesting_form(*bytes);
  if (!source.instance.empty() && input.form != io::NestingForm::placements)
    input.notices.push_back(
        fmt::format("--instance has no effect: {} is no file of placements", io::as_utf8(source.path)));
  if (input.form == io::NestingForm::strip)
    input.instance_name = std::filesystem::path(source.path).filename().string();
  if (input.form == io::NestingForm::placements) {
    if (auto name = io::instance_of_placements(*bytes, source.path)) input.instance_name = std::move(*name);
  }
  // The checker reads the file itself where it can; a job of another program only as what it became.
  const bool is_layout = bytes->find("lekalo-layout/1") != std::string::npos;
  input.text = is_layout ? std::move(*bytes) : io::write_layout(input.document);
  return input;
}

Json begin_layout_json(const char* format, const std::string& status, const LayoutInput& input) {
  Json inputs = Json::array();
  inputs.push_back({{"role", "layout"}, {"path", io::as_utf8(input.path)}, {"sha256", input.sha256}});
  return {{"format", {{"name", format}, {"version", 1}}},
          {"status", status},
          {"units", "mm"},
          {"inputs", std::move(inputs)},
          {"warnings", input.notices},
          {"seed", 0},
          {"work", input.document.placements.size()},
          {"version", kVersion}};
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::string> picture_bytes(const std::string& path, const std::string& name,
                                  const layout::Document& document, const layout::Completeness& completeness,
                                  const std::vector<layout::Violation>& violations) {
  const draw::LayoutPicture picture{io::as_utf8(document.name.empty() ? name : document.name), document,
                                    completeness, violations};
  if (path.ends_with(".png")) return draw::layout_png(picture);
  if (path.ends_with(".pdf")) return draw::layout_pdf(picture);
  return draw::layout_svg(picture);
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
