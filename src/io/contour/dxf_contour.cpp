#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contour_points.hpp"
#include "io/dxf/chain.hpp"
#include "io/dxf/groups.hpp"

namespace lekalo::io {
namespace {

/// The ends of LINEs that belong together may lie this far apart, drawing units.
constexpr double kChainReach = 1e-6;

struct Polyline {
  std::size_t line = 0;
  std::string layer;
  bool closed = false;     ///< flag 1
  std::size_t points = 0;  ///< read so far
  std::string_view count;  ///< as the file says
  bool has_x = false;      ///< of a vertex whose y comes next
  Millimetres x;
  std::size_t x_line = 0;
};

/// The drawing units of $INSUNITS that drawings in the shop come with, for the message.
const char* unit_word(std::string_view code) {
  constexpr std::pair<std::string_view, const char*> kWords[] = {{"2", "feet"},   {"5", "centimetres"},
                                                                 {"6", "metres"}, {"8", "microinches"},
                                                                 {"9", "mils"},   {"13", "micrometres"}};
  for (const auto& [known, word] : kWords) {
    if (code == known) return word;
  }
  return "a unit that is not read here";
}

std::string way_out(std::string_view type) {
  if (type == "INSERT") return "; explode the block";
  if (type == "POLYLINE") return "; save the drawing as R2000 or later, or convert it to an LWPOLYLINE";
  if (type == "ARC" || type == "CIRCLE" || type == "ELLIPSE" || type == "SPLINE") {
    return "; curves are not read until any-shape locate";
  }
  return "; delete it or save the contour alone";
}

class DxfReader {
 public:
  DxfReader(std::string_view bytes, const std::string& name, std::optional<LengthUnit> user_says)
      : groups_(bytes, name), user_says_(user_says) {
    file_.name = name;
    file_.unit = user_says.value_or(LengthUnit::millimetre);
  }

