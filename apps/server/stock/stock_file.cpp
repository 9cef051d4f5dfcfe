#include "stock_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <utility>

#include "lekalo/io/formats/order_table.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "store/digest.hpp"

namespace lekalo::server {
namespace {

using jobs::LayoutToCut;
using jobs::StockBook;
using jobs::StockItem;
using jobs::StockOrder;
using jobs::StockOrderState;
using jobs::StockState;

constexpr std::int64_t kStockApplication = 0x6c656b73;  // "leks"
constexpr std::int64_t kStockFormat = 1;
/// Another process keeps the file for no longer than it takes to find the remnants of an order, s.
constexpr const char* kWaiting = "PRAGMA busy_timeout=20000; PRAGMA synchronous=EXTRA";
constexpr std::size_t kLongestOrder = 100;

/// A piece is never changed: whether it is free follows from the one row that may use it. `item` is the key
/// there, so SQLite itself refuses a second use.
constexpr const char* kStockSchema = R"(
CREATE TABLE stock (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  rule TEXT NOT NULL
) STRICT;
CREATE TABLE item (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  origin INTEGER NOT NULL,
  place TEXT NOT NULL,
  piece TEXT NOT NULL,
  digest TEXT NOT NULL
) STRICT;
CREATE TABLE job (
  id TEXT PRIMARY KEY,
  state INTEGER NOT NULL CHECK (state BETWEEN 0 AND 2),
  rule TEXT NOT NULL,
  digest TEXT NOT NULL
) STRICT;
CREATE TABLE use (
  item INTEGER PRIMARY KEY REFERENCES item,
  job TEXT NOT NULL REFERENCES job,
  layout INTEGER NOT NULL,
  stock TEXT NOT NULL,
  copy INTEGER NOT NULL
) STRICT;
CREATE TABLE layout (
  job TEXT NOT NULL REFERENCES job,
  number INTEGER NOT NULL,
  document TEXT NOT NULL,
  digest TEXT NOT NULL,
  PRIMARY KEY (job, number)
) STRICT;
)";

/// Whole numbers with blanks between them.
std::string numbers_text(std::initializer_list<std::int64_t> numbers) {
  std::string text;
  for (const std::int64_t number : numbers) text += (text.empty() ? "" : " ") + std::to_string(number);
  return text;
}
template <std::size_t N>
std::optional<std::array<std::int64_t, N>> numbers_in(std::string_view text) {
  std::array<std::int64_t, N> numbers{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0 && (at == end || *at++ != ' ')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc{}) return std::nullopt;
    at = next;
  }
  if (at != end) return std::nullopt;
  return numbers;
}

std::string rule_text(const layout::RemnantRule& rule) {
  return numbers_text({rule.width, rule.height, rule.area_mm2});
}

std::string digest_of_item(const StockItem& item, std::string_view place, std::string_view piece) {
  return Digest("item").add(item.id).add(item.from).add(place).add(piece).text();
}

std::string digest_of_job(const StockOrder& order, std::string_view rule) {
  Digest digest("order");
  digest.add(order.id).add(static_cast<std::int64_t>(order.state)).add(rule);
  digest.add(static_cast<std::int64_t>(order.uses.size()));
  for (const jobs::StockUse& use : order.uses)
    digest.add(use.item).add(static_cast<std::int64_t>(use.layout)).add(use.stock).add(use.copy);
  return digest.text();
}

std::string digest_of_layout(const std::string& order, std::size_t number, std::string_view document) {
  return Digest("layout").add(order).add(static_cast<std::int64_t>(number)).add(document).text();
}

Error damaged_row(const std::string& what) {
  return {ErrorCode::bad_input,
          fmt::format("{} is not as it was written; the file is damaged, take a copy of before", what)};
}

/// Makes the file where there is none. Whoever may read the folder's other files may read it too.
Result<void> make_stock_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0)
    return failure(ErrorCode::environment, fmt::format("it cannot be made: {}", std::strerror(errno)));
  ::close(file);
  return {};
}

Result<void> is_plain_file(const std::string& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0)
    return failure(ErrorCode::bad_input, errno == ENOENT
                                             ? "there is no such stock file; lekalo stock add makes one"
                                             : fmt::format("it cannot be read: {}", std::strerror(errno)));
  if (!S_ISREG(about.st_mode)) return failure(ErrorCode::bad_input, "a stock file is a plain file");
  return {};
}

