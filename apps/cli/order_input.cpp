#include "order_input.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "layout_input.hpp"
#include "lekalo/disk/file_words.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/formats/order_table.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/bill.hpp"
#include "lekalo/jobs/material.hpp"
#include "lekalo/jobs/order_words.hpp"
#include "lekalo/layout/material_words.hpp"
#include "server/stock/stock_file.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;

std::string shown(const std::string& path) { return path == "-" ? "standard input" : io::as_utf8(path); }

class OrderReader {
 public:
  OrderReader(const OrderSource& source, const std::vector<NamedPath>& outputs)
      : source_(source), outputs_(outputs) {}

  Result<std::vector<jobs::MaterialLayout>> read() {
    order_ = jobs::order_of(source_.terms);
    order_.reading = source_.reading;
    if (auto rules = layer_rules_of(source_.layer_rules))
      order_.reading.layer_rules = *std::move(rules);
    else
      fault(rules.error().message);
    if (!source_.layer_rules.empty()) inputs_.push_back({"--layer-rules", source_.layer_rules});
    if (source_.parts.empty() && source_.table.empty())
      fault("no part is ordered; say --part FILE=N, a folder, a pattern in quotes, or --order TABLE",
            ErrorCode::usage);
    if (source_.terms.stocks.empty() && source_.stock.empty())
      fault(
          "there is no sheet to cut from; say --sheet 3000x1500, --sheet hide.dxf, --strip 1500 or --stock "
          "FILE",
          ErrorCode::usage);
    for (const PartWord& word : source_.parts) {
      io::OrderRow row;
      row.file = word.files;
      row.quantity = word.count.value_or(1);
      row.material = word.material;
      add_parts(row, "");
    }
    if (!source_.table.empty()) add_table();
    for (const jobs::StockWord& word : source_.terms.stocks) add_stock(word);
    if (!source_.stock.empty()) add_stored();
    if (!faults_.empty()) return failure(code_, faults_);
    LEKALO_CHECK(check_outputs(outputs_, inputs_));
    LEKALO_TRY(std::vector<jobs::MaterialLayout> layouts, jobs::open_orders(order_));
    if (layouts.size() > 1) LEKALO_CHECK(check_outputs(outputs_of(layouts), inputs_));
    std::vector<std::string>& notices = layouts.front().layout.notices;
    notices.insert(notices.begin(), notices_.begin(), notices_.end());
    return layouts;
  }

 private:
  [[nodiscard]] std::vector<NamedPath> outputs_of(const std::vector<jobs::MaterialLayout>& layouts) const {
    std::vector<NamedPath> all;
    for (const jobs::MaterialLayout& one : layouts)
      for (const NamedPath& output : outputs_)
        all.push_back({output.option, jobs::path_with(output.path, one.file_word)});
    return all;
  }

  void fault(const std::string& sentence, ErrorCode code = ErrorCode::bad_input) {
    if (faults_.empty()) code_ = code;
    faults_ += (faults_.empty() ? "" : "; ") + sentence;
  }

  /// \param where, more  stand before and behind what is said of a file that cannot be read
  std::optional<jobs::File> file(const char* option, const std::string& path, const std::string& where = {},
                                 const std::string& more = {}) {
    Result<std::string> bytes = disk::read_file(path == "-" ? "/dev/stdin" : path);
    if (!bytes) {
      fault(where + bytes.error().message + more);
      return std::nullopt;
    }
    inputs_.push_back({option, path});
    return jobs::File{shown(path), *std::move(bytes)};
  }

  void add_parts(const io::OrderRow& row, const std::string& folder) {
    const bool near = !folder.empty() && row.file != "-" && fs::path(row.file).is_relative();
    const std::string word = near ? (fs::path(folder) / row.file).string() : row.file;
    const auto files = disk::files_meant(
        word, [](const std::string& name) { return io::drawing_format_by_ending(name) != nullptr; });
    const std::string where = row.said_in.empty() ? "" : row.said_in + ": ";
    const std::string more = row.assembly.empty() ? "" : "; and no line has it as its assembly";
    if (!files) return fault(where + files.error().message + more);
    for (const std::string& path : *files) {
      std::optional<jobs::File> read = file("--part", path, where, more);
      if (!read) continue;
      order_.parts.push_back(jobs::ordered_part(row, *std::move(read), source_.terms));
    }
  }

  void add_table() {
    const std::optional<jobs::File> table = file("--order", source_.table);
    if (!table) return;
    const auto rows = io::read_order(table->bytes, table->name).and_then([&](io::OrderTable read) {
      return jobs::ordered_rows(std::move(read), table->name, source_.terms.builds, "--");
    });
    if (!rows) return fault(rows.error().message, rows.error().code);
    notices_.insert(notices_.end(), rows->notices.begin(), rows->notices.end());
    const std::string folder = source_.table == "-" ? "" : fs::path(source_.table).parent_path().string();
    for (const io::OrderRow& row : rows->rows) add_parts(row, folder);
  }

  void add_stock(const jobs::StockWord& word) {
    jobs::OrderedStock stock;
    stock.size = word.size;
    stock.count = word.count;
    stock.material = word.material;
    if (!stock.size) {
      std::error_code unseen;
      if (word.said != "-" && !fs::exists(word.said, unseen))
        return fault(fmt::format("--sheet: {} is neither a size, as 3000x1500, nor a file that is there",
                                 shown(word.said)));
      std::optional<jobs::File> read = file("--sheet", word.said);
      if (!read) return;
      stock.file = *std::move(read);
    }
    order_.stocks.push_back(std::move(stock));
  }

  void add_stored() {
    const auto items = server::StockFile::open(source_.stock, server::StockOpening::find)
                           .and_then([](server::StockFile file) { return file.items(); });
    if (!items) return fault(items.error().message, items.error().code);
    inputs_.push_back({"--stock", source_.stock});
    order_.in_store = jobs::offered_stock(*items);
    if (order_.in_store.empty())
      fault(fmt::format("{}: no piece in it is free; lekalo stock add adds some", shown(source_.stock)));
  }

  const OrderSource& source_;
  const std::vector<NamedPath>& outputs_;
  jobs::Order order_;
  std::vector<NamedPath> inputs_;
  std::vector<std::string> notices_;
  std::string faults_;
  ErrorCode code_ = ErrorCode::bad_input;
};

}  // namespace

Result<std::vector<jobs::MaterialLayout>> read_order_input(const OrderSource& order,
                                                           const std::vector<NamedPath>& outputs) {
  return OrderReader(order, outputs).read();
}

Result<void> several_need_files(const std::vector<jobs::MaterialLayout>& layouts, const std::string& output) {
  if (layouts.size() == 1 || !output.empty()) return {};
  std::string materials;
  for (const jobs::MaterialLayout& one : layouts)
    materials += (materials.empty() ? "" : "; ") + layout::words_of(one.material);
  return failure(
      ErrorCode::usage,
      fmt::format("the order is of {} materials ({}), and each gets a layout of its own; say --output "
                  "FILE, as in out.json for out-{}.json and the like",
                  layouts.size(), materials, layouts.front().file_word));
}

}  // namespace lekalo::cli