  Result<ContourFile> read() {
    LEKALO_CHECK(read_sections());
    if (third_numbers_) file_.notices.push_back(fmt::format("{}: z coordinates are ignored", file_.name));
    if (!polylines_.empty() && !lines_.empty()) {
      return refuse(
          file_.name,
          fmt::format("there are an LWPOLYLINE (line {}, layer {}) and LINEs (the first at line {}, layer "
                      "{}); keep the contour alone",
                      polylines_[0].line, excerpt(polylines_[0].layer), lines_[0].line,
                      excerpt(lines_[0].layer)));
    }
    if (!lines_.empty()) return take_chain();
    if (!polylines_.empty()) return take_polyline();
    return refuse(file_.name, seen_entities_
                                  ? "there is no LWPOLYLINE and no LINE in the section ENTITIES"
                                  : "there is no section ENTITIES; this is not a complete DXF file");
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refuse_here(const std::string& sentence) const {
    return refuse_line(file_.name, group_.line, sentence);
  }

  /// False at the end of the file; a fault of the text is an error.
  Result<bool> next() {
    if (groups_.next(group_)) return true;
    if (groups_.fault()) return tl::unexpected(*groups_.fault());
    return false;
  }

  [[nodiscard]] bool at(int code, std::string_view value) const {
    return group_.code == code && group_.value == value;
  }

  Result<void> read_sections() {
    while (true) {
      LEKALO_TRY(const auto more, next());
      if (!more || at(0, "EOF")) return {};
      if (group_.code == 999) continue;  // a comment
      if (!at(0, "SECTION"))
        return refuse_here(fmt::format("a section is wanted here, not {}", excerpt(group_.value)));
      LEKALO_CHECK(read_section());
    }
  }

  Result<void> read_section() {
    const std::size_t begin = group_.line;
    std::string_view section, variable;
    while (true) {
      LEKALO_TRY(const auto more, next());
      if (!more) return refuse_line(file_.name, begin, "this section does not end; the file is not complete");
      if (section.empty()) {
        if (group_.code != 2 || group_.value.empty()) return refuse_here("a section without a name");
        section = group_.value;
        if (section == "ENTITIES") {
          if (std::exchange(seen_entities_, true)) return refuse_here("a second section ENTITIES");
          return read_entities(begin);
        }
        continue;
      }
      if (at(0, "ENDSEC")) return {};
      if (section != "HEADER") continue;
      if (group_.code == 9) variable = group_.value;
      if (variable == "$INSUNITS" && group_.code == 70) {
        LEKALO_CHECK(read_unit());
      }
    }
  }

  Result<void> read_unit() {
    if (seen_entities_) return refuse_here("$INSUNITS stands behind the entities; save the drawing again");
    std::optional<LengthUnit> file_says;
    if (group_.value == "1") file_says = LengthUnit::inch;
    if (group_.value == "4") file_says = LengthUnit::millimetre;
    if (!file_says && group_.value != "0") {
      return refuse_here(fmt::format("$INSUNITS {} ({}): drawings are read in mm (4) or inches (1)",
                                     excerpt(group_.value), unit_word(group_.value)));
    }
    LEKALO_TRY(file_.unit, agree_on_unit(file_.name, file_says,
                                         fmt::format("$INSUNITS in line {}", group_.line), user_says_));
    return {};
  }

  Result<void> read_entities(std::size_t begin) {
    auto more = next();
    while (more && *more) {
      if (at(0, "ENDSEC")) return {};
      if (group_.code == 999) {
        more = next();
        continue;
      }
      if (group_.code != 0) return refuse_here("an entity is wanted here (group code 0)");
      more = group_.value == "LWPOLYLINE" ? read_polyline()
             : group_.value == "LINE"     ? read_line()
                                          : refuse_entity();
    }
    LEKALO_CHECK(more);
    return refuse_line(file_.name, begin, "the section ENTITIES does not end; the file is not complete");
  }

  /// Reads on to the layer of the entity whose name was just read, then refuses it.
  Result<bool> refuse_entity() {
    const std::string type(group_.value);
    const std::size_t line = group_.line;
    std::string layer;
    for (auto more = next(); more && *more && group_.code != 0; more = next()) {
      if (group_.code == 8) layer = group_.value;
    }
    return refuse_line(
        file_.name, line,
        fmt::format("{} on layer {} is not read: a contour is one closed LWPOLYLINE or a closed chain "
                    "of LINEs{}",
                    excerpt(type), excerpt(layer), way_out(type)));
  }

  Result<Millimetres> number(LengthUnit unit) const {
    const auto value = read_millimetres(group_.value, unit);
    if (!value) return refuse_here(number_sentence(value.error(), group_.value));
    return *value;
  }

  /// Reads the groups that mean the same for both entities.
  Result<void> read_common(std::string& layer, const char* type) {
    if (group_.code == 8) layer = group_.value;
    if (group_.code != 210 && group_.code != 220 && group_.code != 230) return {};
    LEKALO_TRY(const auto direction, number(LengthUnit::millimetre));
    if (direction.value != (group_.code == 230 ? 1.0 : 0.0) || direction.error != 0) {
      return refuse_here(
          fmt::format("this {} does not lie in the xy plane seen from above (extrusion direction)", type));
    }
    return {};
  }

  /// Reads up to the next entity; the flag says whether there is one.
  Result<bool> read_polyline() {
    Polyline polyline;
    polyline.line = group_.line;
    auto more = next();
    for (; more && *more && group_.code != 0; more = next()) {
      LEKALO_CHECK(read_common(polyline.layer, "LWPOLYLINE"));
      LEKALO_CHECK(read_vertex_group(polyline));
    }
    if (!more) return more;
    if (polyline.has_x) return refuse_line(file_.name, polyline.x_line, "an x without its y");
    if (!polyline.count.empty() && polyline.count != fmt::format("{}", polyline.points)) {
      return refuse_line(
          file_.name, polyline.line,
          fmt::format("this LWPOLYLINE says it has {} vertices, but has {}; the file is damaged",
                      excerpt(polyline.count), polyline.points));
    }
    polylines_.push_back(std::move(polyline));
    return more;
  }

  Result<void> read_vertex_group(Polyline& polyline) {
    if (group_.code == 90) polyline.count = group_.value;
    if (group_.code != 70 && group_.code != 42 && group_.code != 10 && group_.code != 20) return {};
    const bool is_length = group_.code == 10 || group_.code == 20;
    LEKALO_TRY(const auto value, number(is_length ? file_.unit : LengthUnit::millimetre));
    if (group_.code == 70) polyline.closed = std::fmod(value.value, 2.0) == 1.0;
    if (group_.code == 42 && (value.value != 0 || value.error != 0)) {
      const std::size_t vertex =
          polyline.has_x || polyline.points == 0 ? polyline.points : polyline.points - 1;
      return refuse_here(fmt::format(
          "the LWPOLYLINE of line {} has a bulge at vertex {}; arcs are not read until any-shape locate",
          polyline.line, vertex));
    }
    if (!is_length) return {};
    if (polyline.has_x != (group_.code == 20)) {
      return refuse_here(polyline.has_x ? "an x, but the one before has no y" : "a y without its x");
    }
    polyline.has_x = !polyline.has_x;
    if (polyline.has_x) {
      polyline.x = value;
      polyline.x_line = group_.line;
      return {};
    }
    ++polyline.points;
    if (!append_point(file_, polyline.x, value, polyline.x_line)) return refuse_here(too_many_points());
    return {};
  }

  Result<bool> read_line() {
    DxfLine line;
    line.line = group_.line;
    constexpr int kCodes[] = {10, 20, 11, 21};
    std::optional<double> values[4];
    auto more = next();
    for (; more && *more && group_.code != 0; more = next()) {
      LEKALO_CHECK(read_common(line.layer, "LINE"));
      const auto* code = std::find(std::begin(kCodes), std::end(kCodes), group_.code);
      const bool is_z = group_.code == 30 || group_.code == 31;
      if (code == std::end(kCodes) && !is_z) continue;
      LEKALO_TRY(const auto value, number(file_.unit));
      if (is_z) {
        third_numbers_ = third_numbers_ || value.value != 0;
        continue;
      }
      values[code - std::begin(kCodes)] = value.value;
      file_.coordinate_error = std::max(file_.coordinate_error, value.error);
    }
    if (!more) return more;
    if (!std::all_of(std::begin(values), std::end(values),
                     [](const auto& value) { return value.has_value(); })) {
      return refuse_line(file_.name, line.line, "this LINE does not have two ends");
    }
    line.ends = {geom::Point{*values[0], *values[1]}, geom::Point{*values[2], *values[3]}};
    if (lines_.size() == kMostContourPoints) return refuse_here(too_many_points());
    lines_.push_back(std::move(line));
    return more;
  }

  Result<ContourFile> take_polyline() {
    if (polylines_.size() > 1) {
      std::string list;
      for (std::size_t i = 0; i < std::min<std::size_t>(polylines_.size(), 5); ++i) {
        list += fmt::format("{}line {} on layer {}", i == 0 ? "" : ", ", polylines_[i].line,
                            excerpt(polylines_[i].layer));
      }
      return refuse(file_.name, fmt::format("there are {} LWPOLYLINEs ({}{}); keep the contour alone",
                                            polylines_.size(), list, polylines_.size() > 5 ? ", ..." : ""));
    }
    const Polyline& polyline = polylines_[0];
    const geom::Ring& points = file_.points;
    if (!polyline.closed && !(points.size() > 1 && points.front() == points.back())) {
      return refuse_line(
          file_.name, polyline.line,
          fmt::format("the LWPOLYLINE on layer {} is not closed; close it in the drawing program",
                      excerpt(polyline.layer)));
    }
    return std::move(file_);
  }

  Result<ContourFile> take_chain() {
    // The ends are doubles near their decimals: two decimals 1e-6 apart must not fail for that.
    const double reach = kChainReach * millimetres_per(file_.unit) + 3 * file_.coordinate_error;
    LEKALO_TRY(const auto chain, chain_lines(lines_, reach, file_.name));
    for (const ChainLink& link : chain) {
      file_.points.push_back(lines_[link.line].ends[link.entered_at]);
      file_.places.push_back(lines_[link.line].line);
    }
    return std::move(file_);
  }

  DxfGroups groups_;
  DxfGroup group_;
  std::optional<LengthUnit> user_says_;
  ContourFile file_;
  std::vector<Polyline> polylines_;
  std::vector<DxfLine> lines_;
  bool seen_entities_ = false, third_numbers_ = false;
};

}  // namespace

Result<ContourFile> read_dxf_contour(std::string_view bytes, const std::string& name,
                                     std::optional<LengthUnit> user_says) {
  return DxfReader(bytes, name, user_says).read();
}

}  // namespace lekalo::io
