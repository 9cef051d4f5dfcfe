#include "document.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "verify/read/fields.hpp"
#include "verify/read/known_fields.hpp"

namespace lekalo::verify {
namespace {

tl::unexpected<Error> bad(const std::string& name, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, sentence));
}

bool has_format(Fields& fields, std::string_view format) {
  std::string ignored;
  Fields of(fields.get("format"), "format", ignored);
  return of.text("name") == format && of.get("version").text == "1";
}

WrittenInput read_input(Fields& fields) {
  WrittenInput input;
  const std::string units = fields.text("units");
  if (units != "mm" && units != "inch") fields.complain("units of an input are neither \"mm\" nor \"inch\"");
  input.unit = units == "inch" ? LengthUnit::inch : LengthUnit::millimetre;
  input.points = fields.index("points");
  fields.each("dropped", [&](Json item, const std::string& path) {
    input.dropped.push_back(fields.index_of(item, path));
  });
  return input;
}

void read_inputs(Fields& fields, ResultDocument& result, std::string& complaint) {
  std::size_t parts = 0, blanks = 0;
  fields.each("inputs", [&](Json item, const std::string& path) {
    Fields input(item, path, complaint);
    const std::string role = input.text("role");
    if (role == "part") {
      ++parts, result.part = read_input(input);
      result.part_sha256 = input.text("sha256");
    }
    if (role == "blank") ++blanks, result.blank = read_input(input);
  });
  if (parts != 1 || blanks != 1) {
    fields.complain(fmt::format("inputs name {} part and {} blank, not one each", parts, blanks));
  }
}

WrittenPlacement read_placement(Fields& fields) {
  return {fields.number("x"), fields.number("y"), fields.number("theta"), fields.number("theta_deg"),
          fields.number("clearance")};
}

WrittenContact read_contact(Fields& fields) {
  return {fields.index("part_vertex"), fields.index("blank_edge"), approximate(fields.number("multiplier"))};
}

Window read_window(Fields& fields) {
  std::vector<Decimal> ends;
  fields.each("window_deg",
              [&](Json item, const std::string& path) { ends.push_back(fields.number_of(item, path)); });
  if (ends.size() == 2 && compare(ends[0], ends[1]) <= 0) return {ends[0], ends[1]};
  fields.complain("field window_deg is not two angles in ascending order");
  return {};
}

void read_proof(Fields& fields, ResultDocument& result, std::string& complaint) {
  const Json certificate = fields.get("certificate"), file = fields.get("certificate_file");
  if (certificate.is_array()) {
    result.certificate = certificate;
  } else if (!certificate.is_null()) {
    fields.complain("field certificate is neither a list nor null");
  }
  if (file.is_null()) return;
  result.certificate_file_intervals = Fields(file, "certificate_file", complaint).index("intervals");
  if (result.certificate) fields.complain("the certificate is given both here and in a file");
}

void read_trim(Fields& fields, ResultDocument& result, std::string& complaint) {
  const Json value = fields.get("trim");
  if (value.is_null()) return;
  Fields trim(value, "trim", complaint);
  result.trim = WrittenTrim{trim.number("tolerance"), trim.number("loss"), {}};
  trim.each("contour", [&](Json item, const std::string& path) {
    std::vector<Decimal> point;
    if (item.is_array()) {
      JsonItems numbers(item);
      while (const auto number = numbers.next()) point.push_back(trim.number_of(*number, path));
    }
    if (point.size() != 2) return trim.complain(fmt::format("{} is not a list of two numbers", path));
    result.trim->contour.x.push_back(std::move(point[0]));
    result.trim->contour.y.push_back(std::move(point[1]));
  });
}

void read_comparison(Json value, ResultDocument& result, std::string& complaint) {
  Fields fields(value, "comparison", complaint);
  WrittenComparison& c = result.comparison.emplace();
  if (!fields.get("same_part").is_bool())
    fields.complain("field comparison.same_part is neither true nor false");
  c.same_part = fields.get("same_part").is_true();
  for (auto [key, to] : {std::pair{"dx", &c.dx},
                         {"dy", &c.dy},
                         {"dtheta", &c.dtheta},
                         {"dtheta_deg", &c.dtheta_deg},
                         {"largest_shift", &c.largest_shift},
                         {"last_clearance", &c.last_clearance},
                         {"last_pose_clearance", &c.last_pose_clearance}})
    *to = fields.number(key);
}

void read_extras(Fields& fields, ResultDocument& result, std::string& complaint) {
  if (const Json nc = fields.get("nc"); !nc.is_null()) result.nc = read_written_nc(nc, complaint);
  if (const Json value = fields.get("comparison"); !value.is_null())
    read_comparison(value, result, complaint);
  if (const Json value = fields.get("deviations"); !value.is_null()) {
    Fields deviations(value, "deviations", complaint);
    result.deviations = {deviations.index("points"), deviations.number("least"),
                         deviations.number("greatest")};
  }
}

}  // namespace

