// Reads a layout document from JSON and holds it to its rules.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "io/shape/region_reader.hpp"
#include "io/text/decimal.hpp"
#include "layout_outline.hpp"
#include "layout_reader.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/layout/job.hpp"
#include "mark_words.hpp"

namespace lekalo::io {
namespace detail {
namespace {

using layout::Document;

constexpr std::string_view kFormat = "lekalo-layout/1";
// The limits of commands are those of files, so that what commands make can be read again.
static_assert(layout::kMostSeverity == limits::kMostSeverity && kNeverTolerated == limits::kMostSeverity &&
              layout::kMostQuality == limits::kMostLevel &&
              layout::kMostFeaturePoints == kMostOutlinePoints && layout::kLongestFeatureId == kLongestText &&
              layout::kMostItems == kMostParts);

class LayoutReader {
 public:
  explicit LayoutReader(JsonReader& reader) : reader_(reader) {}

  LayoutFile read() {
    const JsonValue root = reader_.tree().root();
    if (!expect_format(root)) return {};
    if (!reader_.expect_object(
            root, {"format", "units", "name", "rules", "stocks", "parts", "kits", "placements", "next_id"}))
      return {};
    if (const auto units = reader_.need(root, "units", "which is \"mm\""); units && units->text_is("mm")) {
    } else if (units) {
      reader_.refuse(*units, "a layout is in millimetres: \"mm\"");
    }
    optional(root, "name", [&](JsonValue v) { document_.name = reader_.text(v); });
    optional(root, "rules", [&](JsonValue v) { rules(v); });
    items(root, "stocks", kMostParts, [&](JsonValue v) { stock(v); });
    items(root, "parts", kMostParts, [&](JsonValue v) { part(v); });
    items(root, "kits", kMostParts, [&](JsonValue v) { kit(v); });
    items(root, "placements", kMostPlacements, [&](JsonValue v) { placement(v); });
    if (reader_.ok()) order_placements(root);
    return {std::move(document_), notices()};
  }

  layout::Feature read_feature(layout::FeatureKind kind) {
    std::unordered_set<std::string> taken;
    return feature(reader_.tree().root(), kind, taken);
  }
  layout::Part read_part() { return part_of(reader_.tree().root()); }
  layout::Stock read_stock() { return stock_of(reader_.tree().root()); }
  layout::Kit read_kit() {
    return kit_of(reader_.tree().root(), [this](JsonValue v) {
      return static_cast<std::uint32_t>(reader_.integer(v, 0, kMostParts - 1));
    });
  }

 private:
  template <class Take>
  void optional(JsonValue object, std::string_view key, const Take& take) {
    if (!reader_.ok()) return;
    if (const auto value = object.find(key)) take(*value);
  }
  template <class Take>
  void items(JsonValue object, std::string_view key, std::size_t most, const Take& take) {
    optional(object, key, [&](JsonValue list) {
      if (!reader_.expect_list(list, most)) return;
      for (const JsonValue item : list) {
        take(item);
        if (!reader_.ok()) return;
      }
    });
  }

  bool expect_format(JsonValue root) {
    if (root.kind() != JsonKind::object) {
      reader_.refuse(root, fmt::format("a layout is an object, not {}", name_of(root.kind())));
      return false;
    }
    const auto format = reader_.need(root, "format", "which is \"lekalo-layout/1\"");
    if (!format || format->text_is(kFormat)) return reader_.ok();
    reader_.refuse(*format, format->kind() == JsonKind::text
                                ? fmt::format("the format is {}; this program reads \"{}\"",
                                              excerpt(format->text()), kFormat)
                                : fmt::format("\"{}\" is needed", kFormat));
    return false;
  }

  /// The text under "id", which nobody else in `taken` has.
  std::string id(JsonValue object, std::unordered_set<std::string>& taken, const char* whose) {
    const auto value = reader_.need(object, "id", "the name that others refer to");
    if (!value) return {};
    std::string text = reader_.text_not_empty(*value);
    if (reader_.ok() && !taken.insert(text).second)
      reader_.refuse(*value,
                     fmt::format("the id {} stands twice among {}; give each its own", excerpt(text), whose));
    return text;
  }

