#include "stock_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/stock.hpp"
#include "lekalo/layout/material_words.hpp"
#include "outputs.hpp"
#include "server/stock/stock_file.hpp"
#include "stock_words.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using jobs::StockItem;
using server::StockFile;
using server::StockOpening;

constexpr int kAllTrue = 0, kNotTrue = 1;

Result<std::vector<layout::Stock>> pieces_of(const StockOptions& o, const jobs::StockWord& word) {
  std::optional<jobs::File> file;
  if (!word.size) {
    std::error_code unseen;
    if (!std::filesystem::exists(word.said, unseen))
      return failure(ErrorCode::bad_input,
                     fmt::format("--sheet: {} is neither a size, as 3000x1500, nor a file that is there",
                                 io::as_utf8(word.said)));
    LEKALO_TRY(std::string bytes, disk::read_file(word.said));
    file = jobs::File{io::as_utf8(word.said), std::move(bytes)};
  }
  return jobs::added_stock(word, file, o.reading, o.cost, o.grain);
}

Result<int> add_pieces(const StockOptions& o) {
  std::vector<layout::Stock> pieces;
  std::string faults;
  ErrorCode code = ErrorCode::bad_input;
  for (const jobs::StockWord& word : o.pieces) {
    const auto some = pieces_of(o, word);
    if (some) {
      pieces.insert(pieces.end(), some->begin(), some->end());
      continue;
    }
    if (faults.empty()) code = some.error().code;
    faults += (faults.empty() ? "" : "; ") + some.error().message;
  }
  if (!faults.empty()) return failure(code, faults);
  // A file that would hold nothing is not made.
  std::error_code unseen;
  if (o.rule && !std::filesystem::exists(o.file, unseen) &&
      std::none_of(pieces.begin(), pieces.end(),
                   [&](const layout::Stock& piece) { return fits_rule(piece.outline.polygon, *o.rule); }))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", o.file, jobs::rule_too_large(*o.rule)));
  LEKALO_TRY(StockFile file,
             StockFile::open(o.file, pieces.empty() ? StockOpening::find : StockOpening::make));
  LEKALO_TRY(const std::vector<StockItem> added, file.add(pieces, o.rule));
  std::string said;
  for (const StockItem& item : added) said += item_text(item);
  if (o.rule)
    said += fmt::format("no remnant smaller than {} is kept from now on\n", jobs::words_of(*o.rule));
  tell(said);
  return kAllTrue;
}

Result<int> list_pieces(const StockOptions& o) {
  LEKALO_CHECK(check_outputs({{"--picture", o.picture}}, {{"the stock file", o.file}}));
  LEKALO_TRY(StockFile file, StockFile::open(o.file, StockOpening::find));
  LEKALO_TRY(const jobs::StockBook book, file.book());
  if (!o.picture.empty()) {
    LEKALO_TRY(
        const std::string picture,
        jobs::stock_picture(book, o.file, jobs::picture_form(o.picture).value_or(jobs::PictureForm::svg)));
    LEKALO_CHECK(deliver(o.picture, picture));
  }
  if (o.json) return print(jobs::stock_book_json(book)).map([] { return kAllTrue; });
  std::string text;
  for (const StockItem& item : book.items)
    if (item.state != jobs::StockState::cut) text += item_text(item);
  return print(text + sums_text(jobs::sums_of(book)) +
               fmt::format("no remnant smaller than {} is kept\n", jobs::words_of(book.rule)))
      .map([] { return kAllTrue; });
}

Result<std::vector<jobs::LayoutToCut>> layouts_of(const StockOptions& o) {
  std::vector<jobs::LayoutToCut> layouts;
  for (const std::string& path : o.layouts) {
    LEKALO_TRY(jobs::Layout layout, read_layout_input({path, {}, o.reading, {}}, {}));
    layouts.push_back({io::as_utf8(path), std::move(layout.document)});
  }
  return layouts;
}

Result<int> allocate(const StockOptions& o) {
  LEKALO_TRY(const std::vector<jobs::LayoutToCut> layouts, layouts_of(o));
  LEKALO_TRY(StockFile file, StockFile::open(o.file, StockOpening::find));
  LEKALO_TRY(const jobs::StockOrder order, file.allocate(o.order, layouts));
  LEKALO_TRY(const std::vector<StockItem> items, file.items());
  tell(allocated_text(order, items));
  return kAllTrue;
}

Result<int> cut(const StockOptions& o) {
  LEKALO_TRY(const std::vector<jobs::LayoutToCut> layouts, layouts_of(o));
  LEKALO_TRY(StockFile file, StockFile::open(o.file, StockOpening::find));
  LEKALO_TRY(const StockFile::Cut done, file.cut(o.order, layouts));
  std::string said =
      fmt::format("order {}: cut from {}\n", done.order.id, counted(done.order.uses.size(), "piece"));
  for (const StockItem& remnant : done.remnants) said += item_text(remnant);
  if (done.remnants.empty())
    said += fmt::format("no remnant is as large as {}\n", jobs::words_of(done.order.rule));
  tell(said);
  return kAllTrue;
}

Result<int> cancel(const StockOptions& o) {
  LEKALO_TRY(StockFile file, StockFile::open(o.file, StockOpening::find));
  LEKALO_TRY(const jobs::StockOrder order, file.cancel(o.order));
  tell(fmt::format("order {}: cancelled; {} free again\n", order.id,
                   order.uses.size() == 1 ? "1 piece is" : fmt::format("{} pieces are", order.uses.size())));
  return kAllTrue;
}

Result<int> check(const StockOptions& o) {
  LEKALO_TRY(StockFile file, StockFile::open(o.file, StockOpening::find));
  LEKALO_TRY(const jobs::StockBook book, file.book());
  LEKALO_TRY(const verify::ClaimReport report, jobs::check_book(book, o.file));
  for (const std::string& finding : report.findings) tell(fmt::format("{}: {}\n", o.file, finding));
  LEKALO_CHECK(print(fmt::format(
      "{}: {}, {}; {}\n", o.file, counted(book.items.size(), "piece"), counted(book.orders.size(), "order"),
      report.findings.empty() ? "everything was rechecked, and is true"
                              : fmt::format("{} not true", report.findings.size()))));
  return report.findings.empty() ? kAllTrue : kNotTrue;
}

}  // namespace

Result<int> run_stock(const StockOptions& options) {
  switch (options.action) {
    case StockAction::add:
      return add_pieces(options);
    case StockAction::take:
      return allocate(options);
    case StockAction::cut:
      return cut(options);
    case StockAction::cancel:
      return cancel(options);
    case StockAction::check:
      return check(options);
    default:
      return list_pieces(options);
  }
}

}  // namespace lekalo::cli
