#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "refusal.hpp"
#include "rows.hpp"

namespace lekalo::io {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// The content of a line up to a '#'; nothing for comments.
std::string_view without_comment(std::string_view line) {
  line = trimmed(line);
  if (line.empty() || line[0] == ';' || line[0] == '%' || line.substr(0, 2) == "//") return {};
  return trimmed(line.substr(0, line.find('#')));
}

using Fields = std::vector<std::string_view>;

void split_at(std::string_view line, char separator, Fields& fields) {
  fields.clear();
  while (true) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

void split_at_blanks(std::string_view line, Fields& fields) {
  fields.clear();
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    fields.push_back(line.substr(0, end));
    line = trimmed(line.substr(end));
  }
}

/// True for "12,5", a number as half of the world writes it.
bool is_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || comma + 1 == text.size()) return false;
  std::string with_point(text);
  with_point[comma] = '.';
  return is_number(with_point);
}

bool looks_like_decimal_commas(std::string_view line) {
  Fields fields;
  if (line.find(';') != std::string_view::npos) {
    split_at(line, ';', fields);
  } else {
    split_at_blanks(line, fields);
  }
  return fields.size() > 1 && std::any_of(fields.begin(), fields.end(), is_decimal_comma);
}

char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return line.find(',') != std::string_view::npos ? ',' : ' ';
}

bool begins_like_number(std::string_view line) {
  if (!line.empty() && (line[0] == '+' || line[0] == '-')) line.remove_prefix(1);
  if (!line.empty() && line[0] == '.') line.remove_prefix(1);
  return !line.empty() && line[0] >= '0' && line[0] <= '9';
}

class TextReader {
 public:
  TextReader(const std::string& name, DecimalFactor unit,
             const std::function<Result<void>(const TextRow&)>& take, std::vector<std::string>& notices,
             bool in_space)
      : name_(name), unit_(unit), take_(take), notices_(notices), in_space_(in_space) {}

  Result<void> read(std::string_view bytes) {
    while (!bytes.empty()) {
      ask();
      const std::size_t end = std::min(bytes.find('\n'), bytes.size());
      ++row_.line;
      const std::string_view whole = bytes.substr(0, end), line = without_comment(whole);
      bytes.remove_prefix(std::min(end + 1, bytes.size()));
      if (line.empty()) {
        row_.after_a_gap = row_.after_a_gap || trimmed(whole).empty();
        continue;
      }
      LEKALO_CHECK(read_line(line));
    }
    return {};
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refuse_here(const std::string& sentence) const {
    return refuse_line(name_, row_.line, sentence);
  }

  /// A line of words is a header. "O.5 3" is a mistyped point: dropping it would change the contour.
  [[nodiscard]] bool is_header(std::string_view line) const {
    if (begins_like_number(line) || is_not_finite(fields_[0]) || looks_like_decimal_commas(line))
      return false;
    return fields_.size() < 2 || fields_.size() > 3 || !(is_number(fields_[1]) || is_not_finite(fields_[1]));
  }

  Result<void> read_line(std::string_view line) {
    const char separator = separator_of(line);
    if (separator == ' ') {
      split_at_blanks(line, fields_);
    } else {
      split_at(line, separator, fields_);
    }
    const bool first = !std::exchange(seen_content_, true);
    if (first && is_header(line)) {
      // "x,y" needs no notice; what might have been a point does.
      if (line.find_first_of("0123456789") != std::string_view::npos) {
        notices_.push_back(
            fmt::format("{}: line {} is taken for a header: {}", name_, row_.line, excerpt(line)));
      }
      return {};
    }
    return read_point(line, separator);
  }

  Result<void> read_point(std::string_view line, char separator) {
    const bool mixed =
        separator != ' ' && std::any_of(fields_.begin(), fields_.end(), [](std::string_view field) {
          return field.find_first_of(kBlanks) != std::string_view::npos ||
                 field.find(',') != std::string_view::npos;
        });
    const bool with_direction = in_space_ && fields_.size() == 6;
    if (mixed || (fields_.size() > 3 && !with_direction)) {
      if (looks_like_decimal_commas(line) || (separator == ',' && fields_.size() == 4)) {
        return refuse_here(
            fmt::format("{} looks like decimal commas; write a decimal point, as in 12.5", excerpt(line)));
      }
      if (mixed)
        return refuse_here(fmt::format("{} mixes separators; use one kind in a line", excerpt(line)));
      return refuse_here(
          fmt::format("{} numbers where {} are wanted: {}", fields_.size(), wanted(), excerpt(line)));
    }
    if (with_direction && separator == ',' && line.find('.') == std::string_view::npos)
      return refuse_here(
          fmt::format("{} may have decimal commas; put semicolons between the numbers, and decimal points in "
                      "them, as in 12.5",
                      excerpt(line)));
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (fields_[i].empty()) return refuse_here(fmt::format("a number is missing in {}", excerpt(line)));
      const auto number = read_millimetres(fields_[i], i < 3 ? unit_ : DecimalFactor{});
      if (!number) return refuse_here(number_sentence(number.error(), fields_[i]));
      row_.numbers[i] = *number;
    }
    if (fields_.size() < (in_space_ ? 3U : 2U))
      return refuse_here(fmt::format("{} where {} are wanted: {}",
                                     fields_.size() == 1 ? "one number" : "two numbers", wanted(),
                                     excerpt(line)));
    row_.count = fields_.size();
    auto taken = take_(row_);
    row_.after_a_gap = false;
    return taken;
  }

  [[nodiscard]] const char* wanted() const {
    return in_space_ ? "x, y and z (or those and a direction nx, ny, nz)" : "x and y";
  }

  const std::string& name_;
  DecimalFactor unit_;
  const std::function<Result<void>(const TextRow&)>& take_;
  std::vector<std::string>& notices_;
  bool in_space_;
  TextRow row_;
  Fields fields_;
  bool seen_content_ = false;
};

}  // namespace

Result<void> read_text_rows(std::string_view bytes, const std::string& name, DecimalFactor unit,
                            const std::function<Result<void>(const TextRow&)>& take,
                            std::vector<std::string>& notices, bool in_space) {
  return TextReader(name, unit, take, notices, in_space).read(bytes);
}

}  // namespace lekalo::io
