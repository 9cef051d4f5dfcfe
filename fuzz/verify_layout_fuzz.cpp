// Three ways into verify_layout, chosen by the first byte:
//   0: the rest is a layout. Whatever it is, there is a verdict or one sentence, and the same one again.
//   1: edits of a layout, three bytes each (place, new byte): as above.
//   2: two outlines of a small lattice and a shift, as the layout of a stock and two parts: overlaps, parts
//      outside and gaps are those that phi finds.

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <tuple>

#include "lekalo/phi/outline_relation.hpp"
#include "lekalo/verify/layout.hpp"
#include "support/layout_texts.hpp"

namespace {

using namespace lekalo;

void demand(bool condition) {
  if (!condition) std::abort();
}

void check(std::string_view bytes) {
  const auto verdict = verify::verify_layout({"layout.json", bytes});
  if (!verdict) {
    demand(verdict.error().code == ErrorCode::bad_input);
    demand(!verdict.error().message.empty() && verdict.error().message.size() < 2000);
    return;
  }
  const auto again = verify::verify_layout({"layout.json", bytes});
  demand(again && again->violations == verdict->violations);
  for (const verify::LayoutViolation& v : verdict->violations)
    demand(v.a > 0 && (v.b == 0 || v.b > v.a) && !v.stock.empty());
}

cases::Json example() {
  cases::Json layout = cases::empty_layout();
  layout["rules"] = {{"gap", 3}, {"border_gap", 5}, {"defect_gap", 1}};
  cases::Json& stock = layout["stocks"][0];
  stock["grain_deg"] = 90;
  stock["defects"] = {
      {{"id", "d"}, {"severity", 2}, {"outline", cases::outline_json(cases::rectangle(30, 30, 4, 4))}}};
  stock["zones"] = {
      {{"id", "z"}, {"quality", 1}, {"outline", cases::outline_json(cases::rectangle(60, 0, 40, 90))}}};
  cases::Json& part = cases::add_part(
      layout, "a", cases::outline_json(cases::rectangle(0, 0, 20, 20), {cases::rectangle(5, 5, 4, 4)}));
  part["quality"] = "best";
  part["areas"] = {{{"quality", 0}, {"outline", cases::outline_json(cases::rectangle(10, 0, 10, 9))}}};
  part["rotations"] = {0, {{"from", 85}, {"to", 95}}};
  part["grain"] = {{"deg", 90}, {"tolerance_deg", 5}};
  layout["kits"] = {{{"id", "k"}, {"pieces", {{{"part", "a"}, {"count", 2}}}}}};
  cases::place(layout, "a", 10, 10);
  cases::place(layout, "a", 33, 10, 90);
  cases::place(layout, "a", 50, 40);
  return layout;
}

void try_edits(const std::uint8_t* data, std::size_t size) {
  static const std::string honest = example().dump();
  std::string bytes = honest;
  for (std::size_t i = 0; i + 3 <= size && i < 30; i += 3)
    bytes[(data[i] * 256U + data[i + 1]) % bytes.size()] = static_cast<char>(data[i + 2] % 128);
  check(bytes);
}

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::int64_t below(std::int64_t n) { return at_ < size_ ? data_[at_++] % n : 0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

constexpr std::int64_t kUnit = 64;  // steps between points of the lattice

cases::Points in_mm(const std::vector<geom::GridPoint>& loop) {
  cases::Points points;
  for (const geom::GridPoint p : loop) points.emplace_back(geom::mm_from_grid(p.x), geom::mm_from_grid(p.y));
  return points;
}

struct Shape {
  geom::GridRegion region;
  cases::Json json;
};

/// Nothing where the bytes are no outline; repeated points are one.
std::optional<Shape> shape(Bytes& bytes) {
  std::vector<std::vector<geom::GridPoint>> loops(static_cast<std::size_t>(1 + bytes.below(3)));
  for (auto& loop : loops)
    for (std::int64_t i = 0, n = 3 + bytes.below(7); i < n; ++i) {
      const std::int64_t x = kUnit * bytes.below(9);
      loop.push_back({x, kUnit * bytes.below(9)});
    }
  const auto made = geom::make_grid_region(std::move(loops));
  if (!made) return std::nullopt;
  std::vector<cases::Points> written;
  for (std::size_t l = 0; l < made->loops(); ++l)
    written.push_back(in_mm(
        {made->points.begin() + made->loop_starts[l], made->points.begin() + made->loop_starts[l + 1]}));
  return Shape{*made, cases::outline_json(written[0], {written.begin() + 1, written.end()})};
}

void try_outlines(Bytes bytes) {
  const auto stock = shape(bytes), a = shape(bytes), b = shape(bytes);
  if (!stock || !a || !b) return;
  const auto coordinate = [&] { return kUnit * (bytes.below(17) - 8) + bytes.below(3) - 1; };
  const std::int64_t x = coordinate();
  const geom::GridPoint shift{x, coordinate()};
  const std::int64_t gap = kUnit * bytes.below(6) + bytes.below(2);
  cases::Json layout = cases::empty_layout();
  layout["rules"] = {{"gap", geom::mm_from_grid(gap)}, {"border_gap", geom::mm_from_grid(gap)}};
  layout["stocks"][0]["outline"] = stock->json;
  cases::add_part(layout, "a", a->json);
  cases::add_part(layout, "b", b->json);
  cases::place(layout, "a", 0, 0);
  cases::place(layout, "b", geom::mm_from_grid(shift.x), geom::mm_from_grid(shift.y));
  const auto verdict = verify::verify_layout({"layout.json", layout.dump()});
  demand(verdict.has_value());
  const auto has = [&](verify::LayoutRule kind, std::uint64_t id) {
    for (const verify::LayoutViolation& v : verdict->violations)
      if (v.kind == kind && v.a == id) return true;
    return false;
  };
  const bool meet = phi::interiors_meet(a->region, b->region, shift);
  demand(has(verify::LayoutRule::overlap, 1) == meet);
  demand(has(verify::LayoutRule::gap, 1) ==
         (!meet && phi::edges_nearer_than(a->region, b->region, gap, shift)));
  for (const auto& [id, part, at] :
       {std::tuple{1U, &a->region, geom::GridPoint{}}, std::tuple{2U, &b->region, shift}}) {
    const bool within = phi::lies_within(stock->region, *part, at);
    demand(has(verify::LayoutRule::outside, id) == !within);
    demand(has(verify::LayoutRule::border_gap, id) ==
           (within && phi::edges_nearer_than(stock->region, *part, gap, at)));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  switch (data[0] % 3) {
    case 0:
      check({reinterpret_cast<const char*>(data) + 1, size - 1});
      break;
    case 1:
      try_edits(data + 1, size - 1);
      break;
    default:
      try_outlines({data + 1, size - 1});
  }
  return 0;
}
