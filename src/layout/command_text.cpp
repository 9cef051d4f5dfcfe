#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "lekalo/base/double_of_text.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/layout/command.hpp"

namespace lekalo::layout {
namespace {

using geom::GridPoint;

std::string text_of(const std::vector<std::uint64_t>& ids) { return joined_text(ids, ","); }
std::string text_of(GridPoint p) {
  return fmt::format("{} {}", geom::mm_from_grid(p.x), geom::mm_from_grid(p.y));
}

std::string text_of(const std::vector<std::vector<GridPoint>>& loops) {
  std::string text = "outline";
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (i > 0) text += " hole";
    for (const GridPoint p : loops[i]) text += " " + text_of(p);
  }
  return text;
}

/// The words of the rules, in the order of RuleKind.
constexpr std::array<std::string_view, 3> kRuleWords{"gap", "border", "kerf"};

class Writer {
 public:
  explicit Writer(const Document& document) : document_(document) {}

  std::string operator()(const PlaceCommand& c) const {
    return fmt::format("place {} {} {} {} {} {}", quoted_name(document_.parts[c.part].id),
                       text_of(Sheet{c.stock, c.copy}), static_cast<double>(c.rotation.c) * 0x1p-52,
                       static_cast<double>(c.rotation.s) * 0x1p-52, layout::text_of(c.at),
                       c.mirrored ? "mirrored" : "upright");
  }
  std::string operator()(const MoveCommand& c) const {
    return fmt::format("move {} by {}{}", layout::text_of(c.ids), layout::text_of(c.by), to(c.to));
  }
  std::string operator()(const RotateCommand& c) const {
    return fmt::format("rotate {} {}", layout::text_of(c.ids), c.degrees);
  }
  std::string operator()(const FlipCommand& c) const { return "flip " + layout::text_of(c.ids); }
  std::string operator()(const RemoveCommand& c) const { return "remove " + layout::text_of(c.ids); }
  std::string operator()(const SwapCommand& c) const { return fmt::format("swap {} {}", c.a, c.b); }
  std::string operator()(const LockCommand& c) const {
    return (c.locked ? "lock " : "unlock ") + layout::text_of(c.ids);
  }
  std::string operator()(const SlideCommand& c) const {
    return fmt::format("slide {} towards {}", layout::text_of(c.ids), layout::text_of(c.direction));
  }
  std::string operator()(const SlideAlongCommand& c) const {
    return fmt::format("slide-along {} by {}", layout::text_of(c.ids), layout::text_of(c.by));
  }
  std::string operator()(const SettleCommand& c) const {
    return fmt::format("settle {} towards {}{}", layout::text_of(c.ids), layout::text_of(c.direction),
                       c.then ? " then " + layout::text_of(*c.then) : "");
  }
  std::string operator()(const PushCommand& c) const {
    return fmt::format("push {} by {}", layout::text_of(c.ids), layout::text_of(c.by));
  }
  std::string operator()(const SnapCommand& c) const {
    return fmt::format("snap {} within {}", c.id, geom::mm_from_grid(c.reach));
  }
  std::string operator()(const CompactCommand& c) const {
    return fmt::format("compact {}towards {}", c.sheet ? text_of(*c.sheet) + " " : "",
                       layout::text_of(c.direction));
  }
  std::string operator()(const NearestCommand& c) const {
    return fmt::format("nearest {} by {}{}", layout::text_of(c.ids), layout::text_of(c.by), to(c.to));
  }
  std::string operator()(const FitCommand& c) const {
    return fmt::format("fit {} {}{}", quoted_name(document_.parts[c.part].id), text_of(c.sheet),
                       c.mirrored ? (*c.mirrored ? " mirrored" : " upright") : "");
  }
  std::string operator()(const AddFeatureCommand& c) const {
    return fmt::format("add-{} {} {}", named(c), c.grade, layout::text_of(c.loops));
  }
  std::string operator()(const MoveFeatureCommand& c) const {
    return fmt::format("move-{} by {}", named(c), layout::text_of(c.by));
  }
  std::string operator()(const ReshapeFeatureCommand& c) const {
    return fmt::format("reshape-{} {}", named(c), layout::text_of(c.loops));
  }
  std::string operator()(const GradeFeatureCommand& c) const {
    return fmt::format("grade-{} {}", named(c), c.grade);
  }
  std::string operator()(const RemoveFeatureCommand& c) const { return "remove-" + named(c); }
  std::string operator()(const QuantityCommand& c) const {
    return fmt::format("quantity {} {}", part(c.part), c.quantity);
  }
  std::string operator()(const RotationsCommand& c) const {
    std::string angles;
    for (const AngleRange& range : c.rotations) {
      angles += fmt::format("{}{}", angles.empty() ? "" : ",", range.from);
      if (range.to != range.from) angles += fmt::format("..{}", range.to);
    }
    return fmt::format("rotations {} {}", part(c.part), angles.empty() ? "any" : angles);
  }
  std::string operator()(const MirrorCommand& c) const {
    return fmt::format("mirror {} {}", part(c.part), c.may_mirror ? "yes" : "no");
  }
  std::string operator()(const RemovePartCommand& c) const { return "remove-part " + part(c.part); }
  std::string operator()(const AddSheetCommand& c) const {
    std::string text =
        fmt::format("add-sheet {}x{}", geom::mm_from_grid(c.width), geom::mm_from_grid(c.height));
    if (c.count != 0) text += fmt::format("={}", c.count);
    return text;
  }
  std::string operator()(const AddStripCommand& c) const {
    return fmt::format("add-strip {}", geom::mm_from_grid(c.width));
  }
  std::string operator()(const CountCommand& c) const {
    return fmt::format("count {} {}", stock(c.stock), c.count);
  }
  std::string operator()(const RemoveStockCommand& c) const { return "remove-stock " + stock(c.stock); }
  std::string operator()(const RuleCommand& c) const {
    return fmt::format("{} {}", kRuleWords[static_cast<std::size_t>(c.kind)], geom::mm_from_grid(c.length));
  }

