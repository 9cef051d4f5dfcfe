#include "contour.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "json.hpp"
#include "text_rows.hpp"

namespace lekalo::verify {
namespace {

tl::unexpected<Error> bad(const Document& document, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, sentence));
}
Result<Contour> read_text(const Document& document) {
  Contour contour;
  LEKALO_CHECK(read_text_rows(document, [&](TextRow&& row) -> Result<void> {
    contour.x.push_back(std::move(row.numbers[0]));
    contour.y.push_back(std::move(row.numbers[1]));
    return {};
  }));
  return contour;
}

// ---- JSON -------------------------------------------------------------------------------------------------

Result<std::array<Decimal, 2>> json_point(const Document& document, Json value, std::size_t index) {
  std::array<Decimal, 2> point;
  std::size_t count = 0;
  if (value.is_array()) {
    JsonItems items(value);
    while (const auto item = items.next()) {
      const auto number = item->is_number() ? parse_decimal(item->text) : std::nullopt;
      if (!number) {
        return bad(document,
                   fmt::format("point {}: \"{}\" is not {}", index, excerpt(item->text), decimal_rule()));
      }
      if (count < 2) point[count] = *number;
      ++count;
    }
  }
  if (count != 2) return bad(document, fmt::format("point {} is not a list of two numbers", index));
  return point;
}

Result<Contour> json_points(const Document& document, Json list) {
  if (!list.is_array()) return bad(document, "the points are not a list");
  Contour contour;
  JsonItems items(list);
  while (const auto item = items.next()) {
    LEKALO_TRY(auto point, json_point(document, *item, contour.size()));
    contour.x.push_back(std::move(point[0]));
    contour.y.push_back(std::move(point[1]));
  }
  return contour;
}

/// Reads the region form. Point k is where edge k begins, and each edge must begin where the one before it
/// ended.
Result<Contour> json_region(const Document& document, Json outer) {
  if (!outer.is_array()) return bad(document, "field \"outer\" is not a list");
  Contour contour, ends;
  JsonItems items(outer);
  while (const auto edge = items.next()) {
    const std::size_t index = contour.size();
    Json line;
    constexpr std::array<std::string_view, 1> kLine{"line"};
    if (!edge->is_object() || count_items(*edge) != 1 || !find_members(*edge, kLine, {&line, 1}) ||
        !line.is_object()) {
      return bad(document, fmt::format("edge {} of \"outer\" is not a line; arcs are not read here", index));
    }
    std::array<Json, 2> tips;
    constexpr std::array<std::string_view, 2> kTips{"from", "to"};
    if (!find_members(line, kTips, tips))
      return bad(document, fmt::format("edge {} gives an end twice", index));
    if (count_items(line) > 2) return bad(document, fmt::format("edge {} has more than two ends", index));
    LEKALO_TRY(auto from, json_point(document, tips[0], index));
    LEKALO_TRY(auto to, json_point(document, tips[1], index));
    contour.x.push_back(std::move(from[0]));
    contour.y.push_back(std::move(from[1]));
    ends.x.push_back(std::move(to[0]));
    ends.y.push_back(std::move(to[1]));
  }
  const Decimal tolerance{1, -6};
  const auto apart = [&tolerance](const Decimal& a, const Decimal& b) {
    Decimal difference = a - b;
    difference.digits = abs(difference.digits);
    return compare(difference, tolerance) > 0;
  };
  for (std::size_t k = 0; k < contour.size(); ++k) {
    const std::size_t next = (k + 1) % contour.size();
    if (apart(ends.x[k], contour.x[next]) || apart(ends.y[k], contour.y[next])) {
      return bad(document, fmt::format("edge {} does not begin where edge {} ends", next, k));
    }
  }
  return contour;
}

