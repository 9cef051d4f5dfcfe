#include <fmt/core.h>

#include <utility>

#include "draw/paper/pdf_pages.hpp"
#include "draw/paper/report_sheet.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/draw/quote.hpp"

namespace lekalo::draw {
namespace {

constexpr Rect kQuotePage{0, 0, 210, 297};
constexpr Rect kQuoteColumn{15, 18, 180, 258};
constexpr double kQuoteRow = 4.6, kQuoteGap = 6, kQuoteSums = 75;  // mm
constexpr double kQuoteBetween = 2;                                ///< columns, mm
constexpr std::size_t kMostTermLines = 40;

/// Puts a quote on pages, one after the other.
class QuotePages {
 public:
  explicit QuotePages(const QuotePaper& paper) : paper_(paper) {
    begin_page();
    head();
    figures();
    for (std::size_t i = 0; i < paper.tables.size(); ++i) {
      table(paper.tables[i]);
      if (i == 0) sums();
    }
    for (const std::string& words : paper.terms) term(words);
    number_pages();
  }

  Result<std::string> finish() && {
    PdfPages pages(kQuotePage.width, kQuotePage.height, "lekalo: quote " + paper_.title, "quote");
    for (const Scene& page : pages_) pages.add(page);
    return std::move(pages).finish();
  }

 private:
  [[nodiscard]] Sheet sheet() { return Sheet(pages_.back().items); }

  void begin_page() {
    Scene& page = pages_.emplace_back();
    page.width = kQuotePage.width, page.height = kQuotePage.height;
    page.items.push_back(PathItem{{kQuotePage.ring()}, true, filled(kPaper), {"page", ""}});
    y_ = kQuoteColumn.y;
  }
  /// Begins a page where the rest of this one has no room for so much.
  void need(double height) {
    if (y_ + height > kQuoteColumn.bottom()) begin_page();
  }

  void head() {
    const double half = 0.5 * kQuoteColumn.width;
    double issuer = y_;
    for (const std::string& line : paper_.issuer) {
      const bool first = &line == &paper_.issuer.front();
      sheet().text(kQuoteColumn.right(), issuer, half - kQuoteBetween, line,
                   {.size = first ? 3.4 : kReportBody,
                    .colour = first ? kInk : kGrey,
                    .anchor = Anchor::end,
                    .bold = first,
                    .kind = "issuer"});
      issuer += kReportLine;
    }
    sheet().text(kQuoteColumn.x, y_ + 1, half, "Quote", {.size = 7, .bold = true, .kind = "title"});
    y_ = sheet().paragraph({kQuoteColumn.x, y_, half, 30}, y_ + 8, paper_.title,
                           {.size = 3.6, .colour = kGrey}, 4.8, 3);
    y_ = std::max(y_, issuer) + 2;
  }

  /// Names in grey over values, four to a row.
  void figures() {
    constexpr std::size_t kAcross = 4;
    const double width = kQuoteColumn.width / kAcross;
    for (std::size_t i = 0; i < paper_.figures.size(); ++i) {
      const double x = kQuoteColumn.x + static_cast<double>(i % kAcross) * width;
      if (i > 0 && i % kAcross == 0) y_ += 11;
      sheet().text(x, y_ + 3, width - kQuoteBetween, paper_.figures[i].first,
                   {.size = kReportSmall, .colour = kGrey, .kind = "figure-name"});
      sheet().text(x, y_ + 7.4, width - kQuoteBetween, paper_.figures[i].second,
                   {.size = 3.6, .bold = true, .kind = "figure"});
    }
    if (!paper_.figures.empty()) y_ += 11 + kQuoteGap;
  }

  void table(const QuoteTable& table) {
    if (table.rows.empty()) return;
    need(4 * kQuoteRow);
    begin_table(table, table.heading);
    for (const std::vector<std::string>& row : table.rows) {
      ask(20);
      if (y_ + kQuoteRow > kQuoteColumn.bottom()) {
        begin_page();
        begin_table(table, table.heading + ", continued");
      }
      y_ += kQuoteRow;
      cells(table, row, {.size = kReportBody, .kind = "cell"});
    }
    y_ += kQuoteGap;
  }

  void begin_table(const QuoteTable& table, const std::string& heading) {
    y_ = sheet().heading(kQuoteColumn, y_, heading) + kReportLine;
    std::vector<std::string> names;
    for (const QuoteColumn& column : table.columns) names.push_back(column.heading);
    cells(table, names, {.size = kReportSmall, .colour = kGrey, .kind = "column"});
  }

  void cells(const QuoteTable& table, const std::vector<std::string>& words, TextStyle style) {
    double x = kQuoteColumn.x;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const QuoteColumn& column = table.columns[i];
      const double width = column.width_mm - kQuoteBetween;
      // The last number stands on the edge, below which the sums stand.
      const double right = i + 1 == words.size() ? x + column.width_mm : x + width;
      style.anchor = column.is_number ? Anchor::end : Anchor::start;
      if (!words[i].empty()) sheet().text(column.is_number ? right : x, y_, width, words[i], style);
      x += column.width_mm;
    }
  }

  void sums() {
    need(static_cast<double>(paper_.sums.size() + 1) * 6);
    y_ -= kQuoteGap - 2;
    const double x = kQuoteColumn.right() - kQuoteSums;
    for (const QuoteSum& sum : paper_.sums) {
      const bool last = &sum == &paper_.sums.back();
      if (last || &sum == &paper_.sums.front()) sheet().rule(x, kQuoteColumn.right(), y_ + 1.8);
      y_ += last ? 7 : 5.8;
      const TextStyle style{.size = last ? 3.8 : kReportBody, .bold = last, .kind = "sum"};
      sheet().text(x, y_, 0.6 * kQuoteSums, sum.words, style);
      TextStyle amount = style;
      amount.anchor = Anchor::end;
      sheet().text(kQuoteColumn.right(), y_, 0.4 * kQuoteSums, sum.amount, amount);
    }
    y_ += kQuoteGap + 4;
  }

  void term(const std::string& words) {
    const TextStyle style{.size = kReportBody, .colour = kGrey, .kind = "term"};
    const std::vector<std::string> lines =
        io::wrapped(words, kQuoteColumn.width / style.size, kMostTermLines);
    for (const std::string& line : lines) {
      need(kReportLine);
      y_ += kReportLine;
      sheet().text(kQuoteColumn.x, y_, kQuoteColumn.width, line, style);
    }
    y_ += 1.2;
  }

  void number_pages() {
    for (std::size_t i = 0; i < pages_.size(); ++i)
      Sheet(pages_[i].items)
          .text(kQuoteColumn.right(), kQuotePage.height - 9, 60,
                fmt::format("page {} of {}", i + 1, pages_.size()),
                {.size = kReportSmall, .colour = kGrey, .anchor = Anchor::end, .kind = "page-number"});
  }

  const QuotePaper& paper_;
  std::vector<Scene> pages_;
  double y_ = 0;
};

}  // namespace

Result<std::string> quote_pdf(const QuotePaper& paper) { return QuotePages(paper).finish(); }

}  // namespace lekalo::draw
