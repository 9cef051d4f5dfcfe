// Strips, sheets and hides of other programs' job files.

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

#include "forms.hpp"
#include "io/layout/layout_reader.hpp"
#include "lekalo/base/limits.hpp"
#include "shapes.hpp"

namespace lekalo::io {
namespace detail {
namespace {

class JobReader {
 public:
  JobReader(const JsonTree& tree, const std::string& name, LengthUnit unit)
      : reader_(tree, name, "_"), scale_(millimetres_per(unit)), shapes_(reader_, scale_) {}

  Result<LayoutFile> read(NestingForm form) {
    const JsonValue root = reader_.tree().root();
    if (form == NestingForm::strip) strip_job(root);
    if (form == NestingForm::sheets) sheet_job(root);
    if (form == NestingForm::hides) hide_job(root);
    if (!reader_.ok()) return tl::unexpected(reader_.fault());
    merge_alike(document_.stocks);
    LayoutFile file{std::move(document_), std::move(shapes_.notices)};
    file.notices.insert(file.notices.end(), notices_.begin(), notices_.end());
    return file;
  }

 private:
  template <class Take>
  void optional(JsonValue object, std::string_view key, const Take& take) {
    if (!reader_.ok()) return;
    if (const auto value = object.find(key)) take(*value);
  }
  /// Every item of a list that must be there; its index is told.
  template <class Take>
  void items(JsonValue object, std::string_view key, std::string_view what, const Take& take) {
    const auto list = reader_.need(object, key, what);
    if (!list || !reader_.expect_list(*list, kMostParts)) return;
    std::size_t index = 0;
    for (const JsonValue item : *list) {
      if (!reader_.ok()) return;
      take(item, index++);
    }
  }
  void name(JsonValue root, std::string_view key) {
    optional(root, key, [&](JsonValue v) { document_.name = reader_.text(v); });
  }
  void notice(JsonValue at, const std::string& what) {
    notices_.push_back(fmt::format("{}: {}: {}", reader_.name(), at.path(), what));
  }

  // Strips: "strip_height" and "items".

  void strip_job(JsonValue root) {
    if (!reader_.expect_object(root, {"name", "strip_height", "items"})) return;
    name(root, "name");
    layout::Stock strip;
    strip.id = "strip";
    strip.kind = layout::StockKind::strip;
    strip.open_length = true;
    if (const auto height = reader_.need(root, "strip_height", "the strip's height"))
      strip.outline.polygon =
          rectangle(layout::kLongestStrip,
                    reader_.length(*height, limits::kShortestSide, limits::kLargestOutline, scale_));
    document_.stocks.push_back(std::move(strip));
    std::set<std::string> ids;
    items(root, "items", "what is to be cut", [&](JsonValue item, std::size_t index) {
      if (!reader_.expect_object(item,
                                 {"id", "demand", "allowed_orientations", "shape", "dxf", "min_quality"}))
        return;
      layout::Part part;
      part.id = std::to_string(index);
      optional(item, "id", [&](JsonValue v) {
        part.id = v.kind() == JsonKind::text ? reader_.text_not_empty(v)
                                             : std::to_string(reader_.integer(v, 0, kLargestCount));
      });
      if (!ids.insert(part.id).second)
        reader_.refuse(item, fmt::format("the id {} stands twice among items", part.id));
      optional(item, "min_quality", [&](JsonValue v) {
        if (v.kind() != JsonKind::null) reader_.refuse(v, "qualities of strips are not read; only null is");
      });
      if (const auto demand = reader_.need(item, "demand", "how many are wanted"))
        part.demand = reader_.integer(*demand, 0, kLargestCount);
      optional(item, "allowed_orientations", [&](JsonValue v) { orientations(v, part); });
      if (const auto shape = reader_.need(item, "shape", "the outline"))
        part.outline = shapes_.outline(*shape, shapes_.typed(*shape));
      document_.parts.push_back(std::move(part));
    });
  }