  layout::Outline outline(JsonValue object, geom::ChordSide side) {
    const auto value = reader_.need(object, "outline", "the shape");
    return value ? read_outline(reader_, *value, side, chords_made_) : layout::Outline{};
  }

  int level(JsonValue value, std::int64_t low = 0, std::int64_t high = limits::kMostLevel) {
    return static_cast<int>(reader_.integer(value, low, high));
  }
  int quality(JsonValue value) { return value.text_is("best") ? layout::kBestQuality : level(value); }

  void rules(JsonValue value) {
    if (!reader_.expect_object(value, {"gap", "border_gap", "defect_gap", "kerf"})) return;
    optional(value, "gap", [&](JsonValue v) { document_.rules.gap = reader_.gap(v); });
    optional(value, "border_gap", [&](JsonValue v) { document_.rules.border_gap = reader_.gap(v); });
    optional(value, "defect_gap", [&](JsonValue v) { document_.rules.defect_gap = reader_.gap(v); });
    optional(value, "kerf", [&](JsonValue v) { document_.rules.kerf = reader_.gap(v); });
  }

  void stock(JsonValue value) {
    layout::Stock stock = stock_of(value);
    stock_index_.emplace(stock.id, static_cast<std::uint32_t>(document_.stocks.size()));
    document_.stocks.push_back(std::move(stock));
  }

  layout::Stock stock_of(JsonValue value) {
    layout::Stock stock;
    if (!reader_.expect_object(value, {"id", "name", "material", "thickness", "kind", "count", "cost",
                                       "outline", "height", "length", "grain_deg", "defects", "zones"}))
      return stock;
    stock.id = id(value, stock_ids_, "stocks");
    optional(value, "name", [&](JsonValue v) { stock.name = reader_.text(v); });
    material(value, stock.material);
    if (const auto kind = reader_.need(value, "kind", "\"strip\", \"sheet\" or \"hide\"")) {
      if (kind->text_is("strip"))
        stock.kind = layout::StockKind::strip;
      else if (kind->text_is("sheet"))
        stock.kind = layout::StockKind::sheet;
      else if (kind->text_is("hide"))
        stock.kind = layout::StockKind::hide;
      else
        reader_.refuse(*kind, "a stock is a \"strip\", a \"sheet\" or a \"hide\"");
    }
    optional(value, "count", [&](JsonValue v) {
      stock.count = reader_.integer(v, 1, limits::kMostCount);
      if (stock.kind == layout::StockKind::strip && reader_.ok() && stock.count != 1)
        reader_.refuse(v, "there is one of a strip; give others their own ids");
    });
    optional(value, "cost", [&](JsonValue v) { stock.cost = reader_.number(v, 0, limits::kMostMoney); });
    optional(value, "grain_deg", [&](JsonValue v) {
      stock.grain_degrees = reader_.number(v, -limits::kMostDegrees, limits::kMostDegrees);
    });
    stock.kind == layout::StockKind::strip ? strip(value, stock) : no_strip(value, stock);
    std::unordered_set<std::string> defect_ids, zone_ids;
    items(value, "defects", layout::kMostFeatures, [&](JsonValue v) {
      layout::Feature defect = feature(v, layout::FeatureKind::defect, defect_ids);
      stock.defects.push_back({std::move(defect.id), defect.grade, std::move(defect.outline)});
    });
    items(value, "zones", layout::kMostFeatures, [&](JsonValue v) {
      layout::Feature zone = feature(v, layout::FeatureKind::zone, zone_ids);
      stock.zones.push_back({std::move(zone.id), zone.grade, std::move(zone.outline)});
    });
    return stock;
  }

