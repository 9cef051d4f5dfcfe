#include "origin.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "drawing_check.hpp"
#include "scan_check.hpp"
#include "tree_check.hpp"
#include "verify/read/contour.hpp"
#include "verify/read/known_fields.hpp"
#include "verify/shape/edge_of_side.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// Curves of a file are enclosed in doubles: deviations below this share of the largest coordinate are not
/// told from rounding.
constexpr double kReading = 0x1p-42;

double reach_of(const RegionClaim& claim) {
  const Shape& s = claim.used;
  const double size = std::max({-s.low_x, -s.low_y, s.high_x, s.high_y});
  return std::max(claim.tolerance, kReading * size);
}

Origin fault(std::string sentence) {
  Origin origin;
  origin.fault = std::move(sentence);
  return origin;
}
Origin open(std::string sentence) {
  Origin origin;
  origin.open = std::move(sentence);
  return origin;
}

/// A file that does not say its unit may have been given one on the command line, so each is tried; the
/// answer is that for the first where none fits. `check` may find out whether the file says it.
template <class Units, class Check>
Origin in_one_of(const Units& units, const bool& says_unit, Check check) {
  std::optional<Origin> first;
  for (const auto& unit : units) {
    Origin origin = check(unit);
    if (!origin.fault && !origin.open) return origin;
    if (!first) first = std::move(origin);
    if (says_unit) break;
  }
  return *first;
}
constexpr std::array kLengthUnits{LengthUnit::millimetre, LengthUnit::inch};

/// \pre root is an object
bool says(Json root, std::string_view key) {
  Json found;
  // That it is there twice is the complaint of who reads it.
  (void)find_members(root, {&key, 1}, {&found, 1});
  return !found.text.empty();
}

/// Adds what is taken off to a tree, as operands of one difference.
void take_off(const RegionClaim& claim, LengthUnit unit, Tree& tree, std::string& complaint) {
  if (claim.ignored.empty()) return;
  Tree::Node rest{Tree::Kind::subtract, 0, {tree.nodes.size() - 1}};
  for (const Json region : claim.ignored) {
    const bool inch = claim.unit_of_ignored.value_or(unit) == LengthUnit::inch;
    tree.primitives.push_back({read_shape(region, "ignore", complaint, inch), false, ""});
    if (complaint.empty()) refuse_unknown_words(region, complaint);
    tree.nodes.push_back({Tree::Kind::primitive, tree.primitives.size() - 1, {}});
    rest.children.push_back(tree.nodes.size() - 1);
  }
  tree.nodes.push_back(std::move(rest));
}

Origin of_tree(const RegionClaim& claim, const Tree& tree, TreeVerdict& verdict) {
  verdict = check_tree(tree, claim.used, reach_of(claim));
  if (!verdict.fault.empty()) return fault(verdict.fault);
  if (!verdict.open.empty()) return open(verdict.open);
  return {};
}

/// Holds the region used against a shape that is read off the file, less what is taken off.
Origin of_shape(const RegionClaim& claim, Shape shape, LengthUnit unit, const char* otherwise) {
  Origin origin;
  if (claim.ignored.empty()) {
    if (!same_edges(shape, claim.used, claim.tolerance)) return fault(otherwise);
  } else {
    if (const auto wrong = fault_of(shape)) return fault(*wrong);
    Tree tree{{{shape, false, ""}}, {{Tree::Kind::primitive, 0, {}}}};
    std::string complaint;
    take_off(claim, unit, tree, complaint);
    if (!complaint.empty()) return fault(complaint);
    TreeVerdict verdict;
    origin = of_tree(claim, tree, verdict);
    const std::vector<std::size_t> edges = edge_of_side(shape);
    for (const std::set<SideOfTree>& along : verdict.along) {
      auto& of_file = origin.edges.emplace_back();
      for (const SideOfTree& side : along)
        if (side.primitive == 0) of_file.insert(edges[side.side]);
    }
  }
  origin.in_file = std::move(shape);
  return origin;
}

Origin check_regions(const RegionClaim& claim, Json root) {
  std::string unknown;
  refuse_unknown_words(root, unknown);
  if (!unknown.empty()) return fault(unknown);
  return in_one_of(kLengthUnits, says(root, "units"), [&](LengthUnit unit) {
    std::string complaint;
    Shape written = read_shape(root, claim.file.name, complaint, unit == LengthUnit::inch);
    if (!complaint.empty()) return fault(complaint);
    return of_shape(claim, std::move(written), unit, "it has other edges");
  });
}

Origin check_points(const RegionClaim& claim) {
  Result<Contour> read = read_contour(claim.file);
  if (!read) return fault(read.error().message);
  return in_one_of(kLengthUnits, read->unit.has_value(), [&](LengthUnit unit) {
    Contour contour = *read;
    to_millimetres(contour, contour.unit.value_or(unit));
    return of_shape(claim, outline_through(contour.x, contour.y), unit,
                    "it is not the outline through its points");
  });
}

Origin check_tree_file(const RegionClaim& claim, Json root) {
  std::string unknown;
  refuse_unknown_words_of_tree(root, unknown);
  if (!unknown.empty()) return fault(unknown);
  std::array<Json, 2> found;
  constexpr std::array<std::string_view, 2> kKeys{"shape", "units"};
  (void)find_members(root, kKeys, found);
  const std::string said = found[1].is_string() ? json_text(found[1]) : "";
  if (!found[1].text.empty() && said != "mm" && said != "inch") return fault("its units are not mm or inch");
  const auto check = [&](LengthUnit unit) {
    std::string complaint;
    Tree tree = read_tree(found[0], unit, complaint);
    if (complaint.empty()) take_off(claim, unit, tree, complaint);
    if (!complaint.empty()) return fault(complaint);
    TreeVerdict verdict;
    Origin origin = of_tree(claim, tree, verdict);
    for (const std::set<SideOfTree>& along : verdict.along) {
      auto& labels = origin.labels.emplace_back();
      for (const SideOfTree& side : along) labels.insert(tree.primitives[side.primitive].name);
    }
    return origin;
  };
  if (said == "inch") return check(LengthUnit::inch);
  return in_one_of(kLengthUnits, !said.empty(), check);
}

