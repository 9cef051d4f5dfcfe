#include "lekalo/nc/program_writer.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/base/feed_decimals.hpp"
#include "lekalo/nc/decimal.hpp"

namespace lekalo::nc {
namespace {

/// Controls read short comments in capitals, and other letters than these may act within one.
std::string plain(std::string_view words, std::size_t longest) {
  std::string text;
  for (const char c : words) {
    const bool lower = c >= 'a' && c <= 'z';
    const bool kept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    const char put = lower ? static_cast<char>(c - 'a' + 'A') : kept ? c : ' ';
    if ((put == ' ' && (text.empty() || text.back() == ' ')) || text.size() >= longest) continue;
    text += put;
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

void ProgramWriter::begin(std::optional<std::string_view> title) {
  if (!dialect_->tape_mark.empty()) line(dialect_->tape_mark);
  if (dialect_->program_number.empty()) {
    if (title) comment(*title);
  } else {
    line(std::string(dialect_->program_number) + (title ? " " + comment_of(*dialect_, *title) : ""));
  }
}

void ProgramWriter::line(std::string_view words) {
  text_ += words;
  text_ += '\n';
  ++line_count_;
}

void ProgramWriter::lines(std::string_view text, Places places) {
  std::string filled(text);
  const auto fill = [&](std::string_view place, std::string_view word) {
    for (std::size_t at = 0; (at = filled.find(place, at)) != std::string::npos; at += word.size())
      filled.replace(at, place.size(), word);
  };
  fill("{unit}", unit_ == LengthUnit::inch ? "G20" : "G21");
  for (const auto& [place, word] : places) fill(place, word);
  for (std::size_t begin = 0; begin < filled.size();) {
    const std::size_t end = std::min(filled.find('\n', begin), filled.size());
    line(std::string_view(filled).substr(begin, end - begin));
    begin = end + 1;
  }
}

void ProgramWriter::comment(std::string_view words) {
  const Dialect::Comment& marks = dialect_->comment;
  const std::string text = comment_of(*dialect_, words);
  if (text.size() > marks.open.size() + marks.close.size()) line(text);
}

std::string ProgramWriter::finish(std::string_view end) {
  lines(end);
  if (!dialect_->tape_mark.empty()) line(dialect_->tape_mark);
  return std::move(text_);
}

std::string ProgramWriter::number(std::int64_t count) const { return format_decimal(count, decimals_); }

std::string ProgramWriter::pair(char first, char second, WrittenPoint counts) const {
  return fmt::format(" {}{} {}{}", first, number(counts.x), second, number(counts.y));
}

std::string ProgramWriter::feed(double mm_per_min, int inch_decimals) const {
  const bool inch = unit_ == LengthUnit::inch;
  const double feed = inch ? mm_per_min / kMillimetresPerInch : mm_per_min;
  return fmt::format(" F{:.{}f}", feed, feed_decimals(feed, inch ? inch_decimals : 1));
}

std::string comment_of(const Dialect& dialect, std::string_view words) {
  const auto& [open, close, longest] = dialect.comment;
  return fmt::format("{}{}{}", open, plain(words, longest), close);
}

}  // namespace lekalo::nc