/// Makes the tables of an empty file, in one transaction with looking whether another process was faster.
Result<void> make_tables(const Database& database) {
  LEKALO_TRY(Transaction transaction, Transaction::begin(database));
  LEKALO_TRY(const std::int64_t tables, database.number("SELECT count(*) FROM sqlite_master"));
  if (tables > 0) return {};
  LEKALO_CHECK(database.run(kStockSchema));
  LEKALO_TRY(Statement rule, database.prepare("INSERT INTO stock VALUES (1, ?)"));
  LEKALO_CHECK(rule.bind(1, rule_text(jobs::usual_remnant_rule())).run());
  const std::string marks =
      fmt::format("PRAGMA application_id={}; PRAGMA user_version={}", kStockApplication, kStockFormat);
  LEKALO_CHECK(database.run(marks.c_str()));
  return transaction.commit();
}

Result<void> is_stock_file(const Database& database) {
  LEKALO_TRY(const std::int64_t application, database.number("PRAGMA application_id"));
  LEKALO_TRY(const std::int64_t format, database.number("PRAGMA user_version"));
  if (application != kStockApplication)
    return failure(ErrorCode::bad_input, "it is no stock file, as lekalo stock add makes it");
  if (format != kStockFormat)
    return failure(
        ErrorCode::bad_input,
        fmt::format("its format is {}, and this program knows {}; take a newer one", format, kStockFormat));
  LEKALO_TRY(Statement check, database.prepare("PRAGMA quick_check(1)"));
  LEKALO_TRY(const bool row, check.step());
  if (const std::string said = row ? check.text(0) : ""; said != "ok")
    return failure(ErrorCode::bad_input, "the file is damaged, take a copy of before: " + said);
  return {};
}

Result<std::string> fine_order(const std::string& order) {
  const auto kept = io::kept_text(order);
  if (!kept || kept->empty() || kept->size() > kLongestOrder)
    return failure(ErrorCode::bad_input,
                   fmt::format("{} is no id of an order: it has from 1 to {} bytes and no control characters",
                               io::excerpt(order), kLongestOrder));
  return *kept;
}

/// States and orders of the items follow from the uses.
void tell_items(StockBook& book) {
  for (const StockOrder& order : book.orders)
    for (const jobs::StockUse& use : order.uses) {
      const auto item = std::lower_bound(book.items.begin(), book.items.end(), use.item,
                                         [](const StockItem& one, std::int64_t id) { return one.id < id; });
      if (item == book.items.end() || item->id != use.item) continue;
      item->state = order.state == StockOrderState::cut ? StockState::cut : StockState::allocated;
      item->order = order.id;
    }
}

}  // namespace

Error StockFile::at_file(Error error) const {
  if (tells_damaged_pages(error)) error = {ErrorCode::bad_input, "the file is no stock file, or is damaged"};
  error.message = fmt::format("{}: {}", path_, error.message);
  return error;
}

tl::unexpected<Error> StockFile::refused(const std::string& sentence) const {
  return failure(ErrorCode::bad_input, sentence);
}

template <class Value>
Result<Value> StockFile::named(Result<Value> result) const {
  if (!result) return tl::unexpected(at_file(result.error()));
  return result;
}

template <class Work>
auto StockFile::change(const Work& work) const {
  const auto changed = [&]() -> decltype(work(std::declval<StockBook&>())) {
    LEKALO_TRY(Transaction transaction, Transaction::begin(database_));
    LEKALO_TRY(StockBook book, read(Layouts::left));
    auto result = work(book);
    if (result) LEKALO_CHECK(transaction.commit());
    return result;
  };
  return named(changed());
}