  /// A list of degrees; null for any.
  void orientations(JsonValue value, layout::Part& part) {
    if (value.kind() == JsonKind::null || !reader_.expect_list(value, kMostParts)) return;
    if (value.size() == 0) return reader_.refuse(value, "no rotation at all; null allows every one");
    for (const JsonValue item : value) {
      const double degrees = reader_.number(item, -limits::kMostDegrees, limits::kMostDegrees);
      part.rotations.push_back({degrees, degrees});
    }
  }

  // Sheets: "bin_types" and "item_types".

  void sheet_job(JsonValue root) {
    if (!reader_.expect_object(root, {"objective", "parameters", "bin_types", "item_types"})) return;
    optional(root, "parameters", [&](JsonValue parameters) {
      if (parameters.kind() != JsonKind::object)
        return reader_.refuse(parameters,
                              fmt::format("an object is needed, not {}", name_of(parameters.kind())));
      for (const JsonValue item : parameters) {
        if (item.key() == "item_item_minimum_spacing") {
          document_.rules.gap = reader_.gap(item, scale_);
        } else if (item.key().substr(0, 1) != "_") {
          notice(item, "this parameter of the solver is not read");
        }
      }
    });
    std::set<std::int64_t> borders;
    items(root, "bin_types", "the sheets",
          [&](JsonValue bin, std::size_t index) { sheet(bin, index, borders); });
    if (!borders.empty()) document_.rules.border_gap = *borders.rbegin();
    if (borders.size() > 1)
      notices_.push_back(reader_.name() +
                         ": the sheets differ in their spacing from the border; the largest "
                         "counts for all");
    items(root, "item_types", "what is to be cut",
          [&](JsonValue item, std::size_t index) { sheet_item(item, index); });
  }

  void sheet(JsonValue bin, std::size_t index, std::set<std::int64_t>& borders) {
    if (!reader_.expect_object(bin, {"type", "copies", "cost", "width", "height", "vertices", "holes",
                                     "item_bin_minimum_spacing"}))
      return;
    layout::Stock stock;
    stock.id = "sheet-" + std::to_string(index);
    stock.kind = layout::StockKind::sheet;
    optional(bin, "copies", [&](JsonValue v) { stock.count = reader_.integer(v, 1, kLargestCount); });
    // Programs of this form write -1 where nobody gave a cost.
    optional(bin, "cost", [&](JsonValue v) {
      const double cost = reader_.number(v, -1, limits::kMostMoney);
      if (cost >= 0) stock.cost = cost;
    });
    shape(bin, [&](Loops loops) { shapes_.stock(bin, std::move(loops), stock); });
    std::int64_t border = 0;
    optional(bin, "item_bin_minimum_spacing", [&](JsonValue v) { border = reader_.gap(v, scale_); });
    borders.insert(border);
    document_.stocks.push_back(std::move(stock));
  }

  /// Rectangles and polygons.
  template <class Take>
  void shape(JsonValue value, const Take& take) {
    const auto type = reader_.need(value, "type", "\"rectangle\" or \"polygon\"");
    if (!type) return;
    if (type->text_is("polygon")) {
      if (const auto width = value.find("width"); width)
        return reader_.refuse(*width, "a polygon has vertices instead");
      Loops loops = shapes_.vertices(value);
      if (reader_.ok()) take(std::move(loops));
    } else if (type->text_is("rectangle")) {
      if (const auto list = value.find("vertices"); list)
        return reader_.refuse(*list, "a rectangle has \"width\" and \"height\" instead");
      if (const auto holes = value.find("holes"); holes && holes->size() > 0)
        return reader_.refuse(*holes, "holes of rectangles are not read; give it as a polygon");
      const auto width = reader_.need(value, "width", "the length along x"),
                 height = reader_.need(value, "height", "the length along y");
      if (!width || !height) return;
      const geom::GridRegion box =
          rectangle(reader_.length(*width, limits::kShortestSide, limits::kLargestOutline, scale_),
                    reader_.length(*height, limits::kShortestSide, limits::kLargestOutline, scale_));
      if (reader_.ok()) take(Loops{box.points});
    } else {
      reader_.refuse(*type, "shapes of this kind are not read; known are \"rectangle\" and \"polygon\"");
    }
  }