 private:
  std::string part(std::uint32_t index) const { return quoted_name(document_.parts[index].id); }
  std::string stock(std::uint32_t index) const { return quoted_name(document_.stocks[index].id); }
  template <class Named>
  std::string named(const Named& c) const {
    return fmt::format("{} {} {}", name_of(c.kind), quoted_name(document_.stocks[c.stock].id),
                       quoted_name(c.id));
  }
  std::string text_of(Sheet sheet) const {
    return fmt::format("{} {}", quoted_name(document_.stocks[sheet.stock].id), sheet.copy);
  }
  std::string to(const std::optional<Sheet>& sheet) const { return sheet ? " to " + text_of(*sheet) : ""; }

  const Document& document_;
};

/// Reads the words of a line one after the other. The first word that does not fit is remembered, and
/// everything read after it is nothing.
class Reader {
 public:
  Reader(std::string_view line, const Document& document) : rest_(line), document_(document) {}

  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  [[nodiscard]] bool at_end() {
    skip_spaces();
    return rest_.empty();
  }

  std::string word() {
    skip_spaces();
    if (!rest_.empty() && rest_.front() == '"') return quoted_word();
    const std::size_t end = std::min(rest_.find_first_of(" \t\r"), rest_.size());
    std::string found(rest_.substr(0, end));
    rest_.remove_prefix(end);
    if (found.empty()) fail("the line ends too early");
    return found;
  }
  void expect(std::string_view wanted) {
    if (const std::string found = word(); found != wanted)
      fail(fmt::format("'{}' where '{}' belongs", found, wanted));
  }
  [[nodiscard]] bool next_is(std::string_view wanted) {
    skip_spaces();
    return rest_.starts_with(wanted) &&
           (rest_.size() == wanted.size() || rest_.find_first_of(" \t\r", wanted.size()) == wanted.size());
  }
  /// Takes the next word if it is the wanted one.
  bool take(std::string_view wanted) {
    if (!next_is(wanted)) return false;
    rest_.remove_prefix(wanted.size());
    return true;
  }
  double number() {
    const std::string text = word();
    const auto value = double_of_text(text);
    if (!value) fail(fmt::format("'{}' is no number", text));
    return value.value_or(0);
  }
  template <class Integer>
  Integer integer() {
    const std::string text = word();
    Integer value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size())
      return fail(fmt::format("'{}' is no whole number", text)), Integer{0};
    return value;
  }
  std::vector<std::uint64_t> ids() {
    const std::string text = word();
    std::vector<std::uint64_t> found;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (fault_.empty()) {
      std::uint64_t id = 0;
      const auto [next, code] = std::from_chars(at, end, id);
      if (code != std::errc{} || (next != end && *next != ',')) {
        fail(fmt::format("'{}' is no list of placements such as 3,5", text));
        break;
      }
      found.push_back(id);
      if (next == end) break;
      at = next + 1;
    }
    return found;
  }
  std::int64_t length() {
    const double mm = number();
    if (!geom::fits_grid(mm)) return fail(fmt::format("{} mm is beyond the limits of +-1048576 mm", mm)), 0;
    return geom::grid_from_mm(mm);
  }
  /// A gap is rounded up to the grid, as those in files are.
  std::int64_t gap() {
    const double mm = number();
    if (!geom::fits_grid(mm)) return fail(fmt::format("{} mm is beyond the limits of +-1048576 mm", mm)), 0;
    return geom::grid_from_mm_up(mm);
  }
  /// "any", or degrees and ranges between commas: 0,90,170..190.
  std::vector<AngleRange> rotations() {
    const std::string text = word();
    std::vector<AngleRange> found;
    if (text == "any") return found;
    std::string_view rest = text;
    while (fault_.empty()) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      const std::string_view one = rest.substr(0, comma);
      const std::size_t dots = one.find("..");
      const auto from = double_of_text(one.substr(0, dots));
      const auto to = dots == one.npos ? from : double_of_text(one.substr(dots + 2));
      if (!from || !to || found.size() == kMostItems) {
        fail(fmt::format("'{}' is not \"any\" or degrees, as in 0,90,170..190", text));
        break;
      }
      found.push_back({*from, *to});
      if (comma == rest.size()) break;
      rest.remove_prefix(comma + 1);
    }
    return found;
  }
  AddSheetCommand size() {
    const std::string text = word();
    const std::size_t times = text.find('x'), equals = std::min(text.find('='), text.size());
    AddSheetCommand c;
    if (times < equals) {
      const auto width = double_of_text(std::string_view(text).substr(0, times));
      const auto height = double_of_text(std::string_view(text).substr(times + 1, equals - times - 1));
      const char* const end = text.data() + text.size();
      const bool counted = equals < text.size();
      const auto [read, code] =
          counted ? std::from_chars(text.data() + equals + 1, end, c.count) : std::from_chars_result{end, {}};
      if (width && height && geom::fits_grid(*width) && geom::fits_grid(*height) && code == std::errc{} &&
          read == end && (!counted || c.count > 0)) {
        c.width = geom::grid_from_mm(*width), c.height = geom::grid_from_mm(*height);
        return c;
      }
    }
    return fail(fmt::format("'{}' is no size such as 3000x1500, or 3000x1500=2 for two of it, in mm", text)),
           c;
  }
  GridPoint vector() {
    const std::int64_t x = length();
    return {x, length()};
  }
  std::uint32_t stock() { return index(document_.stocks, "stock"); }
  /// Reads "outline" and its points, and the points of a hole after each "hole".
  std::vector<std::vector<GridPoint>> loops() {
    expect("outline");
    std::vector<std::vector<GridPoint>> found(1);
    std::size_t points = 0;
    while (fault_.empty() && !at_end()) {
      if (take("hole")) {
        found.emplace_back();
        continue;
      }
      found.back().push_back(vector());
      if (++points > kMostFeaturePoints)
        fail(fmt::format("an outline of more than {} points", kMostFeaturePoints));
    }
    return found;
  }
  Sheet sheet() {
    const std::uint32_t stock = index(document_.stocks, "stock");
    return {stock, integer<std::int64_t>()};
  }
  std::uint32_t part() { return index(document_.parts, "part"); }
  geom::GridRotation rotation() {
    const double c = number(), s = number();
    if (!(std::abs(c) <= 2 && std::abs(s) <= 2)) return fail("cosine and sine above 2"), geom::GridRotation{};
    return geom::rotation_from_pair(c, s);
  }
  std::optional<Sheet> destination() { return take("to") ? std::optional(sheet()) : std::nullopt; }

 private:
  void skip_spaces() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }
  void fail(std::string message) {
    if (fault_.empty()) fault_ = std::move(message);
    rest_ = {};
  }
  std::string quoted_word() {
    std::string found;
    std::size_t i = 1;
    for (; i < rest_.size() && rest_[i] != '"'; ++i) {
      const bool escaped = rest_[i] == '\\' && i + 1 < rest_.size();
      if (escaped) ++i;
      found += escaped && rest_[i] == 'n' ? '\n' : rest_[i];
    }
    if (i >= rest_.size()) return fail("a name without its closing quotation mark"), std::string{};
    rest_.remove_prefix(i + 1);
    return found;
  }
  template <class Named>
  std::uint32_t index(const std::vector<Named>& all, std::string_view what) {
    const std::string id = word();
    for (std::size_t i = 0; i < all.size() && fault_.empty(); ++i)
      if (all[i].id == id) return static_cast<std::uint32_t>(i);
    // The sentence does not name all kits, because some orders have hundreds.
    std::string known;
    for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 8); ++i)
      known += (i == 0 ? "" : ", ") + quoted_name(all[i].id);
    fail(fmt::format("there is no {} {}; there {} {}{}", what, quoted_name(id),
                     all.size() == 1 ? "is" : "are", all.empty() ? "none" : known,
                     all.size() > 8 ? ", ..." : ""));
    return 0;
  }

  std::string_view rest_;
  const Document& document_;
  std::string fault_;
};

