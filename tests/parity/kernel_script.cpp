// Random sessions on the native kernel, written to stdout call by call with their answers, for replay.mjs. On
// the way the answers are held against the workspace that the server keeps.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"
#include "support/layout_commands.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::layout;

std::string bytes_of(std::span<const double> values) {
  return {reinterpret_cast<const char*>(values.data()), 8 * values.size()};
}

/// Calls, and writes call and answer down.
template <class... Args>
std::int32_t call(const char* name, std::int32_t (*function)(Args...), std::string_view input,
                  std::type_identity_t<Args>... args) {
  if (!input.empty())
    std::memcpy(lekalo_input(static_cast<std::uint32_t>(input.size())), input.data(), input.size());
  const std::int32_t result = function(args...);
  std::string list;
  ((list += fmt::format("{}{}", list.empty() ? "" : ", ", args)), ...);
  const std::uint32_t text = lekalo_text_size(), numbers = 8 * lekalo_numbers_size();
  fmt::print("{{\"f\": \"{}\", \"a\": [{}], \"r\": {}, \"input\": {}, \"text\": {}, \"numbers\": {}}}\n",
             name, list, result, input.size(), text, numbers);
  std::fwrite(input.data(), 1, input.size(), stdout);
  std::fwrite(lekalo_text(), 1, text, stdout);
  std::fwrite(lekalo_numbers(), 1, numbers, stdout);
  return result;
}
#define CALL(function, ...) call(#function, function, __VA_ARGS__)

void require(bool holds, const char* what) {
  if (holds) return;
  fmt::print(stderr, "the kernel and the workspace differ: {}\n", what);
  std::exit(1);
}

std::vector<double> answer() { return {lekalo_numbers(), lekalo_numbers() + lekalo_numbers_size()}; }

bool same(const Violation& v, std::span<const double> n) {
  const double expected[] = {static_cast<double>(v.kind),
                             static_cast<double>(v.a),
                             static_cast<double>(v.b),
                             static_cast<double>(v.stock),
                             static_cast<double>(v.copy),
                             static_cast<double>(v.feature),
                             v.amount_mm,
                             v.at.x,
                             v.at.y,
                             v.direction.x,
                             v.direction.y};
  return std::memcmp(expected, n.data(), sizeof expected) == 0;
}

/// A violation whose defect or zone is named, as indices shift.
struct Held {
  std::array<double, kViolationSize> numbers;
  std::string feature;
  friend auto operator<=>(const Held&, const Held&) = default;
};
std::vector<Held> held_from(std::span<const double> numbers, const Document& document) {
  std::vector<Held> made;
  for (; !numbers.empty(); numbers = numbers.subspan(kViolationSize)) {
    Violation v;
    v.kind = static_cast<ViolationKind>(numbers[0]);
    v.stock = static_cast<std::uint32_t>(numbers[3]);
    v.feature = static_cast<std::uint32_t>(numbers[5]);
    Held& one = made.emplace_back();
    std::copy_n(numbers.begin(), kViolationSize, one.numbers.begin());
    one.numbers[5] = 0;
    one.feature = feature_id(document, v);
  }
  return made;
}

/// What a page keeps of the check that goes on bit by bit.
class BitByBit {
 public:
  explicit BitByBit(std::int32_t handle) : handle_(handle) {}
  void forget(std::uint64_t id) {
    std::erase_if(held_, [&](const Held& one) {
      return one.numbers[1] == static_cast<double>(id) || one.numbers[2] == static_cast<double>(id);
    });
  }
  /// \return whether nothing is left
  bool look(std::uint32_t most, const Document& document) {
    const std::int32_t count = CALL(lekalo_check_some, "", handle_, most);
    const std::vector<double> numbers = answer();
    const auto looked = static_cast<std::size_t>(numbers[1]);
    for (std::size_t i = 0; i < looked; ++i) forget(static_cast<std::uint64_t>(numbers[2 + i]));
    const std::vector<Held> found = held_from(std::span(numbers).subspan(2 + looked), document);
    require(static_cast<std::size_t>(count) == found.size(), "how many bit by bit");
    held_.insert(held_.end(), found.begin(), found.end());
    return numbers[0] == 0;
  }
  void compare(const Document& document) {
    while (!look(5, document))
      ;
    std::sort(held_.begin(), held_.end());
    CALL(lekalo_check, "", handle_);
    std::vector<Held> all = held_from(answer(), document);
    std::sort(all.begin(), all.end());
    require(held_ == all, "the check bit by bit");
  }

 private:
  std::int32_t handle_;
  std::vector<Held> held_;
};