  layout::Feature feature(JsonValue v, layout::FeatureKind kind, std::unordered_set<std::string>& taken) {
    layout::Feature feature;
    feature.kind = kind;
    if (kind == layout::FeatureKind::defect) {
      if (!reader_.expect_object(v, {"id", "severity", "outline"})) return feature;
      feature.id = id(v, taken, "defects of this stock");
      optional(v, "severity", [&](JsonValue s) { feature.grade = level(s, 1, kNeverTolerated); });
    } else {
      if (!reader_.expect_object(v, {"id", "quality", "outline"})) return feature;
      feature.id = id(v, taken, "zones of this stock");
      if (const auto q = reader_.need(v, "quality", "a whole number, higher is better"))
        feature.grade = level(*q);
    }
    feature.outline = outline(v, geom::ChordSide::grow);
    return feature;
  }

  void strip(JsonValue value, layout::Stock& stock) {
    if (const auto wrong = value.find("outline"); wrong)
      return reader_.refuse(*wrong, "a strip has \"height\" and perhaps \"length\" instead of an outline");
    const auto height = reader_.need(value, "height", "how wide the strip is across, mm");
    if (!height) return;
    const std::int64_t across = reader_.length(*height, limits::kShortestSide, limits::kLargestOutline);
    const auto length = value.find("length");
    stock.open_length = !length;
    const std::int64_t along = length
                                   ? reader_.length(*length, limits::kShortestSide, limits::kLargestOutline)
                                   : layout::kLongestStrip;
    stock.outline.polygon = rectangle(along, across);
  }

  void no_strip(JsonValue value, layout::Stock& stock) {
    for (const char* key : {"height", "length"})
      optional(value, key, [&](JsonValue v) {
        reader_.refuse(v, "it belongs to a strip; sheets and hides have an \"outline\"");
      });
    stock.outline = outline(value, geom::ChordSide::shrink);
  }

  void material(JsonValue value, layout::Material& material) {
    optional(value, "material", [&](JsonValue v) { material.name = reader_.text(v); });
    optional(value, "thickness", [&](JsonValue v) {
      material.thickness = reader_.length(v, limits::kShortestSide, limits::kLargestOutline);
    });
  }

  std::string day(JsonValue value) {
    std::string text = reader_.text(value);
    if (reader_.ok() && !layout::is_day(text))
      reader_.refuse(value, fmt::format("{} is no day; write it as in 2026-12-01", excerpt(text)));
    return text;
  }

  void part(JsonValue value) {
    layout::Part part = part_of(value);
    part_index_.emplace(part.id, static_cast<std::uint32_t>(document_.parts.size()));
    document_.parts.push_back(std::move(part));
  }

  layout::Part part_of(JsonValue value) {
    layout::Part part;
    if (!reader_.expect_object(value, {"id",        "name",   "material", "thickness",
                                       "customer",  "due",    "label",    "outline",
                                       "quality",   "areas",  "marks",    "texts",
                                       "rotations", "mirror", "grain",    "tolerated_severity",
                                       "priority",  "demand", "gap",      "border_gap",
                                       "defect_gap"}))
      return part;
    part.id = id(value, part_ids_, "parts");
    optional(value, "name", [&](JsonValue v) { part.name = reader_.text(v); });
    material(value, part.material);
    optional(value, "customer", [&](JsonValue v) { part.purpose.customer = reader_.text(v); });
    optional(value, "due", [&](JsonValue v) { part.purpose.due = day(v); });
    optional(value, "label", [&](JsonValue v) { part.purpose.label = reader_.text(v); });
    part.outline = outline(value, geom::ChordSide::grow);
    optional(value, "quality", [&](JsonValue v) { part.quality = quality(v); });
    items(value, "areas", kMostParts, [&](JsonValue v) {
      layout::PartArea area;
      if (!reader_.expect_object(v, {"quality", "outline"})) return;
      if (const auto q = reader_.need(v, "quality", "a whole number or \"best\"")) area.quality = quality(*q);
      area.outline = outline(v, geom::ChordSide::grow);
      part.areas.push_back(std::move(area));
    });
    items(value, "marks", kMostMarkEdges, [&](JsonValue v) { mark(v, part); });
    items(value, "texts", kMostMarkEdges, [&](JsonValue v) { text(v, part); });
    optional(value, "rotations", [&](JsonValue v) { rotations(v, part); });
    optional(value, "mirror", [&](JsonValue v) { part.may_mirror = reader_.truth(v); });
    optional(value, "grain", [&](JsonValue v) {
      layout::Grain grain;
      if (!reader_.expect_object(v, {"deg", "tolerance_deg"})) return;
      if (const auto deg = reader_.need(v, "deg", "its direction in the part"))
        grain.degrees = reader_.number(*deg, -limits::kMostDegrees, limits::kMostDegrees);
      optional(v, "tolerance_deg", [&](JsonValue t) { grain.tolerance_degrees = reader_.number(t, 0, 90); });
      part.grain = grain;
    });
    optional(value, "tolerated_severity", [&](JsonValue v) { part.tolerated_severity = level(v); });
    optional(value, "priority", [&](JsonValue v) { part.priority = level(v, -limits::kMostLevel); });
    optional(value, "demand", [&](JsonValue v) { part.demand = reader_.integer(v, 0, limits::kMostCount); });
    optional(value, "gap", [&](JsonValue v) { part.gap = reader_.gap(v); });
    optional(value, "border_gap", [&](JsonValue v) { part.border_gap = reader_.gap(v); });
    optional(value, "defect_gap", [&](JsonValue v) { part.defect_gap = reader_.gap(v); });
    return part;
  }

