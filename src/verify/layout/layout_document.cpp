#include "layout_document.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "chords.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/parallel.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

/// Reads the members of one object and complains about unknown ones. Members that begin with x_ belong to
/// other programs and are passed over.
class Members {
 public:
  Members(Json object, const std::string& path, std::string& complaint,
          std::initializer_list<std::string_view> known)
      : fields_(object, path, complaint), path_(path), complaint_(complaint) {
    fields_.each_key([&](std::string_view key) {
      if (!key.starts_with("x_") && std::find(known.begin(), known.end(), key) == known.end())
        complain(fmt::format("field {} is not one of a layout", fields_.name(excerpt(key))));
    });
  }

  [[nodiscard]] bool has(std::string_view key) const { return !fields_.get(key).text.empty(); }
  [[nodiscard]] Json get(std::string_view key) const { return fields_.get(key); }
  [[nodiscard]] std::string name(std::string_view key) const { return fields_.name(key); }
  [[nodiscard]] std::string& complaint() { return complaint_; }
  void complain(const std::string& sentence) { fields_.complain(sentence); }

  [[nodiscard]] double number(std::string_view key, double least, double most) {
    return number_of(fields_.get(key), fields_.name(key), least, most);
  }
  [[nodiscard]] double number_of(Json value, const std::string& what, double least, double most) {
    const double number = approximate(fields_.number_of(value, what));
    if (number >= least && number <= most) return number;
    complain(fmt::format("field {} is {}, not from {} to {}", what, excerpt(value.text), least, most));
    return least;
  }
  [[nodiscard]] std::int64_t steps(std::string_view key, double least, double most, ToStep how) {
    return *steps_of(number(key, least, most), how, most);
  }
  [[nodiscard]] std::int64_t whole(std::string_view key, std::int64_t least, std::int64_t most,
                                   std::int64_t otherwise) {
    if (!has(key)) return otherwise;
    const Json value = get(key);
    const auto number = value.is_number() ? parse_decimal(value.text) : std::nullopt;
    if (number && number->exponent >= 0) {
      const Integer exact = in_units(*number, 0);
      if (exact >= static_cast<long>(least) && exact <= static_cast<long>(most)) return to_long(exact);
    } else if (number) {
      // Readers take a number with decimals as a double, in which one a hair off a whole one is that.
      const double taken = approximate(*number);
      if (taken == std::nearbyint(taken) && taken >= static_cast<double>(least) &&
          taken <= static_cast<double>(most))
        return static_cast<std::int64_t>(taken);
    }
    complain(fmt::format("field {} is {}, not a whole number from {} to {}", name(key), excerpt(value.text),
                         least, most));
    return otherwise;
  }
  [[nodiscard]] bool flag(std::string_view key) {
    if (has(key) && !get(key).is_bool())
      complain(fmt::format("field {} is neither true nor false", name(key)));
    return get(key).is_true();
  }
  [[nodiscard]] std::string id() {
    const std::string text = fields_.text("id");
    if (text.empty()) complain(fmt::format("field {} is empty", name("id")));
    return text;
  }
  [[nodiscard]] std::string text(std::string_view key) { return fields_.text(key); }
  void optional_text(std::string_view key) {
    if (has(key)) (void)fields_.text(key);
  }
  template <class F>
  void each(std::string_view key, F f) {
    if (!has(key)) return;
    fields_.each(key, [&](Json item, const std::string& path) {
      if (complaint_.empty()) f(item, path);
    });
  }

 private:
  Fields fields_;
  std::string path_;
  std::string& complaint_;
};

GridPoint read_point(Json item, const std::string& path, Members& members) {
  std::array<std::int64_t, 2> steps{};
  std::size_t count = 0;
  if (item.is_array()) {
    JsonItems numbers(item);
    for (; const auto number = numbers.next(); ++count)
      if (count < 2)
        steps[count] =
            *steps_of(members.number_of(*number, path, -limits::kLargestOutline, limits::kLargestOutline),
                      ToStep::nearest, limits::kLargestOutline);
  }
  if (count != 2) members.complain(fmt::format("{} is not a list of two numbers", path));
  return {steps[0], steps[1]};
}

GridLoop read_loop(Json list, const std::string& path, Members& members) {
  GridLoop loop;
  if (!list.is_array()) {
    members.complain(fmt::format("field {} is not a list of points", path));
    return loop;
  }
  JsonItems items(list);
  std::string at = path + '[';
  const std::size_t stem = at.size();
  for (std::size_t i = 0; const auto item = items.next(); ++i) {
    if (!members.complaint().empty()) return loop;
    at.resize(stem);
    fmt::format_to(std::back_inserter(at), "{}]", i);
    loop.push_back(read_point(*item, at, members));
  }
  return loop;
}

