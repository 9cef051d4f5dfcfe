#include "lekalo/io/formats/order_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "lekalo/io/text/length_word.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string small(trimmed(text));
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

template <class Number>
std::optional<Number> number_of(std::string_view text, Number low, Number high) {
  text = trimmed(text);
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !(low <= value && value <= high)) return std::nullopt;
  return value;
}

std::optional<bool> truth_of(std::string_view text) {
  const std::string word = lower(text);
  if (word == "yes" || word == "true" || word == "1" || word == "x") return true;
  if (word == "no" || word == "false" || word == "0") return false;
  return std::nullopt;
}

struct Row {
  std::size_t line = 0;
  std::vector<std::string> cells;
};

/// Cuts a table into cells. A quote that nothing closes ends with the table; `open_quote` is its line.
struct Cells {
  std::vector<Row> rows;
  std::optional<std::size_t> open_quote;
};

Cells cells_of(std::string_view bytes, char separator) {
  Cells cut;
  std::size_t line = 1;
  Row row{1, {}};
  std::string cell;
  bool quoted = false, was_quoted = false;
  std::size_t opened = 0;
  const auto end_cell = [&] {
    row.cells.push_back(was_quoted ? cell : std::string(trimmed(cell)));
    cell.clear();
    was_quoted = false;
  };
  const auto end_row = [&] {
    end_cell();
    const bool says_something =
        std::any_of(row.cells.begin(), row.cells.end(), [](const std::string& c) { return !c.empty(); });
    if (says_something) cut.rows.push_back(std::move(row));
    row = {line, {}};
  };
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    const bool ends_line = c == '\n' || (c == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n'));
    if (ends_line) ++line;
    if (quoted) {
      if (c == '"' && i + 1 < bytes.size() && bytes[i + 1] == '"') {
        cell += '"';
        ++i;
      } else if (c == '"') {
        quoted = false;
      } else {
        cell += c;
      }
    } else if (c == '"' && trimmed(cell).empty()) {
      cell.clear();
      quoted = was_quoted = true;
      opened = line;
    } else if (c == separator) {
      end_cell();
    } else if (ends_line) {
      end_row();
    } else if (!was_quoted || trimmed({&c, 1}).size() == 1) {
      cell += c;
    }
  }
  end_row();
  if (quoted) cut.open_quote = opened;
  return cut;
}

/// The separator of the row of names.
char separator_of(std::string_view bytes) {
  const std::string_view first = bytes.substr(0, bytes.find_first_of("\r\n"));
  for (const char c : {';', '\t'})
    if (first.find(c) != std::string_view::npos) return c;
  return ',';
}

/// Takes a cell into a row; false where the cell is not `wanted`.
struct Column {
  const char* name;
  const char* wanted;
  bool (*take)(std::string_view cell, OrderRow& row);
};

template <class T, class To>
bool into(std::optional<T> value, To& to) {
  if (!value) return false;
  to = *std::move(value);
  return true;
}

constexpr const char* kText = "a text of at most 1,000 bytes on one line";

constexpr std::array kColumns{
    Column{"file", "",
           [](std::string_view cell, OrderRow& row) {
             row.file = cell;
             return true;
           }},
    Column{"quantity", "a whole number from 1 to 1,000,000,000",
           [](std::string_view cell, OrderRow& row) { return into(quantity_of(cell), row.quantity); }},
    Column{"rotations", "\"any\" or degrees, as in 0 90",
           [](std::string_view cell, OrderRow& row) { return into(rotations_of(cell), row.rotations); }},
    Column{"mirror", "yes or no",
           [](std::string_view cell, OrderRow& row) { return into(truth_of(cell), row.may_mirror); }},
    Column{"grain", "x, y or a number of degrees",
           [](std::string_view cell, OrderRow& row) {
             const auto degrees = grain_of(cell);
             if (degrees) row.grain = layout::Grain{*degrees, 0};
             return degrees.has_value();
           }},
    Column{"priority", "a whole number from -1,000,000 to 1,000,000",
           [](std::string_view cell, OrderRow& row) {
             return into(number_of<int>(cell, -1'000'000, 1'000'000), row.priority);
           }},
    Column{"name", "",
           [](std::string_view cell, OrderRow& row) {
             row.name = cell;
             return true;
           }},
    Column{"material", kText,
           [](std::string_view cell, OrderRow& row) { return into(kept_text(cell), row.material.name); }},
    Column{"thickness", "a length from 0.001 to 262144 mm, as 2, 1.5 mm or 1/16in",
           [](std::string_view cell, OrderRow& row) {
             return into(thickness_of(cell), row.material.thickness);
           }},
    Column{"customer", kText,
           [](std::string_view cell, OrderRow& row) { return into(kept_text(cell), row.purpose.customer); }},
    Column{"due", "a day, as 2026-12-01",
           [](std::string_view cell, OrderRow& row) {
             row.purpose.due = trimmed(cell);
             return layout::is_day(row.purpose.due);
           }},
    Column{"label", kText,
           [](std::string_view cell, OrderRow& row) { return into(kept_text(cell), row.purpose.label); }},
    Column{"assembly", kText,
           [](std::string_view cell, OrderRow& row) { return into(kept_text(cell), row.assembly); }}};
