// Writes and reads a change as the store keeps it.

#include <fmt/core.h>

#include <charconv>
#include <map>

#include "lekalo/io/layout/layout_messages.hpp"
#include "store.hpp"

namespace lekalo::server {
namespace {

using layout::Placement;

void append_line(std::string& text, char sign, const Placement& p) {
  text += fmt::format("{}{} {} {} {} {} {} {} {} {} {}\n", sign, p.id, p.part, p.stock, p.copy, p.rotation.c,
                      p.rotation.s, p.at.x, p.at.y, p.mirrored ? 1 : 0, p.locked ? 1 : 0);
}

/// Writes a feature as JSON, which has no line ends of its own and therefore goes on to the end of the line.
void append_line(std::string& text, char sign, const layout::FeatureChange& where,
                 const layout::Feature& feature) {
  text += fmt::format("{}{} {} {} {}\n", sign, where.stock, where.index, static_cast<int>(feature.kind),
                      io::feature_json(feature));
}

/// Takes whole numbers, each followed by one given character.
class NumberTaker {
 public:
  explicit NumberTaker(std::string_view text) : text_(text) {}
  template <class Integer>
  void take(Integer& value, char end) {
    const auto [rest, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    const auto read = static_cast<std::size_t>(rest - text_.data());
    if (error != std::errc{} || read >= text_.size() || text_[read] != end) {
      ok_ = false;
      text_ = {};
      return;
    }
    text_.remove_prefix(read + 1);
  }
  void take_truth(bool& value, char end) {
    unsigned number = 0;
    take(number, end);
    if (number > 1) ok_ = false;
    value = number == 1;
  }
  char take_sign() {
    const char sign = text_.front();
    text_.remove_prefix(1);
    if (sign != '-' && sign != '+' && sign != '<' && sign != '>') ok_ = false;
    return sign;
  }
  std::string_view take_line() {
    const std::size_t end = text_.find('\n');
    if (end == text_.npos) {
      ok_ = false;
      return {};
    }
    const std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    return line;
  }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  std::string_view text_;
  bool ok_ = true;
};

bool take_placement(NumberTaker& numbers, char sign, std::vector<layout::PlacementChange>& list) {
  Placement p;
  numbers.take(p.id, ' ');
  numbers.take(p.part, ' ');
  numbers.take(p.stock, ' ');
  numbers.take(p.copy, ' ');
  numbers.take(p.rotation.c, ' ');
  numbers.take(p.rotation.s, ' ');
  numbers.take(p.at.x, ' ');
  numbers.take(p.at.y, ' ');
  numbers.take_truth(p.mirrored, ' ');
  numbers.take_truth(p.locked, '\n');
  if (!numbers.ok()) return false;
  const bool joins = sign == '+' && !list.empty() && list.back().before && !list.back().after &&
                     list.back().before->id == p.id;
  if (!joins) list.emplace_back();
  (sign == '-' ? list.back().before : list.back().after) = p;
  return true;
}

bool take_feature(NumberTaker& numbers, char sign, std::vector<layout::FeatureChange>& list) {
  layout::FeatureChange one;
  unsigned kind = 0;
  numbers.take(one.stock, ' ');
  numbers.take(one.index, ' ');
  numbers.take(kind, ' ');
  if (!numbers.ok() || kind > 1) return false;
  auto feature = io::read_feature(static_cast<layout::FeatureKind>(kind), numbers.take_line(), "a change");
  if (!feature) return false;
  const bool joins = sign == '>' && !list.empty() && list.back().before && !list.back().after &&
                     list.back().stock == one.stock && list.back().index == one.index &&
                     list.back().before->kind == feature->kind && list.back().before->id == feature->id;
  if (!joins) list.push_back(one);
  (sign == '<' ? list.back().before : list.back().after) = std::move(*feature);
  return true;
}

}  // namespace

std::string change_text(const layout::Change& change) {
  std::string text = fmt::format("{} {}\n", change.next_id_before, change.next_id_after);
  for (const layout::PlacementChange& one : change.placements) {
    if (one.before) append_line(text, '-', *one.before);
    if (one.after) append_line(text, '+', *one.after);
  }
  for (const layout::FeatureChange& one : change.features) {
    if (one.before) append_line(text, '<', one, *one.before);
    if (one.after) append_line(text, '>', one, *one.after);
  }
  return text;
}

Result<layout::Change> change_from_text(std::string_view text) {
  layout::Change change;
  NumberTaker numbers(text);
  numbers.take(change.next_id_before, ' ');
  numbers.take(change.next_id_after, '\n');
  bool ok = numbers.ok();
  while (ok && !numbers.empty()) {
    const char sign = numbers.take_sign();
    ok = numbers.ok() && (sign == '-' || sign == '+' ? take_placement(numbers, sign, change.placements)
                                                     : take_feature(numbers, sign, change.features));
  }
  if (!ok) return failure(ErrorCode::environment, "the store is damaged: a change in it cannot be read");
  return change;
}

std::vector<TouchedPart> touched_parts(std::string_view text) {
  std::map<std::uint32_t, TouchedPart> touched;
  NumberTaker lines(text);
  std::uint64_t before = 0;  // the placement of the line before this one, if it was taken away there
  while (lines.ok() && !lines.empty()) {
    const std::string_view line = lines.take_line();
    if (line.empty() || (line.front() != '-' && line.front() != '+')) continue;
    NumberTaker numbers(line.substr(1));
    std::uint64_t id = 0;
    std::uint32_t part = 0;
    numbers.take(id, ' ');
    numbers.take(part, ' ');
    TouchedPart& one = touched.try_emplace(part, TouchedPart{part, id, 0, 0, 0}).first->second;
    if (line.front() == '-') {
      ++one.removed;
    } else if (id == before) {
      --one.removed;
      ++one.changed;
    } else {
      ++one.placed;
    }
    before = line.front() == '-' ? id : 0;
  }
  std::vector<TouchedPart> all;
  for (const auto& [part, one] : touched) all.push_back(one);
  return all;
}

}  // namespace lekalo::server
