#include "lekalo/io/formats/part_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "io/layout/layout_outline.hpp"
#include "io/text/decimal.hpp"
#include "io/text/json_tree.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/shape/shape_tree.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

/// A closed outline with its holes, and what it is called.
struct DrawnPart {
  geom::Region region;
  std::string id, name;
};

struct DrawnParts {
  std::vector<DrawnPart> parts;
  std::vector<geom::Region> sheets;
  double tolerance = 0;  ///< mm: the true outlines are within this
  std::vector<std::string> notices;
};

constexpr std::size_t kLongestName = 200;

/// As a text of a layout: no control characters, not too long, cut between characters.
std::string plain(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  if (text.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80) --end;
    text.resize(end);
  }
  return text;
}

std::string id_of_file(const std::string& name) {
  const std::string stem = plain(stem_of(name));
  return stem.empty() ? "part" : stem;
}

std::size_t edges_of(const geom::Region& region) {
  std::size_t edges = region.outer.size();
  for (const geom::Contour& hole : region.holes) edges += hole.size();
  return edges;
}

bool has_layer(const Drawing& drawing, std::string_view name) {
  return std::any_of(drawing.layers.begin(), drawing.layers.end(),
                     [&](const Layer& layer) { return layer.name == name; });
}

/// With the layers of lekalo's own exports.
bool is_export(const Drawing& drawing) {
  return has_layer(drawing, "CUT") &&
         std::any_of(std::begin(kExportLayers), std::end(kExportLayers), [&](const char* layer) {
           return std::string_view(layer) != "CUT" && has_layer(drawing, layer);
         });
}

Result<DrawnParts> of_drawing(const DrawingFormat& format, std::string_view bytes, const std::string& name,
                              const PartOptions& how) {
  const Result<Drawing> drawing = format.parse(bytes, name, how.unit);
  LEKALO_CHECK(drawing);
  DrawingOptions options = how.drawing;
  DrawnParts made;
  if (options.take.empty() && options.leave.empty() && is_export(*drawing)) {
    made.notices.push_back(
        fmt::format("{}: the layers are those of lekalo's exports, so its parts are on CUT and its sheets on "
                    "SHEET",
                    drawing->name));
    if (has_layer(*drawing, "SHEET")) {
      options.take = {"SHEET"};
      LEKALO_TRY(DrawnRegions sheets, make_regions(*drawing, options));
      made.sheets = std::move(sheets.regions);
      made.tolerance = sheets.tolerance;
    }
    options.take = {"CUT"};
  }
  LEKALO_TRY(DrawnRegions drawn, make_regions(*drawing, options));
  made.tolerance = std::max(made.tolerance, drawn.tolerance);
  made.notices.insert(made.notices.end(), drawn.notices.begin(), drawn.notices.end());
  std::size_t edge = 0;
  for (geom::Region& region : drawn.regions) {
    const DrawnCurve& curve = drawing->curves[drawn.curve_of_edge[edge]];
    edge += edges_of(region);
    const std::string& layer = drawing->layers[curve.layer].name;
    const std::string& handle = drawing->entities[curve.entity].handle;
    made.parts.push_back(
        {std::move(region), format.handles_are_names && !handle.empty() ? handle : layer, layer});
  }
  return made;
}

Result<DrawnParts> of_tree(std::string_view bytes, const std::string& name, const PartOptions& options) {
  LEKALO_TRY(ShapeFile file, parse_shape_tree(bytes, name, options.unit));
  DrawnParts made;
  made.tolerance = file.tolerance;
  std::size_t edge = 0;
  for (geom::Region& region : file.regions) {
    const std::uint32_t named = file.name_of_edge[edge];
    edge += edges_of(region);
    const std::string text = named == kNoName ? "" : file.names[named];
    made.parts.push_back({std::move(region), text, text});
  }
  return made;
}

Result<DrawnParts> of_regions(std::string_view bytes, const std::string& name, const PartOptions& options) {
  LEKALO_TRY(RegionFile file, parse_regions(bytes, name, options.unit));
  DrawnParts made;
  for (geom::Region& region : file.regions) made.parts.push_back({std::move(region), "", ""});
  return made;
}