std::string without_polygon(const std::string& path) {
  return fmt::format("{} has no polygon; let lekalo write the file, which makes it", path);
}

WrittenOutline read_outline(Json value, const std::string& path, std::string& complaint, ChordSide side) {
  WrittenOutline outline;
  Members members(value, path, complaint, {"polygon", "curves", "chord_tolerance"});
  if (!complaint.empty()) return outline;
  const bool tolerant = members.has("chord_tolerance");
  if (tolerant)
    outline.chord_tolerance =
        members.number("chord_tolerance", limits::kLeastChordTolerance, limits::kMostChordTolerance);
  if (members.has("curves"))
    outline.drawn =
        std::make_shared<Shape>(read_shape(members.get("curves"), members.name("curves"), complaint));
  else if (tolerant)
    members.complain(fmt::format("{} is there without curves", members.name("chord_tolerance")));
  if (!complaint.empty()) return outline;
  if (!members.has("polygon")) {
    outline.unmade = path;
    if (outline.drawn == nullptr) members.complain(without_polygon(path));
    return outline;
  }
  Members polygon(members.get("polygon"), members.name("polygon"), complaint, {"outer", "holes"});
  std::vector<GridLoop> loops{read_loop(polygon.get("outer"), polygon.name("outer"), polygon)};
  polygon.each("holes",
               [&](Json hole, const std::string& at) { loops.push_back(read_loop(hole, at, polygon)); });
  if (!complaint.empty()) return outline;
  if (const auto fault = fault_of(loops)) {
    polygon.complain(fmt::format("{} is no outline: {}", members.name("polygon"), *fault));
    return outline;
  }
  if (outline.drawn != nullptr)
    if (const auto fault = fault_of_chords(loops, *outline.drawn, side, outline.chord_tolerance))
      members.complain(
          fmt::format("{} is not what its curves become: {}; leave it out to have lekalo make it",
                      members.name("polygon"), *fault));
  static_cast<GridOutline&>(outline) = make_outline(std::move(loops));
  return outline;
}

int read_quality(Members& members) {
  const Json value = members.get("quality");
  if (value.is_string() && json_text(value) == "best") return std::numeric_limits<int>::max();
  return static_cast<int>(members.whole("quality", 0, limits::kMostLevel, 0));
}

std::vector<WrittenAngles> read_rotations(Members& part) {
  std::vector<WrittenAngles> rotations;
  part.each("rotations", [&](Json item, const std::string& path) {
    if (!item.is_object()) {
      const double angle = part.number_of(item, path, -limits::kMostDegrees, limits::kMostDegrees);
      rotations.push_back({angle, angle});
      return;
    }
    Members range(item, path, part.complaint(), {"from", "to"});
    const double from = range.number("from", -limits::kMostDegrees, limits::kMostDegrees),
                 to = range.number("to", -limits::kMostDegrees, limits::kMostDegrees);
    if (from > to) range.complain(fmt::format("{} ends before it begins", path));
    rotations.push_back({from, to});
  });
  if (part.has("rotations") && rotations.empty())
    part.complain(fmt::format("field {} is empty, so the part can never lie; leave it out for any angle",
                              part.name("rotations")));
  return rotations;
}

struct Gaps {
  std::int64_t gap = 0, border = 0, defect = 0;
};

Gaps read_gaps(Members& members, Gaps otherwise) {
  const auto read = [&](std::string_view key, std::int64_t& gap) {
    if (members.has(key)) gap = members.steps(key, 0, limits::kLargestOutline, ToStep::up);
  };
  read("gap", otherwise.gap);
  read("border_gap", otherwise.border);
  read("defect_gap", otherwise.defect);
  return otherwise;
}