void drag(std::int32_t handle, const Workspace& workspace, Random& random) {
  std::vector<double> ids;
  std::vector<Placement> moved;
  const double dx = random.uniform(-30, 30), dy = random.uniform(-30, 30);
  for (std::size_t i = 0, count = random.below(4) == 0 ? 3 : 1; i < count; ++i) {
    const std::uint64_t id = cases::some_id(workspace.document(), random);
    if (std::find(ids.begin(), ids.end(), static_cast<double>(id)) != ids.end()) continue;
    ids.push_back(static_cast<double>(id));
    moved.push_back(*workspace.find(id));
    moved.back().at = moved.back().at + cases::grid_point(dx, dy);
  }
  const auto count = static_cast<std::uint32_t>(ids.size());
  const std::int32_t level = CALL(lekalo_state, bytes_of(ids), handle, count, dx, dy, 0, 25, 1);
  const std::vector<double> numbers = answer();
  require((level == 0) == workspace.is_clear(moved), "clear");
  const auto violations = workspace.violations_of(moved);
  require(numbers.size() == kNearestSize + kViolationSize * violations.size(), "how many violations");
  for (std::size_t i = 0; i < violations.size(); ++i)
    require(same(violations[i], std::span(numbers).subspan(kNearestSize + kViolationSize * i)),
            "a violation");
  if (random.below(3) == 0)
    CALL(lekalo_state, bytes_of(ids), handle, count, dx, dy, random.uniform(-180, 180), 25, 1);
  require(CALL(lekalo_state, bytes_of(ids), handle, count, dx, dy, 0, 0, 0) == level, "without depths");
  const std::vector<double> quick = answer();
  require(quick.size() == numbers.size(), "how many violations without depths");
  for (std::size_t i = kNearestSize; i < quick.size(); i += kViolationSize)
    for (std::size_t j = 0; j < 6; ++j) require(quick[i + j] == numbers[i + j], "a violation without depth");
}

void session(std::size_t index) {
  const Document first = cases::random_layout(cases::seed(), 500 + index, 14);
  if (first.placements.empty()) return;
  Workspace workspace(first);
  Random random(cases::seed(), 4000 + index);
  const std::string document = io::write_layout(first);
  const std::int32_t handle = CALL(lekalo_open, document, static_cast<std::uint32_t>(document.size()));
  require(handle > 0, "open");
  BitByBit bits(handle);
  for (int kind = 0; kind < 5; ++kind)
    for (int a = 0; a < 3; ++a) CALL(lekalo_outline, "", handle, kind, a, random.below(2) == 0 ? 0 : 1);
  for (int step = 0; step < 60 && !workspace.document().placements.empty(); ++step) {
    drag(handle, workspace, random);
    const std::string line =
        to_text(random.below(4) == 0 ? cases::some_feature_command(workspace.document(), random)
                                     : cases::some_command(workspace.document(), random),
                workspace.document());
    const Mode mode = random.below(3) == 0 ? Mode::free : Mode::strict;
    const std::int32_t done = CALL(lekalo_plan, line, handle, static_cast<std::uint32_t>(line.size()),
                                   mode == Mode::strict ? 1 : 0);
    const std::vector<double> numbers = answer();
    const auto change = plan(workspace, command_from_text(line, workspace.document()).value(), mode);
    require((done < 0) == !change.has_value(), "refusal");
    if (!change) continue;
    require(numbers.size() == 1 + kPlacementSize * change->placements.size(), "how many placements");
    // As a page follows a server: placement by placement.
    for (std::size_t i = 0; i < change->placements.size(); ++i) {
      const std::span<const double> one = std::span(numbers).subspan(1 + kPlacementSize * i, kPlacementSize);
      bits.forget(static_cast<std::uint64_t>(one[0]));
      if (one[1] < 0)
        CALL(lekalo_erase, "", handle, one[0]);
      else
        CALL(lekalo_set, bytes_of(one), handle);
    }
    for (const FeatureChange& one : change->features) {
      const int kind = static_cast<int>(one.either().kind);
      if (one.after) {
        const std::string drawn = io::feature_json(*one.after);
        CALL(lekalo_set_feature, drawn, handle, one.stock, kind, one.index,
             static_cast<std::uint32_t>(drawn.size()));
        CALL(lekalo_violations_with, "", handle, one.stock, kind, one.index, 1);
      } else {
        CALL(lekalo_erase_feature, one.before->id, handle, one.stock, kind,
             static_cast<std::uint32_t>(one.before->id.size()));
      }
    }
    CALL(lekalo_set_next_id, "", handle, numbers[0]);
    carry_out(workspace, *change);
    bits.look(static_cast<std::uint32_t>(1 + random.below(4)), workspace.document());
    if (step % 4 == 0) bits.compare(workspace.document());
    if (step % 10 == 0) {
      CALL(lekalo_document, "", handle);
      require(std::string(lekalo_text(), lekalo_text_size()) == io::write_layout(workspace.document()),
              "the document");
      CALL(lekalo_placements, "", handle);
      CALL(lekalo_completeness, "", handle);
      const std::string whole(lekalo_text(), lekalo_text_size());
      CALL(lekalo_kits, "", handle);
      const std::string kits(lekalo_text(), lekalo_text_size());
      require(whole.find("\"kits\":" + kits) != std::string::npos, "the kits alone");
    }
    const double x = random.uniform(0, 300), y = random.uniform(0, 200);
    CALL(lekalo_pick, "", handle, 0, 0, x, y);
    CALL(lekalo_in_box, "", handle, 0, 0, x, y, x + 60, y + 40);
    if (step % 20 == 3) {
      CALL(lekalo_fits_where, "", handle, 0, 0, 0, 3, -1);
      std::vector<double> found = answer();
      if (!found.empty())
        CALL(lekalo_state_of, bytes_of(std::span(found).first(kPlacementSize)), handle, 1, 10, 1);
    }
  }
  CALL(lekalo_close, "", handle);
}

