#include "solid_document.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

#include "verify/read/known_fields.hpp"

namespace lekalo::verify {
namespace {

constexpr std::array<std::string_view, 4> kStatuses{"optimal", "stopped", "infeasible", "unproved"};
constexpr std::array<std::string_view, 8> kRoles{"part",    "blank",    "start", "points",
                                                 "nominal", "features", "nc",    "allow"};
/// In the order of SolidUnit and of SolidFreedom.
constexpr std::array<std::string_view, 6> kUnits{"mm", "inch", "m", "micron", "cm", "foot"};
constexpr std::array<std::string_view, 3> kFreedoms{"xyz", "c-xyz", "six"};
/// Those that are an answer to more than the largest margin.
constexpr std::array<std::string_view, 2> kCriteria{"largest", "even"};
constexpr std::array<std::string_view, 6> kAxes{"x", "y", "z", "turn_x", "turn_y", "turn_z"};

tl::unexpected<Error> bad(const std::string& name, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, sentence));
}

bool has_format(Fields& fields, std::string_view format) {
  std::string ignored;
  Fields of(fields.get("format"), "format", ignored);
  return of.text("name") == format && of.get("version").text == "1";
}

/// Returns which of some words a text is, and complains where it is none of them.
template <std::size_t Count>
std::size_t word_of(Fields& fields, std::string_view key, const std::array<std::string_view, Count>& words) {
  const std::string text = fields.text(key);
  const auto found = std::ranges::find(words, text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string list;
  for (const std::string_view word : words) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", word);
  fields.complain(fmt::format("field {} is \"{}\", not {}", fields.name(key), excerpt(text), list));
  return 0;
}

class Reader {
 public:
  Reader(Json written, std::string& complaint) : complaint_(complaint), fields_(written, "", complaint) {}

  SolidDocument read() {
    if (!has_format(fields_, "lekalo-locate"))
      fields_.complain("field format does not say lekalo-locate, version 1");
    d_.status = kStatuses[word_of(fields_, "status", kStatuses)];
    if (fields_.text("units") != "mm") fields_.complain("field units is not \"mm\"");
    read_inputs();
    read_window();
    d_.pose = pose(fields_);
    d_.inside = truth(fields_, "inside");
    d_.clearance = fields_.number_or_null("clearance");
    d_.upper_bound = fields_.number_or_null("upper_bound");
    d_.gap = fields_.number_or_null("gap");
    d_.shortfall = fields_.number_or_null("shortfall");
    d_.min_allowance = length(fields_, "min_allowance");
    d_.unknown_area = fields_.number("unknown_area_mm2");
    for (const auto& value : {d_.clearance, d_.upper_bound, d_.gap, d_.shortfall})
      if (value && is_beyond_all_sizes(*value)) fields_.complain("a length is beyond all sizes");
    fields_.each("contacts", [&](Json item, const std::string& path) { read_contact(item, path); });
    fields_.require({"warnings", "seed", "work", "version", "method", "demands", "scan", "certificate",
                     "certificate_file", "nc", "offset", "run"});
    read_demands();
    read_choice();
    read_scan();
    read_proof();
    refuse_no_object("offset");
    if (const Json nc = fields_.get("nc"); !nc.is_null()) d_.nc = read_written_nc(nc, complaint_);
    return std::move(d_);
  }

 private:
  static bool truth(Fields& fields, std::string_view key) {
    const Json value = fields.get(key);
    if (!value.is_bool())
      fields.complain(fmt::format("field {} is neither true nor false", fields.name(key)));
    return value.is_true();
  }
  static Decimal length(Fields& fields, std::string_view key) {
    Decimal value = fields.number(key);
    if (is_beyond_all_sizes(value))
      fields.complain(fmt::format("field {} is beyond {:g} mm", fields.name(key), limits::kLargestDerived));
    return value;
  }
  template <std::size_t Count>
  std::array<Decimal, Count> numbers(Fields& fields, std::string_view key) {
    return numbers_of<Count>(fields.get(key), complaint_, [&] { return "field " + fields.name(key); })
        .value_or(std::array<Decimal, Count>{});
  }
  SolidPose pose(Fields& fields) {
    SolidPose made{numbers<4>(fields, "quaternion"),
                   {length(fields, "x"), length(fields, "y"), length(fields, "z")}};
    if (std::ranges::all_of(made.quaternion, [](const Decimal& q) { return sgn(q.digits) == 0; }))
      fields.complain(fmt::format("field {} is 0, which is no rotation", fields.name("quaternion")));
    return made;
  }

  void read_inputs() {
    std::size_t parts = 0, blanks = 0, features = 0;
    fields_.each("inputs", [&](Json item, const std::string& path) {
      Fields input(item, path, complaint_);
      const std::string_view role = kRoles[word_of(input, "role", kRoles)];
      const bool is_mesh = role == "part" || role == "blank";
      for (const auto& [key, is_said] :
           {std::pair("units", is_mesh || role == "points" || role == "nominal"),
            std::pair("triangles", is_mesh || role == "nominal"), std::pair("deviation", is_mesh),
            std::pair("points", role == "points")})
        if (!is_said && !input.get(key).text.empty())
          input.complain(fmt::format("field {} is said of the file of the role {}", input.name(key), role));
      features += role == "features" ? 1 : 0;
      if (role == "points") {
        if (d_.points) fields_.complain("inputs name two files of points");
        d_.points = {static_cast<SolidUnit>(word_of(input, "units", kUnits)), input.index("points")};
      }
      if (role == "nominal") {
        if (d_.nominal) fields_.complain("inputs name two nominal meshes");
        d_.nominal = {static_cast<SolidUnit>(word_of(input, "units", kUnits)), input.index("triangles")};
      }
      if (!is_mesh) return;
      ++(role == "part" ? parts : blanks);
      WrittenSolid& solid = role == "part" ? d_.part : d_.blank;
      solid.unit = static_cast<SolidUnit>(word_of(input, "units", kUnits));
      solid.triangles = input.index("triangles");
      if (!input.get("deviation").text.empty()) solid.deviation = length(input, "deviation");
    });
    if (parts != 1 || blanks != 1)
      fields_.complain(fmt::format("inputs name {} part and {} blank, not one each", parts, blanks));
    if (features != (fields_.get("demands").is_object() ? 1U : 0U))
      fields_.complain(fmt::format("inputs name {} files of features, and there are {}demands", features,
                                   fields_.get("demands").is_object() ? "" : "no "));
  }

  void read_window() {
    SolidWindow& w = d_.window;
    w.freedom = static_cast<SolidFreedom>(word_of(fields_, "freedom", kFreedoms));
    Fields window(fields_.get("window"), "window", complaint_);
    w.start = pose(window);
    w.pivot = numbers<3>(window, "pivot");
    w.shift = length(window, "shift");
    w.turn_deg = window.number("turn_deg");
    if (sgn(w.shift.digits) < 0) window.complain("field window.shift is below 0");
    if (sgn(w.turn_deg.digits) < 0 ||
        (compare(w.turn_deg, Decimal{9, 1}) > 0 && compare(w.turn_deg, Decimal{18, 1}) != 0))
      window.complain("field window.turn_deg is neither from 0 to 90 nor 180");
  }

  void read_contact(Json item, const std::string& path) {
    Fields contact(item, path, complaint_);
    d_.contacts.push_back(
        {{numbers<3>(contact, "part_point"), numbers<3>(contact, "blank_point"), length(contact, "distance")},
         contact.index("part_triangle"),
         contact.index("blank_triangle")});
    (void)contact.number("multiplier");
  }

  /// A result without them may leave the word out.
  void read_demands() {
    const Json written = fields_.get("demands");
    if (written.is_null()) return;
    Fields fields(written, "demands", complaint_);
    WrittenSolidDemands& demands = d_.demands.emplace();
    fields.require({"minimum"});
    demands.minimum = fields.number_or_null("minimum");
    fields.each("features", [&](Json item, const std::string& path) {
      Fields of(item, path, complaint_);
      of.require({"minimum", "scale"});
      demands.features.push_back({of.text("name"), of.index("triangles"), of.number_or_null("minimum"),
                                  of.number_or_null("scale"), truth(of, "as_cast")});
      const auto has = [&](const char* key) { return !of.get(key).text.empty(); };
      if (has("maximum") && has("finished"))
        of.complain(fmt::format("field {} has a maximum and is finished", path));
      if ((has("maximum") || has("finished")) != has("largest"))
        of.complain(fmt::format("field {} has one of a maximum and a largest allowance", path));
      if (has("rim") && !has("finished"))
        of.complain(fmt::format("field {} has a rim and is not finished", path));
      if (has("target")) demands.features.back().target = length(of, "target");
      if (!has("largest")) return;
      if (has("rim")) demands.features.back().rim = length(of, "rim");
      if (has("maximum")) demands.features.back().maximum = length(of, "maximum");
      if (has("finished")) demands.features.back().finished = length(of, "finished");
      demands.features.back().largest = length(of, "largest");
    });
    fields.each("datums", [&](Json item, const std::string& path) {
      Fields of(item, path, complaint_);
      demands.datums.push_back({of.text("name"), length(of, "within"), length(of, "off")});
      if (!of.get("missed").text.empty()) demands.datums.back().missed = length(of, "missed");
    });
    fields.require({"margin", "margin_bound", "margin_gap"});
    demands.margin = fields.number_or_null("margin");
    demands.bound = fields.number_or_null("margin_bound");
    demands.gap = fields.number_or_null("margin_gap");
    for (const auto& value : {demands.minimum, demands.margin, demands.bound, demands.gap})
      if (value && is_beyond_all_sizes(*value)) fields.complain("a margin is beyond all sizes");
  }

  /// A result of the largest margin alone leaves the word out.
  void read_choice() {
    const Json written = fields_.get("choice");
    if (written.text.empty()) return;
    Fields fields(written, "choice", complaint_);
    WrittenSolidChoice& choice = d_.choice.emplace();
    choice.even = word_of(fields, "criterion", kCriteria) == 1;
    choice.give_up = length(fields, "give_up");
    if (sgn(choice.give_up.digits) < 0) fields.complain("field choice.give_up is below 0");
    fields.require({"margin_found", "largest"});
    choice.margin_found = fields.number_or_null("margin_found");
    choice.largest = fields.number_or_null("largest");
    for (const auto& [key, value] :
         {std::pair("largest_found", &choice.largest_found), {"deviation", &choice.deviation}}) {
      if (fields.get(key).text.empty() == choice.even)
        fields.complain(fmt::format("choice.{} {} a placement by the criterion even", key,
                                    choice.even ? "is missing of" : "is of"));
      if (choice.even) *value = fields.number_or_null(key);
    }
    for (const auto& value : {choice.margin_found, choice.largest, choice.largest_found, choice.deviation})
      if (value && is_beyond_all_sizes(*value)) fields.complain("a length of choice is beyond all sizes");
    if (choice.margin_found.has_value() != d_.inside || choice.largest.has_value() != d_.inside)
      fields.complain(fmt::format("choice {} margin_found and largest, but inside is {}",
                                  d_.inside ? "needs" : "has", d_.inside));
    const bool is_evened = choice.even && d_.inside;
    if (choice.largest_found.has_value() != is_evened || choice.deviation.has_value() != is_evened)
      fields.complain(fmt::format("choice {} largest_found and deviation, but inside is {}",
                                  d_.inside ? "needs" : "has", d_.inside));
  }

  void read_scan() {
    const Json written = fields_.get("scan");
    if (written.is_null()) return;
    Fields fields(written, "scan", complaint_);
    WrittenSolidScan& scan = d_.scan.emplace();
    const auto size = [&](Fields& of, std::string_view key, bool positive) {
      Decimal value = length(of, key);
      if (sgn(value.digits) < (positive ? 1 : 0))
        of.complain(fmt::format("field {} is not {} 0", of.name(key), positive ? "above" : "from"));
      return value;
    };
    scan.guard = size(fields, "guard", false);
    fields.require({"min_radius", "max_dip", "underside"});
    if (!fields.get("min_radius").is_null()) scan.min_radius = size(fields, "min_radius", true);
    if (!fields.get("max_dip").is_null()) scan.max_dip = size(fields, "max_dip", false);
    if (const Json touches = fields.get("touches"); !touches.text.empty()) read_touches(touches);
    if (scan.touches.has_value() == (scan.min_radius || scan.max_dip))
      fields.complain(scan.touches ? "scan has a min_radius or a max_dip, and touches"
                                   : "scan has neither a min_radius nor a max_dip");
    if (const Json side = fields.get("underside"); !side.is_null()) {
      Fields of(side, "scan.underside", complaint_);
      scan.underside = {length(of, "z"), size(of, "flat", true)};
    }
    for (const Decimal* off : {&scan.guard, scan.underside ? &scan.underside->flat : nullptr})
      if (off != nullptr && scan.min_radius && compare(*off, *scan.min_radius) >= 0)
        fields.complain("scan.min_radius is not above what the points, or the underside, may be off");
    scan.widest = size(fields, "widest", false);
    scan.unknown_triangles = fields.index("unknown_triangles");
    scan.proved = truth(fields, "proved");
    fields.require({"left_out"});
    fields.each("left_out", [&](Json item, const std::string& path) {
      scan.left_out.push_back(fields.index_of(item, path));
    });
    std::size_t sentences = 0;
    fields.each("assumptions", [&](Json item, const std::string&) { sentences += item.is_string() ? 1 : 0; });
    if (sentences == 0) fields.complain("scan.assumptions is without a sentence");
  }

  void refuse_no_object(std::string_view key) {
    const Json value = fields_.get(key);
    if (!value.is_null() && !value.is_object())
      fields_.complain(fmt::format("field {} is neither an object nor null", key));
  }

  /// Reads what touches cut off a box, or the way of a corner.
  WrittenTouches::Cut cut(Fields& fields, std::size_t axes) {
    WrittenTouches::Cut made;
    made.axis = word_of(fields, "axis", kAxes);
    if (made.axis >= axes) fields.complain(fmt::format("field {} is no way", fields.name("axis")));
    made.above = truth(fields, "above");
    made.at = length(fields, "at");
    fields.each("terms", [&](Json item, const std::string& path) {
      const auto three = numbers_of<3>(item, complaint_, [&] { return "field " + path; });
      if (!three) return;
      const auto& [touch, ball, multiplier] = *three;
      made.terms.push_back({index(touch, path), index(ball, path), multiplier});
      if (sgn(multiplier.digits) < 0) fields.complain(fmt::format("field {} has a multiplier below 0", path));
    });
    return made;
  }
  std::size_t index(const Decimal& number, const std::string& path) {
    const double value = approximate(number);
    if (number.exponent >= 0 && value >= 0 && value < static_cast<double>(limits::kMostSolidItems))
      return static_cast<std::size_t>(value);
    if (complaint_.empty()) complaint_ = fmt::format("field {} has a number of nothing", path);
    return 0;
  }

  void read_touches(Json written) {
    Fields fields(written, "scan.touches", complaint_);
    WrittenTouches& touches = d_.scan->touches.emplace();
    touches.ball = length(fields, "ball");
    touches.form = length(fields, "form");
    if (sgn(touches.ball.digits) < 0 || sgn(touches.form.digits) <= 0)
      fields.complain("scan.touches has a ball below 0, or a form that is not above 0");
    touches.directions = truth(fields, "directions");
    touches.pivot = numbers<3>(fields, "pivot");
    touches.quaternion = numbers<4>(fields, "quaternion");
    for (std::size_t k = 0; k < 6; ++k) touches.box[k] = numbers<2>(fields, kAxes[k]);
    fields.each("balls", [&](Json item, const std::string& path) {
      auto ball = numbers_of<4>(item, complaint_, [&] { return "field " + path; });
      if (!ball) return;
      if (sgn(ball->back().digits) <= 0)
        fields.complain(fmt::format("field {} has a radius not above 0", path));
      touches.balls.push_back(*std::move(ball));
    });
    fields.each("cuts", [&](Json item, const std::string& path) {
      Fields of(item, path, complaint_);
      touches.cuts.push_back(cut(of, 6));
    });
    Fields moved(fields.get("moved"), "scan.touches.moved", complaint_);
    touches.moved = pose(moved);
    std::size_t ends = 0;
    fields.each("around", [&](Json item, const std::string& path) {
      auto end = numbers_of<3>(item, complaint_, [&] { return "field " + path; });
      if (end && ends < 2) touches.around[ends] = *std::move(end);
      ++ends;
    });
    if (ends != 2) fields.complain("field scan.touches.around is not a list of two points");
    fields.each("ways", [&](Json item, const std::string& path) {
      Fields of(item, path, complaint_);
      WrittenTouches::Way way;
      way.corner = of.index("corner");
      way.multiplier = length(of, "multiplier");
      if (way.corner >= 8 || sgn(way.multiplier.digits) < 0)
        of.complain(fmt::format("field {} has no corner from 0 to 7, or a multiplier below 0", path));
      way.cut = cut(of, 3);
      touches.ways.push_back(std::move(way));
    });
    if (complaint_.empty() &&
        std::ranges::all_of(touches.quaternion, [](const Decimal& q) { return sgn(q.digits) == 0; }))
      fields.complain("field scan.touches.quaternion is 0, which is no rotation");
  }

  void read_proof() {
    d_.certificate = fields_.get("certificate");
    refuse_no_object("certificate");
    const Json file = fields_.get("certificate_file");
    if (file.is_null()) return;
    d_.boxes_in_file = Fields(file, "certificate_file", complaint_).index("boxes");
    if (!d_.certificate.is_null()) fields_.complain("the certificate is given both here and in a file");
  }

  std::string& complaint_;
  Fields fields_;
  SolidDocument d_;
};

}  // namespace

