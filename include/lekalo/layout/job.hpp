#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// The job is what is cut, from what, and by which rules: the parts, stocks, kits and rules of a document.
/// This is how it changes while things lie on it; docs/design/layout-commands.md.

/// A part, stock or kit that comes (no `before`), goes (no `after`) or becomes another. Its `index` counts in
/// the list that has both what goes and what comes.
template <class Item>
struct ItemChange {
  std::uint32_t index = 0;
  std::optional<Item> before, after;
  [[nodiscard]] const Item& either() const { return after ? *after : *before; }
  friend bool operator==(const ItemChange&, const ItemChange&) = default;
};

struct RulesChange {
  Rules before, after;
  friend bool operator==(const RulesChange&, const RulesChange&) = default;
};

/// The changes of a job, each list ascending by index. First comes what comes, at its index; then placements
/// and features are changed, which name parts and stocks as they are numbered at that moment; last goes what
/// goes. So the same numbers serve for the way there and the way back. Kits name parts by those numbers too.
struct JobChange {
  std::vector<ItemChange<Part>> parts;
  std::vector<ItemChange<Stock>> stocks;
  std::optional<RulesChange> rules;
  std::vector<ItemChange<Kit>> kits = {};
  [[nodiscard]] bool is_nothing() const noexcept {
    return parts.empty() && stocks.empty() && !rules && kits.empty();
  }
  friend bool operator==(const JobChange&, const JobChange&) = default;
};

[[nodiscard]] JobChange reversed(const JobChange& change);

/// Puts in what comes, puts what becomes another in its place, and sets the rules. Placements and the other
/// kits name the same parts and stocks as before. Cost: O(document) where something comes that is not the
/// last of its list. \pre can_bring_in
void bring_in(Document& document, const JobChange& change);
/// Takes out what goes.
/// \pre bring_in was called, and can_take_out
void take_out(Document& document, const JobChange& change);
/// Returns the kits with the numbers that parts have when what comes is there.
[[nodiscard]] std::vector<Kit> kits_beside(const Document& document, const JobChange& change);
/// Says whether everything is as a change says it was before, what comes has an id of its own, and kits name
/// parts that are there.
[[nodiscard]] bool can_bring_in(const Document& document, const JobChange& change);
/// Says whether no placement names what goes, and no kit that stays.
/// \pre bring_in was called
[[nodiscard]] bool can_take_out(const Document& document, const JobChange& change);

/// The most parts and the most stocks of a document.
inline constexpr std::size_t kMostItems = 100'000;

/// Parts and stocks that are to come into a layout. Their ids are what they would like to be called; a stock
/// whose count is 0 is there as often as may be needed, once for every piece that is wanted.
struct Additions {
  std::vector<Part> parts;
  std::vector<Stock> stocks;
};
/// Returns the change that brings them in behind those that are there, with ids that are free: "lid", or
/// "lid-2". Where all parts of the layout have one grain, those that come without one get it too, and stocks
/// likewise; and what comes without a material gets that of the others where they have one.
[[nodiscard]] JobChange added(const Document& document, Additions additions);

/// Gives ids that nothing else has: a name, then the name with -2, -3 behind it.
class FreeIds {
 public:
  void keep(const std::string& id) { taken_.insert(id); }
  [[nodiscard]] std::string take(const std::string& wanted);

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> last_of_;
};

/// A rectangle, its sides in steps, called after its size. It costs what it holds, so that a small one is
/// taken where it is enough.
[[nodiscard]] Stock sheet_of(std::int64_t width, std::int64_t height, std::int64_t count);
/// A strip of open length, called after its width.
[[nodiscard]] Stock strip_of(std::int64_t width);

}  // namespace lekalo::layout
