#include "order_form.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "lekalo/io/text/excerpt.hpp"
#include "lekalo/jobs/bill.hpp"
#include "lekalo/jobs/order_words.hpp"
#include "multipart.hpp"

namespace lekalo::server {
namespace {

class OrderForm {
 public:
  explicit OrderForm(bool adds) : adds_(adds) {}

  Result<jobs::Layout> layout(std::string_view body) {
    LEKALO_TRY(const std::vector<FormField> fields, read_form(body));
    for (const FormField& field : fields) take(field);
    const auto terms = jobs::read_order_words(words_, "");
    if (!terms) fault(terms.error().message);
    if (!faults_.empty()) return failure(ErrorCode::bad_input, faults_);
    jobs::Order order = jobs::order_of(*terms);
    order.adds = adds_;
    std::vector<std::string> notices;
    add_parts(*terms, order, notices);
    for (const jobs::StockWord& word : terms->stocks) add_stock(word, order);
    for (const auto& [name, file] : files_)
      if (!file.is_used)
        fault(fmt::format("{} came along and is neither a part of the table nor a sheet", name));
    if (!faults_.empty()) return failure(ErrorCode::bad_input, faults_);
    LEKALO_TRY(jobs::Layout made, jobs::open_order(order));
    made.notices.insert(made.notices.begin(), notices.begin(), notices.end());
    return made;
  }

 private:
  struct Sent {
    std::string_view bytes;
    bool is_used = false;
  };

  void fault(const std::string& sentence) { faults_ += (faults_.empty() ? "" : "; ") + sentence; }

  void take(const FormField& field) {
    const std::string value(field.value.substr(0, kLongestWord));
    if (field.name == "file" && !field.file.empty()) {
      if (!files_.emplace(field.file, Sent{field.value, false}).second)
        return fault(fmt::format("two files are called {}", field.file));
      names_.push_back(field.file);
    } else if (field.name == "table") {
      table_ = field.value;
    } else if (field.value.size() > kLongestWord) {
      fault(fmt::format("the field {} is longer than {} bytes", io::excerpt(field.name), kLongestWord));
    } else if (field.name == "sheet") {
      words_.sheets.push_back(value);
    } else if (field.name == "strip") {
      words_.strips.push_back(value);
    } else if (adds_ && (field.name == "gap" || field.name == "border" || field.name == "kerf")) {
      fault(fmt::format("the {} is one of the layout; what is added keeps it", field.name));
    } else if (field.name == "gap") {
      words_.gap = value;
    } else if (field.name == "border") {
      words_.border = value;
    } else if (field.name == "kerf") {
      words_.kerf = value;
    } else if (field.name == "build") {
      words_.builds.push_back(value);
    } else if (field.name == "rotations") {
      words_.rotations = value;
    } else if (field.name == "grain") {
      words_.grain = value;
    } else if (field.name == "mirror") {
      words_.may_mirror = true;
    } else {
      fault(fmt::format("an order has no field {}", io::excerpt(field.name)));
    }
  }

  void add_parts(const jobs::OrderTerms& terms, jobs::Order& order, std::vector<std::string>& notices) {
    io::OrderTable table;
    if (table_.empty()) {
      for (const std::string& name : names_)
        if (!is_stock(terms, name)) table.rows.push_back(row_of(name));
    } else {
      auto read = io::read_order(table_, "the table");
      if (!read) return fault(read.error().message);
      table = *std::move(read);
    }
    auto rows = jobs::ordered_rows(std::move(table), "the table", terms.builds, "");
    if (!rows) return fault(rows.error().message);
    table = *std::move(rows);
    notices = std::move(table.notices);
    for (const io::OrderRow& row : table.rows)
      if (auto file = file_named(row.file))
        order.parts.push_back(jobs::ordered_part(row, *std::move(file), terms));
  }

  void add_stock(const jobs::StockWord& word, jobs::Order& order) {
    jobs::OrderedStock stock;
    stock.size = word.size;
    stock.count = word.count;
    stock.material = word.material;
    if (!stock.size) {
      if (!files_.contains(word.said))
        return fault(fmt::format("sheet: {} is neither a size such as 3000x1500 nor a file that came along",
                                 io::excerpt(word.said)));
      auto file = file_named(word.said);
      stock.file = *std::move(file);
    }
    order.stocks.push_back(std::move(stock));
  }

  static bool is_stock(const jobs::OrderTerms& terms, const std::string& name) {
    return std::any_of(terms.stocks.begin(), terms.stocks.end(),
                       [&](const jobs::StockWord& word) { return !word.size && word.said == name; });
  }
  static io::OrderRow row_of(const std::string& name) {
    io::OrderRow row;
    row.file = name;
    return row;
  }

  std::optional<jobs::File> file_named(const std::string& name) {
    const auto found = files_.find(name);
    if (found == files_.end()) {
      fault(fmt::format("{} did not come along", io::excerpt(name)));
      return std::nullopt;
    }
    found->second.is_used = true;
    return jobs::File{name, std::string(found->second.bytes)};
  }

  static constexpr std::size_t kLongestWord = 1000;
  bool adds_;
  jobs::OrderWords words_;
  std::map<std::string, Sent> files_;
  std::vector<std::string> names_;  ///< in the order in which they came
  std::string_view table_;
  std::string faults_;
};

}  // namespace

Result<jobs::Layout> ordered_layout(std::string_view body) { return OrderForm(false).layout(body); }
Result<jobs::Layout> ordered_additions(std::string_view body) { return OrderForm(true).layout(body); }

}  // namespace lekalo::server
