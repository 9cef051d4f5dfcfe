#include "lekalo/io/formats/part_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engraving.hpp"
#include "equal_parts.hpp"
#include "inner_lines.hpp"
#include "io/drawing/near_edges.hpp"
#include "io/layout/layout_outline.hpp"
#include "io/text/decimal.hpp"
#include "io/text/json_tree.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/shape/shape_tree.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/layout/part_text.hpp"
#include "part_outline.hpp"

namespace lekalo::io {
namespace {

/// A closed outline with its holes, the lines on it, and what it is called.
struct DrawnPart {
  geom::Region region;
  std::string id, name;
  std::vector<layout::PartMark> marks{};
  std::vector<layout::PartText> texts{};
};

struct DrawnParts {
  std::vector<DrawnPart> parts;
  std::vector<geom::Region> sheets;
  double tolerance = 0;  ///< mm: the true outlines are within this
  std::vector<std::string> set_aside, notices;
  /// True for an export of lekalo, in which every placed piece is a part of its own.
  bool exported = false;
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

/// The words by which people know an outline: its layer, and what its element is called.
std::string name_of(const Drawing& drawing, const DrawingFormat& format, const DrawnCurve& curve) {
  const std::string& layer = drawing.layers[curve.layer].name;
  const DrawnEntity& entity = drawing.entities[curve.entity];
  const std::string& own = !entity.label.empty()      ? entity.label
                           : format.handles_are_names ? entity.handle
                                                      : entity.label;
  if (layer.empty() || own.empty() || own == layer) return layer.empty() ? own : layer;
  return layer + ", " + own;
}

/// A point within an edge.
geom::Point middle_of(const geom::Edge& edge) {
  return edge.kind == geom::EdgeKind::line ? 0.5 * (edge.from + edge.to) : bisected(edge).middle;
}

std::string first_point_of(const geom::Contour& line) {
  return fmt::format("({:.6g}, {:.6g}) mm", line.front().from.x, line.front().from.y);
}

/// Cuts a line where an edge does not begin exactly where the one before ends.
std::vector<geom::Contour> without_gaps(geom::Contour line) {
  std::vector<geom::Contour> pieces;
  for (geom::Edge& edge : line) {
    const bool goes_on = !pieces.empty() && pieces.back().back().to == edge.from;
    if (!goes_on) pieces.emplace_back();
    pieces.back().push_back(edge);
  }
  return pieces;
}

/// The lines and texts of a drawing that are no outlines.
struct Inside {
  const InnerLines& rules;
  std::vector<RuledLine> lines;
  std::vector<layout::PartText> texts;
};

/// Puts each text on the part in which its middle lies, or where that is none its place.
void put_texts(const Drawing& drawing, const RegionsAround& around, std::vector<layout::PartText> texts,
               DrawnParts& made) {
  std::size_t on_parts = 0;
  std::vector<const layout::PartText*> lost;
  for (layout::PartText& text : texts) {
    std::uint32_t part = around.innermost(layout::text_middle(text));
    if (part == kNoRegion) part = around.innermost(text.at);
    if (part == kNoRegion) {
      lost.push_back(&text);
      continue;
    }
    ++on_parts;
    text.layer = plain(text.layer);
    made.parts[part].texts.push_back(std::move(text));
  }
  if (on_parts > 0)
    made.notices.push_back(fmt::format("{}: {} kept on {} parts", drawing.name,
                                       on_parts == 1 ? "1 text is" : fmt::format("{} texts are", on_parts),
                                       on_parts == 1 ? "its" : "their"));
  if (!lost.empty())
    made.notices.push_back(
        fmt::format("{}: {} on no part and {} left out, the first is {} at ({:.6g}, {:.6g}) mm", drawing.name,
                    lost.size() == 1 ? "1 text lies" : fmt::format("{} texts lie", lost.size()),
                    lost.size() == 1 ? "is" : "are", excerpt(lost.front()->text), lost.front()->at.x,
                    lost.front()->at.y));
}

/// Makes parts of regions, with the lines and texts that lie on them; lines that lie on none are set aside.
void take_parts(const Drawing& drawing, const DrawingFormat& format, DrawnRegions drawn, Inside inside,
                DrawnParts& made) {
  const Engraved engraved = without_engraving(drawing, drawn, inside.rules.said_to_be_cut(drawing));
  std::size_t edge = 0;
  for (const geom::Region& region : engraved.regions) {
    const DrawnCurve& curve = drawing.curves[engraved.curve_of_edge[edge]];
    edge += edges_of(region);
    made.parts.push_back({region, made.exported ? "CUT" : "", name_of(drawing, format, curve)});
  }
  std::size_t on_parts = 0;
  const auto put = [&](std::uint32_t part, std::uint32_t number, layout::MarkRole role, geom::Contour line) {
    const Layer& layer = drawing.layers[number];
    if (part != kNoRegion) {
      ++on_parts;
      for (geom::Contour& piece : without_gaps(std::move(line)))
        made.parts[part].marks.push_back({plain(layer.name), std::move(piece), colour_of(layer), role});
      return;
    }
    made.set_aside.push_back(fmt::format("{}: the line of {} {} on layer {} from {} on lies on no part",
                                         drawing.name, line.size(), line.size() == 1 ? "edge" : "edges",
                                         excerpt(layer.name), first_point_of(line)));
  };
  const auto layer_of = [&](std::uint32_t curve) { return drawing.curves[curve].layer; };
  const RegionsAround around(engraved.regions);
  for (const Engraved::Line& line : engraved.lines)
    put(around.innermost(line.contour.front().from), layer_of(line.curve), layout::MarkRole::mark,
        line.contour);
  for (Mark& mark : drawn.marks) {
    std::uint32_t part = mark.region ? engraved.new_number[*mark.region] : kNoRegion;
    if (part == kNoRegion) part = around.innermost(mark.edges.front().from);
    const std::uint32_t layer = layer_of(mark.curve_of_edge.front());
    put(part, layer, inside.rules.role_of_open_line(drawing.layers[layer]), std::move(mark.edges));
  }
  for (RuledLine& line : inside.lines) {
    std::uint32_t part = around.innermost(middle_of(line.edges.front()));
    if (part == kNoRegion) part = around.innermost(line.edges.front().from);
    put(part, line.layer, line.role, std::move(line.edges));
  }
  put_texts(drawing, around, std::move(inside.texts), made);
  for (const SetAside& one : drawn.set_aside) made.set_aside.push_back(drawing.name + ": " + one.sentence);
  for (const std::string& sentence : drawing.damaged) made.set_aside.push_back(sentence);
  if (!engraved.lines.empty())
    made.notices.push_back(fmt::format("{}: {} closed lines are engraving, filled or in rows of letters",
                                       drawing.name, engraved.lines.size()));
  if (!engraved.doubt.empty()) made.notices.push_back(engraved.doubt);
  if (on_parts > 0)
    made.notices.push_back(fmt::format("{}: {} lines that bound no area are kept as marks on their parts",
                                       drawing.name, on_parts));
}

Result<DrawnParts> of_drawing(const DrawingFormat& format, std::string_view bytes, const std::string& name,
                              const PartOptions& how) {
  LEKALO_TRY(Drawing drawing, format.parse(bytes, name, how.unit));
  DrawingOptions options = how.drawing;
  if (options.strict && !drawing.damaged.empty())
    return failure(ErrorCode::bad_input, drawing.damaged.front());
  DrawnParts made;
  made.exported = options.take.empty() && options.leave.empty() && is_export(drawing);
  if (made.exported) {
    made.notices.push_back(
        fmt::format("{}: the layers are those of lekalo's exports, so its parts are on CUT and its sheets on "
                    "SHEET",
                    drawing.name));
    if (has_layer(drawing, "SHEET")) {
      options.take = {"SHEET"};
      LEKALO_TRY(DrawnRegions sheets, make_regions(drawing, options));
      made.sheets = std::move(sheets.regions);
      made.tolerance = sheets.tolerance;
    }
    options.take = {"CUT"};
  }
  InnerLines rules(how.layer_rules, options, made.exported);
  LEKALO_TRY(std::vector<RuledLine> lines, rules.take_lines(drawing));
  std::vector<layout::PartText> texts = rules.take_texts(drawing);
  LEKALO_TRY(DrawnRegions drawn, make_regions(drawing, options));
  made.tolerance = std::max(made.tolerance, drawn.tolerance);
  made.notices.insert(made.notices.end(), drawn.notices.begin(), drawn.notices.end());
  if (std::string ignored = rules.ignored(drawing); !ignored.empty())
    made.notices.push_back(std::move(ignored));
  take_parts(drawing, format, std::move(drawn), {rules, std::move(lines), std::move(texts)}, made);
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

/// Takes the holes off a region that are lost in the steps of the grid.
void drop_specks(geom::Region& region, const std::string& name, double chord_tolerance,
                 std::vector<std::string>& set_aside) {
  std::erase_if(region.holes, [&](const geom::Contour& hole) {
    const auto alone =
        detail::outline_of_curves({geom::reversed(hole), {}}, geom::ChordSide::shrink, chord_tolerance);
    if (!alone)
      set_aside.push_back(
          fmt::format("{}: the hole at {}: {}", name, first_point_of(hole), alone.error().message));
    return !alone;
  });
}

/// Puts -2, -3 behind ids that come again.
void give_ids(std::vector<layout::Part>& parts) {
  std::set<std::string> ids;
  std::map<std::string, std::size_t> last_of;
  for (layout::Part& part : parts) {
    const std::string base = part.id;
    std::size_t& last = last_of[base];
    if (last == 0) last = 1;
    while (!ids.insert(part.id).second) part.id = fmt::format("{}-{}", base, ++last);
  }
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
  tell_set_aside(drawn.set_aside, file.notices);
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
  std::size_t points = 0, lines = 0;
  double worst = 0;  // loss of those that became lines
  // Some outlines are made side by side, and looked at in order before the next are made.
  constexpr std::size_t kAtATime = 256;
  const double most_loss = options.drawing.strict ? 0 : options.drawing.repair;
  std::vector<std::optional<Result<PartOutline>>> found(kAtATime);
  const auto find_outlines = [&](std::size_t first) {
    share_out(std::min(kAtATime, drawn->parts.size() - first), kUsualThreads, [&](std::size_t k) {
      found[k] = outline_of_part(drawn->parts[first + k].region, options.chord_tolerance, most_loss);
    });
  };
  for (std::size_t i = 0; i < drawn->parts.size(); ++i) {
    DrawnPart& one = drawn->parts[i];
    layout::Part part;
    part.id = one.id.empty() ? id_of_file(name) : plain(one.id);
    part.name = plain(one.name);
    part.demand = 1;
    part.marks = std::move(one.marks);
    part.texts = std::move(one.texts);
    if (i % kAtATime == 0) find_outlines(i);
    Result<PartOutline> outline = *std::move(found[i % kAtATime]);
    if (!outline && !options.drawing.strict) {
      drop_specks(one.region, name, options.chord_tolerance, drawn->set_aside);
      outline = outline_of_part(one.region, options.chord_tolerance, most_loss);
    }
    if (!outline) {
      const std::string why = fmt::format("{}: part {} at {}: {}", name, excerpt(part.id),
                                          first_point_of(one.region.outer), outline.error().message);
      if (options.drawing.strict || drawn->parts.size() == 1) return failure(ErrorCode::bad_input, why);
      drawn->set_aside.push_back(why);
      continue;
    }
    if (outline->loss > 0) ++lines, worst = std::max(worst, outline->loss);
    points += outline->outline.polygon.points.size();
    constexpr std::size_t kMostPointsInAll = 20'000'000;
    if (points > kMostPointsInAll)
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: more than {} points with chords within {} mm; a larger tolerance needs "
                                 "fewer",
                                 name, kMostPointsInAll, options.chord_tolerance));
    part.outline = std::move(outline->outline);
    file.parts.push_back(std::move(part));
  }
  if (lines > 0)
    file.notices.push_back(fmt::format(
        "{}: {} parts became lines, where arcs are too near to each other for chords", name, lines));
  if (file.parts.empty() && !drawn->set_aside.empty())
    return failure(ErrorCode::bad_input, drawn->set_aside.back());
  const std::size_t outlines = file.parts.size();
  const double merged = drawn->exported ? 0 : merge_equal(file.parts);
  if (file.parts.size() < outlines)
    file.notices.push_back(fmt::format("{}: {} outlines are {} parts, equal ones by their number", name,
                                       outlines, file.parts.size()));
  give_ids(file.parts);
  file.set_aside = std::move(drawn->set_aside);
  tell_set_aside(file.set_aside, file.notices);
  tell_tolerance(drawn->tolerance + worst + merged, name, file.notices);
  return file;
}

}  // namespace lekalo::io