/// Appends the numbers of an edge of a mark, and complains where it is none.
void read_mark_edge(Json item, const std::string& path, std::string& complaint,
                    std::vector<double>& numbers) {
  Members edge(item, path, complaint, {"line", "arc"});
  const bool arc = edge.has("arc");
  if (arc == edge.has("line")) return edge.complain(fmt::format("{} is not one line or one arc", path));
  const std::string_view kind = arc ? "arc" : "line";
  Members inner(edge.get(kind), edge.name(kind), complaint, {"from", "to", "centre", "ccw"});
  const auto point = [&](std::string_view key) {
    std::size_t count = 0;
    inner.each(key, [&](Json number, const std::string& at) {
      numbers.push_back(inner.number_of(number, at, -limits::kLargestCoordinate, limits::kLargestCoordinate));
      ++count;
    });
    if (count != 2) inner.complain(fmt::format("field {} is not two numbers", inner.name(key)));
  };
  const std::size_t before = numbers.size();
  point("from");
  point("to");
  if (!complaint.empty()) return;
  if (numbers[before] == numbers[before + 2] && numbers[before + 1] == numbers[before + 3] && !arc)
    inner.complain(fmt::format("{} has no length", path));
  if (!arc && (inner.has("centre") || inner.has("ccw")))
    inner.complain(fmt::format("{} is a line with a centre or a direction", path));
  if (!arc) return;
  point("centre");
  if (!inner.get("ccw").is_bool())
    inner.complain(fmt::format("field {} is neither true nor false", inner.name("ccw")));
  numbers.push_back(inner.flag("ccw") ? 1 : -1);
}

/// Complains of a word that is not one of these.
void check_word(Members& members, std::string_view key, const std::string& word,
                std::initializer_list<std::string_view> known) {
  if (std::find(known.begin(), known.end(), word) == known.end())
    members.complain(fmt::format("field {} is {}", members.name(key), excerpt(word)));
}

/// Reads the layer, the colour and the role of a mark or a text.
template <class Item>
void read_look(Members& members, Item& item) {
  if (members.has("layer")) item.layer = members.text("layer");
  if (members.has("colour")) {
    item.colour = members.text("colour");
    const bool is_hex = item.colour.size() == 7 && item.colour.starts_with("#") &&
                        item.colour.find_first_not_of("0123456789abcdef", 1) == std::string::npos;
    if (!is_hex) members.complain(fmt::format("field {} is no colour as in #0000ff", members.name("colour")));
  }
  if (!members.has("role")) return;
  item.role = members.text("role");
  check_word(members, "role", item.role, {"mark", "engrave", "bend", "cut"});
}

WrittenText read_part_text(Json item, const std::string& path, std::string& complaint) {
  WrittenText text;
  Members members(
      item, path, complaint,
      {"text", "at", "height", "deg", "width_factor", "mirrored", "anchor", "layer", "colour", "role"});
  read_look(members, text);
  text.text = members.text("text");
  if (text.text.empty()) members.complain(fmt::format("field {} is empty", members.name("text")));
  std::vector<double> place;
  members.each("at", [&](Json number, const std::string& at) {
    place.push_back(members.number_of(number, at, -limits::kLargestCoordinate, limits::kLargestCoordinate));
  });
  if (place.size() == 2)
    text.x = place[0], text.y = place[1];
  else
    members.complain(fmt::format("field {} is not two numbers", members.name("at")));
  text.height = members.number("height", limits::kLowestText, limits::kHighestText);
  if (members.has("deg")) text.degrees = members.number("deg", -limits::kMostDegrees, limits::kMostDegrees);
  if (members.has("width_factor"))
    text.width_factor = members.number("width_factor", limits::kNarrowestText, limits::kWidestText);
  text.mirrored = members.flag("mirrored");
  if (members.has("anchor")) text.anchor = members.text("anchor");
  check_word(members, "anchor", text.anchor, {"left", "middle", "right"});
  return text;
}

WrittenMark read_mark(Json item, const std::string& path, std::string& complaint) {
  WrittenMark mark;
  Members members(item, path, complaint, {"layer", "colour", "role", "edges"});
  read_look(members, mark);
  // The end of the edge before; from, to, centre and direction of an arc are seven numbers, a line has four.
  std::vector<double> before;
  members.each("edges", [&](Json value, const std::string& at) {
    std::vector<double> edge;
    read_mark_edge(value, at, complaint, edge);
    if (!complaint.empty()) return;
    if (!before.empty() && (before[2] != edge[0] || before[3] != edge[1]))
      members.complain(fmt::format("{} does not begin where the edge before it ends", at));
    mark.numbers.insert(mark.numbers.end(), edge.begin(), edge.end());
    mark.arcs.push_back(edge.size() > 4);
    before = std::move(edge);
  });
  if (mark.numbers.empty()) members.complain(fmt::format("{} has no edges", path));
  return mark;
}

WrittenMaterial read_material(Members& members) {
  WrittenMaterial material;
  if (members.has("material")) material.name = members.text("material");
  if (members.has("thickness"))
    material.thickness =
        members.steps("thickness", limits::kShortestSide, limits::kLargestOutline, ToStep::nearest);
  return material;
}

