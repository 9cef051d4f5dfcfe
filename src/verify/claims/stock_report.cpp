#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "layout_claims.hpp"
#include "report_fields.hpp"
#include "same_layout.hpp"

namespace lekalo::verify {
namespace {

/// A cost is a share by a quotient of two areas.
constexpr double kCostRounding = 1e-12;

/// Twice the area, in square steps; sums of a million outlines fit.
Wide twice_area_of(const GridOutline& outline) {
  Wide sum = 0;
  for (const GridEdge& e : outline.edges) sum += Wide{e.from.x} * e.to.y - Wide{e.to.x} * e.from.y;
  return sum;
}

double mm2_of(Wide twice_steps) { return static_cast<double>(twice_steps) * 0x1p-41; }

GridOutline moved_outline(GridOutline outline, GridPoint by) {
  for (GridEdge& edge : outline.edges)
    edge = {{edge.from.x + by.x, edge.from.y + by.y}, {edge.to.x + by.x, edge.to.y + by.y}};
  outline.box = {outline.box.low_x + by.x, outline.box.low_y + by.y, outline.box.high_x + by.x,
                 outline.box.high_y + by.y};
  return outline;
}

/// The smallest remnant that is kept: a rectangle, or an area of whole mm^2.
struct WrittenRule {
  std::int64_t width = 0, height = 0, area_mm2 = 0;
};

struct WrittenItem {
  std::string id, state;
  std::optional<std::string> order, from;
  GridPoint at;
  GridBox rectangle{};
  double cost = 0;
};

/// A part where it lies, and how far a remnant stays from it.
struct PartOnItem {
  GridOutline outline;
  std::int64_t gap;
};

/// An item as an order uses it.
struct ItemUse {
  std::string order, state;
  WrittenRule rule;
  std::vector<PartOnItem> parts;
};

/// The areas of one material.
struct AreaSums {
  WrittenMaterial material;
  Wide added = 0, free = 0, allocated = 0, parts = 0, cut = 0, remnants = 0;
};

class StockReport {
 public:
  StockReport(const Document& report, Json root) : report_(report), fields_(root, "", complaint_) {}

  Result<ClaimReport> recheck() {
    check_format(fields_, "lekalo-stock", complaint_);
    fields_.each("inputs", [&](Json, const std::string& path) {
      fields_.complain(fmt::format("{}: a stock is made of no other file", path));
    });
    (void)read_rule(fields_.get("remnant_min"), "remnant_min");
    LEKALO_CHECK(read_items());
    LEKALO_CHECK(read_orders());
    for (std::size_t i = 0; i < items_.size(); ++i) {
      compare_state(i);
      if (items_[i].from) compare_remnant(i);
    }
    compare_siblings();
    compare_area_sums();
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    claims_.notes.push_back(fmt::format("{} items and {} orders were rechecked", items_.size(), orders_));
    return std::move(claims_);
  }

 private:
  [[nodiscard]] Result<void> fine() const {
    if (complaint_.empty()) return {};
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, complaint_));
  }

  void find(const std::string& sentence) { claims_.findings.push_back(sentence); }

  static std::optional<std::string> text_or_null(ReportFields& fields, std::string_view key) {
    if (fields.get(key).is_null()) return std::nullopt;
    return fields.text(key);
  }

  /// Lengths that are whole steps.
  template <std::size_t N>
  std::array<std::int64_t, N> steps(ReportFields& fields, std::string_view key) {
    std::array<std::int64_t, N> whole{};
    const std::array<double, N> written = fields.numbers<N>(key);
    for (std::size_t i = 0; i < N; ++i) whole[i] = step_of(written[i], fields, key);
    return whole;
  }
  static std::int64_t step_of(double mm, ReportFields& fields, std::string_view key) {
    const auto step = steps_of(mm, ToStep::nearest, 1e6);
    if (step && static_cast<double>(*step) * kStep == mm) return *step;
    fields.complain(fmt::format("field {} has a length that is no whole number of steps", fields.name(key)));
    return 0;
  }

  WrittenRule read_rule(Json value, const std::string& path) {
    ReportFields fields(value, path, complaint_);
    WrittenRule rule;
    if (fields.has("area_mm2")) {
      rule.area_mm2 = static_cast<std::int64_t>(fields.index("area_mm2"));
    } else {
      rule.width = step_of(fields.number("width"), fields, "width");
      rule.height = step_of(fields.number("height"), fields, "height");
    }
    if (rule.area_mm2 <= 0 && (rule.width <= 0 || rule.height <= 0))
      fields.complain(fmt::format("field {} is no size and no area", path));
    fields.refuse_others();
    return rule;
  }