Result<Contour> read_json(const Document& document) {
  LEKALO_TRY(const auto root, parse_json(document.bytes, document.name));
  if (root.is_array()) return json_points(document, root);
  if (!root.is_object()) return bad(document, "neither a list of points nor an object");

  constexpr std::array<std::string_view, 5> kKeys{"points", "outer", "units", "holes", "islands"};
  std::array<Json, 5> found;
  if (!find_members(root, kKeys, found)) return bad(document, "a field is given twice");
  const auto& [points, outer, units, holes, islands] = found;
  // Single values beside the outline are for people; a misspelt list would be a part of it.
  JsonItems members(root);
  while (const auto member = members.next())
    if ((member->is_object() || member->is_array()) &&
        std::find(kKeys.begin(), kKeys.end(), members.key()) == kKeys.end())
      return bad(document, fmt::format("field {} is not one of a contour", excerpt(members.key())));
  for (const Json& inner : {holes, islands}) {
    if (!inner.text.empty() && (!inner.is_array() || count_items(inner) > 0)) {
      return bad(document, "the contour has holes or islands, which are not read here");
    }
  }
  if (points.text.empty() == outer.text.empty()) {
    return bad(document, "a contour needs either \"points\" or \"outer\"");
  }
  auto contour = outer.text.empty() ? json_points(document, points) : json_region(document, outer);
  if (!contour || units.text.empty()) return contour;
  const std::string unit = units.is_string() ? json_text(units) : std::string();
  if (unit != "mm" && unit != "inch") {
    return bad(document, fmt::format("units are {}, not \"mm\" or \"inch\"", excerpt(units.text)));
  }
  contour->unit = unit == "mm" ? LengthUnit::millimetre : LengthUnit::inch;
  return contour;
}

// ---- DXF --------------------------------------------------------------------------------------------------

struct DxfPair {
  int code = 0;
  std::string_view value;
  std::size_t line = 0;
};

struct DxfEntity {
  std::string_view type;
  std::size_t line = 0;
  std::vector<DxfPair> pairs;
};

struct DxfPoint {
  Decimal x, y;
};

/// A straight line of the drawing, which runs from tip 0 to tip 1.
struct DxfLine {
  std::array<DxfPoint, 2> tips;
  std::size_t line = 0;
};

/// Says whether two points are within a millionth of a drawing unit, which is where one line of a chain
/// continues another.
bool touch(const DxfPoint& a, const DxfPoint& b, Decimal& squared_distance) {
  const Decimal dx = a.x - b.x, dy = a.y - b.y;
  const long exponent = std::min(dx.exponent, dy.exponent);
  const Integer u = in_units(dx, exponent), v = in_units(dy, exponent);
  squared_distance = Decimal{u * u + v * v, 2 * exponent};
  return compare(squared_distance, Decimal{1, -12}) <= 0;
}

class DxfReader {
 public:
  explicit DxfReader(const Document& document) : document_(document) {}

