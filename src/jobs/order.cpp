#include "lekalo/jobs/order.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/formats/order_table.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/material.hpp"
#include "lekalo/layout/job.hpp"
#include "lekalo/layout/material_words.hpp"

namespace lekalo::jobs {
namespace {

/// Says whether a file holds more than outlines.
bool is_layout(const File& file) {
  const auto read = io::read_any_layout(file.bytes, file.name);
  return read && !read->document.stocks.empty();
}

struct PartsRead {
  std::string sha256;
  Result<io::PartsFile> parts = io::PartsFile{};
};

/// A layout in the making.
struct MadeOf {
  MaterialLayout of;
  std::set<std::string> said;  ///< all notices, each of which is said once
  layout::FreeIds part_ids, stock_ids;
  std::string first_part;  ///< where the first of its parts is ordered
};

class OrderMaker {
 public:
  explicit OrderMaker(const Order& order) : order_(order) {}

  Result<std::vector<MaterialLayout>> make() {
    LEKALO_CHECK(said_enough());
    read_parts();
    tell_materials_apart();
    for (std::size_t i = 0; i < order_.parts.size(); ++i)
      take(order_.parts[i], read_[i], materials_[i], *made_of(materials_[i]));
    for (std::size_t i = 0; i < order_.stocks.size(); ++i)
      take(order_.stocks[i], materials_[order_.parts.size() + i]);
    for (std::size_t i = 0; i < order_.in_store.size(); ++i)
      take_stored(order_.in_store[i], materials_[order_.parts.size() + order_.stocks.size() + i]);
    if (!order_.adds)
      for (const MadeOf& made : made_) stock_is_there(made);
    if (!order_.adds) rules();
    if (!faults_.empty()) return failure(ErrorCode::bad_input, faults_);
    return layouts();
  }

 private:
  [[nodiscard]] Result<void> said_enough() const {
    if (order_.adds && (!order_.parts.empty() || !order_.stocks.empty())) return {};
    std::string missing;
    if (order_.parts.empty()) missing = "no part is ordered";
    if (order_.stocks.empty() && order_.in_store.empty())
      missing += std::string(missing.empty() ? "" : ", and ") + "there is no sheet to cut from";
    if (missing.empty()) return {};
    return failure(ErrorCode::usage, missing);
  }

  void fault(const std::string& sentence) { faults_ += (faults_.empty() ? "" : "; ") + sentence; }

  static void notices(std::vector<std::string>& said, MadeOf& made) {
    for (std::string& notice : said)
      if (made.said.insert(notice).second) made.of.layout.notices.push_back(std::move(notice));
  }

  /// Reads every file for itself, which is most of the time that an order takes.
  void read_parts() {
    read_.resize(order_.parts.size());
    share_out(read_.size(), kUsualThreads, [this](std::size_t i) {
      const File& file = order_.parts[i].file;
      read_[i] = {io::sha256(file.bytes), io::read_parts(file.bytes, file.name, order_.reading)};
    });
  }

  /// An order that adds to a layout is one, whatever it is of: that layout says what it leaves unsaid.
  void tell_materials_apart() {
    for (const OrderedPart& part : order_.parts) materials_.push_back(part.material);
    for (const OrderedStock& stock : order_.stocks) materials_.push_back(stock.material);
    for (const layout::Stock& stock : order_.in_store) materials_.push_back(stock.material);
    if (order_.adds) {
      made_.emplace_back();
      return;
    }
    share_materials(materials_);
    for (std::size_t i = 0; i < order_.parts.size(); ++i) {
      if (!numbers_.emplace(key_of(materials_[i]), made_.size()).second) continue;
      MadeOf& made = made_.emplace_back();
      made.of.material = materials_[i];
      made.first_part = place_of(order_.parts[i]);
    }
  }

  using Key = std::pair<std::string, std::int64_t>;
  static Key key_of(const layout::Material& material) { return {material.name, material.thickness}; }

  static std::string place_of(const OrderedPart& ordered) {
    return ordered.said_in.empty() ? ordered.file.name : ordered.said_in;
  }

  /// The layout of a material, or nullptr where no part is of it.
  MadeOf* made_of(const layout::Material& material) {
    if (order_.adds) return &made_.front();
    const auto found = numbers_.find(key_of(material));
    return found == numbers_.end() ? nullptr : &made_[found->second];
  }

  void take(const OrderedPart& ordered, PartsRead& part_file, const layout::Material& material,
            MadeOf& made) {
    made.of.layout.inputs.push_back({"part", ordered.file.name, std::move(part_file.sha256)});
    Result<io::PartsFile>& read = part_file.parts;
    if (!read)
      return fault(is_layout(ordered.file)
                       ? ordered.file.name +
                             ": is a layout or a job already, with sheets and rules of its own; give it alone"
                       : read.error().message);
    notices(read->notices, made);
    const std::string name =
        ordered.name.empty() ? io::clean_text(io::stem_of(ordered.file.name)) : io::clean_text(ordered.name);
    for (layout::Part& part : read->parts) {
      if (part.demand > limits::kMostCount / ordered.quantity)
        return fault(fmt::format(
            "{}: {} has an outline {} times, and {} times that is more than the {} pieces "
            "that a part may be wanted",
            place_of(ordered), ordered.file.name, part.demand, ordered.quantity, limits::kMostCount));
      part.id = made.part_ids.take(name.empty() ? "part" : name);
      part.name.clear();
      part.demand *= ordered.quantity;
      part.rotations = ordered.rotations;
      part.may_mirror = ordered.may_mirror;
      part.grain = ordered.grain;
      part.priority = ordered.priority;
      part.material = material;
      part.purpose = ordered.purpose;
      made.of.layout.document.parts.push_back(std::move(part));
    }
  }

