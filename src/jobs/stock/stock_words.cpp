// Reads what people say of stock, and says what they are told.

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/formats/part_file.hpp"
#include "lekalo/io/text/length_word.hpp"
#include "lekalo/jobs/stock.hpp"
#include "lekalo/layout/job.hpp"
#include "lekalo/layout/material_words.hpp"

namespace lekalo::jobs {
namespace {

constexpr double kLargestRemnantArea = 1e10;  // mm^2

std::optional<std::int64_t> whole_mm2(double mm2) {
  const double whole = std::round(mm2);
  if (!(whole >= 1 && whole <= kLargestRemnantArea) || std::abs(mm2 - whole) > 1e-6) return std::nullopt;
  return static_cast<std::int64_t>(whole);
}

/// The stocks that a file holds: those of a layout, with how many of each there are, or the outlines of a
/// drawing.
Result<std::vector<layout::Stock>> stocks_in(const File& file, const io::PartOptions& reading) {
  auto layout = io::read_any_layout(file.bytes, file.name, reading);
  if (layout && !layout->document.stocks.empty()) return std::move(layout->document.stocks);
  LEKALO_TRY(io::StocksFile drawn, io::read_stocks(file.bytes, file.name, reading));
  for (layout::Stock& stock : drawn.stocks) stock.cost = geom::area_mm2(stock.outline.polygon) * 1e-6;
  return std::move(drawn.stocks);
}

}  // namespace

std::string_view name_of(StockState state) noexcept {
  constexpr std::array<std::string_view, 3> kNames{"free", "allocated", "cut"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string_view name_of(StockOrderState state) noexcept {
  constexpr std::array<std::string_view, 3> kNames{"allocated", "cut", "cancelled"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string name_of(const StockItem& item) {
  return fmt::format("{}{}", item.from == 0 ? 'S' : 'R', item.id);
}

layout::RemnantRule usual_remnant_rule() { return {200 * geom::kGridPerMm, 200 * geom::kGridPerMm, 0}; }

std::optional<layout::RemnantRule> remnant_rule_of(std::string_view word) {
  if (const auto size = io::size_of(word)) {
    const auto fine = [](double mm) { return limits::kShortestSide <= mm && mm <= limits::kLargestOutline; };
    if (!fine(size->width_mm) || !fine(size->height_mm)) return std::nullopt;
    return layout::RemnantRule{geom::grid_from_mm_up(size->width_mm), geom::grid_from_mm_up(size->height_mm),
                               0};
  }
  if (!word.ends_with('2')) return std::nullopt;
  word.remove_suffix(1);
  struct Unit {
    std::string_view name;
    double mm2;
  };
  constexpr std::array kUnits{Unit{"mm", 1}, Unit{"cm", 100}, Unit{"m", 1e6}};
  for (const Unit& unit : kUnits) {
    if (!word.ends_with(unit.name)) continue;
    // A length of so many millimetres is read by its number alone.
    const auto number = io::length_of(word.substr(0, word.size() - unit.name.size()));
    const auto area = number ? whole_mm2(*number * unit.mm2) : std::nullopt;
    if (!area) return std::nullopt;
    return layout::RemnantRule{0, 0, *area};
  }
  return std::nullopt;
}

std::string words_of(const StockItem& item) {
  const geom::GridBox box = geom::bounds(item.stock.outline.polygon);
  const geom::Point size = geom::mm_from_grid(box.high - box.low);
  std::string text = fmt::format("{:<6} {:g} x {:g} mm, {:.4f} m2, {}, cost {:g}", name_of(item), size.x,
                                 size.y, geom::area_mm2(item.stock.outline.polygon) * 1e-6,
                                 layout::words_of(item.stock.material), item.stock.cost);
  if (item.state == StockState::allocated) text += ", allocated to order " + item.order;
  return text;
}

std::string words_of(const layout::RemnantRule& rule) {
  if (rule.area_mm2 > 0) return fmt::format("{} mm2", rule.area_mm2);
  return fmt::format("{:g}x{:g} mm", geom::mm_from_grid(rule.width), geom::mm_from_grid(rule.height));
}

std::string rule_too_large(const layout::RemnantRule& rule) {
  return fmt::format("no piece in it is large enough for a remnant of {}, so none would ever come back",
                     words_of(rule));
}

Result<std::vector<layout::Stock>> added_stock(const StockWord& word, const std::optional<File>& file,
                                               const io::PartOptions& reading, std::optional<double> cost,
                                               std::optional<double> grain) {
  std::vector<layout::Stock> kinds;
  if (word.size) {
    kinds.push_back(layout::sheet_of(geom::grid_from_mm(word.size->width_mm),
                                     geom::grid_from_mm(word.size->height_mm), 1));
  } else {
    LEKALO_TRY(kinds, stocks_in(*file, reading));
  }
  std::vector<layout::Stock> all;
  for (layout::Stock& stock : kinds) {
    if (stock.kind == layout::StockKind::strip)
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: its stock {} is a strip; a stock file holds pieces with an outline",
                                 word.said, stock.id));
    const std::int64_t count = word.count.value_or(stock.count);
    if (count > kMostAdded - static_cast<std::int64_t>(all.size()))
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: {} pieces are more than the {} that are added at once", word.said,
                                 count, kMostAdded));
    stock.count = 1;
    stock.name.clear();
    if (cost) stock.cost = *cost;
    if (grain) stock.grain_degrees = grain;
    if (word.material.is_said()) stock.material = word.material;
    all.insert(all.end(), static_cast<std::size_t>(count), stock);
  }
  return all;
}

}  // namespace lekalo::jobs