  Result<Contour> read() {
    LEKALO_CHECK(read_pairs());
    Contour contour;
    LEKALO_CHECK(read_unit(contour));
    LEKALO_CHECK(read_outline(contour));
    return contour;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> complain(std::size_t line, const std::string& sentence) const {
    return bad_line(document_, line, sentence);
  }

  /// Reads group codes and values. It keeps what HEADER says of units, and the entities.
  Result<void> read_pairs() {
    Lines lines(document_.bytes);
    std::string_view section, variable;
    bool section_begins = false;
    while (const auto code_text = lines.next()) {
      const std::size_t line = lines.number();
      const auto code = parse_decimal(*code_text);
      if (!code || code->exponent < 0 || compare(*code, Decimal{2000, 0}) > 0 || sgn(code->digits) < 0) {
        return complain(line, fmt::format("\"{}\" is not a DXF group code", excerpt(*code_text)));
      }
      const auto value = lines.next();
      if (!value) return complain(line, "the file ends after a group code");
      const DxfPair pair{static_cast<int>(to_long(in_units(*code, 0))), *value, line + 1};
      if (pair.code == 0) {
        section_begins = pair.value == "SECTION";
        if (pair.value == "ENDSEC") section = {};
        if (section == "ENTITIES") entities_.push_back({pair.value, pair.line, {}});
      } else if (pair.code == 2 && section_begins) {
        section = pair.value;
        section_begins = false;
      } else if (section == "HEADER") {
        if (pair.code == 9) variable = pair.value;
        if (variable == "$INSUNITS" && pair.code == 70) unit_ = pair;
      } else if (section == "ENTITIES" && !entities_.empty()) {
        entities_.back().pairs.push_back(pair);
      }
    }
    return {};
  }

  Result<void> read_unit(Contour& contour) const {
    if (!unit_ || unit_->value == "0") return {};
    if (unit_->value == "1") {
      contour.unit = LengthUnit::inch;
    } else if (unit_->value == "4") {
      contour.unit = LengthUnit::millimetre;
    } else {
      return complain(unit_->line, fmt::format("$INSUNITS {} is neither 1 (inch) nor 4 (mm) nor 0 (not said)",
                                               excerpt(unit_->value)));
    }
    return {};
  }

  Result<void> read_outline(Contour& contour) const {
    std::vector<const DxfEntity*> polylines, lines;
    for (const DxfEntity& entity : entities_) {
      if (entity.type == "LWPOLYLINE") {
        polylines.push_back(&entity);
      } else if (entity.type == "LINE") {
        lines.push_back(&entity);
      } else {
        return complain(entity.line,
                        fmt::format("entity {} is not read here, only one closed LWPOLYLINE or LINEs",
                                    excerpt(entity.type)));
      }
    }
    if (polylines.size() == 1 && lines.empty()) return read_polyline(*polylines[0], contour);
    if (polylines.empty() && !lines.empty()) return read_chain(lines, contour);
    return bad(document_,
               fmt::format("{} LWPOLYLINE and {} LINE; a contour is one closed LWPOLYLINE or LINEs alone",
                           polylines.size(), lines.size()));
  }

  Result<Decimal> number(const DxfPair& pair) const {
    if (auto value = parse_decimal(pair.value)) return *std::move(value);
    return complain(pair.line, fmt::format("\"{}\" is not {}", excerpt(pair.value), decimal_rule()));
  }

  /// Refuses an entity that is not seen from +z, because its coordinates are those of another plane.
  Result<void> check_plane(const DxfEntity& entity) const {
    for (const DxfPair& pair : entity.pairs) {
      if (pair.code != 210 && pair.code != 220 && pair.code != 230) continue;
      LEKALO_TRY(const auto value, number(pair));
      if (compare(value, Decimal{pair.code == 230 ? 1 : 0, 0}) != 0) {
        return complain(pair.line,
                        fmt::format("{} does not lie in the xy plane seen from above", entity.type));
      }
    }
    return {};
  }

  Result<void> read_polyline(const DxfEntity& entity, Contour& contour) const {
    LEKALO_CHECK(check_plane(entity));
    bool closed = false;
    for (const DxfPair& pair : entity.pairs) {
      if (pair.code != 10 && pair.code != 20 && pair.code != 42 && pair.code != 70) continue;
      LEKALO_TRY(auto value, number(pair));
      if (pair.code == 42 && value.digits != 0) return complain(pair.line, "a bulge; arcs are not read here");
      if (pair.code == 70) closed = value.exponent == 0 && value.digits % 2 != 0;
      if (pair.code == 10) contour.x.push_back(std::move(value));
      if (pair.code == 20) contour.y.push_back(std::move(value));
      if (pair.code == 20 && contour.x.size() != contour.y.size()) {
        return complain(pair.line, "a y without its x");
      }
    }
    if (contour.x.size() != contour.y.size()) return complain(entity.line, "an x without its y");
    const bool returns = contour.size() > 1 && compare(contour.x.front(), contour.x.back()) == 0 &&
                         compare(contour.y.front(), contour.y.back()) == 0;
    if (!closed && !returns) return complain(entity.line, "the LWPOLYLINE is not closed");
    return {};
  }

  Result<DxfLine> read_line(const DxfEntity& entity) const {
    LEKALO_CHECK(check_plane(entity));
    std::array<std::optional<Decimal>, 4> values;  // codes 10, 20, 11, 21
    for (const DxfPair& pair : entity.pairs) {
      if (pair.code != 10 && pair.code != 20 && pair.code != 11 && pair.code != 21) continue;
      LEKALO_TRY(auto value, number(pair));
      values[static_cast<std::size_t>((pair.code % 10) * 2 + pair.code / 10 - 1)] = std::move(value);
    }
    for (const auto& value : values) {
      if (!value) return complain(entity.line, "the LINE has no two ends");
    }
    return DxfLine{{DxfPoint{*values[0], *values[1]}, DxfPoint{*values[2], *values[3]}}, entity.line};
  }

  Result<void> read_chain(const std::vector<const DxfEntity*>& entities, Contour& contour) const;

  const Document& document_;
  std::optional<DxfPair> unit_;
  std::vector<DxfEntity> entities_;
};

/// The ends of all lines, sorted by x, so that the ends near a point are found without looking at every line.
class ChainEnds {
 public:
  struct End {
    double x;
    std::size_t line, tip;
  };