  /// The pieces of material are read as the stocks of a layout.
  Result<void> read_items() {
    std::string layout = R"({"format":"lekalo-layout/1","units":"mm","stocks":[)";
    fields_.each("items", [&](Json value, const std::string& path) {
      ReportFields fields(value, path, complaint_);
      WrittenItem item;
      item.id = fields.text("id"), item.state = fields.text("state");
      item.order = text_or_null(fields, "order"), item.from = text_or_null(fields, "from");
      if (item.from) {
        const auto at = steps<2>(fields, "at");
        const auto box = steps<4>(fields, "rectangle");
        item.at = {at[0], at[1]}, item.rectangle = {box[0], box[1], box[2], box[3]};
      } else if (!fields.get("at").is_null() || !fields.get("rectangle").is_null()) {
        fields.complain(fmt::format("{} has a place in no sheet", path));
      }
      item.cost = fields.number("cost");
      areas_.push_back(fields.number("area_mm2"));
      if (!numbers_.emplace(item.id, items_.size()).second)
        fields.complain(fmt::format("{} has the id of another item", path));
      if (!items_.empty()) layout += ',';
      layout += fields.get("stock").text;
      items_.push_back(std::move(item));
      fields.refuse_others();
    });
    LEKALO_CHECK(fine());
    layout += "]}";
    LEKALO_TRY(WrittenLayout read, read_layout({report_.name + ": items", layout}));
    stocks_ = std::move(read.stocks);
    if (stocks_.size() != items_.size()) fields_.complain("an item has not one stock");
    LEKALO_CHECK(fine());
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const WrittenStock& stock = stocks_[i];
      const std::string& id = items_[i].id;
      if (stock.id != id || stock.count != 1 || stock.kind == "strip")
        find(id + ": its stock is another piece");
      if (stock.cost != items_[i].cost) find(id + ": its cost is not that of its stock");
      if (areas_[i] != mm2_of(twice_area_of(stock.outline)))
        find(fmt::format("{}: area_mm2 is {} and is to be {}", id, areas_[i],
                         mm2_of(twice_area_of(stock.outline))));
      // (An empty id begins with its end.)
      if (id[0] != (items_[i].from ? 'R' : 'S')) find(id + ": its id is not that of such an item");
    }
    return {};
  }

  Result<void> read_orders() {
    std::set<std::string> ids;
    Result<void> fault;
    fields_.each("orders", [&](Json value, const std::string& path) {
      ReportFields fields(value, path, complaint_);
      ItemUse use;
      use.order = fields.text("id"), use.state = fields.text("state");
      if (use.order.empty()) fields.complain(fmt::format("field {}.id is empty", path));
      if (!ids.insert(use.order).second) fields.complain(fmt::format("{} has the id of another order", path));
      const Json rule = fields.get("remnant_min");
      if (use.state == "cut")
        use.rule = read_rule(rule, path + ".remnant_min");
      else if ((use.state != "allocated" && use.state != "cancelled") || !rule.is_null())
        fields.complain(fmt::format("field {}.state is not what such an order says", path));
      std::size_t layouts = 0;
      fields.each("layouts", [&](Json layout, const std::string& place) {
        ++layouts;
        if (fault) fault = read_layout_of(use, layout, place);
      });
      if ((layouts == 0) != (use.state == "cancelled"))
        find(fmt::format("order {}: it is {} and has {} layouts", excerpt(use.order), use.state, layouts));
      fields.refuse_others();
      ++orders_;
    });
    LEKALO_CHECK(fault);
    return fine();
  }

  Result<void> read_layout_of(const ItemUse& use, Json value, const std::string& path) {
    ReportFields fields(value, path, complaint_);
    const Document document{report_.name + ": " + path, fields.get("layout").text};
    LEKALO_CHECK(fine());
    LEKALO_TRY(const WrittenLayout layout, read_layout(document));
    LEKALO_TRY(const LayoutVerdict verdict, verify_layout(document));
    for (const std::string& sentence : sentences(verdict.violations))
      find(fmt::format("order {}: {}", excerpt(use.order), sentence));
    std::map<std::pair<std::string, std::int64_t>, std::vector<PartOnItem>> parts;
    for (const WrittenPiece& piece : layout.placements) {
      const WrittenPart& part = layout.parts[piece.part];
      parts[{layout.stocks[piece.stock].id, piece.copy}].push_back(
          {placed_outline(part.outline, piece), std::max(part.gap, layout.kerf)});
    }
    fields.each("sheets", [&](Json sheet, const std::string& place) {
      ReportFields of(sheet, place, complaint_);
      const std::string stock = of.text("stock"), item = of.text("item");
      const auto copy = static_cast<std::int64_t>(of.index("copy"));
      of.refuse_others();
      const auto found = parts.find({stock, copy});
      if (found == parts.end())
        return find(fmt::format("order {}: nothing lies on {} #{}, which {} is said to be",
                                excerpt(use.order), excerpt(stock), copy + 1, excerpt(item)));
      ItemUse mine = use;
      mine.parts = std::move(found->second);
      parts.erase(found);
      use_item(item, layout, stock, std::move(mine));
    });
    for (const auto& [sheet, lying] : parts)
      find(fmt::format("order {}: no item is said to be {} #{}", excerpt(use.order), excerpt(sheet.first),
                       sheet.second + 1));
    fields.refuse_others();
    return fine();
  }

  void use_item(const std::string& id, const WrittenLayout& layout, const std::string& stock, ItemUse use) {
    const auto number = numbers_.find(id);
    if (number == numbers_.end())
      return find(fmt::format("order {}: there is no item {}", use.order, excerpt(id)));
    const auto drawn = std::find_if(layout.stocks.begin(), layout.stocks.end(),
                                    [&](const WrittenStock& one) { return one.id == stock; });
    const WrittenStock& item = stocks_[number->second];
    const bool material =
        (item.material.name.empty() || item.material.name == drawn->material.name) &&
        (item.material.thickness == 0 || item.material.thickness == drawn->material.thickness);
    if (!material || loops_of(item.outline) != loops_of(drawn->outline) ||
        !same_features_moved(item.defects, drawn->defects, {}) ||
        !same_features_moved(item.zones, drawn->zones, {}))
      find(fmt::format("order {}: {} is not the stock {} of its layout", use.order, id, excerpt(stock)));
    if (const auto before = uses_.find(id); before != uses_.end())
      find(fmt::format("{} is used twice, by order {} and by order {}", id, before->second.order, use.order));
    uses_[id] = std::move(use);
  }

  static bool same_features_moved(const std::vector<WrittenStockFeature>& a,
                                  const std::vector<WrittenStockFeature>& b, GridPoint by) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const WrittenStockFeature& p, const WrittenStockFeature& q) {
                        return p.id == q.id && p.grade == q.grade &&
                               loops_of(moved_outline(p.outline, by)) == loops_of(q.outline);
                      });
  }

  void compare_state(std::size_t i) {
    const WrittenItem& item = items_[i];
    const auto use = uses_.find(item.id);
    const std::string state = use == uses_.end() ? "free" : use->second.state;
    if (item.state != state)
      find(fmt::format("{}: state is {} and is to be {}", item.id, excerpt(item.state), state));
    if (item.order != (use == uses_.end() ? std::nullopt : std::optional(use->second.order)))
      find(item.id + ": order is not the one that uses it");
  }

  void compare_remnant(std::size_t i) {
    const WrittenItem& item = items_[i];
    const auto use = uses_.find(*item.from);
    // The sheet is an item, as it is used, and comes before this one, so that nothing is a remnant of itself.
    if (use == uses_.end() || use->second.state != "cut" || numbers_.at(*item.from) >= i)
      return find(fmt::format("{}: it is a remnant of {}, which was not cut", item.id, excerpt(*item.from)));
    const std::size_t number = numbers_.at(*item.from);
    const WrittenStock &sheet = stocks_[number], &stock = stocks_[i];
    const GridOutline outline = moved_outline(stock.outline, item.at);
    if (have_common_disc({&outline}, {&sheet.outline}))
      find(fmt::format("{}: it reaches beyond {}", item.id, *item.from));
    for (const PartOnItem& part : use->second.parts)
      if (have_common_disc({&outline, &part.outline}, {}) ||
          edges_nearer_than(outline, part.outline, part.gap)) {
        find(
            fmt::format("{}: it is nearer than the gap to a part that was cut from {}", item.id, *item.from));
        break;
      }
    compare_rule(item, stock, use->second.rule);
    if (stock.material != sheet.material || stock.kind != sheet.kind || stock.grain != sheet.grain)
      find(fmt::format("{}: it is of another material than {}", item.id, *item.from));
    if (!same_features_moved(met(sheet.defects, outline), stock.defects, {-item.at.x, -item.at.y}) ||
        !same_features_moved(met(sheet.zones, outline), stock.zones, {-item.at.x, -item.at.y}))
      find(fmt::format("{}: its defects and zones are not those of {} that meet it", item.id, *item.from));
    const double share = static_cast<double>(twice_area_of(stock.outline)) /
                         static_cast<double>(twice_area_of(sheet.outline)),
                 cost = items_[number].cost * share;
    if (!(std::abs(item.cost - cost) <= kCostRounding * cost))
      find(fmt::format("{}: cost is {} and is to be {}", item.id, item.cost, cost));
    remnants_[*item.from].push_back({item.id, outline});
  }

  void compare_rule(const WrittenItem& item, const WrittenStock& stock, const WrittenRule& rule) {
    const GridBox& box = item.rectangle;
    if (!(box.low_x < box.high_x && box.low_y < box.high_y)) {
      if (rule.area_mm2 == 0 || box.low_x != box.high_x || box.low_y != box.high_y)
        return find(item.id + ": rectangle is no rectangle");
    } else {
      const GridOutline rectangle = make_outline({{{box.low_x, box.low_y},
                                                   {box.high_x, box.low_y},
                                                   {box.high_x, box.high_y},
                                                   {box.low_x, box.high_y}}});
      if (have_common_disc({&rectangle}, {&stock.outline})) find(item.id + ": rectangle does not lie in it");
    }
    const std::int64_t width = box.high_x - box.low_x, height = box.high_y - box.low_y;
    const bool fits = rule.area_mm2 > 0 ? twice_area_of(stock.outline) >= (Wide{rule.area_mm2} << 41)
                                        : (width >= rule.width && height >= rule.height) ||
                                              (width >= rule.height && height >= rule.width);
    if (!fits) find(item.id + ": it is smaller than remnant_min of its order");
  }

  static std::vector<WrittenStockFeature> met(const std::vector<WrittenStockFeature>& features,
                                              const GridOutline& outline) {
    std::vector<WrittenStockFeature> list;
    for (const WrittenStockFeature& feature : features)
      if (have_common_disc({&outline, &feature.outline}, {})) list.push_back(feature);
    return list;
  }

  void compare_siblings() {
    for (const auto& [from, list] : remnants_)
      for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (have_common_disc({&list[i].second, &list[k].second}, {}))
            find(fmt::format("{} and {} overlap", list[k].first, list[i].first));
  }

  void compare_area_sums() {
    std::vector<AreaSums> all;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      auto sums = std::find_if(all.begin(), all.end(),
                               [&](const AreaSums& one) { return one.material == stocks_[i].material; });
      if (sums == all.end()) sums = all.insert(sums, AreaSums{stocks_[i].material});
      const Wide area = twice_area_of(stocks_[i].outline);
      (items_[i].from ? sums->remnants : sums->added) += area;
      const auto use = uses_.find(items_[i].id);
      if (use == uses_.end()) {
        sums->free += area;
      } else if (use->second.state != "cut") {
        sums->allocated += area;
      } else {
        sums->cut += area;
        for (const PartOnItem& part : use->second.parts) sums->parts += twice_area_of(part.outline);
      }
    }
    compare_items(fields_, "sums", all.size(), claims_, [&](ReportFields& item, std::size_t i) {
      const AreaSums& sums = all[i];
      if (text_or_null(item, "material").value_or("") != sums.material.name)
        find(item.name("material") + " is that of no such item");
      const double thickness = item.number_or_null("thickness").value_or(0);
      if (thickness != static_cast<double>(sums.material.thickness) * kStep)
        find(item.name("thickness") + " is that of no such item");
      compare(item, "added_mm2", mm2_of(sums.added), claims_);
      compare(item, "free_mm2", mm2_of(sums.free), claims_);
      compare(item, "allocated_mm2", mm2_of(sums.allocated), claims_);
      compare(item, "parts_mm2", mm2_of(sums.parts), claims_);
      compare(item, "lost_mm2", mm2_of(sums.cut - sums.parts - sums.remnants), claims_);
    });
  }

  const Document& report_;
  std::string complaint_;
  ReportFields fields_;
  ClaimReport claims_;
  std::vector<WrittenItem> items_;
  std::vector<double> areas_;
  std::vector<WrittenStock> stocks_;  ///< by item
  std::map<std::string, std::size_t> numbers_;
  std::map<std::string, ItemUse> uses_;  ///< by the id of the item
  std::map<std::string, std::vector<std::pair<std::string, GridOutline>>>
      remnants_;  ///< by that of their sheet
  std::size_t orders_ = 0;
};

}  // namespace

Result<ClaimReport> verify_stock(const Document& stock) {
  LEKALO_TRY(const Json root, parse_json(stock.bytes, stock.name));
  return StockReport(stock, root).recheck();
}

}  // namespace lekalo::verify