Result<DrawnParts> drawn_parts(std::string_view bytes, const std::string& name, const PartOptions& options) {
  if (!kJsonFormat.begins_so(bytes)) {
    // The first reader has the words to refuse what begins like no drawing.
    const DrawingFormat* const format = drawing_format_by_content(bytes);
    return of_drawing(format != nullptr ? *format : drawing_formats().front(), bytes, name, options);
  }
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  return tree.root().find("shape") ? of_tree(bytes, name, options) : of_regions(bytes, name, options);
}

Result<layout::Stock> make_sheet(const geom::Region& region, std::string id, const std::string& name,
                                 double chord_tolerance) {
  layout::Stock sheet;
  sheet.id = std::move(id);
  auto outline = detail::outline_of_curves(region, geom::ChordSide::shrink, chord_tolerance);
  if (!outline)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: sheet {}: {}", name, excerpt(sheet.id), outline.error().message));
  sheet.outline = *std::move(outline);
  return sheet;
}

/// A notice where outlines are not exactly what is drawn.
void tell_tolerance(double tolerance, const std::string& name, std::vector<std::string>& notices) {
  if (tolerance > geom::kGridStep)
    notices.push_back(
        fmt::format("{}: outlines are within {:.2g} mm of what is drawn (ellipses, splines, "
                    "joined ends)",
                    name, tolerance));
}

}  // namespace

Result<StocksFile> read_stocks(std::string_view bytes, const std::string& name, const PartOptions& options) {
  LEKALO_TRY(DrawnParts drawn, drawn_parts(bytes, name, options));
  StocksFile file;
  file.notices = std::move(drawn.notices);
  if (drawn.sheets.empty())
    for (DrawnPart& one : drawn.parts) drawn.sheets.push_back(std::move(one.region));
  for (std::size_t i = 0; i < drawn.sheets.size(); ++i) {
    const std::string stem = id_of_file(name);
    LEKALO_TRY(layout::Stock sheet,
               make_sheet(drawn.sheets[i], i == 0 ? stem : fmt::format("{}-{}", stem, i + 1), name,
                          options.chord_tolerance));
    file.stocks.push_back(std::move(sheet));
  }
  tell_tolerance(drawn.tolerance, name, file.notices);
  return file;
}

Result<PartsFile> read_parts(std::string_view bytes, const std::string& name, const PartOptions& options) {
  auto drawn = drawn_parts(bytes, name, options);
  if (!drawn) return tl::unexpected(drawn.error());
  if (drawn->parts.size() > kMostParts)
    return failure(ErrorCode::bad_input, fmt::format("{}: {} outlines; at most {} parts are read", name,
                                                     drawn->parts.size(), kMostParts));
  PartsFile file;
  file.notices = std::move(drawn->notices);
  for (std::size_t i = 0; i < drawn->sheets.size(); ++i) {
    LEKALO_TRY(layout::Stock sheet,
               make_sheet(drawn->sheets[i], i == 0 ? "SHEET" : fmt::format("SHEET-{}", i + 1), name,
                          options.chord_tolerance));
    file.stocks.push_back(std::move(sheet));
  }
  std::set<std::string> ids;
  std::map<std::string, std::size_t> last_of;
  std::size_t points = 0;
  for (DrawnPart& one : drawn->parts) {
    layout::Part part;
    const std::string base = one.id.empty() ? id_of_file(name) : plain(one.id);
    part.id = base;
    std::size_t& last = last_of[base];
    if (last == 0) last = 1;
    while (!ids.insert(part.id).second) part.id = fmt::format("{}-{}", base, ++last);
    part.name = plain(one.name);
    part.demand = 1;
    auto outline = detail::outline_of_curves(one.region, geom::ChordSide::grow, options.chord_tolerance);
    if (!outline)
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: part {}: {}", name, excerpt(part.id), outline.error().message));
    points += outline->polygon.points.size();
    constexpr std::size_t kMostPointsInAll = 20'000'000;
    if (points > kMostPointsInAll)
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: more than {} points with chords within {} mm; a larger tolerance needs "
                                 "fewer",
                                 name, kMostPointsInAll, options.chord_tolerance));
    part.outline = *std::move(outline);
    file.parts.push_back(std::move(part));
  }
  tell_tolerance(drawn->tolerance, name, file.notices);
  return file;
}

}  // namespace lekalo::io