/// Says whether the calendar has a day that is written so: year, month and day with dashes between.
bool is_in_calendar(std::string_view day) {
  std::string form(day);
  std::ranges::replace_if(
      form, [](unsigned char c) { return std::isdigit(c) != 0; }, '0');
  if (form != "0000-00-00") return false;
  int year{}, month{}, date{};
  const char* const end = day.data() + day.size();
  std::from_chars(day.data(), end, year);
  std::from_chars(day.data() + 5, end, month);
  std::from_chars(day.data() + 8, end, date);
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  const int days = month == 2 ? 28 + (leap ? 1 : 0) : 30 + (month + month / 8) % 2;
  return month >= 1 && month <= 12 && date >= 1 && date <= days;
}

WrittenPart read_part(Json item, const std::string& path, std::string& complaint, const Gaps& rules) {
  Members members(
      item, path, complaint,
      {"id",       "name",   "material", "thickness",  "customer",  "due",    "label", "outline",
       "quality",  "areas",  "marks",    "texts",      "rotations", "mirror", "grain", "tolerated_severity",
       "priority", "demand", "gap",      "border_gap", "defect_gap"});
  WrittenPart part;
  if (!complaint.empty()) return part;
  part.id = members.id();
  members.optional_text("name");
  part.material = read_material(members);
  if (members.has("customer")) part.customer = members.text("customer");
  if (members.has("due")) {
    part.due = members.text("due");
    if (!is_in_calendar(part.due))
      members.complain(fmt::format("field {} is no day as in 2026-12-01", members.name("due")));
  }
  if (members.has("label")) part.label = members.text("label");
  part.outline = read_outline(members.get("outline"), members.name("outline"), complaint, ChordSide::outside);
  part.quality = read_quality(members);
  members.each("areas", [&](Json value, const std::string& at) {
    Members area(value, at, complaint, {"quality", "outline"});
    if (!area.has("quality")) area.complain(fmt::format("field {} is missing", area.name("quality")));
    part.areas.push_back({read_quality(area), read_outline(area.get("outline"), area.name("outline"),
                                                           complaint, ChordSide::outside)});
  });
  members.each("marks", [&](Json value, const std::string& at) {
    part.marks.push_back(read_mark(value, at, complaint));
  });
  members.each("texts", [&](Json value, const std::string& at) {
    part.texts.push_back(read_part_text(value, at, complaint));
  });
  part.rotations = read_rotations(members);
  part.may_mirror = members.flag("mirror");
  if (members.has("grain")) {
    Members grain(members.get("grain"), members.name("grain"), complaint, {"deg", "tolerance_deg"});
    part.grain = WrittenGrain{grain.number("deg", -limits::kMostDegrees, limits::kMostDegrees),
                              grain.has("tolerance_deg") ? grain.number("tolerance_deg", 0, 90) : 0};
  }
  part.tolerated_severity = members.whole("tolerated_severity", 0, limits::kMostLevel, 0);
  part.priority = members.whole("priority", -limits::kMostLevel, limits::kMostLevel, 0);
  part.demand = members.whole("demand", 0, limits::kMostCount, 0);
  const Gaps gaps = read_gaps(members, rules);
  part.gap = gaps.gap, part.border_gap = gaps.border, part.defect_gap = gaps.defect;
  return part;
}

/// Reads all parts, of which each is read for itself. Complains of what is wrong with the first faulty one.
void read_parts(Members& root, const Gaps& rules, std::vector<WrittenPart>& parts) {
  std::vector<std::pair<Json, std::string>> items;
  root.each("parts", [&](Json item, const std::string& path) { items.emplace_back(item, path); });
  parts.resize(items.size());
  std::vector<std::string> complaints(items.size());
  share_out(items.size(), kUsualThreads, [&](std::size_t i) {
    parts[i] = read_part(items[i].first, items[i].second, complaints[i], rules);
  });
  const auto first = std::find_if(complaints.begin(), complaints.end(),
                                  [](const std::string& said) { return !said.empty(); });
  if (first != complaints.end()) root.complain(*first);
}

GridOutline rectangle(std::int64_t length, std::int64_t height) {
  return make_outline({{{0, 0}, {length, 0}, {length, height}, {0, height}}});
}