  void mark(JsonValue value, layout::Part& part) {
    layout::PartMark mark;
    if (!reader_.expect_object(value, {"layer", "colour", "role", "edges"})) return;
    look(value, mark);
    const auto edges = reader_.need(value, "edges", "its lines and arcs");
    if (!edges || !reader_.expect_list(*edges, kMostMarkEdges)) return;
    auto chain = read_chain(*edges, fmt::format("{}: {}", reader_.name(), edges->path()));
    if (!chain) return reader_.take(chain.error());
    mark.edges = *std::move(chain);
    part.marks.push_back(std::move(mark));
  }

  /// Reads the layer, the colour and the role of a mark or a text.
  template <class Item>
  void look(JsonValue value, Item& item) {
    optional(value, "layer", [&](JsonValue v) { item.layer = reader_.text(v); });
    optional(value, "colour", [&](JsonValue v) {
      item.colour = reader_.text(v);
      if (reader_.ok() && !is_colour(item.colour))
        reader_.refuse(v, fmt::format("{} is no colour; write it as in #0000ff", excerpt(item.colour)));
    });
    optional(value, "role", [&](JsonValue v) {
      const std::string word = reader_.text(v);
      const auto role = value_among(kMarkRoles, word);
      if (role)
        item.role = *role;
      else if (reader_.ok())
        reader_.refuse(v, fmt::format("{} is no role; there are mark, engrave, bend and cut", excerpt(word)));
    });
  }

  void text(JsonValue value, layout::Part& part) {
    layout::PartText text;
    if (!reader_.expect_object(value, {"text", "at", "height", "deg", "width_factor", "mirrored", "anchor",
                                       "layer", "colour", "role"}))
      return;
    look(value, text);
    const auto words = reader_.need(value, "text", "its letters"),
               at = reader_.need(value, "at", "where it stands"),
               height = reader_.need(value, "height", "that of its capitals, mm");
    if (!words || !at || !height) return;
    text.text = reader_.text_not_empty(*words);
    if (!reader_.expect_list(*at, 2)) return;
    if (at->size() != 2) return reader_.refuse(*at, "a place is two numbers, x and y");
    double place[2] = {0, 0};
    std::size_t k = 0;
    for (const JsonValue number : *at)
      place[k++] = reader_.number(number, -limits::kLargestCoordinate, limits::kLargestCoordinate);
    text.at = {place[0], place[1]};
    text.height = reader_.number(*height, limits::kLowestText, limits::kHighestText);
    optional(value, "deg", [&](JsonValue v) {
      text.degrees = reader_.number(v, -limits::kMostDegrees, limits::kMostDegrees);
    });
    optional(value, "width_factor", [&](JsonValue v) {
      text.width_factor = reader_.number(v, limits::kNarrowestText, limits::kWidestText);
    });
    optional(value, "mirrored", [&](JsonValue v) { text.mirrored = reader_.truth(v); });
    optional(value, "anchor", [&](JsonValue v) {
      const std::string word = reader_.text(v);
      const auto anchor = value_among(kTextAnchors, word);
      if (anchor)
        text.anchor = *anchor;
      else if (reader_.ok())
        reader_.refuse(v, fmt::format("{} is no anchor; there are left, middle and right", excerpt(word)));
    });
    part.texts.push_back(std::move(text));
  }

