// The stock file of apps/server/stock: states, damage, several processes, and processes that are killed.

#include <gtest/gtest.h>

#include <algorithm>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/layout/job.hpp"
#include "server/stock/stock_file.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::server::stock_file_test {
namespace {

namespace fs = std::filesystem;
using jobs::LayoutToCut;
using jobs::StockBook;
using jobs::StockItem;
using jobs::StockState;

constexpr std::int64_t mm = geom::kGridPerMm;

layout::Stock sheet(const std::string& material, double width = 300) {
  layout::Stock stock = layout::sheet_of(geom::grid_from_mm(width), 100 * mm, 1);
  stock.material = {material, 2 * mm};
  return stock;
}

/// A layout that cuts a square of 60 from each of so many copies of a piece.
LayoutToCut squares_on(layout::Stock stock, std::int64_t copies = 1) {
  layout::Document document;
  stock.id = "piece";
  stock.count = copies;
  document.stocks = {std::move(stock)};
  layout::Part part;
  part.id = "square";
  part.outline = cases::outline_of({cases::box_loop(0, 0, 60, 60)});
  document.parts = {part};
  for (std::int64_t copy = 0; copy < copies; ++copy) {
    layout::Placement placement;
    placement.id = document.next_id++;
    placement.copy = copy;
    document.placements.push_back(placement);
  }
  return {"out.json", std::move(document)};
}

class Stock : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lekalo-stock-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    path_ = (folder_ / "shop.stock").string();
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] StockFile open() const {
    Result<StockFile> file = StockFile::open(path_, StockOpening::make);
    if (!file) throw std::runtime_error(file.error().message);
    return *std::move(file);
  }
  void add(const std::vector<layout::Stock>& pieces) const { ASSERT_TRUE(open().add(pieces, {})); }
  [[nodiscard]] StockBook book() const { return open().book().value(); }
  [[nodiscard]] std::size_t count(StockState state) const {
    const std::vector<StockItem> items = open().items().value();
    return static_cast<std::size_t>(std::count_if(
        items.begin(), items.end(), [&](const StockItem& item) { return item.state == state; }));
  }
  /// Everything that the independent checker finds.
  [[nodiscard]] std::vector<std::string> findings() const {
    const auto report = jobs::check_book(book(), path_);
    return report ? report->findings : std::vector<std::string>{report.error().message};
  }
  void expect_true() const {
    const auto found = findings();
    EXPECT_TRUE(found.empty()) << found.front();
  }
  void run_sql(const std::string& sql) const {
    sqlite3* raw = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &raw), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(raw, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(raw);
    sqlite3_close(raw);
  }

  fs::path folder_;
  std::string path_;
};

std::string error_of(const auto& result) { return result ? "no error" : result.error().message; }
bool says(const std::string& sentence, const std::string& words) {
  return sentence.find(words) != std::string::npos;
}

TEST_F(Stock, AnOrderTakesItsSheetsAndLeavesItsRemnants) {
  add({sheet("steel"), sheet("steel"), sheet("birch")});
  StockFile file = open();
  const auto order = file.allocate("A1", {squares_on(sheet("steel"))});
  ASSERT_TRUE(order) << error_of(order);
  EXPECT_EQ(order->uses[0].item, 1);
  EXPECT_EQ(count(StockState::allocated), 1u);
  expect_true();
  // 236 x 100 mm beside the square, in the usual rule of 200 x 200: nothing comes back.
  ASSERT_TRUE(file.add({}, layout::RemnantRule{100 * mm, 100 * mm, 0}));
  const auto cut = file.cut("A1", {});
  ASSERT_TRUE(cut) << error_of(cut);
  ASSERT_EQ(cut->remnants.size(), 1u);
  EXPECT_EQ(name_of(cut->remnants[0]), "R4");
  EXPECT_EQ(cut->remnants[0].from, 1);
  EXPECT_NEAR(cut->remnants[0].stock.cost, 0.03 * 0.8, 1e-12);
  EXPECT_EQ(count(StockState::cut), 1u);
  expect_true();

  layout::Stock remnant = cut->remnants[0].stock;
  const auto next = file.allocate("A2", {squares_on(remnant)});
  ASSERT_TRUE(next) << error_of(next);
  EXPECT_EQ(next->uses[0].item, 4);
  ASSERT_TRUE(file.cut("A2", {}));
  EXPECT_EQ(book().items.back().from, 4);
  expect_true();
}