Origin check_scan_file(const RegionClaim& claim) {
  std::string complaint;
  const auto scan = read_written_scan(claim.scan, complaint);
  if (!complaint.empty()) return fault(complaint);
  if (!scan)
    return open(
        "the result does not say by which numbers the scan became the blank, as those of lekalo 0.1 did "
        "not");
  const Result<MeasuredPoints> points = read_scan_points(claim.file, scan->unit, scan->slice);
  if (!points) return fault(points.error().message);
  const ScanVerdict verdict = check_scan(*scan, *points, claim.used);
  if (!verdict.fault.empty()) return fault(verdict.fault);
  if (verdict.unknown && scan->proved)
    return fault("scan.proved is true, but some of its contours is unknown");
  if (!verdict.open.empty()) return open(verdict.open);
  if (verdict.unknown) return open("some of its contours is not measured, and nothing is proved there");
  return {};
}

/// Lines stand for the Bezier curves and ellipses of a drawing within this share of the reach, and no nearer
/// than this. What the first leaves open the second decides.
constexpr double kOffShares[] = {1.0 / 128, 1.0 / 1024}, kLeastOff = 1e-9;

Result<ReadDrawing> read_drawing(const RegionClaim& claim, const Fraction& mm, double off) {
  if (ending_of(claim.file.name) == ".svg") return read_svg_drawing(claim.file, mm, off);
  return read_dxf_drawing(claim.file, mm == 1 ? LengthUnit::millimetre : LengthUnit::inch, off);
}

/// The answer for one unit. `says_unit` becomes whether the file says its own.
Origin of_drawing(const RegionClaim& claim, const WrittenDrawing& written, const Fraction& mm,
                  bool& says_unit) {
  const double reach = reach_of(claim);
  Origin origin;
  for (const double share : kOffShares) {
    const Result<ReadDrawing> drawing = read_drawing(claim, mm, std::max(share * reach, kLeastOff));
    if (!drawing) return says_unit = true, open(drawing.error().message);
    says_unit = drawing->says_unit;
    if (!drawing->not_read.empty())
      return open(fmt::format("it has {}, which are not read here", *drawing->not_read.begin()));
    DrawingVerdict verdict = check_drawing(written, *drawing, claim.used, reach);
    if (!verdict.fault.empty()) return fault(verdict.fault);
    if (verdict.open.empty()) {
      origin.labels = std::move(verdict.layers), origin.open.reset();
      return origin;
    }
    origin.open = verdict.open;
  }
  return origin;
}

/// A drawing that does not say its unit is in mm, in inches, or if it is an SVG in pixels.
Origin check_drawing_file(const RegionClaim& claim) {
  if (claim.drawing.text.empty())
    return open(
        "the result does not say which curves of the drawing counted, as those of lekalo 0.1 did not");
  if (claim.drawing.is_null())
    return fault("it is a drawing, but the field drawings does not say how it was read");
  std::string complaint;
  const WrittenDrawing written = read_written_drawing(claim.drawing, "drawings", complaint);
  if (!complaint.empty()) return fault(complaint);
  if (!claim.ignored.empty()) return open("a drawing less what is ignored is not rebuilt");
  std::vector<Fraction> units{Fraction(1), Fraction(127) / Fraction(5)};
  if (ending_of(claim.file.name) == ".svg") units.push_back(Fraction(127) / Fraction(480));
  bool says_unit = false;
  return in_one_of(units, says_unit,
                   [&](const Fraction& mm) { return of_drawing(claim, written, mm, says_unit); });
}

}  // namespace

Origin check_origin(const RegionClaim& claim) {
  const std::string ending = ending_of(claim.file.name);
  const bool says_drawing = !claim.drawing.text.empty() && !claim.drawing.is_null();
  const auto no_drawing = [] {
    return fault("it is no drawing, but the field drawings says how one was read");
  };
  if (!claim.scan.is_null()) return says_drawing ? no_drawing() : check_scan_file(claim);
  if (ending == ".ply") return fault("it holds measured points, but the field scan is null");
  if (ending == ".dxf" || ending == ".svg") return check_drawing_file(claim);
  // A document without an ending is told by its beginning.
  const std::string_view bytes = claim.file.bytes;
  const bool is_object = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()), 1) == "{";
  constexpr std::array<std::string_view, 4> kPoints{".csv", ".txt", ".xyz", ""};
  if (ending != ".json" && std::find(kPoints.begin(), kPoints.end(), ending) == kPoints.end())
    return open("files that end so are not read here");
  if (says_drawing) return no_drawing();
  if (ending != ".json" && !(ending.empty() && is_object)) return check_points(claim);
  const Result<Json> root = parse_json(claim.file.bytes, claim.file.name);
  if (!root) return fault(root.error().message);
  // A list is one of points.
  if (!root->is_object()) return check_points(claim);
  if (says(*root, "shape")) return check_tree_file(claim, *root);
  if (says(*root, "outer") || says(*root, "pieces")) return check_regions(claim, *root);
  return check_points(claim);
}

}  // namespace lekalo::verify