Result<StockFile> StockFile::open(const std::string& path, StockOpening opening) {
  const auto opened = [&]() -> Result<Database> {
    if (opening == StockOpening::make) LEKALO_CHECK(make_stock_file(path));
    LEKALO_CHECK(is_plain_file(path));
    LEKALO_TRY(Database database, Database::open(path));
    LEKALO_CHECK(database.run(kWaiting));
    LEKALO_TRY(const std::int64_t tables, database.number("SELECT count(*) FROM sqlite_master"));
    if (tables == 0 && opening == StockOpening::find)
      return failure(ErrorCode::bad_input, "nothing is in it yet; lekalo stock add fills it");
    if (tables == 0) LEKALO_CHECK(make_tables(database));
    LEKALO_CHECK(is_stock_file(database));
    return database;
  };
  Result<Database> database = opened();
  if (!database) {
    Error error = database.error();
    if (tells_damaged_pages(error)) error = {ErrorCode::bad_input, "it is no stock file, or is damaged"};
    return failure(error.code, fmt::format("{}: {}", path, error.message));
  }
  return StockFile(path, *std::move(database));
}

Result<StockBook> StockFile::book() {
  return named([&]() -> Result<StockBook> {
    // One transaction, so that all tables are of one moment.
    LEKALO_CHECK(database_.run("BEGIN"));
    Result<StockBook> book = read(Layouts::read);
    database_.roll_back();
    return book;
  }());
}

Result<std::vector<StockItem>> StockFile::items() {
  return named([&]() -> Result<std::vector<StockItem>> {
    LEKALO_CHECK(database_.run("BEGIN"));
    Result<StockBook> book = read(Layouts::left);
    database_.roll_back();
    if (!book) return tl::unexpected(book.error());
    return std::move(book->items);
  }());
}

Result<StockBook> StockFile::read(Layouts layouts) const {
  StockBook book;
  LEKALO_TRY(Statement rule, database_.prepare("SELECT rule FROM stock"));
  LEKALO_TRY(const bool row, rule.step());
  const auto numbers = row ? numbers_in<3>(rule.text(0)) : std::nullopt;
  if (!numbers) return tl::unexpected(damaged_row("the rule of the remnants"));
  book.rule = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  LEKALO_TRY(book.items, read_items());
  LEKALO_TRY(book.orders, read_orders());
  LEKALO_CHECK(read_uses(book.orders));
  if (layouts == Layouts::read)
    for (StockOrder& order : book.orders) LEKALO_CHECK(read_layouts(order));
  tell_items(book);
  return book;
}

Result<std::vector<StockItem>> StockFile::read_items() const {
  LEKALO_TRY(Statement rows,
             database_.prepare("SELECT id, origin, place, piece, digest FROM item ORDER BY id"));
  std::vector<StockItem> items;
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return items;
    StockItem item;
    item.id = rows.integer(0);
    item.from = rows.integer(1);
    const std::string place = rows.text(2), piece = rows.text(3), name = "item " + std::to_string(item.id);
    const auto numbers = numbers_in<6>(place);
    if (!numbers || rows.text(4) != digest_of_item(item, place, piece))
      return tl::unexpected(damaged_row(name));
    const auto& n = *numbers;
    item.at = {n[0], n[1]};
    item.rectangle = {{n[2], n[3]}, {n[4], n[5]}};
    LEKALO_TRY(item.stock, io::read_stock(piece, name));
    item.stock.id = name_of(item);
    items.push_back(std::move(item));
  }
}

Result<std::vector<StockOrder>> StockFile::read_orders() const {
  LEKALO_TRY(Statement rows, database_.prepare("SELECT id, state, rule FROM job ORDER BY id"));
  std::vector<StockOrder> orders;
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return orders;
    StockOrder order;
    order.id = rows.text(0);
    order.state = static_cast<StockOrderState>(rows.integer(1));
    const auto numbers = numbers_in<3>(rows.text(2));
    if (!numbers) return tl::unexpected(damaged_row("order " + order.id));
    order.rule = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    orders.push_back(std::move(order));
  }
}

Result<void> StockFile::read_uses(std::vector<StockOrder>& orders) const {
  LEKALO_TRY(Statement rows,
             database_.prepare("SELECT job, layout, stock, copy, item FROM use ORDER BY job, layout, item"));
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) break;
    const std::string id = rows.text(0);
    const auto order =
        std::lower_bound(orders.begin(), orders.end(), id,
                         [](const StockOrder& one, const std::string& text) { return one.id < text; });
    if (order == orders.end() || order->id != id) return tl::unexpected(damaged_row("order " + id));
    order->uses.push_back(
        {static_cast<std::size_t>(rows.integer(1)), rows.text(2), rows.integer(3), rows.integer(4)});
  }
  LEKALO_TRY(Statement digests, database_.prepare("SELECT rule, digest FROM job ORDER BY id"));
  for (const StockOrder& order : orders) {
    LEKALO_TRY(const bool row, digests.step());
    if (!row || digests.text(1) != digest_of_job(order, digests.text(0)))
      return tl::unexpected(damaged_row("order " + order.id));
  }
  return {};
}

