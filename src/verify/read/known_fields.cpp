#include "known_fields.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <span>
#include <string_view>

#include "verify/number/exact.hpp"

namespace lekalo::verify {
namespace {

/// A member that an object may have, and those of the objects that stand there, alone or in a list; none
/// where its reader looks itself.
struct Known {
  std::string_view name;
  std::span<const Known> members = {};
};

constexpr Known kFormat[] = {{"name"}, {"version"}};
constexpr Known kInputs[] = {{"role"}, {"path"}, {"sha256"}, {"units"}, {"points"}, {"dropped"}};
constexpr Known kContacts[] = {{"part_vertex"}, {"blank_edge"}, {"multiplier"}, {"part_edge"},
                               {"part_at"},     {"blank_at"},   {"distance"}};
constexpr Known kTriple[] = {{"part_vertex"}, {"blank_edge"}, {"multiplier"}};
constexpr Known kTrees[] = {{"mirrored"}, {"theta"}, {"x"}, {"y"}, {"nodes"}};
constexpr Known kIntervals[] = {{"from"}, {"to"}, {"contacts", kTriple}};
constexpr Known kCertificate[] = {{"from"}, {"to"}, {"contacts", kTriple}, {"pivot"}, {"trees", kTrees}};
constexpr Known kFile[] = {{"path"}, {"sha256"}, {"intervals"}};
constexpr Known kAlternatives[] = {{"x"}, {"y"}, {"theta"}, {"theta_deg"}, {"clearance"}};
constexpr Known kTrim[] = {{"tolerance"}, {"loss"}, {"contour"}};
constexpr Known kNc[] = {{"mode"},      {"scan_frame"}, {"control"}, {"work_offset"},  {"rounding_mm"},
                         {"clearance"}, {"motions"},    {"notes"},   {"output", kFile}};
constexpr Known kComparison[] = {
    {"same_part"},          {"dx"}, {"dy"}, {"dtheta"}, {"dtheta_deg"}, {"largest_shift"}, {"last_clearance"},
    {"last_pose_clearance"}};
constexpr Known kDeviations[] = {{"path"}, {"sha256"}, {"points"}, {"least"}, {"greatest"}};
constexpr Known kShift[] = {{"x"}, {"y"}};
constexpr Known kLine[] = {{"from"}, {"to"}};
constexpr Known kArc[] = {{"from"}, {"to"}, {"centre"}, {"ccw"}};
constexpr Known kEdge[] = {{"line", kLine}, {"arc", kArc}, {"open"}};
constexpr Known kPiece[] = {{"outer", kEdge}, {"holes", kEdge}};
constexpr Known kRegion[] = {{"units"}, {"outer", kEdge}, {"holes", kEdge}, {"pieces", kPiece}};
constexpr Known kPieceOfFile[] = {{"outer", kEdge}, {"holes", kEdge}, {"islands", kEdge}};
constexpr Known kRegionFile[] = {
    {"outer", kEdge}, {"holes", kEdge}, {"islands", kEdge}, {"pieces", kPieceOfFile}};
/// The tree's reader looks at its shapes itself.
constexpr Known kTreeFile[] = {{"name"}, {"source"}, {"units"}, {"shape"}};
constexpr Known kRegions[] = {{"part", kRegion}, {"blank", kRegion}};
constexpr Known kSlice[] = {{"height"}, {"thickness"}};
constexpr Known kScan[] = {{"points"},         {"proved"},   {"ordered"}, {"guard"},      {"step"},
                           {"median_spacing"}, {"widest"},   {"deepest"}, {"loss"},       {"assumptions"},
                           {"unknown"},        {"dropped"},  {"units"},   {"min_radius"}, {"max_dip"},
                           {"slice", kSlice},  {"left_out"}, {"outlines"}};
constexpr Known kDrawing[] = {{"layers"},       {"join"},        {"set_aside"},
                              {"marks", kEdge}, {"loose_error"}, {"set_aside_curves", kEdge}};
constexpr Known kDrawings[] = {{"part", kDrawing}, {"blank", kDrawing}};
constexpr Known kTolerances[] = {{"part"}, {"blank"}};
constexpr Known kFeatures[] = {{"name"},    {"edges"}, {"minimum"}, {"target"},
                               {"maximum"}, {"scale"}, {"finished"}};
constexpr Known kProof[] = {{"grown_for"}, {"most"}, {"shift"}, {"bound"}};
constexpr Known kSmallest[] = {{"margin"}, {"found"}, {"bound"}, {"gap"}, {"kept"}, {"proof", kProof}};
constexpr Known kTradeOff[] = {{"x"},        {"y"},      {"theta"},   {"theta_deg"},    {"clearance"},
                               {"mirrored"}, {"margin"}, {"largest"}, {"largest_bound"}};
constexpr Known kDemands[] = {
    {"minimum"},      {"features", kFeatures},  {"criterion"},  {"give_up"}, {"margin"},
    {"margin_bound"}, {"margin_found"},         {"margin_gap"}, {"largest"}, {"smallest_largest", kSmallest},
    {"deviation"},    {"trade_off", kTradeOff}, {"grown_for"},  {"shift"},   {"bound"}};
constexpr Known kPlacement[] = {{"format", kFormat},
                                {"status"},
                                {"units"},
                                {"inputs", kInputs},
                                {"warnings"},
                                {"seed"},
                                {"work"},
                                {"version"},
                                {"method"},
                                {"x"},
                                {"y"},
                                {"theta"},
                                {"theta_deg"},
                                {"mirrored"},
                                {"clearance"},
                                {"upper_bound"},
                                {"gap"},
                                {"min_allowance"},
                                {"shortfall"},
                                {"window_deg"},
                                {"contacts", kContacts},
                                {"certificate", kCertificate},
                                {"largest_certificate", kCertificate},
                                {"certificate_file", kFile},
                                {"alternatives", kAlternatives},
                                {"alternatives_complete"},
                                {"trim", kTrim},
                                {"mirror"},
                                {"locked", kShift},
                                {"part_cut"},
                                {"scan", kScan},
                                {"drawings", kDrawings},
                                {"demands", kDemands},
                                {"tolerances", kTolerances},
                                {"regions", kRegions},
                                {"nc", kNc},
                                {"comparison", kComparison},
                                {"deviations", kDeviations},
                                {"run"},
                                // A file of a certificate has these.
                                {"intervals", kIntervals}};
constexpr Known kSolidInputs[] = {{"role"},      {"path"},   {"sha256"},   {"units"},
                                  {"triangles"}, {"points"}, {"deviation"}};
constexpr Known kSolidWindow[] = {{"quaternion"}, {"x"}, {"y"}, {"z"}, {"pivot"}, {"shift"}, {"turn_deg"}};
constexpr Known kSolidSymmetryAxes[] = {{"direction"}, {"turns"}};
constexpr Known kSolidSymmetry[] = {{"tolerance"}, {"rotations"}, {"centre"}, {"axes", kSolidSymmetryAxes}};
constexpr Known kSolidContacts[] = {{"part_point"},     {"blank_point"}, {"part_triangle"},
                                    {"blank_triangle"}, {"distance"},    {"multiplier"}};
constexpr Known kSolidTrees[] = {{"quaternion"}, {"x"},      {"y"},      {"z"},
                                 {"turn_x"},     {"turn_y"}, {"turn_z"}, {"nodes"}};
constexpr Known kSolidCertificate[] = {{"pivot"},        {"part_balls"}, {"part_points"},
                                       {"datum_points"}, {"directions"}, {"blank_balls"},
                                       {"planes"},       {"bodies"},     {"trees", kSolidTrees}};
constexpr Known kSolidFeatures[] = {{"name"},    {"triangles"}, {"minimum"}, {"maximum"}, {"scale"},
                                    {"as_cast"}, {"finished"},  {"rim"},     {"largest"}, {"target"}};
constexpr Known kSolidDatums[] = {{"name"}, {"within"}, {"off"}, {"missed"}};
constexpr Known kSolidDemands[] = {
    {"minimum"},   {"features", kSolidFeatures}, {"datums", kSolidDatums}, {"margin"}, {"margin_bound"},
    {"margin_gap"}};
constexpr Known kSolidChoice[] = {{"criterion"}, {"give_up"},       {"margin_found"},
                                  {"largest"},   {"largest_found"}, {"deviation"}};
constexpr Known kSolidUnderside[] = {{"z"}, {"flat"}};
constexpr Known kTouchCuts[] = {{"axis"}, {"above"}, {"at"}, {"terms"}};
constexpr Known kTouchWays[] = {{"corner"}, {"axis"}, {"above"}, {"at"}, {"multiplier"}, {"terms"}};
constexpr Known kTouchPose[] = {{"quaternion"}, {"x"}, {"y"}, {"z"}};
constexpr Known kTouches[] = {{"ball"},
                              {"form"},
                              {"directions"},
                              {"pivot"},
                              {"quaternion"},
                              {"x"},
                              {"y"},
                              {"z"},
                              {"turn_x"},
                              {"turn_y"},
                              {"turn_z"},
                              {"balls"},
                              {"cuts", kTouchCuts},
                              {"moved", kTouchPose},
                              {"around"},
                              {"ways", kTouchWays}};
constexpr Known kSolidScan[] = {{"guard"},
                                {"min_radius"},
                                {"max_dip"},
                                {"underside", kSolidUnderside},
                                {"touches", kTouches},
                                {"widest"},
                                {"unknown_triangles"},
                                {"proved"},
                                {"left_out"},
                                {"assumptions"}};
constexpr Known kOffset[] = {{"control"}, {"axes"}, {"work_offset"}, {"output", kFile}};
constexpr Known kSolidFile[] = {{"path"}, {"sha256"}, {"boxes"}};
constexpr Known kSolidPlacement[] = {{"format", kFormat},
                                     {"status"},
                                     {"units"},
                                     {"inputs", kSolidInputs},
                                     {"warnings"},
                                     {"seed"},
                                     {"work"},
                                     {"version"},
                                     {"method"},
                                     {"freedom"},
                                     {"start"},
                                     {"symmetry", kSolidSymmetry},
                                     {"window", kSolidWindow},
                                     {"quaternion"},
                                     {"x"},
                                     {"y"},
                                     {"z"},
                                     {"inside"},
                                     {"clearance"},
                                     {"upper_bound"},
                                     {"gap"},
                                     {"min_allowance"},
                                     {"shortfall"},
                                     {"demands", kSolidDemands},
                                     {"choice", kSolidChoice},
                                     {"contacts", kSolidContacts},
                                     {"scan", kSolidScan},
                                     {"unknown_area_mm2"},
                                     {"certificate", kSolidCertificate},
                                     {"certificate_file", kSolidFile},
                                     {"nc", kNc},
                                     {"offset", kOffset},
                                     {"run"}};
constexpr Known kOfReports[] = {{"regions", kRegion}, {"drawing", kDrawing}, {"scan", kScan}};

void look(Json value, std::span<const Known> known, const std::string& path, std::string& complaint,
          std::string_view whose = "a placement") {
  if (!complaint.empty() || !(value.is_object() || value.is_array())) return;
  JsonItems items(value);
  if (value.is_array()) {
    for (std::size_t i = 0; const auto item = items.next(); ++i)
      look(*item, known, fmt::format("{}[{}]", path, i), complaint, whose);
    return;
  }
  std::set<std::string_view> seen;
  while (const auto item = items.next()) {
    const std::string name =
        path.empty() ? excerpt(items.key()) : fmt::format("{}.{}", path, excerpt(items.key()));
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Known& one) { return one.name == items.key(); });
    if (found == known.end())
      complaint = fmt::format("field {} is not one of {}", name, whose);
    else if (!seen.insert(found->name).second)
      complaint = fmt::format("field {} is given twice", name);
    else if (!found->members.empty())
      look(*item, found->members, name, complaint, whose);
    if (!complaint.empty()) return;
  }
}

}  // namespace

