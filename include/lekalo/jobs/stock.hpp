#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/order_words.hpp"
#include "lekalo/jobs/picture_form.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/layout/remnant_outline.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::jobs {

/// The stock of a shop: sheets, and what is left of them, each a piece of material with an id of its own.
/// These are values; apps/server/stock keeps them in a file. docs/design/stock.md says what they mean.

enum class StockState : std::uint8_t {
  free,
  allocated,  ///< to an order that is not cut yet
  cut         ///< gone
};
/// Returns "free", "allocated" or "cut".
[[nodiscard]] std::string_view name_of(StockState state) noexcept;

/// A piece of material.
struct StockItem {
  std::int64_t id = 0;      ///< from 1; never given again
  std::int64_t from = 0;    ///< the item that it is a remnant of; 0: it came as a sheet
  geom::GridPoint at;       ///< of a remnant: the place of its (0, 0) in that item
  geom::GridBox rectangle;  ///< of a remnant, in its own frame: a rectangle that lies in it
  StockState state = StockState::free;
  std::string order;  ///< that it is allocated to, or was cut for; empty: none
  /// Its outline, material, defects and zones; one copy, called name_of(item). The cost is what the sheet
  /// cost, and of a remnant its share by area.
  layout::Stock stock;
};
/// Returns what people call an item: "S3" a sheet, "R7" a remnant.
[[nodiscard]] std::string name_of(const StockItem& item);

enum class StockOrderState : std::uint8_t { allocated, cut, cancelled };
/// Returns "allocated", "cut" or "cancelled".
[[nodiscard]] std::string_view name_of(StockOrderState state) noexcept;

/// The item that one copy of a stock of a layout is.
struct StockUse {
  std::size_t layout = 0;  ///< of the order's
  std::string stock;       ///< its id in the layout
  std::int64_t copy = 0;
  std::int64_t item = 0;
};

/// An order has layouts and uses items while it is allocated, and when it was cut; when it is cancelled
/// neither.
struct StockOrder {
  std::string id;
  StockOrderState state = StockOrderState::allocated;
  layout::RemnantRule rule;          ///< by which its remnants were kept, when it was cut
  std::vector<std::string> layouts;  ///< as "lekalo-layout/1"
  std::vector<StockUse> uses;
};

/// Everything that a stock file holds: also what is gone, so that every remnant can be followed to its sheet.
struct StockBook {
  layout::RemnantRule rule;
  std::vector<StockItem> items;    ///< by id
  std::vector<StockOrder> orders;  ///< by id
};

/// Items that `lekalo stock` takes no more of, each with a sentence.
inline constexpr std::int64_t kMostAdded = 10'000;
/// The rule of a stock file for which none was said: 200 x 200 mm.
[[nodiscard]] layout::RemnantRule usual_remnant_rule();
/// Reads "300x200", or an area: "60000mm2", "600cm2", "0.06m2". Nothing for other words, sides that are not
/// from 0.001 to 262144 mm, and areas that are no whole number of mm^2 from 1 to 10^10.
[[nodiscard]] std::optional<layout::RemnantRule> remnant_rule_of(std::string_view word);
/// Returns "300x200 mm" or "60000 mm2".
[[nodiscard]] std::string words_of(const layout::RemnantRule& rule);
/// Returns what a piece is, on one line: name, size, area, material, cost, and the order that has it.
[[nodiscard]] std::string words_of(const StockItem& item);

/// The sentence about a rule that no piece of a stock file is large enough for.
[[nodiscard]] std::string rule_too_large(const layout::RemnantRule& rule);

/// Makes the pieces that a word adds (jobs/order_words.hpp), one without a count: a size, the outlines of a
/// drawing, or the stocks of a layout with their defects and zones. \param file   where the word names one
/// \param cost   of each; without one, and for drawings and sizes, its area in m^2
/// \param grain  of each; without one, that of the file
/// Fails with ErrorCode::bad_input for files that cannot be read, strips, and more than kMostAdded pieces.
[[nodiscard]] Result<std::vector<layout::Stock>> added_stock(const StockWord& word,
                                                             const std::optional<File>& file,
                                                             const io::PartOptions& reading,
                                                             std::optional<double> cost,
                                                             std::optional<double> grain);

/// The share of its cost at which a remnant is offered to the nester, which takes the least cost: of two
/// pieces with room for the same parts it takes the remnant, and two remnants rather than a sheet that holds
/// as much as both.
inline constexpr double kRemnantCostShare = 0.5;
/// The most remnants of a material that are offered; of more, the largest. Each is a shape of its own for the
/// nester.
inline constexpr std::size_t kMostOffered = 48;
/// Returns the free items as stock for a layout: remnants first, each alone under its name; sheets that are
/// alike as one stock with a count, under the name of the first of them.
[[nodiscard]] std::vector<layout::Stock> offered_stock(const std::vector<StockItem>& items);

/// A layout that is to be cut, under the name of its file.
struct LayoutToCut {
  std::string name;
  layout::Document document;
};

/// Finds an item for every copy of a stock on which something lies: the one that the stock's id names, else
/// the first one that is free (or allocated to this order already) and the same: in outline, defects and
/// zones, and in material as far as the item says one. No item is taken twice.
///
/// Fails with ErrorCode::bad_input and one sentence that lists everything: nothing is placed, a layout breaks
/// a rule, a strip, no such item, one that is allocated or cut, and for whom.
[[nodiscard]] Result<std::vector<StockUse>> uses_of(const std::vector<LayoutToCut>& layouts,
                                                    const std::vector<StockItem>& items,
                                                    const std::string& order);

/// Returns the remnants of what an order cuts (layout::remnants_of), without ids.
/// \param items  those that the order uses, among others
[[nodiscard]] std::vector<StockItem> remnants_left(const std::vector<LayoutToCut>& layouts,
                                                   const std::vector<StockUse>& uses,
                                                   const std::vector<StockItem>& items,
                                                   const layout::RemnantRule& rule);

/// The areas of one material, mm^2: added = free + allocated + parts + lost.
struct StockSums {
  layout::Material material;
  double added = 0, free = 0, allocated = 0;
  double parts = 0;  ///< of what was cut
  double lost = 0;   ///< of what was cut, and neither part nor remnant
};
/// Returns the sums by material, in the order of the items.
[[nodiscard]] std::vector<StockSums> sums_of(const StockBook& book);

/// The book as a "lekalo-stock" document (docs/formats.md), ending in a line end.
[[nodiscard]] std::string stock_book_json(const StockBook& book);
/// Rechecks a book through the independent checker, as the bytes of its document.
[[nodiscard]] Result<verify::ClaimReport> check_book(const StockBook& book, const std::string& name);

/// The pieces that are not gone, side by side in rows on one page (draw/layout_picture.hpp), with a line
/// about each. Fails with ErrorCode::bad_input where there are none, and as layout_picture does
/// (jobs/show.hpp).
[[nodiscard]] Result<std::string> stock_picture(const StockBook& book, const std::string& title,
                                                PictureForm form);

}  // namespace lekalo::jobs