  void rotations(JsonValue value, layout::Part& part) {
    if (!reader_.expect_list(value, kMostParts)) return;
    if (value.size() == 0)
      return reader_.refuse(value, "no rotation at all; leave \"rotations\" out to allow every one");
    for (const JsonValue item : value) {
      if (item.is_number()) {
        const double angle = reader_.number(item, -limits::kMostDegrees, limits::kMostDegrees);
        part.rotations.push_back({angle, angle});
      } else {
        if (!reader_.expect_object(item, {"from", "to"})) return;
        const auto from = reader_.need(item, "from", "the first angle"),
                   to = reader_.need(item, "to", "the last angle");
        if (!from || !to) return;
        const layout::AngleRange range{reader_.number(*from, -limits::kMostDegrees, limits::kMostDegrees),
                                       reader_.number(*to, -limits::kMostDegrees, limits::kMostDegrees)};
        if (reader_.ok() && !(range.from <= range.to))
          return reader_.refuse(item, fmt::format("from {} to {} degrees: the first angle may not be above "
                                                  "the last; add 360 to the last",
                                                  range.from, range.to));
        part.rotations.push_back(range);
      }
      if (!reader_.ok()) return;
    }
  }

  /// The item that an id names; 0 and a fault where there is none.
  std::uint32_t named(JsonValue value, const std::unordered_map<std::string, std::uint32_t>& index,
                      const char* what) {
    if (!reader_.ok()) return 0;
    if (value.kind() != JsonKind::text) {
      reader_.refuse(value, fmt::format("the id of a {} is needed, not {}", what, name_of(value.kind())));
      return 0;
    }
    scratch_ = value.text();
    const auto found = index.find(scratch_);
    if (found != index.end()) return found->second;
    reader_.refuse(value, fmt::format("there is no {} {}; \"{}s\" has {} others", what, excerpt(scratch_),
                                      what, index.size()));
    return 0;
  }

  void kit(JsonValue value) {
    layout::Kit kit = kit_of(value, [this](JsonValue v) { return named(v, part_index_, "part"); });
    if (reader_.ok()) document_.kits.push_back(std::move(kit));
  }

  /// \param part_of  the part that a piece names
  template <class PartOf>
  layout::Kit kit_of(JsonValue value, const PartOf& part_of) {
    layout::Kit kit;
    if (!reader_.expect_object(value, {"id", "name", "demand", "value", "pieces"})) return kit;
    kit.id = id(value, kit_ids_, "kits");
    optional(value, "name", [&](JsonValue v) { kit.name = reader_.text(v); });
    optional(value, "demand", [&](JsonValue v) { kit.demand = reader_.integer(v, 0, limits::kMostKits); });
    optional(value, "value", [&](JsonValue v) { kit.value = reader_.number(v, 0, limits::kMostMoney); });
    const auto pieces = reader_.need(value, "pieces", "what one kit is made of");
    if (!pieces || !reader_.expect_list(*pieces, kMostParts)) return kit;
    if (pieces->size() == 0) reader_.refuse(*pieces, "a kit of no pieces; name at least one part");
    for (const JsonValue item : *pieces) {
      layout::KitPiece piece;
      if (!reader_.expect_object(item, {"part", "count", "mirrored"})) return kit;
      if (const auto p = reader_.need(item, "part", "the id of the part")) piece.part = part_of(*p);
      optional(item, "count", [&](JsonValue v) { piece.count = reader_.integer(v, 1, limits::kMostKits); });
      optional(item, "mirrored", [&](JsonValue v) {
        piece.mirrored = reader_.truth(v);
        // A kit that is read alone has no parts to ask.
        if (reader_.ok() && *piece.mirrored && piece.part < document_.parts.size() &&
            !document_.parts[piece.part].may_mirror)
          reader_.refuse(v, fmt::format("the part {} may not be mirrored; its \"mirror\" must say true",
                                        excerpt(document_.parts[piece.part].id)));
      });
      if (!reader_.ok()) return kit;
      kit.pieces.push_back(piece);
    }
    return kit;
  }

