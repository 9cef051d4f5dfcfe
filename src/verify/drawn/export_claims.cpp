#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "lekalo/verify/claims.hpp"
#include "lekalo/verify/layout.hpp"
#include "line_match.hpp"
#include "placed_sheet.hpp"
#include "verify/layout/layout_document.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

/// Drawings have doubles: a turned arc's ends are off by their rounding. Two steps of the grid are more.
constexpr double kDrawn = 2e-6;
/// Half a plotter unit in x and in y.
constexpr double kPlotted = 0.0178;
constexpr std::array<const char*, 6> kLayersOfLines{"CUT", "SHEET", "DEFECT", "ZONE", "AREA", "MARK"};

Result<std::vector<DrawnLine>> read_export(const Document& document, Kind kind) {
  if (kind == Kind::dxf) return read_dxf(document);
  if (kind == Kind::svg) return read_svg(document);
  return read_hpgl(document);
}

std::vector<const DrawnLine*> on_layer(const std::vector<DrawnLine>& lines, std::string_view layer) {
  std::vector<const DrawnLine*> found;
  for (const DrawnLine& line : lines)
    if (line.layer == layer) found.push_back(&line);
  return found;
}

/// Marks end well inside their parts, so that chords will do for arcs.
bool inside(Place p, const std::vector<std::vector<Stroke>>& contours) {
  bool in = false;
  std::vector<Stroke> pieces;
  for (const std::vector<Stroke>& contour : contours)
    for (const Stroke& edge : contour) add_pieces(edge, edge.arc ? 0.1 * edge.radius : kInfinity, pieces);
  for (const Stroke& s : pieces)
    if (crosses_ray_to_the_right(line_between(s.from, s.to), p)) in = !in;
  return in;
}

class ExportCheck {
 public:
  ExportCheck(std::vector<DrawnLine> file, std::vector<DrawnLine> wanted, const Likeness& likeness)
      : file_(std::move(file)), wanted_(std::move(wanted)), likeness_(likeness) {}

  ClaimReport checked(const std::vector<PlacedSheet>& sheets, const std::vector<std::string>& only) {
    std::size_t outlines = 0;
    for (const char* layer : kLayersOfLines) {
      const bool asked = only.empty() || std::find(only.begin(), only.end(), layer) != only.end();
      if (layer == std::string_view("MARK"))
        compare_marks(sheets, asked);
      else
        outlines += compare(layer, asked);
    }
    for (const DrawnLine& line : file_)
      if (std::find(kLayersOfLines.begin(), kLayersOfLines.end(), line.layer) == kLayersOfLines.end())
        report_.findings.push_back(fmt::format("something is drawn on a layer \"{}\"", line.layer));
    report_.notes.push_back(fmt::format("{} outlines were compared both ways, within {} mm", outlines,
                                        likeness_.places + likeness_.chords));
    return std::move(report_);
  }

 private:
  std::size_t compare(const char* layer, bool asked) {
    const std::vector<const DrawnLine*> file = on_layer(file_, layer);
    const std::vector<const DrawnLine*> wanted =
        asked ? on_layer(wanted_, layer) : std::vector<const DrawnLine*>();
    if (file.size() != wanted.size())
      report_.findings.push_back(
          fmt::format("layer {} has {} outlines and is to have {}", layer, file.size(), wanted.size()));
    const EdgeSet drawn(file), placed(wanted);
    for (const DrawnLine* line : file) {
      if (!line->closed)
        report_.findings.push_back(fmt::format("an outline on layer {} is not closed", layer));
      find_each(*line, placed, layer, "is not on an outline of the layout");
    }
    for (const DrawnLine* line : wanted) find_each(*line, drawn, layer, "of the layout is not drawn");
    return file.size();
  }

  void find_each(const DrawnLine& line, const EdgeSet& others, const char* layer, const char* what) {
    for (const Stroke& edge : line.edges)
      if (!others.holds(edge, likeness_)) {
        report_.findings.push_back(fmt::format("layer {}: the edge from ({}, {}) to ({}, {}) {}", layer,
                                               edge.from.x, edge.from.y, edge.to.x, edge.to.y, what));
        return;
      }
  }

  /// Each part with a grain has one mark, which lies in it and runs along the grain.
  void compare_marks(const std::vector<PlacedSheet>& sheets, bool asked) {
    std::vector<const PlacedSheet::Part*> marked;
    if (asked)
      for (const PlacedSheet& sheet : sheets)
        for (const PlacedSheet::Part& part : sheet.parts)
          if (part.grain) marked.push_back(&part);
    for (const DrawnLine* mark : on_layer(file_, "MARK")) {
      const auto of = std::find_if(marked.begin(), marked.end(), [&](const PlacedSheet::Part* part) {
        return mark->edges.size() == 1 && runs_along(mark->edges[0], *part);
      });
      if (of == marked.end())
        report_.findings.push_back(fmt::format("the mark from ({}, {}) runs along the grain of no part",
                                               mark->edges[0].from.x, mark->edges[0].from.y));
      else
        marked.erase(of);
    }
    if (!marked.empty())
      report_.findings.push_back(fmt::format("{} marks of a grain are missing", marked.size()));
  }

  [[nodiscard]] bool runs_along(const Stroke& mark, const PlacedSheet::Part& part) const {
    const double off = std::abs(cross(*part.grain, mark.to - mark.from));
    return off <= 2 * likeness_.places && inside(mark.from, part.contours) && inside(mark.to, part.contours);
  }

  std::vector<DrawnLine> file_, wanted_;
  Likeness likeness_;
  ClaimReport report_;
};

}  // namespace

Result<ClaimReport> verify_export(const Document& document, const Document& layout,
                                  const ExportWords& words) {
  LEKALO_TRY(const Kind kind, kind_of(document));
  LEKALO_TRY(const WrittenLayout written, read_layout(layout));
  LEKALO_TRY(std::vector<PlacedSheet> sheets, placed_sheets(written, layout.name, words.sheet));
  if (kind == Kind::hpgl && sheets.size() > 1)
    return failure(
        ErrorCode::usage,
        fmt::format("{}: a plot holds one sheet and {} are in use; say which, for example --sheet {}",
                    document.name, sheets.size(), sheets[0].name));
  put_side_by_side(sheets);
  LEKALO_TRY(std::vector<DrawnLine> file, read_export(document, kind));
  std::vector<DrawnLine> wanted;
  for (const PlacedSheet& sheet : sheets) wanted.insert(wanted.end(), sheet.lines.begin(), sheet.lines.end());
  const Likeness likeness =
      kind == Kind::hpgl ? Likeness{kPlotted, words.chord_tolerance} : Likeness{kDrawn, 0};
  return ExportCheck(std::move(file), std::move(wanted), likeness).checked(sheets, words.only);
}

}  // namespace lekalo::verify