std::optional<Command> feature_command(std::string_view what, FeatureKind kind, Reader& in) {
  if (what != "add-" && what != "move-" && what != "reshape-" && what != "grade-" && what != "remove-")
    return std::nullopt;
  const std::uint32_t stock = in.stock();
  std::string id = in.word();
  if (what == "add-") {
    const int grade = in.integer<int>();
    return AddFeatureCommand{kind, stock, std::move(id), grade, in.loops()};
  }
  if (what == "move-") {
    in.expect("by");
    return MoveFeatureCommand{kind, stock, std::move(id), in.vector()};
  }
  if (what == "reshape-") return ReshapeFeatureCommand{kind, stock, std::move(id), in.loops()};
  if (what == "grade-") return GradeFeatureCommand{kind, stock, std::move(id), in.integer<int>()};
  return RemoveFeatureCommand{kind, stock, std::move(id)};
}

std::optional<Command> job_command(std::string_view name, Reader& in) {
  if (name == "quantity") return QuantityCommand{in.part(), in.integer<std::int64_t>()};
  if (name == "rotations") return RotationsCommand{in.part(), in.rotations()};
  if (name == "mirror") {
    MirrorCommand c{in.part(), in.take("yes")};
    if (!c.may_mirror) in.expect("no");
    return c;
  }
  if (name == "remove-part") return RemovePartCommand{in.part()};
  if (name == "add-sheet") return in.size();
  if (name == "add-strip") return AddStripCommand{in.length()};
  if (name == "count") return CountCommand{in.stock(), in.integer<std::int64_t>()};
  if (name == "remove-stock") return RemoveStockCommand{in.stock()};
  for (std::size_t kind = 0; kind < kRuleWords.size(); ++kind)
    if (name == kRuleWords[kind]) return RuleCommand{static_cast<RuleKind>(kind), in.gap()};
  return std::nullopt;
}