void refuse_unknown_fields(Json placement, std::string& complaint) {
  look(placement, kPlacement, "", complaint);
}

void refuse_unknown_fields_of_solids(Json placement, std::string& complaint) {
  look(placement, kSolidPlacement, "", complaint, "a placement of solids");
}

void refuse_unknown_fields(Json value, const std::string& key, std::string& complaint) {
  for (const Known& one : kOfReports)
    if (one.name == key) look(value, one.members, key, complaint);
}

void refuse_unknown_words_of_tree(Json root, std::string& complaint) {
  look(root, kTreeFile, "", complaint, "a tree of primitives");
}

void refuse_unknown_words(Json region, std::string& complaint) {
  JsonItems items(region);
  while (const auto item = items.next()) {
    // A single value beside the outline is its unit, or a name or a date for people.
    if (!item->is_object() && !item->is_array()) continue;
    const auto* const found = std::find_if(std::begin(kRegionFile), std::end(kRegionFile),
                                           [&](const Known& one) { return one.name == items.key(); });
    if (found != std::end(kRegionFile))
      look(*item, found->members, std::string(found->name), complaint, "a region file");
    else if (complaint.empty())
      complaint = fmt::format("field {} is not one of a region file", excerpt(items.key()));
  }
}

}  // namespace lekalo::verify
