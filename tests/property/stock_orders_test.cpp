// Orders in a row on one stock: nothing is cut twice, and less material is used than without remnants.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "lekalo/jobs/nest.hpp"
#include "lekalo/layout/job.hpp"
#include "server/stock/stock_file.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::server::stock_orders_test {
namespace {

namespace fs = std::filesystem;
using jobs::StockBook;
using jobs::StockItem;
using jobs::StockState;

constexpr std::int64_t mm = geom::kGridPerMm;
constexpr std::int64_t kWidth = 1500 * mm, kHeight = 1000 * mm;

/// Rectangles of 5 to 60 cm, some tens of percent of a sheet as a rule, on whatever is free.
layout::Document order_on(std::vector<layout::Stock> stocks, std::size_t index) {
  Random random(cases::seed(), 3000 + index);
  layout::Document order;
  order.stocks = std::move(stocks);
  order.rules = {4 * mm, 5 * mm, 0, 2 * mm};
  for (std::size_t i = 0, count = 1 + random.below(4); i < count; ++i) {
    layout::Part part;
    part.id = "part " + std::to_string(i);
    const double width = random.uniform(50, 600);
    part.outline = cases::outline_of({cases::box_loop(0, 0, width, random.uniform(50, 400))});
    part.rotations = {{0, 0}, {90, 90}};
    part.demand = 1 + static_cast<std::int64_t>(random.below(6));
    order.parts.push_back(part);
  }
  return order;
}

struct Used {
  std::size_t sheets = 0;  ///< that were cut
  double kept = 0;         ///< of remnants that are still there, in sheets
};

std::size_t free_sheets(const std::vector<StockItem>& items) {
  return static_cast<std::size_t>(std::count_if(items.begin(), items.end(), [](const StockItem& item) {
    return item.from == 0 && item.state == StockState::free;
  }));
}

/// Cuts so many orders. Each fifth is cancelled first, and comes again.
Used cut_orders(const std::string& path, std::size_t orders, const layout::RemnantRule& rule) {
  StockFile file = StockFile::open(path, StockOpening::make).value();
  const layout::Stock sheet = layout::sheet_of(kWidth, kHeight, 1);
  for (std::size_t i = 0; i < orders; ++i) {
    const std::size_t free = free_sheets(file.items().value());
    if (free < 5) (void)file.add(std::vector<layout::Stock>(5 - free, sheet), rule).value();
    RunControl control;
    control.work_limit = 20'000;
    jobs::NestOptions options;
    options.threads = 1;
    const auto nested =
        jobs::nest(order_on(jobs::offered_stock(file.items().value()), i), options, control).value();
    EXPECT_TRUE(nested.unplaced.empty()) << "order " << i;
    const std::string id = "order " + std::to_string(i);
    const auto allocate = [&] {
      const auto allocated = file.allocate(id, {{id, nested.document}});
      if (!allocated) throw std::runtime_error(allocated.error().message);
    };
    allocate();
    if (i % 5 == 4) {
      (void)file.cancel(id).value();
      allocate();
    }
    (void)file.cut(id, {}).value();
  }
  const StockBook book = file.book().value();
  const auto report = jobs::check_book(book, path).value();
  EXPECT_TRUE(report.findings.empty()) << report.findings.front();
  Used used;
  for (const StockItem& item : book.items) {
    if (item.from == 0 && item.state == StockState::cut) ++used.sheets;
    if (item.from != 0 && item.state == StockState::free)
      used.kept += geom::area_mm2(item.stock.outline.polygon) / geom::area_mm2(sheet.outline.polygon);
  }
  return used;
}

TEST(StockOrders, InARowUseNoAreaTwiceAndLessThanWithoutRemnants) {
  std::string folder = (fs::temp_directory_path() / "lekalo-orders-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::size_t orders = cases::case_count(12);
  const Used with = cut_orders(folder + "/with", orders, {200 * mm, 150 * mm, 0});
  // Only a whole sheet would be large enough, so nothing ever comes back.
  const Used without = cut_orders(folder + "/without", orders, {kWidth, kHeight, 0});
  fs::remove_all(folder);
  std::printf("%zu orders: %zu sheets, and remnants of %.2f sheets are left; without remnants %zu sheets\n",
              orders, with.sheets, with.kept, without.sheets);
  EXPECT_LT(with.sheets, without.sheets);
  EXPECT_EQ(without.kept, 0);
}

}  // namespace
}  // namespace lekalo::server::stock_orders_test
