#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "io/drawing/exact_arcs.hpp"
#include "io/drawing/layers.hpp"
#include "io/drawing/written_contours.hpp"
#include "io/text/decimal.hpp"
#include "stated_arcs.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

constexpr std::size_t kLongestName = 255;

/// Refuses names that DXF cannot hold; nothing where the name will do.
std::optional<tl::unexpected<Error>> fault_of_name(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    return failure(ErrorCode::usage,
                   fmt::format("{} cannot be the name of a layer in a DXF drawing: {}", excerpt(name), why));
  };
  const auto letters = letters_of(name);
  if (!letters) return refuse("it is not UTF-8");
  if (letters->empty() || letters->size() > kLongestName)
    return refuse(fmt::format("it has {} characters; 1 to {} are allowed", letters->size(), kLongestName));
  for (const std::uint32_t letter : *letters) {
    if (letter < 0x20 || (letter >= 0x7f && letter < 0xa0)) return refuse("it holds a control character");
    if (letter < 0x80 &&
        std::string_view("<>/\\\":;?*|,=`").find(static_cast<char>(letter)) != std::string_view::npos)
      return refuse(fmt::format("it holds {}", static_cast<char>(letter)));
  }
  if (name.front() == ' ' || name.back() == ' ') return refuse("it begins or ends with a space");
  return std::nullopt;
}

class DxfWriter {
 public:
  DxfWriter(const WrittenDrawing& drawing, LengthUnit unit)
      : drawing_(drawing), unit_(unit), layers_(drawing.layers) {
    if (std::none_of(layers_.begin(), layers_.end(), [](const auto& name) { return name == "0"; }))
      layers_.insert(layers_.begin(), "0");
  }

  std::string write() {
    // The header states the next free handle, which is known when all else is written.
    write_tables();
    write_blocks();
    write_entities();
    write_objects();
    std::string rest = std::move(text_);
    text_.clear();
    write_header();
    return std::move(text_) + rest + "  0\nEOF\n";
  }

 private:
  void group(int code, const std::string& value) { text_ += fmt::format("{:3}\n{}\n", code, value); }
  void group(int code, const char* value) { group(code, std::string(value)); }
  void group(int code, int value) { group(code, fmt::format("{:6}", value)); }
  void group(int code, double value) { group(code, fmt::format("{}", value)); }
  /// Points take code, code + 10 and, in space, code + 20.
  void point(int code, Point p) { group(code, p.x), group(code + 10, p.y); }
  void point_in_space(int code, Point p, double z = 0) { point(code, p), group(code + 20, z); }
  std::string handle() { return fmt::format("{:X}", next_handle_++); }

  void section(const char* name) { group(0, "SECTION"), group(2, name); }
  void end_section() { group(0, "ENDSEC"); }