std::vector<WrittenStockFeature> read_features(Members& stock, std::string_view list, std::string_view grade,
                                               std::int64_t least, std::int64_t most) {
  std::vector<WrittenStockFeature> features;
  std::set<std::string> ids;
  stock.each(list, [&](Json item, const std::string& path) {
    Members members(item, path, stock.complaint(), {"id", grade, "outline"});
    WrittenStockFeature feature;
    feature.id = members.id();
    if (!ids.insert(feature.id).second) members.complain(fmt::format("{} has the id of another", path));
    if (grade == "quality" && !members.has(grade))
      members.complain(fmt::format("field {} is missing", members.name(grade)));
    feature.grade = members.whole(grade, least, most, least);
    feature.outline =
        read_outline(members.get("outline"), members.name("outline"), stock.complaint(), ChordSide::outside);
    features.push_back(std::move(feature));
  });
  return features;
}

WrittenStock read_stock(Json item, const std::string& path, std::string& complaint) {
  Members members(item, path, complaint,
                  {"id", "name", "material", "thickness", "kind", "count", "cost", "outline", "height",
                   "length", "grain_deg", "defects", "zones"});
  WrittenStock stock;
  if (!complaint.empty()) return stock;
  stock.id = members.id();
  members.optional_text("name");
  stock.material = read_material(members);
  stock.kind = members.text("kind");
  const std::string& kind = stock.kind;
  if (kind != "strip" && kind != "sheet" && kind != "hide")
    members.complain(fmt::format("field {} is not strip, sheet or hide", members.name("kind")));
  stock.count = members.whole("count", 1, limits::kMostCount, 1);
  if (members.has("cost")) stock.cost = members.number("cost", 0, limits::kMostMoney);
  if (kind == "strip") {
    if (members.has("outline"))
      members.complain(fmt::format("{} is a strip: height and length, no outline", path));
    if (stock.count != 1) members.complain(fmt::format("{} is a strip, of which there is one", path));
    const std::int64_t height =
        members.steps("height", limits::kShortestSide, limits::kLargestOutline, ToStep::nearest);
    const std::int64_t length =
        members.has("length")
            ? members.steps("length", limits::kShortestSide, limits::kLargestOutline, ToStep::nearest)
            : kMostWritten;
    stock.open = !members.has("length");
    if (complaint.empty()) static_cast<GridOutline&>(stock.outline) = rectangle(length, height);
  } else {
    if (members.has("height") || members.has("length"))
      members.complain(fmt::format("{} has a height or length, but is no strip", path));
    stock.outline =
        read_outline(members.get("outline"), members.name("outline"), complaint, ChordSide::inside);
  }
  if (members.has("grain_deg"))
    stock.grain = members.number("grain_deg", -limits::kMostDegrees, limits::kMostDegrees);
  stock.defects = read_features(members, "defects", "severity", 1, limits::kMostSeverity);
  stock.zones = read_features(members, "zones", "quality", 0, limits::kMostLevel);
  return stock;
}

using Index = std::map<std::string, std::size_t, std::less<>>;

void number_ids(const std::string& id, const std::string& path, Index& index, std::string& complaint) {
  if (complaint.empty() && !index.emplace(id, index.size()).second)
    complaint = fmt::format("{} has the id \"{}\" of another", path, excerpt(id));
}

std::size_t find(Members& members, std::string_view key, const Index& index) {
  const std::string id = members.text(key);
  const auto found = index.find(id);
  if (found != index.end()) return found->second;
  members.complain(fmt::format("{} names \"{}\", which is not there", members.name(key), excerpt(id)));
  return {};
}

void read_kits(Members& root, const Index& parts, std::vector<WrittenKit>& kits) {
  Index ids;
  root.each("kits", [&](Json item, const std::string& path) {
    Members members(item, path, root.complaint(), {"id", "name", "demand", "value", "pieces"});
    WrittenKit kit;
    kit.id = members.id();
    number_ids(kit.id, path, ids, root.complaint());
    members.optional_text("name");
    kit.demand = members.whole("demand", 0, limits::kMostKits, 1);
    if (members.has("value")) kit.value = members.number("value", 0, limits::kMostMoney);
    members.each("pieces", [&](Json value, const std::string& at) {
      Members piece(value, at, root.complaint(), {"part", "count", "mirrored"});
      WrittenKitPiece& read = kit.pieces.emplace_back();
      read.part = find(piece, "part", parts);
      read.count = piece.whole("count", 1, limits::kMostKits, 1);
      if (piece.has("mirrored")) read.mirrored = piece.flag("mirrored");
    });
    kits.push_back(std::move(kit));
  });
}

