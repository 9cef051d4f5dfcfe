#include "pose_document.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace lekalo::verify {

bool truth_of(Fields& fields, std::string_view key) {
  const Json value = fields.get(key);
  if (!value.is_bool()) fields.complain(fmt::format("field {} is neither true nor false", fields.name(key)));
  return value.is_true();
}

RegionDocument read_region_document(Json root, std::string& complaint) {
  RegionDocument r;
  Fields fields(root, "", complaint);
  std::string ignored;
  Fields format(fields.get("format"), "format", ignored);
  if (format.text("name") != "lekalo-locate" || format.get("version").text != "1")
    fields.complain("field format does not say lekalo-locate, version 1");
  if (fields.text("units") != "mm") fields.complain("field units is not \"mm\"");
  r.status = fields.text("status");
  constexpr std::array<std::string_view, 3> kStatuses{"optimal", "stopped", "infeasible"};
  if (std::find(kStatuses.begin(), kStatuses.end(), r.status) == kStatuses.end())
    fields.complain(fmt::format("\"{}\" is no status of a result", excerpt(r.status)));
  r.x = fields.number("x"), r.y = fields.number("y");
  r.theta = fields.number("theta"), r.theta_deg = fields.number("theta_deg");
  r.mirrored = truth_of(fields, "mirrored");
  r.mirror = fields.text("mirror");
  if (r.mirror != "no" && r.mirror != "yes" && r.mirror != "either")
    fields.complain("field mirror is none of \"no\", \"yes\", \"either\"");
  for (auto [key, to] : {std::pair{"clearance", &r.clearance},
                         {"min_allowance", &r.min_allowance},
                         {"shortfall", &r.shortfall}})
    *to = enclosed(fields.number(key));
  r.min_allowance_as_written = fields.number("min_allowance");
  r.shortfall_as_written = fields.number("shortfall");
  std::vector<Decimal> ends;
  fields.each("window_deg",
              [&](Json item, const std::string& path) { ends.push_back(fields.number_of(item, path)); });
  if (ends.size() == 2) r.window_from = ends[0], r.window_to = ends[1];
  if (ends.size() != 2 || compare(ends[0], ends[1]) > 0)
    fields.complain("field window_deg is not two angles in ascending order");
  Fields tolerances(fields.get("tolerances"), "tolerances", complaint);
  r.part_tolerance = enclosed(tolerances.number("part")),
  r.blank_tolerance = enclosed(tolerances.number("blank"));
  Fields regions(fields.get("regions"), "regions", complaint);
  for (const auto& [key, to] : {std::pair{"part", &r.part}, {"blank", &r.blank}}) {
    const std::string path = fmt::format("regions.{}", key);
    if (Fields(regions.get(key), path, complaint).text("units") != "mm")
      fields.complain(fmt::format("the units of {} are not mm", path));
    *to = read_shape(regions.get(key), path, complaint);
  }
  // Drawings are not asked for: lekalo 0.1 wrote none.
  fields.require({"locked", "demands", "scan", "part_cut", "certificate", "largest_certificate",
                  "certificate_file", "trim", "nc", "comparison", "deviations"});
  if (const Json locked = fields.get("locked"); !locked.is_null()) {
    Fields shift(locked, "locked", complaint);
    r.locked_x = shift.number_or_null("x"), r.locked_y = shift.number_or_null("y");
  }
  r.part_cut = truth_of(fields, "part_cut");
  r.scan = fields.get("scan");
  if (const Json drawings = fields.get("drawings"); !drawings.text.empty()) {
    Fields each(drawings, "drawings", complaint);
    each.require({"part", "blank"});
    r.part_drawing = each.get("part"), r.blank_drawing = each.get("blank");
  }
  const Json demands = fields.get("demands");
  if (!demands.is_null()) {
    r.demands = read_demands(demands, complaint);
    for (const std::string_view key : {"upper_bound", "gap"})
      if (fields.number_or_null(key)) r.bound_beside_demands = true;
  } else {
    r.upper_bound = enclosed(fields.number("upper_bound")), r.gap = enclosed(fields.number("gap"));
  }
  for (const std::string_view key : {"trim", "comparison", "deviations"})
    if (!fields.get(key).is_null())
      fields.complain(fmt::format("field {} says something that this checker does not know", key));
  if (const Json nc = fields.get("nc"); !nc.is_null()) r.nc = read_written_nc(nc, complaint);
  fields.each("contacts", [&](Json item, const std::string& path) {
    Fields contact(item, path, complaint);
    const auto point = [&](std::string_view key) {
      std::vector<Span> numbers;
      contact.each(key, [&](Json number, const std::string& at) {
        numbers.push_back(enclosed(contact.number_of(number, at)));
      });
      if (numbers.size() != 2)
        return contact.complain(fmt::format("{} is not two numbers", contact.name(key))), Vec{};
      return Vec{numbers[0], numbers[1]};
    };
    r.contacts.push_back({contact.index("part_edge"), contact.index("blank_edge"), point("part_at"),
                          point("blank_at"), approximate(contact.number("distance")),
                          approximate(contact.number("multiplier"))});
  });
  r.in_file = !fields.get("certificate_file").is_null();
  if (r.part_tolerance.low < 0 || r.blank_tolerance.low < 0) fields.complain("a tolerance is negative");
  return r;
}

}  // namespace lekalo::verify