  /// Says whether AutoCAD 2000 will do.
  [[nodiscard]] bool is_simple() const {
    const auto plain = [](const std::string& text) {
      return std::all_of(text.begin(), text.end(),
                         [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    };
    // Colours of three bytes are younger than AutoCAD 2000, too.
    const auto has_colour = [](const auto& one) { return !one.colour.empty(); };
    if (std::any_of(drawing_.contours.begin(), drawing_.contours.end(), has_colour)) return false;
    const auto is_plain_text = [&](const WrittenSetText& text) {
      return plain(text.clean) && text.text->layer.colour.empty();
    };
    return std::all_of(layers_.begin(), layers_.end(), plain) &&
           std::all_of(drawing_.set_texts.begin(), drawing_.set_texts.end(), is_plain_text) &&
           std::all_of(drawing_.texts.begin(), drawing_.texts.end(),
                       [&](const WrittenText& text) { return plain(text.text); });
  }

  void write_header() {
    section("HEADER");
    const auto variable = [this](const char* name) { group(9, name); };
    variable("$ACADVER"), group(1, is_simple() ? "AC1015" : "AC1021");
    variable("$DWGCODEPAGE"), group(3, "ANSI_1252");
    variable("$INSBASE"), point_in_space(10, {});
    variable("$EXTMIN"), point_in_space(10, drawing_.box.low);
    variable("$EXTMAX"), point_in_space(10, drawing_.box.high);
    variable("$HANDSEED"), group(5, fmt::format("{:X}", next_handle_));
    const bool inch = unit_ == LengthUnit::inch;
    variable("$INSUNITS"), group(70, inch ? 1 : 4);
    variable("$MEASUREMENT"), group(70, inch ? 0 : 1);
    end_section();
    section("CLASSES");
    end_section();
  }

  /// Returns the table's handle.
  std::string begin_table(const char* name, std::size_t entries) {
    const std::string own = handle();
    group(0, "TABLE"), group(2, name), group(5, own), group(330, "0");
    group(100, "AcDbSymbolTable"), group(70, static_cast<int>(entries));
    return own;
  }
  void end_table() { group(0, "ENDTAB"); }
  /// DIMSTYLE has another code for its handle.
  std::string entry(const char* type, const std::string& table, const char* kind, const std::string& name,
                    int handle_code = 5) {
    const std::string own = handle();
    group(0, type), group(handle_code, own), group(330, table);
    group(100, "AcDbSymbolTableRecord"), group(100, kind), group(2, name);
    return own;
  }

  void write_tables() {
    section("TABLES");
    const Point middle = 0.5 * (drawing_.box.low + drawing_.box.high),
                size = drawing_.box.high - drawing_.box.low;
    std::string table = begin_table("VPORT", 1);
    entry("VPORT", table, "AcDbViewportTableRecord", "*ACTIVE");
    group(70, 0);
    point(10, {0, 0}), point(11, {1, 1}), point(12, middle), point(13, {}), point(14, {10, 10}),
        point(15, {10, 10});
    point_in_space(16, {}, 1), point_in_space(17, {});
    group(40, std::max({1.1 * size.y, 0.6 * size.x, 1.0})), group(41, 2.0), group(42, 50.0), group(43, 0.0);
    group(44, 0.0), group(50, 0.0), group(51, 0.0);
    group(71, 0), group(72, 100), group(73, 1), group(74, 3), group(75, 0), group(76, 0), group(77, 0),
        group(78, 0);
    end_table();

    table = begin_table("LTYPE", 3);
    for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
      entry("LTYPE", table, "AcDbLinetypeTableRecord", name);
      group(70, 0), group(3, name == std::string("Continuous") ? "Solid line" : ""), group(72, 65),
          group(73, 0);
      group(40, 0.0);
    }
    end_table();

    table = begin_table("LAYER", layers_.size());
    const std::size_t before = layers_.size() - drawing_.layers.size();
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      entry("LAYER", table, "AcDbLayerTableRecord", layers_[i]);
      group(70, 0), group(62, i < before ? 7 : drawing_.colours[i - before].index), group(6, "Continuous");
    }
    end_table();

    table = begin_table("STYLE", 1);
    entry("STYLE", table, "AcDbTextStyleTableRecord", "Standard");
    group(70, 0), group(40, 0.0), group(41, 1.0), group(50, 0.0), group(71, 0), group(42, 2.5),
        group(3, "txt"), group(4, "");
    end_table();
    begin_table("VIEW", 0);
    end_table();
    begin_table("UCS", 0);
    end_table();
    table = begin_table("APPID", 1);
    entry("APPID", table, "AcDbRegAppTableRecord", "ACAD");
    group(70, 0);
    end_table();

    table = begin_table("DIMSTYLE", 1);
    group(100, "AcDbDimStyleTable"), group(71, 1);
    entry("DIMSTYLE", table, "AcDbDimStyleTableRecord", "Standard", 105);
    group(70, 0);
    end_table();

    table = begin_table("BLOCK_RECORD", 2);
    for (std::size_t i = 0; i < 2; ++i) {
      spaces_[i] = entry("BLOCK_RECORD", table, "AcDbBlockTableRecord", kSpaces[i]);
      group(340, "0");
    }
    end_table();
    end_section();
  }

  void write_blocks() {
    section("BLOCKS");
    for (std::size_t i = 0; i < 2; ++i) {
      const auto common = [&](const char* type, const char* kind) {
        group(0, type), group(5, handle()), group(330, spaces_[i]), group(100, "AcDbEntity");
        if (i == 1) group(67, 1);
        group(8, "0"), group(100, kind);
      };
      common("BLOCK", "AcDbBlockBegin");
      group(2, kSpaces[i]), group(70, 0), point_in_space(10, {}), group(3, kSpaces[i]), group(1, "");
      common("ENDBLK", "AcDbBlockEnd");
    }
    end_section();
  }

  void write_entities() {
    section("ENTITIES");
    for (const WrittenContour& contour : drawing_.contours) write(contour);
    for (const WrittenLine& line : drawing_.lines) {
      begin_entity("LINE", line.layer, "AcDbLine");
      point_in_space(10, line.from), point_in_space(11, line.to);
    }
    for (const WrittenText& text : drawing_.texts) {
      begin_entity("TEXT", text.layer, "AcDbText");
      point_in_space(10, text.middle), group(40, text.height), group(1, text.text);
      group(72, 1), point_in_space(11, text.middle);
      group(100, "AcDbText"), group(73, 2);
    }
    for (const WrittenSetText& text : drawing_.set_texts) write(text);
    end_section();
  }

  /// \param colour  "#0000ff"; empty: that of the layer
  void begin_entity(const char* type, std::size_t layer, const char* kind, const std::string& colour = "") {
    entity_ = handle();
    group(0, type), group(5, entity_), group(330, spaces_[0]), group(100, "AcDbEntity");
    group(8, layers_[layer + layers_.size() - drawing_.layers.size()]);
    if (!colour.empty()) {
      int rgb = 0;
      std::from_chars(colour.data() + 1, colour.data() + colour.size(), rgb, 16);
      group(420, fmt::format("{:9}", rgb));
    }
    group(100, kind);
  }