std::vector<std::string> faults_of_choice(const SolidDocument& d) {
  std::vector<std::string> faults;
  const auto& [margin, bound] =
      d.demands ? std::tie(d.demands->margin, d.demands->bound) : std::tie(d.clearance, d.upper_bound);
  if (!d.choice || !d.choice->margin_found || !margin) return faults;
  if (d.choice->largest_found && to_fraction(*d.choice->largest) >
                                     to_fraction(*d.choice->largest_found) + to_fraction(d.choice->give_up))
    faults.push_back(fmt::format("choice.largest {} is above choice.largest_found {} and choice.give_up {}",
                                 approximate(*d.choice->largest), approximate(*d.choice->largest_found),
                                 approximate(d.choice->give_up)));
  const Fraction is = to_fraction(*margin), found = to_fraction(*d.choice->margin_found);
  if (is > found)
    faults.push_back(fmt::format("choice.margin_found {} is below the margin {}",
                                 approximate(*d.choice->margin_found), approximate(*margin)));
  if (is < found - to_fraction(d.choice->give_up))
    faults.push_back(fmt::format("the margin {} is below choice.margin_found {} less choice.give_up {}",
                                 approximate(*margin), approximate(*d.choice->margin_found),
                                 approximate(d.choice->give_up)));
  if (bound && found > to_fraction(*bound))
    faults.push_back(fmt::format("choice.margin_found {} is above the bound {}",
                                 approximate(*d.choice->margin_found), approximate(*bound)));
  return faults;
}

bool is_beyond_all_sizes(const Decimal& value) {
  return !(std::abs(approximate(value)) <= limits::kLargestDerived);
}

Result<SolidDocument> read_solid_document(Json written, const std::string& name) {
  std::string complaint;
  refuse_unknown_fields_of_solids(written, complaint);
  SolidDocument document = Reader(written, complaint).read();
  if (!complaint.empty()) return bad(name, complaint);
  return document;
}

Result<Json> read_solid_certificate_document(const Document& document) {
  LEKALO_TRY(const Json root, parse_json(document.bytes, document.name));
  std::string complaint;
  refuse_unknown_fields_of_solids(root, complaint);
  Fields fields(root, "", complaint);
  if (!has_format(fields, "lekalo-certificate"))
    fields.complain("field format does not say lekalo-certificate, version 1");
  const Json certificate = fields.get("certificate");
  if (!certificate.is_object()) fields.complain("field certificate is not an object");
  if (!complaint.empty()) return bad(document.name, complaint);
  return certificate;
}

}  // namespace lekalo::verify
