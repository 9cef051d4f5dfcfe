#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include "knife_check.hpp"
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
/// The sines and cosines of texts' angles are rounded.
constexpr double kTextRounding = 1e-9;

Result<DrawnFile> read_export(const Document& document, Kind kind) {
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
  ExportCheck(DrawnFile file, std::vector<DrawnLine> wanted, const Likeness& likeness, bool is_plot)
      : file_(std::move(file.lines)),
        texts_(std::move(file.texts)),
        wanted_(std::move(wanted)),
        likeness_(likeness),
        is_plot_(is_plot) {}

  ClaimReport checked(const std::vector<PlacedSheet>& sheets, const std::vector<std::string>& only,
                      const std::optional<KnifeWords>& knife) {
    std::size_t outlines = 0;
    take_inside(sheets, only.empty() || std::find(only.begin(), only.end(), "MARK") != only.end());
    for (const char* layer : kLayersOfLines) {
      const bool asked = only.empty() || std::find(only.begin(), only.end(), layer) != only.end();
      if (layer == std::string_view("MARK"))
        compare_marks(sheets, asked);
      else if (knife && layer == std::string_view("CUT"))
        check_knife(on_layer(file_, layer),
                    asked ? on_layer(wanted_, layer) : std::vector<const DrawnLine*>(), *knife, report_);
      else
        outlines += compare(layer, asked);
    }
    compare_inside();
    report_.notes.push_back(fmt::format("{} outlines were compared both ways, within {} mm", outlines,
                                        likeness_.places + likeness_.chords));
    if (inner_lines_ + inner_texts_ > 0)
      report_.notes.push_back(
          fmt::format("{} lines and {} texts on parts were compared both ways", inner_lines_, inner_texts_));
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
      find_own_colour(*line);
      find_each(*line, placed, layer, "is not on an outline of the layout");
    }
    for (const DrawnLine* line : wanted) find_each(*line, drawn, layer, "of the layout is not drawn");
    return file.size();
  }

  /// Machines tell by the colour what they do with a line.
  void find_own_colour(const DrawnLine& line) {
    if (!line.colour.empty())
      report_.findings.push_back(fmt::format(
          "a line on layer {} is drawn in {} and not in the colour of its layer", line.layer, line.colour));
  }

  void find_each(const DrawnLine& line, const EdgeSet& others, const char* layer, const char* what) {
    for (const Stroke& edge : line.edges)
      if (!others.holds(edge, likeness_)) {
        report_.findings.push_back(fmt::format("layer {}: the edge from ({}, {}) to ({}, {}) {}", layer,
                                               edge.from.x, edge.from.y, edge.to.x, edge.to.y, what));
        return;
      }
  }

  /// Keeps the lines and texts that lie on parts, and takes those of the file from its other lines. In a plot
  /// they are drawn with the pen of marks, and texts as strokes.
  void take_inside(const std::vector<PlacedSheet>& sheets, bool asked) {
    if (asked)
      for (const PlacedSheet& sheet : sheets)
        for (const PlacedSheet::Part& part : sheet.parts)
          for (const PlacedInside& one : part.inside) {
            const bool as_letters = !one.letters.empty() && !is_plot_;
            if (as_letters) inner_letters_.push_back(one.letters.front());
            inner_texts_ += one.letters.size();
            if (one.letters.empty()) inner_lines_ += one.lines.size();
            if (!as_letters) inner_.insert(inner_.end(), one.lines.begin(), one.lines.end());
          }
    if (is_plot_) {
      std::vector<const DrawnLine*> inner;
      for (const DrawnLine& line : inner_) inner.push_back(&line);
      const EdgeSet placed(inner);
      split_off([&](const DrawnLine& line) {
        return line.layer == "MARK" &&
               std::all_of(line.edges.begin(), line.edges.end(),
                           [&](const Stroke& edge) { return placed.holds(edge, likeness_); });
      });
    } else {
      split_off([](const DrawnLine& line) {
        return std::find(kLayersOfLines.begin(), kLayersOfLines.end(), line.layer) == kLayersOfLines.end();
      });
    }
  }

  template <class Is>
  void split_off(const Is& is) {
    const auto from =
        std::stable_partition(file_.begin(), file_.end(), [&](const DrawnLine& line) { return !is(line); });
    std::move(from, file_.end(), std::back_inserter(inner_of_file_));
    file_.erase(from, file_.end());
  }

  /// Lines on parts are the same both ways, each on its layer and in its colour; so are texts.
  void compare_inside() {
    std::set<std::pair<std::string, std::string>> looks;
    for (const auto* lines : {&inner_, &inner_of_file_})
      for (const DrawnLine& line : *lines) looks.insert(look_of(line));
    for (const auto& look : looks) {
      const auto of_look = [&](const std::vector<DrawnLine>& lines) {
        std::vector<const DrawnLine*> found;
        for (const DrawnLine& line : lines)
          if (look_of(line) == look) found.push_back(&line);
        return found;
      };
      const std::vector<const DrawnLine*> file = of_look(inner_of_file_), wanted = of_look(inner_);
      if (wanted.empty()) {
        report_.findings.push_back(fmt::format("something is drawn on a layer \"{}\"{}", file.front()->layer,
                                               look.second.empty() ? "" : " in " + look.second));
        continue;
      }
      const std::string where = look.second.empty() ? look.first : look.first + " in " + look.second;
      // A line of a plot that falls into one unit is drawn no less.
      if (file.size() != wanted.size())
        report_.findings.push_back(fmt::format("layer {} has {} lines on parts and is to have {}", where,
                                               file.size(), wanted.size()));
      const EdgeSet drawn(file), placed(wanted);
      for (const DrawnLine* line : file) find_each(*line, placed, where.c_str(), "is on no line of a part");
      for (const DrawnLine* line : wanted) find_each(*line, drawn, where.c_str(), "of a part is not drawn");
    }
    compare_texts();
  }

  /// The layer without regard to case, and the colour; a plot has one pen for all.
  [[nodiscard]] std::pair<std::string, std::string> look_of(const DrawnLine& line) const {
    if (is_plot_) return {"MARK", ""};
    return {upper_case(line.layer), line.colour};
  }

  void compare_texts() {
    std::vector<DrawnLetters> left = inner_letters_;
    for (const DrawnLetters& text : texts_) {
      const auto same =
          std::find_if(left.begin(), left.end(), [&](const DrawnLetters& one) { return is_same(text, one); });
      if (same == left.end())
        report_.findings.push_back(fmt::format("the text {} at ({}, {}) on layer {} is on no part",
                                               excerpt(text.text), text.at.x, text.at.y, text.layer));
      else
        left.erase(same);
    }
    for (const DrawnLetters& text : left)
      report_.findings.push_back(fmt::format("the text {} at ({}, {}) on layer {} of a part is not drawn",
                                             excerpt(text.text), text.at.x, text.at.y, text.layer));
  }

  [[nodiscard]] bool is_same(const DrawnLetters& a, const DrawnLetters& b) const {
    const double off = likeness_.places + kTextRounding * (length(b.right) + length(b.up));
    const bool colour = a.colour == b.colour || (b.colour.empty() && a.colour == "#000000");
    return a.text == b.text && colour && a.anchor == b.anchor && upper_case(a.layer) == upper_case(b.layer) &&
           length(a.at - b.at) <= off && length(a.right - b.right) <= off && length(a.up - b.up) <= off;
  }

  /// Each part with a grain has one mark, which lies in it and runs along the grain.
  void compare_marks(const std::vector<PlacedSheet>& sheets, bool asked) {
    std::vector<const PlacedSheet::Part*> marked;
    if (asked)
      for (const PlacedSheet& sheet : sheets)
        for (const PlacedSheet::Part& part : sheet.parts)
          if (part.grain) marked.push_back(&part);
    for (const DrawnLine* mark : on_layer(file_, "MARK")) {
      find_own_colour(*mark);
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

  std::vector<DrawnLine> file_;
  std::vector<DrawnLetters> texts_;
  std::vector<DrawnLine> wanted_;
  Likeness likeness_;
  bool is_plot_;
  /// Lines that are to be on parts, and those that the file has there.
  std::vector<DrawnLine> inner_, inner_of_file_;
  std::vector<DrawnLetters> inner_letters_;
  std::size_t inner_lines_ = 0, inner_texts_ = 0;
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
  LEKALO_TRY(DrawnFile file, read_export(document, kind));
  std::vector<DrawnLine> wanted;
  for (const PlacedSheet& sheet : sheets) wanted.insert(wanted.end(), sheet.lines.begin(), sheet.lines.end());
  const Likeness likeness =
      kind == Kind::hpgl ? Likeness{kPlotted, words.chord_tolerance} : Likeness{kDrawn, 0};
  return ExportCheck(std::move(file), std::move(wanted), likeness, kind == Kind::hpgl)
      .checked(sheets, words.only, words.knife);
}

}  // namespace lekalo::verify