  void placement(JsonValue value) {
    layout::Placement placement;
    if (!reader_.expect_object(
            value, {"id", "part", "stock", "copy", "c", "s", "rotation_deg", "x", "y", "mirrored", "locked"}))
      return;
    placement.id = last_id_ + 1;
    optional(value, "id", [&](JsonValue v) {
      placement.id = static_cast<std::uint64_t>(reader_.integer(v, 1, limits::kMostId));
    });
    if (placement.id > static_cast<std::uint64_t>(limits::kMostId))
      return reader_.refuse(value,
                            "its id would be one more than the highest possible before it; give it one");
    last_id_ = std::max(last_id_, placement.id);
    if (const auto v = reader_.need(value, "part", "the id of a part"))
      placement.part = named(*v, part_index_, "part");
    if (const auto v = reader_.need(value, "stock", "the id of a stock"))
      placement.stock = named(*v, stock_index_, "stock");
    optional(value, "copy", [&](JsonValue v) { placement.copy = reader_.integer(v, 0, limits::kMostCount); });
    placement.rotation = rotation(value);
    if (const auto v = reader_.need(value, "x", "mm"))
      placement.at.x = reader_.length(*v, -limits::kLargestPlacement, limits::kLargestPlacement);
    if (const auto v = reader_.need(value, "y", "mm"))
      placement.at.y = reader_.length(*v, -limits::kLargestPlacement, limits::kLargestPlacement);
    optional(value, "mirrored", [&](JsonValue v) { placement.mirrored = reader_.truth(v); });
    optional(value, "locked", [&](JsonValue v) { placement.locked = reader_.truth(v); });
    document_.placements.push_back(placement);
  }

  geom::GridRotation rotation(JsonValue value) {
    if (!reader_.ok()) return {};
    const auto c = value.find("c"), s = value.find("s"), degrees = value.find("rotation_deg");
    if (degrees) {
      if (c || s) reader_.refuse(*degrees, "it stands beside \"c\" or \"s\"; give one of the two forms");
      return geom::rotation_from_degrees(
          reader_.number(*degrees, -limits::kMostDegrees, limits::kMostDegrees));
    }
    if (!c || !s) {
      reader_.refuse(value, "\"c\" and \"s\", or \"rotation_deg\", are missing");
      return {};
    }
    const double cosine = reader_.number(*c, -limits::kLargestSine, limits::kLargestSine),
                 sine = reader_.number(*s, -limits::kLargestSine, limits::kLargestSine);
    const geom::GridRotation pair = geom::rotation_from_pair(cosine, sine);
    if (reader_.ok() && !geom::is_rotation(pair)) {
      reader_.refuse(value, fmt::format("c {} and s {} are no rotation, c^2 + s^2 is {}; \"rotation_deg\" "
                                        "takes the angle instead",
                                        cosine, sine, cosine * cosine + sine * sine));
    }
    return reader_.ok() ? pair : geom::GridRotation{};
  }

