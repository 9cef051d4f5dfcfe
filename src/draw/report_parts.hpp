#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/paper/report_sheet.hpp"
#include "draw/paper/view.hpp"

namespace lekalo::draw {

/// The parts that reports of a placement share, in the plane and in space.

/// The page is A4, upright.
inline constexpr Rect kReportPage{0, 0, 210, 297};
inline constexpr Rect kReportFrame{12, 10, 186, 277};
/// The columns, whose heights are open, and the room of the line at the foot.
inline constexpr double kReportBetween = 5;
inline constexpr Rect kReportLeft{kReportFrame.x, 0, 0.5 * (kReportFrame.width - kReportBetween), 0};
inline constexpr Rect kReportRight{kReportFrame.x + kReportLeft.width + kReportBetween, 0, kReportLeft.width,
                                   0};
inline constexpr double kReportFooter = 4;

/// A column with its share of the table's width. Numbers are set against their right side.
struct ReportColumn {
  const char* title;
  double share;
  bool number = true;
};

/// A table of texts.
class ReportTable {
 public:
  ReportTable(std::vector<ReportColumn> columns, const Rect& column, Sheet& sheet)
      : columns_(std::move(columns)), room_(column), sheet_(sheet) {
    double sum = 0;
    for (const ReportColumn& one : columns_) sum += one.share;
    for (ReportColumn& one : columns_) one.share /= sum;
  }
  double titles(double y) {
    std::vector<std::string> words;
    for (const ReportColumn& one : columns_) words.emplace_back(one.title);
    return row(y, words, {.size = kReportSmall, .colour = kGrey, .kind = "table-title"});
  }
  /// Draws a row of cells in order; an empty cell is left out.
  double row(double y, const std::vector<std::string>& cells, const TextStyle& style, Colour last = kInk) {
    double x = room_.x;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const double width = columns_[k].share * room_.width;
      TextStyle cell = style;
      if (last != kInk && k + 1 == columns_.size()) cell.colour = last;
      cell.anchor = columns_[k].number ? Anchor::end : Anchor::start;
      sheet_.text(columns_[k].number ? x + width - 1 : x, y + kReportLine - 1, width - 2, cells[k], cell);
      x += width;
    }
    return y + kReportLine;
  }

 private:
  std::vector<ReportColumn> columns_;
  Rect room_;
  Sheet& sheet_;
};

/// Names and values below each other.
class ReportRows {
 public:
  ReportRows(const Rect& column, double y, Sheet& sheet) : column_(column), y_(y), sheet_(sheet) {}
  void add(const std::string& what, const std::string& value, const char* kind, Colour colour = kInk,
           bool bold = false) {
    y_ += kReportLine;
    const double half = 0.42 * column_.width;
    sheet_.text(column_.x, y_ - 1, half, what, {.colour = kGrey});
    sheet_.text(column_.right(), y_ - 1, column_.width - half - 2, value,
                {.colour = colour, .anchor = Anchor::end, .bold = bold, .kind = kind});
  }
  [[nodiscard]] double end() const { return y_; }

 private:
  Rect column_;
  double y_;
  Sheet& sheet_;
};

/// Draws title and status, and returns where they end.
double draw_report_header(const std::string& title, const std::string& subtitle, const std::string& status,
                          Sheet& sheet);
/// Writes the version of the program and how the result came about at the foot of the page.
void draw_report_footer(const std::string& made, Sheet& sheet);

/// The functions below draw the sections. Each draws from `top` downwards in its column and returns where it
/// ends.
double draw_proof(const std::vector<std::string>& sentences, const Rect& column, double top, Sheet& sheet);

struct ReportFile {
  std::string role, words, sha256;
};
double draw_inputs(const std::vector<ReportFile>& files, const Rect& column, double top, Sheet& sheet);

struct ReportNotes {
  std::vector<std::string> warnings, assumptions;
  /// The sentence about how the allowance was measured, which always has room.
  std::string measured;
};
double draw_notes(const ReportNotes& notes, const Rect& column, double top, std::size_t most_lines,
                  Sheet& sheet);

}  // namespace lekalo::draw