GridTurn read_turn(Members& members) {
  if (members.has("rotation_deg")) {
    if (members.has("c") || members.has("s"))
      members.complain(fmt::format("{} is there beside c and s", members.name("rotation_deg")));
    const double degrees = members.number("rotation_deg", -limits::kMostDegrees, limits::kMostDegrees);
    return turn_of_degrees(degrees);
  }
  const double c = members.number("c", -limits::kLargestSine, limits::kLargestSine),
               s = members.number("s", -limits::kLargestSine, limits::kLargestSine);
  const auto turn = turn_of_pair(c, s);
  if (!turn)
    members.complain(fmt::format("{} and {} are no cosine and sine", members.name("c"), members.name("s")));
  return turn.value_or(GridTurn{});
}

void read_placements(Members& root, const Index& parts, const Index& stocks, WrittenLayout& layout) {
  std::set<std::uint64_t> ids;
  std::uint64_t next = 1;
  root.each("placements", [&](Json item, const std::string& path) {
    Members members(
        item, path, root.complaint(),
        {"id", "part", "stock", "copy", "c", "s", "rotation_deg", "x", "y", "mirrored", "locked"});
    WrittenPiece piece;
    piece.id =
        static_cast<std::uint64_t>(members.whole("id", 1, limits::kMostId, static_cast<std::int64_t>(next)));
    next = std::max(next, piece.id + 1);
    if (!ids.insert(piece.id).second) members.complain(fmt::format("{} has the id of another", path));
    piece.part = find(members, "part", parts);
    piece.stock = find(members, "stock", stocks);
    piece.copy = members.whole("copy", 0, limits::kMostCount, 0);
    piece.turn = read_turn(members);
    piece.at = {members.steps("x", -limits::kLargestPlacement, limits::kLargestPlacement, ToStep::nearest),
                members.steps("y", -limits::kLargestPlacement, limits::kLargestPlacement, ToStep::nearest)};
    piece.mirrored = members.flag("mirrored");
    piece.locked = members.flag("locked");
    layout.placements.push_back(piece);
  });
  (void)root.whole("next_id", static_cast<std::int64_t>(next), limits::kMostId + 1, 0);
}

/// Returns the place of the first outline without a polygon, or nothing.
std::string first_unmade(const WrittenLayout& layout) {
  std::string path;
  const auto look = [&](const WrittenOutline& outline) {
    if (path.empty()) path = outline.unmade;
  };
  for (const WrittenStock& stock : layout.stocks) {
    look(stock.outline);
    for (const auto* features : {&stock.defects, &stock.zones})
      for (const WrittenStockFeature& feature : *features) look(feature.outline);
  }
  for (const WrittenPart& part : layout.parts) {
    look(part.outline);
    for (const WrittenArea& area : part.areas) look(area.outline);
  }
  return path;
}

}  // namespace

Result<WrittenLayout> read_layout(const Document& document, bool unmade) {
  LEKALO_TRY(const auto parsed, parse_json(document.bytes, document.name));
  std::string complaint;
  WrittenLayout layout;
  Members root(parsed, "", complaint,
               {"format", "units", "name", "rules", "stocks", "parts", "kits", "placements", "next_id"});
  if (root.text("format") != "lekalo-layout/1") root.complain("field format does not say lekalo-layout/1");
  if (root.text("units") != "mm") root.complain("field units is not \"mm\"");
  root.optional_text("name");
  Gaps rules;
  if (root.has("rules")) {
    Members members(root.get("rules"), "rules", complaint, {"gap", "border_gap", "defect_gap", "kerf"});
    rules = read_gaps(members, {});
    if (members.has("kerf")) layout.kerf = members.steps("kerf", 0, limits::kLargestOutline, ToStep::up);
  }
  Index stocks, parts;
  root.each("stocks", [&](Json item, const std::string& path) {
    layout.stocks.push_back(read_stock(item, path, complaint));
    number_ids(layout.stocks.back().id, path, stocks, complaint);
  });
  if (complaint.empty()) read_parts(root, rules, layout.parts);
  for (std::size_t i = 0; i < layout.parts.size(); ++i)
    number_ids(layout.parts[i].id, fmt::format("parts[{}]", i), parts, complaint);
  read_kits(root, parts, layout.kits);
  read_placements(root, parts, stocks, layout);
  if (const std::string path = unmade ? "" : first_unmade(layout); !path.empty())
    root.complain(without_polygon(path));
  if (!complaint.empty())
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, complaint));
  return layout;
}

}  // namespace lekalo::verify