  void order_placements(JsonValue root) {
    auto& placements = document_.placements;
    std::vector<std::uint32_t> order(placements.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    const auto by_id = [&](std::uint32_t a, std::uint32_t b) { return placements[a].id < placements[b].id; };
    if (!std::is_sorted(order.begin(), order.end(), by_id))
      std::stable_sort(order.begin(), order.end(), by_id);
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (placements[order[i - 1]].id != placements[order[i]].id) continue;
      const auto list = root.find("placements");
      std::size_t index = 0;
      for (const JsonValue item : *list)
        if (index++ == order[i])
          return reader_.refuse(*item.find("id"),  // one that was counted on differs
                                fmt::format("the id {} stands twice among placements; give each its own",
                                            placements[order[i]].id));
    }
    std::vector<layout::Placement> ordered;
    ordered.reserve(order.size());
    for (const std::uint32_t i : order) ordered.push_back(placements[i]);
    placements = std::move(ordered);
    document_.next_id = last_id_ + 1;
    optional(root, "next_id", [&](JsonValue v) {
      document_.next_id = static_cast<std::uint64_t>(reader_.integer(v, 1, limits::kMostId + 1));
      if (reader_.ok() && document_.next_id <= last_id_)
        reader_.refuse(v,
                       fmt::format("{} is not above the id {} of a placement", document_.next_id, last_id_));
    });
  }

  [[nodiscard]] std::vector<std::string> notices() const {
    std::vector<std::string> all;
    if (const auto names = reader_.left_out(); !names.empty())
      all.push_back(fmt::format("{}: fields of your own are not kept when it is written: {}", reader_.name(),
                                joined_text(names, ", ")));
    if (chords_made_ > 0)
      all.push_back(fmt::format("{}: {} {} given as curves alone; chords were made", reader_.name(),
                                chords_made_, chords_made_ == 1 ? "outline was" : "outlines were"));
    return all;
  }

  JsonReader& reader_;
  Document document_;
  std::unordered_set<std::string> stock_ids_, part_ids_, kit_ids_;
  std::unordered_map<std::string, std::uint32_t> stock_index_, part_index_;
  std::string scratch_;
  std::size_t chords_made_ = 0;
  std::uint64_t last_id_ = 0;
};

}  // namespace

geom::GridRegion rectangle(std::int64_t along, std::int64_t across) {
  return {{{0, 0}, {along, 0}, {along, across}, {0, across}}, {0, 4}};
}

Result<LayoutFile> read_layout_tree(const JsonTree& tree, const std::string& name) {
  JsonReader reader(tree, name);
  LayoutFile file = LayoutReader(reader).read();
  if (!reader.ok()) return tl::unexpected(reader.fault());
  return file;
}

}  // namespace detail

Result<LayoutFile> read_layout(std::string_view bytes, const std::string& name) {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  return detail::read_layout_tree(tree, name);
}

namespace {

/// The item that `read` reads of the bytes.
template <class Read>
auto read_item(std::string_view bytes, const std::string& name, const Read& read)
    -> Result<decltype(read(std::declval<detail::LayoutReader&>()))> {
  LEKALO_TRY(const auto tree, detail::JsonTree::parse(bytes, name));
  detail::JsonReader reader(tree, name);
  detail::LayoutReader layout(reader);
  auto item = read(layout);
  if (!reader.ok()) return tl::unexpected(reader.fault());
  return item;
}

}  // namespace

Result<layout::Feature> read_feature(layout::FeatureKind kind, std::string_view bytes,
                                     const std::string& name) {
  return read_item(bytes, name, [kind](detail::LayoutReader& layout) { return layout.read_feature(kind); });
}

Result<layout::Part> read_part(std::string_view bytes, const std::string& name) {
  return read_item(bytes, name, [](detail::LayoutReader& layout) { return layout.read_part(); });
}

Result<layout::Stock> read_stock(std::string_view bytes, const std::string& name) {
  return read_item(bytes, name, [](detail::LayoutReader& layout) { return layout.read_stock(); });
}

Result<layout::Kit> read_kit(std::string_view bytes, const std::string& name) {
  return read_item(bytes, name, [](detail::LayoutReader& layout) { return layout.read_kit(); });
}

}  // namespace lekalo::io