constexpr const Column* kAssembly = &kColumns.back();

class OrderReader {
 public:
  explicit OrderReader(const std::string& name) : name_(name) {}

  Result<OrderTable> read(std::string_view bytes) {
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
    const Cells cells = cells_of(bytes, separator_of(bytes));
    if (cells.open_quote) complain(*cells.open_quote, "a quote is not closed");
    if (cells.rows.empty())
      return failure(ErrorCode::bad_input,
                     name_ + ": the table is empty; its first row names the columns: file, quantity");
    header(cells.rows.front());
    for (std::size_t i = 1; i < cells.rows.size() && knows_files_; ++i) row(cells.rows[i]);
    if (knows_files_ && cells.rows.size() == 1) complain(cells.rows.front().line, "no row follows the names");
    if (!complaints_.empty()) return failure(ErrorCode::bad_input, name_ + ": " + complaints_);
    return std::move(table_);
  }

 private:
  void complain(std::size_t line, const std::string& what) {
    constexpr std::size_t kMostTold = 20;
    if (++complained_ > kMostTold) return;
    complaints_ += fmt::format("{}line {}: {}", complaints_.empty() ? "" : "; ", line, what);
    if (complained_ == kMostTold) complaints_ += "; and more";
  }

  void header(const Row& names) {
    for (const std::string& cell : names.cells) {
      const std::string word = lower(cell);
      const auto column = std::find_if(kColumns.begin(), kColumns.end(),
                                       [&](const Column& known) { return word == known.name; });
      if (column == kColumns.end() && !word.empty())
        table_.notices.push_back(fmt::format("{}: the column {} is not read", name_, excerpt(cell)));
      columns_.push_back(column == kColumns.end() ? nullptr : &*column);
      knows_files_ = knows_files_ || columns_.back() == &kColumns.front();
      table_.is_bill = table_.is_bill || columns_.back() == kAssembly;
    }
    if (!knows_files_)
      complain(names.line,
               "the column \"file\" is missing; the first row names the columns: " + names_of_columns());
  }

  static std::string names_of_columns() {
    std::string names;
    for (const Column& column : kColumns) names += std::string(names.empty() ? "" : ", ") + column.name;
    return names;
  }

  void row(const Row& said) {
    OrderRow made;
    made.said_in = fmt::format("{}: line {}", name_, said.line);
    if (said.cells.size() > columns_.size())
      complain(said.line,
               fmt::format("{} cells where {} columns have names", said.cells.size(), columns_.size()));
    for (std::size_t i = 0; i < std::min(said.cells.size(), columns_.size()); ++i) {
      const std::string& cell = said.cells[i];
      if (columns_[i] == nullptr || cell.empty() || columns_[i]->take(cell, made)) continue;
      complain(said.line,
               fmt::format("the {} {} is not {}", columns_[i]->name, excerpt(cell), columns_[i]->wanted));
    }
    if (made.file.empty()) complain(said.line, "the file is missing");
    if (table_.is_bill && made.assembly.empty()) complain(said.line, "the assembly is missing");
    table_.rows.push_back(std::move(made));
  }

  const std::string& name_;
  OrderTable table_;
  std::vector<const Column*> columns_;
  bool knows_files_ = false;
  std::string complaints_;
  std::size_t complained_ = 0;
};

}  // namespace

Result<OrderTable> read_order(std::string_view bytes, const std::string& name) {
  return OrderReader(name).read(bytes);
}

std::optional<std::vector<layout::AngleRange>> rotations_of(std::string_view text) {
  if (lower(text) == "any") return std::vector<layout::AngleRange>{};
  std::vector<layout::AngleRange> angles;
  constexpr std::string_view kBetween = ", \t";
  for (text = trimmed(text); !text.empty();) {
    const std::size_t end = std::min(text.find_first_of(kBetween), text.size());
    const auto degrees = number_of(text.substr(0, end), -limits::kMostDegrees, limits::kMostDegrees);
    if (!degrees) return std::nullopt;
    angles.push_back({*degrees, *degrees});
    const std::size_t next = text.find_first_not_of(kBetween, end);
    text.remove_prefix(std::min(next, text.size()));
  }
  if (angles.empty()) return std::nullopt;
  return angles;
}

std::optional<double> grain_of(std::string_view text) {
  const std::string word = lower(text);
  if (word == "x") return 0;
  if (word == "y") return 90;
  return number_of(word, -limits::kMostDegrees, limits::kMostDegrees);
}

std::optional<std::int64_t> thickness_of(std::string_view text) {
  const auto mm = length_of(text);
  if (!mm || !(limits::kShortestSide <= *mm && *mm <= limits::kLargestOutline)) return std::nullopt;
  return geom::grid_from_mm(*mm);
}

std::optional<std::string> kept_text(std::string_view text) {
  constexpr std::size_t kMost = 1000;
  std::string kept = as_utf8(text);
  const bool fine = kept.size() <= kMost && std::none_of(kept.begin(), kept.end(), [](char c) {
                      return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
                    });
  return fine ? std::optional(std::move(kept)) : std::nullopt;
}

std::optional<std::int64_t> quantity_of(std::string_view text) {
  return number_of<std::int64_t>(text, 1, 1'000'000'000);
}

}  // namespace lekalo::io
