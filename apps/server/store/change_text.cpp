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

/// The letter of a line of the job is a small one for what was there before, and a capital for what is there
/// after.
template <class Item, class Write>
void append_lines(std::string& text, char letter, const std::vector<layout::ItemChange<Item>>& changes,
                  const Write& write) {
  const auto capital = static_cast<char>(letter - 'a' + 'A');
  for (const layout::ItemChange<Item>& one : changes) {
    if (one.before) text += fmt::format("{}{} {}\n", letter, one.index, write(*one.before));
    if (one.after) text += fmt::format("{}{} {}\n", capital, one.index, write(*one.after));
  }
}

std::string text_of(const layout::Rules& rules) {
  return fmt::format("{} {} {}", rules.gap, rules.border_gap, rules.defect_gap);
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
    if (kSigns.find(sign) == kSigns.npos) ok_ = false;
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
  static constexpr std::string_view kSigns = "-+<>pPsSkKrc";
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

template <class Item, class Read>
bool take_item(NumberTaker& numbers, bool is_after, std::vector<layout::ItemChange<Item>>& list,
               const Read& read) {
  std::uint32_t index = 0;
  numbers.take(index, ' ');
  if (!numbers.ok()) return false;
  auto item = read(numbers.take_line(), "a change");
  if (!item) return false;
  const bool joins = is_after && !list.empty() && !list.back().after && list.back().index == index;
  if (!joins) list.push_back({index, std::nullopt, std::nullopt});
  (is_after ? list.back().after : list.back().before) = std::move(*item);
  return true;
}

bool take_rules(NumberTaker& numbers, std::optional<layout::RulesChange>& change) {
  if (change) return false;
  change.emplace();
  numbers.take(change->before.gap, ' ');
  numbers.take(change->before.border_gap, ' ');
  numbers.take(change->before.defect_gap, ' ');
  numbers.take(change->after.gap, ' ');
  numbers.take(change->after.border_gap, ' ');
  numbers.take(change->after.defect_gap, '\n');
  return numbers.ok();
}

bool take_kerf(NumberTaker& numbers, std::optional<layout::RulesChange>& change) {
  if (!change) return false;
  numbers.take(change->before.kerf, ' ');
  numbers.take(change->after.kerf, '\n');
  return numbers.ok();
}

bool take_line(NumberTaker& numbers, char sign, layout::Change& change) {
  switch (sign) {
    case '-':
    case '+':
      return take_placement(numbers, sign, change.placements);
    case '<':
    case '>':
      return take_feature(numbers, sign, change.features);
    case 'p':
    case 'P':
      return take_item(numbers, sign == 'P', change.job.parts, io::read_part);
    case 's':
    case 'S':
      return take_item(numbers, sign == 'S', change.job.stocks, io::read_stock);
    case 'k':
    case 'K':
      return take_item(numbers, sign == 'K', change.job.kits, io::read_kit);
    case 'c':
      return take_kerf(numbers, change.job.rules);
    default:
      return take_rules(numbers, change.job.rules);
  }
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
  append_lines(text, 'p', change.job.parts, io::part_json);
  append_lines(text, 's', change.job.stocks, io::stock_json);
  append_lines(text, 'k', change.job.kits, io::kit_json);
  if (const auto& rules = change.job.rules) {
    text += fmt::format("r{} {}\n", text_of(rules->before), text_of(rules->after));
    if (rules->before.kerf != 0 || rules->after.kerf != 0)
      text += fmt::format("c{} {}\n", rules->before.kerf, rules->after.kerf);
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
    ok = numbers.ok() && take_line(numbers, sign, change);
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

std::vector<layout::ItemChange<layout::Part>> shifted_parts(std::string_view text) {
  std::vector<layout::ItemChange<layout::Part>> all;
  std::string_view last;  // the line of a part as it was before, of which it is not known yet whether it goes
  const auto add = [&](std::string_view line) {
    NumberTaker numbers(line.substr(1));
    std::uint32_t index = 0;
    numbers.take(index, ' ');
    auto part = io::read_part(line.substr(line.find(' ') + 1), "a change");
    if (!numbers.ok() || !part) return;
    all.push_back({index, std::nullopt, std::nullopt});
    (line.front() == 'p' ? all.back().before : all.back().after) = std::move(*part);
  };
  NumberTaker lines(text);
  while (lines.ok() && !lines.empty()) {
    const std::string_view line = lines.take_line();
    if (line.empty() || (line.front() != 'p' && line.front() != 'P')) continue;
    const auto number = [](std::string_view of) { return of.substr(1, of.find(' ') - 1); };
    if (line.front() == 'P' && !last.empty() && number(last) == number(line)) {
      last = {};
      continue;
    }
    if (!last.empty()) add(last);
    last = line.front() == 'p' ? line : std::string_view{};
    if (line.front() == 'P') add(line);
  }
  if (!last.empty()) add(last);
  return all;
}

void name_touched_parts(std::vector<HistoryEntry>& entries,
                        const std::vector<std::vector<layout::ItemChange<layout::Part>>>& shifts) {
  // The names of the first parts, from the newest state back to the oldest; those behind are shifted alike.
  struct Name {
    std::uint32_t part = 0;
    std::string gone;
  };
  std::vector<Name> names;
  std::int64_t shift = 0;
  const auto name_up_to = [&](std::size_t size) {
    while (names.size() < size)
      names.push_back({static_cast<std::uint32_t>(static_cast<std::int64_t>(names.size()) + shift), {}});
  };
  for (std::size_t i = entries.size(); i-- > 0;) {
    for (const auto& one : shifts[i]) {
      if (one.after) continue;
      name_up_to(one.index);
      names.insert(names.begin() + one.index, {0, one.before->id});
      --shift;
    }
    for (TouchedPart& touched : entries[i].parts) {
      if (touched.part < names.size()) {
        const Name& name = names[touched.part];
        touched.part = name.part;
        touched.gone = name.gone;
      } else {
        touched.part = static_cast<std::uint32_t>(touched.part + shift);
      }
    }
    for (auto one = shifts[i].rbegin(); one != shifts[i].rend(); ++one) {
      if (one->before) continue;
      name_up_to(std::size_t{one->index} + 1);
      names.erase(names.begin() + one->index);
      ++shift;
    }
  }
}

}  // namespace lekalo::server