  void sheet_item(JsonValue item, std::size_t index) {
    if (!reader_.expect_object(item, {"type", "copies", "shapes", "vertices", "holes", "width", "height",
                                      "allowed_rotations", "allow_mirroring", "profit"}))
      return;
    layout::Part part;
    part.id = std::to_string(index);
    part.demand = 1;
    optional(item, "copies", [&](JsonValue v) { part.demand = reader_.integer(v, 0, kLargestCount); });
    optional(item, "allow_mirroring", [&](JsonValue v) { part.may_mirror = reader_.truth(v); });
    if (const auto rotations = item.find("allowed_rotations")) {
      if (!reader_.expect_list(*rotations, kMostParts)) return;
      for (const JsonValue range : *rotations) {
        if (!reader_.expect_object(range, {"start", "end"})) return;
        const auto start = reader_.need(range, "start", "degrees"),
                   end = reader_.need(range, "end", "degrees");
        if (!start || !end) return;
        const layout::AngleRange angles{reader_.number(*start, -limits::kMostDegrees, limits::kMostDegrees),
                                        reader_.number(*end, -limits::kMostDegrees, limits::kMostDegrees)};
        if (reader_.ok() && !(angles.from <= angles.to))
          return reader_.refuse(range, "the start is above the end; add 360 to the end");
        part.rotations.push_back(angles);
      }
    }
    if (part.rotations.empty()) part.rotations.push_back({0, 0});
    const auto take = [&](JsonValue at) {
      shape(at, [&](Loops loops) { part.outline = shapes_.outline(at, std::move(loops)); });
    };
    if (const auto list = item.find("shapes")) {
      for (const char* key : {"vertices", "holes", "width", "height"})
        if (const auto inlined = item.find(key); inlined)
          return reader_.refuse(*inlined, "it stands beside \"shapes\"; give the shape once");
      if (!reader_.expect_list(*list, kMostParts)) return;
      if (list->size() != 1)
        return reader_.refuse(*list, fmt::format("an item of {} shapes; a part is one piece: make each shape "
                                                 "an item",
                                                 list->size()));
      const JsonValue only = *list->begin();
      if (reader_.expect_object(only, {"type", "vertices", "holes", "width", "height"})) take(only);
    } else {
      take(item);
    }
    document_.parts.push_back(std::move(part));
  }

  // Hides: "Items" and "Objects".

  void hide_job(JsonValue root) {
    if (!reader_.expect_object(root, {"Name", "Items", "Objects"})) return;
    name(root, "Name");
    items(root, "Objects", "the hides", [&](JsonValue object, std::size_t index) {
      if (!reader_.expect_object(object, {"Cost", "Stock", "Dxf", "Zones", "Shape"})) return;
      layout::Stock stock;
      stock.id = "hide-" + std::to_string(index);
      stock.kind = layout::StockKind::hide;
      optional(object, "Cost", [&](JsonValue v) { stock.cost = reader_.number(v, 0, limits::kMostMoney); });
      optional(object, "Stock", [&](JsonValue v) { stock.count = reader_.integer(v, 1, kLargestCount); });
      if (const auto shape = reader_.need(object, "Shape", "the outline"))
        shapes_.stock(*shape, shapes_.typed(*shape), stock);
      const auto larger = [](int) { return NestingShapes::Stricter::larger; };
      zones(object, larger, [&](int quality, layout::Outline outline, const std::string& number) {
        stock.zones.push_back({"zone-" + number, quality, std::move(outline)});
      });
      document_.stocks.push_back(std::move(stock));
    });
    items(root, "Items", "what is to be cut", [&](JsonValue item, std::size_t index) {
      if (!reader_.expect_object(
              item, {"Demand", "DemandMax", "Dxf", "BaseQuality", "Zones", "Shape", "AllowedOrientations"}))
        return;
      layout::Part part;
      part.id = std::to_string(index);
      if (const auto demand = reader_.need(item, "Demand", "how many are wanted"))
        part.demand = reader_.integer(*demand, 0, kLargestCount);
      optional(item, "DemandMax", [&](JsonValue v) {
        if (reader_.integer(v, 0, kLargestCount) != part.demand && reader_.ok())
          notice(v, "it differs from \"Demand\", which counts");
      });
      part.quality = layout::kBestQuality;
      optional(item, "BaseQuality", [&](JsonValue v) {
        if (v.kind() != JsonKind::null)
          part.quality = static_cast<int>(reader_.integer(v, 0, limits::kMostLevel));
      });
      optional(item, "AllowedOrientations", [&](JsonValue v) { orientations(v, part); });
      if (const auto shape = reader_.need(item, "Shape", "the outline"))
        part.outline = shapes_.outline(*shape, shapes_.typed(*shape));
      // An area that asks for less than the part forbids more where it is smaller.
      const auto stricter = [&](int quality) {
        return quality >= part.quality ? NestingShapes::Stricter::larger : NestingShapes::Stricter::smaller;
      };
      zones(item, stricter, [&](int quality, layout::Outline outline, const std::string&) {
        part.areas.push_back({quality, std::move(outline)});
      });
      document_.parts.push_back(std::move(part));
    });
  }