  explicit ChainEnds(const std::vector<DxfLine>& lines) : lines_(lines), used_(lines.size(), false) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const std::size_t tip : {0U, 1U}) ends_.push_back({approximate(lines[i].tips[tip].x), i, tip});
    }
    std::ranges::stable_sort(ends_, {}, &End::x);
  }

  void use(std::size_t line) { used_[line] = true; }

  /// Returns the end of an unused line that is nearest to p and at most 1e-6 away, among equals the first in
  /// the file.
  [[nodiscard]] std::optional<End> nearest(const DxfPoint& p) const {
    const double x = approximate(p.x);
    // The reach is a little larger, which pays for the rounding of both x.
    const double reach = 1.001e-6 + 1e-15 * std::abs(x);
    const auto first = std::ranges::lower_bound(ends_, x - reach, {}, &End::x);
    std::optional<End> best;
    Decimal best_distance, distance;
    for (auto end = first; end != ends_.end() && end->x <= x + reach; ++end) {
      if (used_[end->line] || !touch(p, lines_[end->line].tips[end->tip], distance)) continue;
      const int order = best ? compare(distance, best_distance) : -1;
      const bool earlier = best && std::pair(end->line, end->tip) < std::pair(best->line, best->tip);
      if (order < 0 || (order == 0 && earlier)) {
        best = *end;
        best_distance = distance;
      }
    }
    return best;
  }

 private:
  const std::vector<DxfLine>& lines_;
  std::vector<bool> used_;
  std::vector<End> ends_;
};

Result<void> DxfReader::read_chain(const std::vector<const DxfEntity*>& entities, Contour& contour) const {
  std::vector<DxfLine> lines;
  for (const DxfEntity* entity : entities) {
    LEKALO_TRY(auto line, read_line(*entity));
    lines.push_back(std::move(line));
  }
  ChainEnds ends(lines);
  ChainEnds::End entered{0, 0, 0};
  for (std::size_t count = 1;; ++count) {
    const DxfLine& line = lines[entered.line];
    ends.use(entered.line);
    contour.x.push_back(line.tips[entered.tip].x);
    contour.y.push_back(line.tips[entered.tip].y);
    const DxfPoint& end = line.tips[1 - entered.tip];
    if (count == lines.size()) {
      Decimal distance;
      if (touch(end, lines[0].tips[0], distance)) return {};
      return complain(line.line, "the chain of LINEs does not come back to its start");
    }
    const auto next = ends.nearest(end);
    if (!next)
      return complain(line.line, "no LINE continues this one, so the LINEs are not one closed chain");
    entered = *next;
  }
}

}  // namespace

std::string ending_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  std::string ending(dot == std::string_view::npos ? std::string_view() : name.substr(dot));
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

Result<Contour> read_contour(const Document& document) {
  const std::string ending = ending_of(document.name);
  const auto read = [&]() -> Result<Contour> {
    if (ending == ".csv" || ending == ".txt" || ending == ".xyz") return read_text(document);
    if (ending == ".json") return read_json(document);
    if (ending == ".dxf") return DxfReader(document).read();
    return bad(document, "the name does not end in .csv, .txt, .xyz, .json or .dxf");
  };
  LEKALO_TRY(Contour contour, read());
  if (contour.size() < 3) {
    return bad(document, fmt::format("{} points; a contour has at least 3", contour.size()));
  }
  return contour;
}

void to_millimetres(Contour& contour, LengthUnit unit) {
  if (unit == LengthUnit::millimetre) return;
  for (std::vector<Decimal>* coordinates : {&contour.x, &contour.y}) {
    for (Decimal& value : *coordinates) {
      value.digits *= 254;
      if (value.digits != 0) value.exponent -= 1;
    }
  }
}

}  // namespace lekalo::verify
