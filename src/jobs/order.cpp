#include "lekalo/jobs/order.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "lekalo/base/parallel.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/layout/job.hpp"

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

class OrderMaker {
 public:
  explicit OrderMaker(const Order& order) : order_(order) {}

  Result<Layout> make() {
    LEKALO_CHECK(said_enough());
    read_parts();
    for (std::size_t i = 0; i < order_.parts.size(); ++i) take(order_.parts[i], read_[i]);
    std::int64_t pieces = 0;
    for (const layout::Part& part : made_.document.parts) pieces += part.demand;
    for (const OrderedStock& stock : order_.stocks)
      take(stock, order_.adds ? 0 : std::max<std::int64_t>(pieces, 1));
    if (!order_.adds) rules();
    if (!faults_.empty()) return failure(ErrorCode::bad_input, faults_);
    return std::move(made_);
  }

 private:
  [[nodiscard]] Result<void> said_enough() const {
    if (order_.adds && (!order_.parts.empty() || !order_.stocks.empty())) return {};
    std::string missing;
    if (order_.parts.empty()) missing = "no part is ordered";
    if (order_.stocks.empty())
      missing += std::string(missing.empty() ? "" : ", and ") + "there is no sheet to cut from";
    if (missing.empty()) return {};
    return failure(ErrorCode::usage, missing);
  }

  void fault(const std::string& sentence) { faults_ += (faults_.empty() ? "" : "; ") + sentence; }

  void notices(std::vector<std::string>& said) {
    for (std::string& notice : said)
      if (said_.insert(notice).second) made_.notices.push_back(std::move(notice));
  }

  /// Reads every file for itself, which is most of the time that an order takes.
  void read_parts() {
    read_.resize(order_.parts.size());
    share_out(read_.size(), kUsualThreads, [this](std::size_t i) {
      const File& file = order_.parts[i].file;
      read_[i] = {io::sha256(file.bytes), io::read_parts(file.bytes, file.name, order_.reading)};
    });
  }

  void take(const OrderedPart& ordered, PartsRead& part_file) {
    made_.inputs.push_back({"part", ordered.file.name, std::move(part_file.sha256)});
    Result<io::PartsFile>& read = part_file.parts;
    if (!read)
      return fault(is_layout(ordered.file)
                       ? ordered.file.name +
                             ": is a layout or a job already, with sheets and rules of its own; give it alone"
                       : read.error().message);
    notices(read->notices);
    const std::string name =
        ordered.name.empty() ? io::clean_text(io::stem_of(ordered.file.name)) : io::clean_text(ordered.name);
    for (layout::Part& part : read->parts) {
      part.id = part_ids_.take(name.empty() ? "part" : name);
      part.name.clear();
      part.demand *= ordered.quantity;
      part.rotations = ordered.rotations;
      part.may_mirror = ordered.may_mirror;
      part.grain = ordered.grain;
      part.priority = ordered.priority;
      made_.document.parts.push_back(std::move(part));
    }
  }

  void take(const OrderedStock& ordered, std::int64_t enough) {
    const std::int64_t count = ordered.count.value_or(enough);
    if (!ordered.size) return take_drawn(ordered.file, count);
    const std::int64_t height = geom::grid_from_mm(ordered.size->height_mm);
    const bool strip = ordered.size->width_mm == 0;
    add(strip ? layout::strip_of(height)
              : layout::sheet_of(geom::grid_from_mm(ordered.size->width_mm), height, count));
  }

  void take_drawn(const File& file, std::int64_t count) {
    made_.inputs.push_back({"sheet", file.name, io::sha256(file.bytes)});
    auto read = io::read_stocks(file.bytes, file.name, order_.reading);
    if (!read) return fault(read.error().message);
    notices(read->notices);
    for (layout::Stock& stock : read->stocks) {
      stock.count = count;
      stock.cost = geom::area_mm2(stock.outline.polygon) * 1e-6;
      add(std::move(stock));
    }
  }

  void add(layout::Stock stock) {
    stock.id = stock_ids_.take(stock.id);
    stock.grain_degrees = order_.grain_degrees;
    made_.document.stocks.push_back(std::move(stock));
  }

  void rules() {
    const double gap = std::max(order_.gap_mm, order_.kerf_mm);
    if (gap > order_.gap_mm)
      made_.notices.push_back(fmt::format(
          "the gap of {:g} mm is narrower than the cut; it is raised to {:g} mm", order_.gap_mm, gap));
    made_.document.rules = {geom::grid_from_mm_up(gap), geom::grid_from_mm_up(order_.border_mm), 0,
                            geom::grid_from_mm_up(order_.kerf_mm)};
  }

  const Order& order_;
  std::vector<PartsRead> read_;
  Layout made_;
  std::set<std::string> said_;  ///< all notices, each of which is said once
  layout::FreeIds part_ids_, stock_ids_;
  std::string faults_;
};

}  // namespace

Result<Layout> open_order(const Order& order) { return OrderMaker(order).make(); }

}  // namespace lekalo::jobs