  /// Reads the zones, those that cross themselves by what `stricter` says of their quality.
  template <class Stricter, class Take>
  void zones(JsonValue value, const Stricter& stricter, const Take& take) {
    const auto list = value.find("Zones");
    if (!list || !reader_.expect_list(*list, kMostParts)) return;
    std::size_t index = 0;
    for (const JsonValue zone : *list) {
      if (!reader_.expect_object(zone, {"Quality", "Shape"})) return;
      const auto quality = reader_.need(zone, "Quality", "a whole number, higher is better"),
                 shape = reader_.need(zone, "Shape", "the outline");
      if (!quality || !shape) return;
      const int level = static_cast<int>(reader_.integer(*quality, 0, limits::kMostLevel));
      std::vector<layout::Outline> outlines = shapes_.zone(*shape, shapes_.typed(*shape), stricter(level));
      if (!reader_.ok()) return;
      // A zone in several pieces has numbers 3, 3-2, 3-3.
      for (std::size_t piece = 0; piece < outlines.size(); ++piece)
        take(level, std::move(outlines[piece]),
             piece == 0 ? std::to_string(index) : fmt::format("{}-{}", index, piece + 1));
      ++index;
    }
  }

  JsonReader reader_;
  double scale_;
  NestingShapes shapes_;
  layout::Document document_;
  std::vector<std::string> notices_;
};

}  // namespace

std::optional<NestingForm> form_of(const JsonTree& tree) {
  const JsonValue root = tree.root();
  const auto has = [&](const char* key) { return root.find(key).has_value(); };
  if (has("format")) return std::nullopt;
  if (has("strip_height") && has("items")) return NestingForm::strip;
  if (has("bin_types") || has("item_types")) return NestingForm::sheets;
  if (has("Items") || has("Objects")) return NestingForm::hides;
  if (has("placements")) return NestingForm::placements;
  if (has("items")) return NestingForm::strip;
  return std::nullopt;
}

Result<LayoutFile> read_nesting_tree(const JsonTree& tree, const std::string& name, NestingForm form,
                                     std::optional<LengthUnit> unit) {
  return JobReader(tree, name, unit.value_or(LengthUnit::millimetre)).read(form);
}

}  // namespace detail

Result<LayoutFile> read_nesting(std::string_view bytes, const std::string& name,
                                std::optional<LengthUnit> unit) {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  const auto form = detail::form_of(tree);
  if (!form)
    return failure(ErrorCode::bad_input,
                   name +
                       ": no job of a nesting program; known are strips (\"strip_height\", \"items\"), "
                       "sheets (\"bin_types\", \"item_types\") and hides (\"Items\", \"Objects\")");
  if (*form == NestingForm::placements)
    return failure(ErrorCode::bad_input,
                   name + ": placements alone; the file of the items that they place is needed too");
  return detail::read_nesting_tree(tree, name, *form, unit);
}

}  // namespace lekalo::io