  void take(const OrderedStock& ordered, const layout::Material& material) {
    MadeOf* const made = made_of(material);
    if (made == nullptr) {
      std::vector<std::string> notice{
          material.is_said() ? fmt::format("nothing is cut from the sheet of {}", words_of(material))
                             : "nothing is cut from the sheet that says no material"};
      return notices(notice, made_.front());
    }
    std::int64_t pieces = 0;
    for (const layout::Part& part : made->of.layout.document.parts) pieces += part.demand;
    const std::int64_t enough = order_.adds ? 0 : std::clamp<std::int64_t>(pieces, 1, limits::kMostCount);
    const std::int64_t count = ordered.count.value_or(enough);
    if (!ordered.size) return take_drawn(ordered.file, count, material, *made);
    const std::int64_t height = geom::grid_from_mm(ordered.size->height_mm);
    const bool strip = ordered.size->width_mm == 0;
    add(strip ? layout::strip_of(height)
              : layout::sheet_of(geom::grid_from_mm(ordered.size->width_mm), height, count),
        material, *made);
  }

  void take_drawn(const File& file, std::int64_t count, const layout::Material& material, MadeOf& made) {
    made.of.layout.inputs.push_back({"sheet", file.name, io::sha256(file.bytes)});
    auto read = io::read_stocks(file.bytes, file.name, order_.reading);
    if (!read) return fault(read.error().message);
    notices(read->notices, made);
    for (layout::Stock& stock : read->stocks) {
      stock.count = count;
      stock.cost = geom::area_mm2(stock.outline.polygon) * 1e-6;
      add(std::move(stock), material, made);
    }
  }

  /// A stock file has material that no order needs, of which nothing is said.
  void take_stored(const layout::Stock& stock, const layout::Material& material) {
    if (MadeOf* const made = made_of(material); made != nullptr) add(stock, material, *made);
  }

  void add(layout::Stock stock, const layout::Material& material, MadeOf& made) {
    stock.id = made.stock_ids.take(stock.id);
    if (!stock.grain_degrees) stock.grain_degrees = order_.grain_degrees;
    stock.material = material;
    made.of.layout.document.stocks.push_back(std::move(stock));
  }

  void stock_is_there(const MadeOf& made) {
    const auto begin = materials_.begin() + static_cast<std::ptrdiff_t>(order_.parts.size());
    if (std::find(begin, materials_.end(), made.of.material) != materials_.end()) return;
    std::string there;
    for (auto one = begin; one != materials_.end(); ++one)
      if (std::find(begin, one, *one) == one) there += (there.empty() ? "" : "; ") + words_of(*one);
    const std::string way_out =
        made.of.material.is_said() && !order_.in_store.empty()
            ? "add some to the stock file, as in lekalo stock add FILE --sheet 3000x1500@" +
                  order_word_of(made.of.material)
        : made.of.material.is_said()
            ? "say it behind a sheet, as in 3000x1500@" + order_word_of(made.of.material)
            : "say what it is of, in the columns material and thickness, or as in side.dxf@steel:2";
    fault(fmt::format("{}: there is no sheet of {}; {} (there are sheets of: {})", made.first_part,
                      words_of(made.of.material), way_out, there));
  }

  void rules() {
    const double gap = std::max(order_.gap_mm, order_.kerf_mm);
    for (MadeOf& made : made_) {
      if (gap > order_.gap_mm)
        made.of.layout.notices.push_back(fmt::format(
            "the gap of {:g} mm is narrower than the cut; it is raised to {:g} mm", order_.gap_mm, gap));
      made.of.layout.document.rules = {geom::grid_from_mm_up(gap), geom::grid_from_mm_up(order_.border_mm), 0,
                                       geom::grid_from_mm_up(order_.kerf_mm)};
    }
  }

  std::vector<MaterialLayout> layouts() {
    std::vector<MaterialLayout> all;
    std::vector<layout::Material> materials;
    for (MadeOf& made : made_) {
      materials.push_back(made.of.material);
      all.push_back(std::move(made.of));
    }
    if (all.size() == 1) return all;
    const std::vector<std::string> words = file_words(materials);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].file_word = words[i];
      all[i].layout.document.name = io::kept_text(words_of(materials[i])).value_or(words[i]);
    }
    return all;
  }

  const Order& order_;
  std::vector<PartsRead> read_;
  std::vector<layout::Material> materials_;  ///< of the parts, then of the stocks
  std::map<Key, std::size_t> numbers_;       ///< of the materials of parts, in made_
  std::vector<MadeOf> made_;
  std::string faults_;
};

}  // namespace

Result<std::vector<MaterialLayout>> open_orders(const Order& order) { return OrderMaker(order).make(); }

Result<Layout> open_order(const Order& order) {
  LEKALO_TRY(std::vector<MaterialLayout> layouts, open_orders(order));
  if (layouts.size() == 1) return std::move(layouts.front().layout);
  std::string materials;
  for (const MaterialLayout& one : layouts)
    materials += (materials.empty() ? "" : "; ") + words_of(one.material);
  return failure(ErrorCode::bad_input,
                 fmt::format("the order is of {} materials, and each needs a layout of its "
                             "own; order them one by one: {}",
                             layouts.size(), materials));
}

}  // namespace lekalo::jobs