Result<void> StockFile::read_layouts(StockOrder& order) const {
  LEKALO_TRY(Statement rows,
             database_.prepare("SELECT document, digest FROM layout WHERE job = ? ORDER BY number"));
  rows.bind(1, order.id);
  for (;;) {
    LEKALO_TRY(const bool row, rows.step());
    if (!row) return {};
    std::string document = rows.text(0);
    if (rows.text(1) != digest_of_layout(order.id, order.layouts.size(), document))
      return tl::unexpected(
          damaged_row(fmt::format("layout {} of order {}", order.layouts.size() + 1, order.id)));
    order.layouts.push_back(std::move(document));
  }
}

Result<void> StockFile::put(StockItem& item) const {
  LEKALO_TRY(Statement next, database_.prepare("SELECT seq FROM sqlite_sequence WHERE name = 'item'"));
  LEKALO_TRY(const bool row, next.step());
  item.id = (row ? next.integer(0) : 0) + 1;
  next.reset();
  item.stock.id = name_of(item);
  const std::string place = numbers_text({item.at.x, item.at.y, item.rectangle.low.x, item.rectangle.low.y,
                                          item.rectangle.high.x, item.rectangle.high.y}),
                    piece = io::stock_json(item.stock);
  LEKALO_TRY(Statement insert, database_.prepare("INSERT INTO item VALUES (?, ?, ?, ?, ?)"));
  return insert.bind(1, item.id)
      .bind(2, item.from)
      .bind(3, place)
      .bind(4, piece)
      .bind(5, digest_of_item(item, place, piece))
      .run();
}

Result<void> StockFile::put(const StockOrder& order) const {
  for (const char* const sql : {"DELETE FROM use WHERE job = ?", "DELETE FROM layout WHERE job = ?"}) {
    LEKALO_TRY(Statement remove, database_.prepare(sql));
    LEKALO_CHECK(remove.bind(1, order.id).run());
  }
  const std::string rule = rule_text(order.rule);
  LEKALO_TRY(Statement job, database_.prepare("INSERT OR REPLACE INTO job VALUES (?, ?, ?, ?)"));
  StockOrder sorted = order;  // as they are read again
  std::sort(sorted.uses.begin(), sorted.uses.end(), [](const jobs::StockUse& a, const jobs::StockUse& b) {
    return std::pair(a.layout, a.item) < std::pair(b.layout, b.item);
  });
  LEKALO_CHECK(job.bind(1, order.id)
                   .bind(2, static_cast<std::int64_t>(order.state))
                   .bind(3, rule)
                   .bind(4, digest_of_job(sorted, rule))
                   .run());
  LEKALO_TRY(Statement use, database_.prepare("INSERT INTO use VALUES (?, ?, ?, ?, ?)"));
  for (const jobs::StockUse& one : sorted.uses)
    LEKALO_CHECK(use.bind(1, one.item)
                     .bind(2, order.id)
                     .bind(3, static_cast<std::int64_t>(one.layout))
                     .bind(4, one.stock)
                     .bind(5, one.copy)
                     .run());
  LEKALO_TRY(Statement layout, database_.prepare("INSERT INTO layout VALUES (?, ?, ?, ?)"));
  for (std::size_t i = 0; i < order.layouts.size(); ++i)
    LEKALO_CHECK(layout.bind(1, order.id)
                     .bind(2, static_cast<std::int64_t>(i))
                     .bind(3, order.layouts[i])
                     .bind(4, digest_of_layout(order.id, i, order.layouts[i]))
                     .run());
  return {};
}

Result<StockOrder> StockFile::find(const StockBook& book, const std::string& order) const {
  const auto found = std::find_if(book.orders.begin(), book.orders.end(),
                                  [&](const StockOrder& one) { return one.id == order; });
  if (found == book.orders.end()) {
    const auto open = std::find_if(book.orders.begin(), book.orders.end(), [](const StockOrder& one) {
      return one.state == StockOrderState::allocated;
    });
    return refused(fmt::format(
        "there is no order {}{}", io::excerpt(order),
        open == book.orders.end() ? "; none is allocated" : "; one that is allocated is " + open->id));
  }
  return *found;
}

