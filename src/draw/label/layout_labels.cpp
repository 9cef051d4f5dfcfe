#include "lekalo/draw/label/layout_labels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "draw/paper/pdf_pages.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/report_sheet.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "label_plan.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/grid_region.hpp"
#include "lekalo/layout/material_words.hpp"
#include "qr_code.hpp"

namespace lekalo::draw {
namespace {

using geom::GridBox;
using geom::GridRegion;
using geom::Point;
using layout::Placement;

/// Printers of labels know no grey.
constexpr Colour kLabelInk{0, 0, 0};
constexpr double kLabelOutline = 0.2;  ///< width of the line, mm
constexpr double kSumsLose = 1e-6;     ///< of lengths on paper, mm, by rounding
constexpr double kLeastNumber = 1.2;   ///< letters of the number, in multiples of the others'
constexpr double kNumberShare = 0.6;   ///< of the text's width, at most

/// The words of one label. It shows the outline of the placement, or else of the remnant.
struct LayoutLabel {
  std::string number, sheet;
  std::vector<std::string> fields;
  std::string code;
  const Placement* placement = nullptr;
  GridBox remnant;
};

/// Tenths of a millimetre, without a zero behind the point.
std::string label_number(double mm, Rounding rounding) {
  std::string text = decimal(mm, 1, rounding);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string label_size(const GridBox& box, Rounding rounding) {
  const Point size = geom::mm_from_grid(box.high - box.low);
  return fmt::format("{}\u00A0x\u00A0{}\u00A0mm", label_number(size.x, rounding),
                     label_number(size.y, rounding));
}

/// Writes the labels of a layout.
class LabelWriter {
 public:
  explicit LabelWriter(const LayoutLabels& labels) : labels_(labels), document_(labels.document) {}

  /// Sheets by stock and copy, the pieces of each by id, and then its remnant.
  [[nodiscard]] std::vector<LayoutLabel> write() const {
    std::map<layout::Sheet, std::vector<const Placement*>> on_sheet;
    for (const Placement& placement : document_.placements)
      on_sheet[{placement.stock, placement.copy}].push_back(&placement);
    std::vector<LayoutLabel> written;
    for (std::size_t i = 0; i < labels_.completeness.sheets.size(); ++i) {
      const layout::SheetUse& use = labels_.completeness.sheets[i];
      for (const Placement* placement : on_sheet[use.sheet]) written.push_back(of_piece(*placement));
      const Point left = geom::mm_from_grid(use.remnant.high - use.remnant.low);
      if (std::min(left.x, left.y) >= labels_.least_remnant_mm && left.x > 0)
        written.push_back(of_remnant(use, i + 1));
    }
    return written;
  }

 private:
  [[nodiscard]] LayoutLabel of_piece(const Placement& placement) const {
    ask(16);
    const layout::Part& part = document_.parts[placement.part];
    const layout::Material& material =
        part.material.is_said() ? part.material : document_.stocks[placement.stock].material;
    return {fmt::format("{}", placement.id),
            sheet_words({placement.stock, placement.copy}),
            fields({part.name.empty() ? part.id : part.name},
                   {label_size(bounds(part.outline.polygon), Rounding::nearest)}, material,
                   {part.purpose.label, part.purpose.customer, due_words(part.purpose.due),
                    part.name.empty() ? "" : part.id, placement.mirrored ? "mirrored" : "", labels_.name}),
            fmt::format("{}/{}", labels_.code, placement.id),
            &placement,
            {}};
  }

  /// \param number  of the sheet among those in use, from 1
  [[nodiscard]] LayoutLabel of_remnant(const layout::SheetUse& use, std::size_t number) const {
    return {fmt::format("R{}", number),
            sheet_words(use.sheet),
            fields({"Remnant"}, {label_size(use.remnant, Rounding::down)},
                   document_.stocks[use.sheet.stock].material, {labels_.name}),
            fmt::format("{}/R{}", labels_.code, number),
            nullptr,
            use.remnant};
  }

  /// The lines below the number: what it is, what is to be measured of it, what it is of, and where it
  /// belongs. Names may be shortened, so that sizes do not stand beside them.
  using FieldWords = std::vector<std::string>;
  static std::vector<std::string> fields(const FieldWords& what, const FieldWords& measures,
                                         const layout::Material& material, const FieldWords& where) {
    const std::string of = material.is_said() ? words_of(material) : "";
    // A number stays on one line with its unit.
    std::string shown = of;
    if (shown.ends_with(" mm")) shown.replace(shown.size() - 3, 1, "\u00A0");
    std::vector<std::string> all;
    for (FieldWords words : {what, measures, FieldWords{shown}, where}) {
      std::erase(words, "");
      // Layouts of an order of several materials are called by theirs, which is said once.
      std::erase(words, of);
      if (!words.empty()) all.push_back(joined_text(words, ", "));
    }
    return all;
  }

  static std::string due_words(const std::string& day) { return day.empty() ? "" : "due " + day; }

  [[nodiscard]] std::string sheet_words(layout::Sheet sheet) const {
    const layout::Stock& stock = document_.stocks[sheet.stock];
    return stock.count > 1 ? fmt::format("{} #{}", stock.id, sheet.copy + 1) : stock.id;
  }

  const LayoutLabels& labels_;
  const layout::Document& document_;
};

/// Draws labels, all with codes of one version.
class LabelPainter {
 public:
  LabelPainter(const layout::Document& document, int version) : document_(document), version_(version) {}

  /// Draws a label into its place on the page.
  Result<void> paint(const LayoutLabel& label, const Rect& whole, std::vector<Item>& items) const {
    LEKALO_TRY(const QrCode code, qr_code(label.code, version_));
    const LabelPlan plan = label_plan(whole, code.modules, label.fields.size());
    // Widths of words are estimates, and the label's neighbour has to stay clean.
    items.push_back(ClipBegin{{whole.ring()}});
    words(label, plan.text, items);
    modules(code, label.code, plan.code, items);
    if (plan.picture.width > 0) outline(label, plan.picture, items);
    items.push_back(ClipEnd{});
    return {};
  }

 private:
  static void words(const LayoutLabel& label, const Rect& text, std::vector<Item>& items) {
    const LabelLines lines = label_lines(label.fields, text);
    // Nobody finds the piece by half of its number: it gets smaller where the sheet wants room, never
    // shorter.
    const double gap = 0.5 * lines.letters, one = kReportBoldWider * io::text_width(label.number),
                 sheet_width = kSmallerLetters * lines.letters * io::text_width(label.sheet),
                 left = std::clamp((text.width - gap - sheet_width) / one, kLeastNumber * lines.letters,
                                   kNumberLetters * lines.letters),
                 size = std::min(left, kNumberShare * text.width / one), width = one * size + gap;
    double baseline = text.y + 0.75 * kNumberLetters * lines.letters;
    items.push_back(TextItem{
        {text.x, baseline}, label.number, size, Anchor::start, kLabelInk, true, {"label-number", ""}});
    Sheet sheet(items);
    sheet.text(text.x + width, baseline, text.width - width, label.sheet,
               {.size = lines.letters, .colour = kLabelInk, .kind = "label-sheet"});
    baseline = text.y + kNumberLetters * lines.letters;
    for (const LabelLines::Line& line : lines.lines) {
      sheet.text(text.x, baseline + lines.letters, text.width, line.words,
                 {.size = lines.letters, .colour = kLabelInk, .bold = line.bold, .kind = "label-line"});
      baseline += kLabelLine * lines.letters;
    }
  }

  /// Draws the dark modules as one path, so that there are no light seams between them.
  static void modules(const QrCode& code, const std::string& says, const Rect& place,
                      std::vector<Item>& items) {
    const double module = place.width / (code.modules + 2 * kQuietModules);
    const Point corner{place.x + kQuietModules * module, place.y + kQuietModules * module};
    PathItem dark{{}, true, filled(kLabelInk), {"label-code", says}};
    for (int row = 0; row < code.modules; ++row)
      for (int begin = 0; begin < code.modules;) {
        int end = begin;
        while (end < code.modules && code.at(row, end)) ++end;
        if (end > begin)
          dark.lines.push_back(
              Rect{corner.x + begin * module, corner.y + row * module, (end - begin) * module, module}
                  .ring());
        begin = end + 1;
      }
    items.push_back(std::move(dark));
  }

  void outline(const LayoutLabel& label, const Rect& place, std::vector<Item>& items) const {
    const GridRegion shape = label.placement != nullptr
                                 ? placed_outline(document_.parts[label.placement->part], *label.placement)
                                 : geom::rectangle(label.remnant);
    const GridBox box = bounds(shape);
    const Rect inner = place.grown(-kLabelOutline);
    const View view = fitted({geom::mm_from_grid(box.low), geom::mm_from_grid(box.high)}, inner);
    PathItem line{{}, true, stroked_round(kLabelInk, kLabelOutline), {"label-outline", ""}};
    for (std::size_t l = 0; l < shape.loops(); ++l) {
      ask();
      geom::Ring ring;
      for (std::uint32_t i = shape.loop_starts[l]; i < shape.loop_starts[l + 1]; ++i)
        ring.push_back(geom::mm_from_grid(shape.points[i]));
      if (geom::Ring shown = on_paper(ring, view, place); shown.size() > 1)
        line.lines.push_back(std::move(shown));
    }
    items.push_back(std::move(line));
  }

  const layout::Document& document_;
  int version_;
};

/// The code that needs most room: the longest, and of those one with a letter, which takes more than a digit.
Result<QrCode> largest_code(const std::vector<LayoutLabel>& labels) {
  const auto room = [](const LayoutLabel& label) {
    return std::pair(label.code.size(), label.placement == nullptr);
  };
  return qr_code(std::max_element(labels.begin(), labels.end(), [&](const auto& a, const auto& b) {
                   return room(a) < room(b);
                 })->code);
}

/// How often a side of the paper has room for a label.
int times_in(double page, double margin, double gap, double label) {
  return static_cast<int>(std::floor((page - 2 * margin + gap) / (label + gap) + kSumsLose));
}

/// Fails where labels of this paper are too small.
Result<void> fits_paper(const LabelPaper& paper, int modules, std::size_t fields) {
  const double width = paper.label_width(), height = paper.label_height();
  const LeastLabel least = least_label(is_tall(width, height), modules, fields);
  if (width >= least.width - kSumsLose && height >= least.height - kSumsLose) return {};
  const auto up = [](double mm) { return label_number(mm - kSumsLose, Rounding::up); };
  std::string says = fmt::format(
      "labels of {} x {} mm are too small: {} lines of text and a QR code of {} modules of {} mm and its "
      "light "
      "margin need {} x {} mm",
      label_number(width, Rounding::nearest), label_number(height, Rounding::nearest), 1 + fields, modules,
      kLeastModule, up(least.width), up(least.height));
  if (paper.columns > 1 || paper.rows > 1) {
    const int columns = times_in(paper.page_width, paper.margin_x, paper.gap_x, least.width),
              rows = times_in(paper.page_height, paper.margin_y, paper.gap_y, least.height);
    if (columns > 0 && rows > 0) says += fmt::format(", of which the paper takes {} x {}", columns, rows);
  }
  return failure(ErrorCode::usage, says);
}

}  // namespace

Result<std::string> labels_pdf(const LayoutLabels& labels, const LabelPaper& paper) {
  const std::vector<LayoutLabel> written = LabelWriter(labels).write();
  if (written.empty())
    return failure(ErrorCode::bad_input, "nothing is placed, so there is nothing to write labels for");
  LEKALO_TRY(const QrCode largest, largest_code(written));
  std::size_t fields = 0;
  for (const LayoutLabel& label : written) fields = std::max(fields, label.fields.size());
  LEKALO_CHECK(fits_paper(paper, largest.modules, fields));

  const LabelPainter painter(labels.document, largest.version);
  PdfPages pages(paper.page_width, paper.page_height, "lekalo: labels of " + labels.name,
                 counted(written.size(), "label"));
  const auto columns = static_cast<std::size_t>(paper.columns),
             on_page = columns * static_cast<std::size_t>(paper.rows);
  const double width = paper.label_width(), height = paper.label_height();
  for (std::size_t first = 0; first < written.size(); first += on_page) {
    Scene page;
    page.width = paper.page_width, page.height = paper.page_height;
    for (std::size_t i = first; i < std::min(first + on_page, written.size()); ++i) {
      ask(2000);
      const auto column = static_cast<double>((i - first) % columns),
                 row = static_cast<double>((i - first) / columns);
      const Rect whole{paper.margin_x + column * (width + paper.gap_x),
                       paper.margin_y + row * (height + paper.gap_y), width, height};
      LEKALO_CHECK(painter.paint(written[i], whole, page.items));
    }
    pages.add(page);
  }
  return std::move(pages).finish();
}

}  // namespace lekalo::draw
