// Placements on a strip in the form that other programs share: item, degrees, x, y.

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "forms.hpp"
#include "io/text/decimal.hpp"
#include "io/text/grid_decimal.hpp"
#include "io/text/json_reader.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/io/text/json_writer.hpp"

namespace lekalo::io {
namespace detail {
namespace {

/// The id as a number, written as numbers are.
std::optional<std::int64_t> number_of(const std::string& id) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), value);
  if (error != std::errc() || end != id.data() + id.size() || value < 0 || std::to_string(value) != id)
    return std::nullopt;
  return value;
}

/// The value of "item" for every part: its id where all ids are numbers, else its index.
std::vector<std::int64_t> item_numbers(const layout::Document& document) {
  std::vector<std::int64_t> numbers;
  for (const layout::Part& part : document.parts) {
    const auto number = number_of(part.id);
    if (!number || *number > kLargestCount) {
      numbers.resize(document.parts.size());
      std::iota(numbers.begin(), numbers.end(), 0);
      return numbers;
    }
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

Result<std::string> instance_of_tree(const JsonTree& tree, const std::string& name) {
  JsonReader reader(tree, name, "_");
  const auto instance = reader.need(tree.root(), "instance", "the file of the items");
  std::string path = instance ? reader.text_not_empty(*instance) : std::string();
  if (!reader.ok()) return tl::unexpected(reader.fault());
  return path;
}

Result<LayoutFile> read_placements_tree(const JsonTree& tree, const std::string& name,
                                        layout::Document instance, std::optional<LengthUnit> unit) {
  JsonReader reader(tree, name, "_");
  const JsonValue root = tree.root();
  const double scale = millimetres_per(unit.value_or(LengthUnit::millimetre));
  if (instance.stocks.size() != 1 || instance.stocks[0].kind != layout::StockKind::strip)
    return failure(ErrorCode::bad_input, name + ": its items must come from a file of one strip");
  if (!reader.expect_object(
          root, {"instance", "made_by", "strip_height", "length", "density", "note", "placements"}))
    return tl::unexpected(reader.fault());
  if (const auto height = root.find("strip_height")) {
    const std::int64_t said = reader.length(*height, 0, limits::kLargestOutline, scale);
    const std::int64_t is = geom::bounds(instance.stocks[0].outline.polygon).high.y;
    if (reader.ok() && said != is)
      reader.refuse(*height, fmt::format("{} mm, but the strip of the items is {} mm high; these placements "
                                         "belong to another file",
                                         geom::mm_from_grid(said), geom::mm_from_grid(is)));
  }
  const std::vector<std::int64_t> numbers = item_numbers(instance);
  std::unordered_map<std::int64_t, std::uint32_t> index;
  for (std::size_t i = 0; i < numbers.size(); ++i) index.emplace(numbers[i], static_cast<std::uint32_t>(i));

  instance.placements.clear();
  instance.next_id = 1;
  const auto list = reader.need(root, "placements", "where the items lie");
  if (!list || !reader.expect_list(*list, kMostPlacements)) return tl::unexpected(reader.fault());
  for (const JsonValue value : *list) {
    if (!reader.expect_object(value, {"item", "rotation", "x", "y"})) break;
    const auto item = reader.need(value, "item", "the item's id"),
               rotation = reader.need(value, "rotation", "degrees"), x = reader.need(value, "x", "a length"),
               y = reader.need(value, "y", "a length");
    if (!reader.ok()) break;
    const std::int64_t number = reader.integer(*item, 0, kLargestCount);
    const auto found = index.find(number);
    if (reader.ok() && found == index.end()) {
      reader.refuse(*item, fmt::format("there is no item {} among the {} of its file", number, index.size()));
    }
    if (!reader.ok()) break;
    layout::Placement placement;
    placement.id = instance.next_id++;
    placement.part = found->second;
    placement.rotation =
        geom::rotation_from_degrees(reader.number(*rotation, -limits::kMostDegrees, limits::kMostDegrees));
    placement.at = {reader.length(*x, -limits::kLargestPlacement, limits::kLargestPlacement, scale),
                    reader.length(*y, -limits::kLargestPlacement, limits::kLargestPlacement, scale)};
    instance.placements.push_back(placement);
  }
  if (!reader.ok()) return tl::unexpected(reader.fault());
  return LayoutFile{std::move(instance), {}};
}

}  // namespace detail

Result<std::string> instance_of_placements(std::string_view bytes, const std::string& name) {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  return detail::instance_of_tree(tree, name);
}

Result<LayoutFile> read_placements(std::string_view bytes, const std::string& name, layout::Document instance,
                                   std::optional<LengthUnit> unit) {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  return detail::read_placements_tree(tree, name, std::move(instance), unit);
}

Result<std::size_t> strip_in_use(const layout::Document& document) {
  for (std::size_t stock = 0; stock < document.stocks.size(); ++stock) {
    if (document.stocks[stock].kind != layout::StockKind::strip) continue;
    for (const layout::Placement& placement : document.placements)
      if (placement.stock == stock) return stock;
  }
  return failure(ErrorCode::bad_input,
                 "nothing lies on a strip; the form 'placements' holds the parts of one strip");
}

Result<std::string> write_placements(const layout::Document& document, std::size_t stock,
                                     const std::string& instance) {
  if (stock >= document.stocks.size())
    return failure(ErrorCode::bad_input,
                   fmt::format("stock {} is asked for; there are {}", stock, document.stocks.size()));
  const layout::Stock& strip = document.stocks[stock];
  if (strip.kind != layout::StockKind::strip)
    return failure(ErrorCode::bad_input,
                   fmt::format("the stock {} is no strip, and this form has strips alone; "
                               "write the layout itself",
                               excerpt(strip.id)));
  const std::vector<std::int64_t> numbers = detail::item_numbers(document);
  std::vector<const layout::Placement*> placed;
  std::int64_t length = 0;
  double area = 0;
  for (const layout::Placement& placement : document.placements) {
    if (placement.stock != stock) continue;
    if (placement.mirrored)
      return failure(ErrorCode::bad_input,
                     fmt::format("placement {} is mirrored, which this form cannot say; write the layout "
                                 "itself",
                                 placement.id));
    const layout::Part& part = document.parts[placement.part];
    length = std::max(length, geom::bounds(layout::placed_outline(part, placement)).high.x);
    area += geom::area_mm2(part.outline.polygon);
    placed.push_back(&placement);
  }
  if (placed.empty())
    return failure(ErrorCode::bad_input, fmt::format("nothing lies on the strip {}", excerpt(strip.id)));
  const std::int64_t height = geom::bounds(strip.outline.polygon).high.y;
  JsonWriter json(JsonLayout::spaced);
  json.begin_object().line(1).field("instance", instance);
  detail::append_mm(json.line(1).key("strip_height").raw(), height);
  detail::append_mm(json.line(1).key("length").raw(), length);
  const double room = geom::mm_from_grid(height) * geom::mm_from_grid(length);
  if (length > 0) json.line(1).field("density", area / room + 0.0);
  json.line(1).field("note",
                     "a part's outline is turned about the origin by rotation (degrees, "
                     "counter-clockwise), then moved by x, y (mm)");
  json.line(1).key("placements").list_of_lines(placed, 2, 1, [&](const layout::Placement* placement) {
    json.begin_object().fields(
        {{"item", numbers[placement->part]}, {"rotation", geom::degrees_of(placement->rotation) + 0.0}});
    detail::append_mm(json.key("x").raw(), placement->at.x);
    detail::append_mm(json.key("y").raw(), placement->at.y);
    json.end();
  });
  json.line(0).end();
  return json.take() + "\n";
}

}  // namespace lekalo::io