TEST_F(Stock, ACancelledOrderGivesBackAndMayComeAgain) {
  add({sheet("steel")});
  StockFile file = open();
  ASSERT_TRUE(file.allocate("A1", {squares_on(sheet("steel"))}));
  EXPECT_TRUE(
      says(error_of(file.allocate("A2", {squares_on(sheet("steel"))})), "S1 is allocated to order A1"));
  ASSERT_TRUE(file.cancel("A1"));
  EXPECT_EQ(count(StockState::free), 1u);
  expect_true();
  EXPECT_TRUE(says(error_of(file.cancel("A1")), "was cancelled already"));
  EXPECT_TRUE(says(error_of(file.cut("A1", {})), "was cancelled"));
  ASSERT_TRUE(file.allocate("A1", {squares_on(sheet("steel"))}));
  ASSERT_TRUE(file.cut("A1", {}));
  EXPECT_TRUE(says(error_of(file.cancel("A1")), "was cut"));
  EXPECT_TRUE(says(error_of(file.cut("A1", {})), "was cut already"));
  EXPECT_TRUE(says(error_of(file.allocate("A1", {squares_on(sheet("steel"))})), "was cut already"));
  EXPECT_TRUE(says(error_of(file.allocate("A2", {squares_on(sheet("steel"))})), "S1 is cut for order A1"));
  expect_true();
}

TEST_F(Stock, WhatWasCutOtherwiseThanPlannedUsesWhatItUses) {
  add({sheet("steel"), sheet("steel"), sheet("steel")});
  StockFile file = open();
  ASSERT_TRUE(file.allocate("A1", {squares_on(sheet("steel"), 3)}));
  EXPECT_EQ(count(StockState::allocated), 3u);
  ASSERT_TRUE(file.cut("A1", {squares_on(sheet("steel"), 2)}));
  EXPECT_EQ(count(StockState::cut), 2u);
  EXPECT_EQ(count(StockState::free), 1u);
  expect_true();
}

TEST_F(Stock, OnlyTheSamePieceOfAFittingMaterialServes) {
  layout::Stock plain = sheet("");
  plain.material = {};
  add({sheet("birch"), sheet("steel", 200), plain});
  StockFile file = open();
  EXPECT_TRUE(
      says(error_of(file.allocate("A1", {squares_on(sheet("steel", 400))})), "no piece of this stock file"));
  const auto order = file.allocate("A1", {squares_on(sheet("steel"))});
  ASSERT_TRUE(order) << error_of(order);
  EXPECT_EQ(order->uses[0].item, 3);
  EXPECT_TRUE(says(error_of(file.allocate("A2", {squares_on(sheet("oak"))})), "S3 is allocated to order A1"));
  run_sql("DELETE FROM item WHERE id = 3; DELETE FROM use; DELETE FROM layout; DELETE FROM job");
  EXPECT_TRUE(says(error_of(file.allocate("A2", {squares_on(sheet("oak"))})),
                   "of another material: S1 of birch, 2 mm"));
}

TEST_F(Stock, WhatIsNoLayoutToCutIsRefused) {
  add({sheet("steel")});
  StockFile file = open();
  LayoutToCut empty = squares_on(sheet("steel"));
  empty.document.placements.clear();
  EXPECT_TRUE(says(error_of(file.allocate("A1", {empty})), "nothing is placed"));
  LayoutToCut broken = squares_on(sheet("steel"));
  broken.document.placements[0].at.x = 290 * mm;
  EXPECT_TRUE(says(error_of(file.allocate("A1", {broken})), "breaks 1 rule"));
  EXPECT_TRUE(says(error_of(file.allocate("", {squares_on(sheet("steel"))})), "is no id of an order"));
  EXPECT_TRUE(
      says(error_of(file.allocate("A1", {squares_on(sheet("steel"), 2)})), "it needs 2 of its stock piece"));
  EXPECT_TRUE(says(error_of(file.cut("B7", {})), "there is no order 'B7'"));
  EXPECT_TRUE(says(error_of(file.add({}, layout::RemnantRule{400 * mm, 100 * mm, 0})), "large enough"));
  EXPECT_EQ(count(StockState::free), 1u);
}

TEST_F(Stock, DamageIsSaid) {
  add({sheet("steel"), sheet("steel")});
  ASSERT_TRUE(open().allocate("A1", {squares_on(sheet("steel"))}));
  fs::copy_file(path_, folder_ / "good");
  const std::vector<std::pair<std::string, std::string>> damages{
      {"UPDATE item SET piece = replace(piece, '300', '400') WHERE id = 2",
       "item 2 is not as it was written"},
      {"UPDATE use SET item = 2", "order A1 is not as it was written"},
      {"DELETE FROM use", "order A1 is not as it was written"},
      {"UPDATE job SET state = 1", "order A1 is not as it was written"},
      {"UPDATE stock SET rule = 'x'", "the rule of the remnants is not as it was written"},
      {"UPDATE layout SET document = replace(document, '60', '61')", "layout 1 of order A1 is not"}};
  for (const auto& [sql, said] : damages) {
    fs::copy_file(folder_ / "good", path_, fs::copy_options::overwrite_existing);
    run_sql(sql);
    EXPECT_TRUE(says(error_of(open().book()), said)) << sql << ": " << error_of(open().book());
  }
  // What the digests do not know, because it is gone with them, the checker finds.
  fs::copy_file(folder_ / "good", path_, fs::copy_options::overwrite_existing);
  ASSERT_TRUE(open().add({}, layout::RemnantRule{50 * mm, 50 * mm, 0}));
  ASSERT_TRUE(open().cut("A1", {}));
  run_sql("DELETE FROM use; DELETE FROM layout; DELETE FROM job");
  EXPECT_TRUE(says(findings().at(0), "it is a remnant of S1, which was not cut"));
}