/// What strangers send: the same sentences.
void refusals() {
  const std::string document = io::write_layout(cases::random_layout(cases::seed(), 500, 14));
  const auto size = [](std::string_view text) { return static_cast<std::uint32_t>(text.size()); };
  const std::int32_t handle = CALL(lekalo_open, document, size(document));
  for (const char* line :
       {"move 1 by 1e-310 0", "move 1 by 1e-999 0", "move 1 by 1e999 0", "move 1 by 0x1 0", "move 1 by +1 0",
        "move 1 by inf nan", "move 1 by .5 5.", "move 1 by 0.1e1 -0", "move 1 by 1e 0", "rotate 1 1e9",
        "slide 1 towards 0 0", "move 999 by 1 1", "place 'x' y", "", "\"", "move 1,1 by 1 1", "lock 1",
        "move 1 by 2.0000000000000000000000000000000000000001 1e300"})
    CALL(lekalo_plan, line, handle, size(line), 1);
  for (const std::string& text :
       {std::string("{"), std::string("[1e400]"), std::string(100, '['), std::string("{\"format\": 3}"),
        document.substr(0, document.size() / 2), std::string("\xff\x00{", 3),
        "{\"format\": \"lekalo-layout/1\", \"units\": \"mm\", \"x_1\": 1e-400, \"rules\": {\"gap\": "
        "1e-310}}" +
            std::string(" ")})
    CALL(lekalo_open, text, size(text));
  for (const std::string text : {"", "{", "{\"id\": \"a\"}", "{\"id\": \"a\", \"severity\": 0}",
                                 "{\"id\": \"a\", \"quality\": 1, \"outline\": {\"polygon\": {\"outer\": "
                                 "[[0, 0], [1, 1], [1, 0], [0, 1]]}}}"})
    for (const int kind : {-1, 0, 1, 2}) {
      CALL(lekalo_set_feature, text, handle, 0, kind, 0, size(text));
      CALL(lekalo_erase_feature, text, handle, 0, kind, size(text));
      CALL(lekalo_violations_with, "", handle, 7, kind, 1e9, 0);
    }
  for (const double value : {0.0, -1.0, 0.5, 1e18})
    CALL(lekalo_erase, "", handle, value), CALL(lekalo_outline, "", handle, 0, value, 0),
        CALL(lekalo_pick, "", handle, value, 0, 1e9, 0);
  CALL(lekalo_document, "", -7);
  for (std::size_t field = 0; field < 10; ++field)
    for (const double value : {-1.0, 1e12, 0.3}) {
      std::vector<double> one{1, 0, 0, 0, 1, 0, 10, 10, 0, 0};
      one[field] = value;
      CALL(lekalo_set, bytes_of(one), handle);
      CALL(lekalo_state_of, bytes_of(one), handle, 1, 5, 0);
    }
  Random random(cases::seed(), 1);
  for (std::size_t i = 0; i < 2000; ++i) {
    const double degrees = random.uniform(-400, 400);
    CALL(lekalo_rotation, "", degrees);
    const std::vector<double> pair = answer();
    CALL(lekalo_degrees, "", pair[0], pair[1]);
  }
}

}  // namespace

int main() {
  refusals();
  const std::size_t sessions = std::max<std::size_t>(1, cases::case_count(300) / 25);
  for (std::size_t i = 0; i < sessions; ++i) session(i);
  return 0;
}