  void write(const WrittenSetText& set) {
    const ReadText& text = *set.text;
    begin_entity("TEXT", set.layer, "AcDbText", text.layer.colour);
    point_in_space(10, text.at), group(40, text.height), group(1, set.clean);
    if (text.degrees != 0) group(50, text.degrees);
    if (text.width_factor != 1) group(41, text.width_factor);
    constexpr int kBackwards = 2;
    if (text.mirrored) group(71, kBackwards);
    if (text.anchor != ReadText::Anchor::left)
      group(72, text.anchor == ReadText::Anchor::middle ? 1 : 2), point_in_space(11, text.at);
    group(100, "AcDbText");
  }

  void write(const WrittenContour& contour) {
    const Edge& first = contour.edges->front();
    if (first.kind != EdgeKind::line && first.from == first.to) {
      begin_entity("CIRCLE", contour.layer, "AcDbCircle", contour.colour);
      point_in_space(10, first.centre);
      const double radius = radius_of_circle(first);
      group(40, radius);
      keep_exact_arcs(contour, {std::get<Edge>(circle({first.centre, 0}, {radius, 0}).shape)}, {1});
      return;
    }
    std::vector<std::pair<Point, double>> vertices;
    std::vector<Edge> read;  // what a reader makes of it
    std::vector<std::size_t> of_edge;
    const auto add = [&](const Edge& edge, double bulge) {
      vertices.emplace_back(edge.from, bulge);
      if (const auto shape = bulge_arc({edge.from, 0}, {edge.to, 0}, bulge))
        read.push_back(std::get<Edge>(shape->shape));
    };
    for (const Edge& edge : *contour.edges) {
      const std::size_t before = read.size();
      if (edge.kind == EdgeKind::line) {
        add(edge, 0);
      } else if (geom::arc_sweep(edge) <= kWidestPiece) {
        add(edge, bulge_of(edge));
      } else {
        for (const Edge& half : halves_of(edge)) add(half, bulge_of(half));
      }
      of_edge.push_back(read.size() - before);
    }
    if (contour.is_open) vertices.emplace_back(contour.edges->back().to, 0);
    begin_entity("LWPOLYLINE", contour.layer, "AcDbPolyline", contour.colour);
    group(90, fmt::format("{}", vertices.size())), group(70, contour.is_open ? 0 : 1), group(43, 0.0);
    for (const auto& [at, bulge] : vertices) {
      point(10, at);
      if (bulge != 0) group(42, bulge);
    }
    keep_exact_arcs(contour, read, of_edge);
  }

  void keep_exact_arcs(const WrittenContour& contour, const std::vector<Edge>& read,
                       const std::vector<std::size_t>& of_edge) {
    // Scaling to millimetres rounds the curves that the exact numbers would have to agree with.
    if (unit_ != LengthUnit::millimetre) return;
    for (const ExactArc& arc : exact_arcs_of(*contour.edges, read, of_edge))
      exact_arcs_.push_back(entity_ + ' ' + text_of(arc));
  }

  void write_objects() {
    section("OBJECTS");
    const std::string root = handle(), groups = handle(), arcs = exact_arcs_.empty() ? "" : handle();
    group(0, "DICTIONARY"), group(5, root), group(330, "0"), group(100, "AcDbDictionary"), group(281, 1);
    group(3, "ACAD_GROUP"), group(350, groups);
    if (!arcs.empty()) group(3, kExactArcsName), group(350, arcs);
    group(0, "DICTIONARY"), group(5, groups), group(330, root), group(100, "AcDbDictionary"), group(281, 1);
    if (!arcs.empty()) {
      // An entity's extended data would be the usual place, but holds no more than 16 kB.
      group(0, "XRECORD"), group(5, arcs), group(330, root), group(100, "AcDbXrecord"), group(280, 1);
      group(1, kExactArcsName);
      for (const std::string& line : exact_arcs_) group(1, line);
    }
    end_section();
  }

  static constexpr std::array<const char*, 2> kSpaces{"*Model_Space", "*Paper_Space"};

  const WrittenDrawing& drawing_;
  LengthUnit unit_;
  std::vector<std::string>
      layers_;  ///< escaped; "0", which every drawing has, perhaps before those of the drawing
  std::array<std::string, 2> spaces_;
  std::uint64_t next_handle_ = 1;
  std::string entity_;                   ///< handle of the one that is written
  std::vector<std::string> exact_arcs_;  ///< each behind its entity's handle
  std::string text_;
};

}  // namespace

Result<std::string> dxf_drawing(const std::vector<LayeredRegion>& regions, const DrawingExtras& extras,
                                LengthUnit unit) {
  LEKALO_TRY(const auto drawing, written_drawing(regions, extras, same_layer));
  for (const std::string& name : drawing.layers)
    if (auto fault = fault_of_name(name)) return *fault;
  return DxfWriter(drawing, unit).write();
}

}  // namespace lekalo::io