TEST_F(Stock, AnotherFileIsNoStockFile) {
  EXPECT_TRUE(says(error_of(StockFile::open(path_, StockOpening::find)), "there is no such stock file"));
  std::ofstream(path_) << "no database, but long enough to be told apart from one that is empty";
  EXPECT_TRUE(says(error_of(StockFile::open(path_, StockOpening::make)), "no stock file"));
  std::ofstream(path_, std::ios::trunc).flush();
  EXPECT_TRUE(says(error_of(StockFile::open(path_, StockOpening::find)), "nothing is in it yet"));
  EXPECT_TRUE(says(error_of(StockFile::open(folder_.string(), StockOpening::find)), "a plain file"));
  run_sql("CREATE TABLE other (x)");
  EXPECT_TRUE(says(error_of(StockFile::open(path_, StockOpening::make)), "no stock file"));
}

/// Runs work in a process of its own.
pid_t in_process(const std::function<void()>& work) {
  const pid_t process = fork();
  if (process == 0) {
    work();
    _exit(0);
  }
  return process;
}

TEST_F(Stock, NoPieceIsGivenToTwoProcesses) {
  constexpr int kProcesses = 4, kSheets = 20, kTries = 12;
  add(std::vector<layout::Stock>(kSheets, sheet("steel")));
  std::vector<pid_t> processes;
  for (int p = 0; p < kProcesses; ++p)
    processes.push_back(in_process([&] {
      // A handle of SQLite may not be taken along into another process.
      StockFile file = StockFile::open(path_, StockOpening::find).value();
      for (int i = 0; i < kTries; ++i)
        (void)file.allocate("P" + std::to_string(p) + "-" + std::to_string(i), {squares_on(sheet("steel"))});
    }));
  for (const pid_t process : processes) {
    int status = 0;
    waitpid(process, &status, 0);
    EXPECT_EQ(status, 0);
  }
  std::set<std::int64_t> used;
  std::size_t uses = 0;
  for (const jobs::StockOrder& order : book().orders)
    for (const jobs::StockUse& use : order.uses) used.insert(use.item), ++uses;
  EXPECT_EQ(uses, static_cast<std::size_t>(kSheets));
  EXPECT_EQ(used.size(), uses);
  expect_true();
}

/// Goes through orders from wherever the file stands: allocates, cuts and cancels.
void work_on(const std::string& path) {
  StockFile file = StockFile::open(path, StockOpening::make).value();
  for (int i = 0;; ++i) {
    (void)file.add({sheet("steel")}, layout::RemnantRule{50 * mm, 50 * mm, 0});
    const std::string id = std::to_string(getpid()) + "-" + std::to_string(i);
    (void)file.allocate(id, {squares_on(sheet("steel"))});
    (void)(i % 3 == 2 ? file.cancel(id).has_value() : file.cut(id, {}).has_value());
  }
}

/// The sums hold after every kill: a piece that was half taken or half put back would break one of them.
TEST_F(Stock, AProcessThatIsKilledAtAnyMomentLosesNothing) {
  std::size_t items = 0, orders = 0;
  for (std::size_t kill_number = 0; kill_number < cases::case_count(40); ++kill_number) {
    Random random(cases::seed(), 700 + kill_number);
    const pid_t process = in_process([&] { work_on(path_); });
    usleep(static_cast<useconds_t>(random.below(30'000)));
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    if (!fs::exists(path_)) continue;
    const StockBook now = book();
    EXPECT_GE(now.items.size(), items) << "kill " << kill_number;
    EXPECT_GE(now.orders.size(), orders) << "kill " << kill_number;
    items = now.items.size(), orders = now.orders.size();
    // Whatever is allocated is so to the one order that was under way.
    for (const jobs::StockSums& sums : jobs::sums_of(now)) {
      EXPECT_GE(sums.lost, 0) << "kill " << kill_number;
      EXPECT_NEAR(sums.added, sums.free + sums.allocated + sums.parts + sums.lost, 1e-6)
          << "kill " << kill_number;
    }
    expect_true();
    if (items > 400) fs::remove(path_), items = orders = 0;  // checking a long history takes long
  }
}

}  // namespace
}  // namespace lekalo::server::stock_file_test