std::optional<Command> command_named(std::string_view name, Reader& in) {
  // Words are read in the order of evaluation, so each is read in a statement of its own or in a braced list.
  if (name == "place") {
    PlaceCommand c;
    c.part = in.part();
    const Sheet sheet = in.sheet();
    c.stock = sheet.stock, c.copy = sheet.copy;
    c.rotation = in.rotation();
    c.at = in.vector();
    c.mirrored = in.take("mirrored");
    if (!c.mirrored) in.expect("upright");
    return c;
  }
  if (name == "fit") {
    FitCommand c;
    c.part = in.part();
    c.sheet = in.sheet();
    if (in.take("mirrored"))
      c.mirrored = true;
    else if (in.take("upright"))
      c.mirrored = false;
    return c;
  }
  if (name == "swap") return SwapCommand{in.integer<std::uint64_t>(), in.integer<std::uint64_t>()};
  if (name == "snap") {
    SnapCommand c{in.integer<std::uint64_t>(), 0};
    in.expect("within");
    c.reach = in.length();
    return c;
  }
  if (name == "compact") {
    CompactCommand c;
    if (!in.next_is("towards")) c.sheet = in.sheet();
    in.expect("towards");
    c.direction = in.vector();
    return c;
  }
  if (name == "rotate") return RotateCommand{in.ids(), in.number()};
  if (name == "flip") return FlipCommand{in.ids()};
  if (name == "remove") return RemoveCommand{in.ids()};
  if (name == "lock" || name == "unlock") return LockCommand{in.ids(), name == "lock"};
  const auto directed = [&](std::string_view preposition) {
    std::vector<std::uint64_t> ids = in.ids();
    in.expect(preposition);
    return std::pair{std::move(ids), in.vector()};
  };
  if (name == "slide") {
    auto [ids, direction] = directed("towards");
    return SlideCommand{std::move(ids), direction};
  }
  if (name == "settle") {
    auto [ids, direction] = directed("towards");
    SettleCommand c{std::move(ids), direction, std::nullopt};
    if (in.take("then")) c.then = in.vector();
    return c;
  }
  if (name == "slide-along") {
    auto [ids, by] = directed("by");
    return SlideAlongCommand{std::move(ids), by};
  }
  if (name == "push") {
    auto [ids, by] = directed("by");
    return PushCommand{std::move(ids), by};
  }
  if (name == "move") {
    auto [ids, by] = directed("by");
    return MoveCommand{std::move(ids), by, in.destination()};
  }
  if (name == "nearest") {
    auto [ids, by] = directed("by");
    return NearestCommand{std::move(ids), by, in.destination()};
  }
  if (auto command = job_command(name, in)) return command;
  for (const FeatureKind kind : {FeatureKind::defect, FeatureKind::zone})
    if (name.ends_with(name_of(kind)))
      if (auto command = feature_command(name.substr(0, name.size() - name_of(kind).size()), kind, in))
        return command;
  return std::nullopt;
}

}  // namespace

std::string quoted_name(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result + '"';
}

std::string to_text(const Command& command, const Document& document) {
  return std::visit(Writer(document), command);
}

Result<Command> command_from_text(std::string_view line, const Document& document) {
  Reader in(line, document);
  const std::string name = in.word();
  auto command = in.fault().empty() ? command_named(name, in) : std::nullopt;
  if (!in.fault().empty()) return failure(ErrorCode::bad_input, in.fault());
  if (!command)
    return failure(
        ErrorCode::bad_input,
        fmt::format(
            "there is no command '{}'; there are place, fit, move, rotate, flip, remove, swap, lock, unlock, "
            "slide, slide-along, settle, push, snap, compact and nearest, add-, move-, reshape-, grade- and "
            "remove-, each with defect or zone, and quantity, rotations, mirror, remove-part, add-sheet, "
            "add-strip, count, remove-stock, gap, border and kerf",
            name));
  if (!in.at_end()) return failure(ErrorCode::bad_input, fmt::format("'{}' is left over", in.word()));
  return *command;
}

}  // namespace lekalo::layout