Result<ResultDocument> read_result_document(Json written, const std::string& name) {
  std::string complaint;
  refuse_unknown_fields(written, complaint);
  Fields fields(written, "", complaint);
  if (!has_format(fields, "lekalo-locate")) {
    return bad(name, "field format does not say lekalo-locate, version 1");
  }
  ResultDocument result;
  result.status = fields.text("status");
  constexpr std::array<std::string_view, 4> kStatuses{"optimal", "stopped", "infeasible", "unproved"};
  if (std::find(kStatuses.begin(), kStatuses.end(), result.status) == kStatuses.end()) {
    fields.complain(fmt::format("\"{}\" is no status of a result", excerpt(result.status)));
  }
  if (fields.text("units") != "mm") fields.complain("field units is not \"mm\"");
  if (fields.get("mirrored").text != "false") fields.complain("field mirrored is not false");
  read_inputs(fields, result, complaint);
  result.best = read_placement(fields);
  result.upper_bound = fields.number_or_null("upper_bound");
  result.gap = fields.number_or_null("gap");
  result.min_allowance = fields.number("min_allowance");
  result.shortfall = fields.number("shortfall");
  result.window = read_window(fields);
  fields.each("contacts", [&](Json item, const std::string& path) {
    Fields contact(item, path, complaint);
    result.contacts.push_back(read_contact(contact));
  });
  fields.require({"certificate", "certificate_file", "trim", "nc", "comparison", "deviations"});
  read_proof(fields, result, complaint);
  fields.each("alternatives", [&](Json item, const std::string& path) {
    Fields alternative(item, path, complaint);
    result.alternatives.push_back(read_placement(alternative));
  });
  read_trim(fields, result, complaint);
  read_extras(fields, result, complaint);
  if (!complaint.empty()) return bad(name, complaint);
  return result;
}

Result<Json> read_certificate_document(const Document& document) {
  LEKALO_TRY(const Json root, parse_json(document.bytes, document.name));
  std::string complaint;
  refuse_unknown_fields(root, complaint);
  Fields fields(root, "", complaint);
  if (!has_format(fields, "lekalo-certificate")) {
    return bad(document.name, "field format does not say lekalo-certificate, version 1");
  }
  if (!fields.get("intervals").is_array()) fields.complain("field intervals is not a list");
  if (!complaint.empty()) return bad(document.name, complaint);
  return fields.get("intervals");
}

// This function reads up to a million items, so it makes maps and paths only to complain.
Result<WrittenInterval> read_interval(Json item, std::size_t index, const std::string& name) {
  constexpr std::array<std::string_view, 3> kKeys{"from", "to", "contacts"};
  constexpr std::array<std::string_view, 3> kContactKeys{"part_vertex", "blank_edge", "multiplier"};
  const auto complain = [&](std::string_view sentence) {
    return bad(name, fmt::format("certificate interval {}: {}", index, sentence));
  };
  std::array<Json, 3> found;
  if (!item.is_object() || !find_members(item, kKeys, found))
    return complain("it is not an object with each field once");
  WrittenInterval interval{found[0].text, found[1].text, {}};
  for (const Json& end : {found[0], found[1]}) {
    if (!parse_decimal(end.text)) {
      return complain(fmt::format("\"{}\" is not {}", excerpt(end.text), decimal_rule()));
    }
  }
  if (!found[2].is_array()) return complain("it has no list of contacts");
  JsonItems contacts(found[2]);
  std::size_t count = 0;
  while (const auto contact = contacts.next()) {
    if (count == 3) return complain("it has more than three contacts");
    std::string sentence;
    std::array<Json, 3> values;
    if (!contact->is_object() || !find_members(*contact, kContactKeys, values)) {
      return complain("a contact is not an object with each field once");
    }
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = parse_decimal(values[i].text);
      const bool whole = number && sgn(number->digits) >= 0 && number->exponent >= 0;
      if (!number || (i < 2 && !whole)) {
        return complain(fmt::format("{} is \"{}\"", kContactKeys[i], excerpt(values[i].text)));
      }
      numbers[i] = approximate(*number);
    }
    constexpr double kLargest = 1e15;
    if (!(numbers[0] < kLargest) || !(numbers[1] < kLargest)) return complain("an index is larger than 1e15");
    interval.contacts[count++] = {static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1]),
                                  numbers[2]};
  }
  if (count != 3) return complain(fmt::format("it has {} contacts, not three", count));
  return interval;
}

}  // namespace lekalo::verify