Result<std::vector<StockItem>> StockFile::add(const std::vector<layout::Stock>& pieces,
                                              const std::optional<layout::RemnantRule>& rule) {
  return change([&](StockBook& book) -> Result<std::vector<StockItem>> {
    std::vector<StockItem> added;
    for (const layout::Stock& piece : pieces) {
      StockItem& item = added.emplace_back();
      item.stock = piece;
      LEKALO_CHECK(put(item));
    }
    if (!rule) return added;
    const auto fits = [&](const StockItem& item) {
      return item.state != StockState::cut && fits_rule(item.stock.outline.polygon, *rule);
    };
    if (std::none_of(book.items.begin(), book.items.end(), fits) &&
        std::none_of(added.begin(), added.end(), fits))
      return refused(jobs::rule_too_large(*rule));
    LEKALO_TRY(Statement update, database_.prepare("UPDATE stock SET rule = ?"));
    LEKALO_CHECK(update.bind(1, rule_text(*rule)).run());
    return added;
  });
}

Result<StockOrder> StockFile::allocate(const std::string& order, const std::vector<LayoutToCut>& layouts) {
  return change([&](StockBook& book) -> Result<StockOrder> {
    StockOrder made;
    LEKALO_TRY(made.id, fine_order(order));
    for (const StockOrder& one : book.orders)
      if (one.id == made.id && one.state != StockOrderState::cancelled)
        return refused(
            one.state == StockOrderState::cut
                ? fmt::format("order {} was cut already; give this one another id", one.id)
                : fmt::format("order {0} is allocated already; give this one another id, or give that back "
                              "with lekalo stock cancel {0}",
                              one.id));
    LEKALO_TRY(made.uses, jobs::uses_of(layouts, book.items, made.id));
    for (const LayoutToCut& layout : layouts) made.layouts.push_back(io::write_layout(layout.document));
    LEKALO_CHECK(put(made));
    return made;
  });
}

Result<StockFile::Cut> StockFile::cut(const std::string& order, const std::vector<LayoutToCut>& layouts) {
  return change([&](StockBook& book) -> Result<Cut> {
    Cut done;
    LEKALO_TRY(done.order, find(book, order));
    StockOrder& found = done.order;
    if (found.state != StockOrderState::allocated)
      return refused(fmt::format("order {} {}", found.id,
                                 found.state == StockOrderState::cut
                                     ? "was cut already"
                                     : "was cancelled, so nothing is allocated to it"));
    std::vector<LayoutToCut> cut = layouts;
    if (cut.empty()) {
      LEKALO_CHECK(read_layouts(found));
      for (const std::string& text : found.layouts) {
        LEKALO_TRY(io::LayoutFile file, io::read_layout(text, "order " + found.id));
        cut.push_back({"order " + found.id, std::move(file.document)});
      }
    } else {
      LEKALO_TRY(found.uses, jobs::uses_of(cut, book.items, found.id));
      for (const LayoutToCut& layout : cut) found.layouts.push_back(io::write_layout(layout.document));
    }
    found.state = StockOrderState::cut;
    found.rule = book.rule;
    done.remnants = jobs::remnants_left(cut, found.uses, book.items, found.rule);
    for (StockItem& remnant : done.remnants) LEKALO_CHECK(put(remnant));
    LEKALO_CHECK(put(found));
    return done;
  });
}

Result<StockOrder> StockFile::cancel(const std::string& order) {
  return change([&](StockBook& book) -> Result<StockOrder> {
    LEKALO_TRY(StockOrder found, find(book, order));
    if (found.state != StockOrderState::allocated)
      return refused(fmt::format("order {} {}", found.id,
                                 found.state == StockOrderState::cut
                                     ? "was cut, and what was cut does not come back"
                                     : "was cancelled already"));
    StockOrder cancelled;
    cancelled.id = found.id;
    cancelled.state = StockOrderState::cancelled;
    LEKALO_CHECK(put(cancelled));
    return found;
  });
}

}  // namespace lekalo::server
