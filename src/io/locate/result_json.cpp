#include "lekalo/io/locate/result_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/assert.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io {
namespace {

using Json = nlohmann::ordered_json;

void append_number(std::string& out, double value) {
  LEKALO_ASSERT(std::isfinite(value));
  fmt::format_to(std::back_inserter(out), "{}", value);
}

/// Like Json::dump, on one line, with numbers in shortest form: the library's own are shortest nearly always.
void append_json(std::string& out, const Json& value) {
  if (value.is_number_float()) return append_number(out, value.get<double>());
  if (value.is_object()) {
    out += '{';
    const char* separator = "";
    for (const auto& [key, item] : value.items()) {
      out += separator + json_string(key) + ": ";
      append_json(out, item);
      separator = ", ";
    }
    out += '}';
  } else if (value.is_array()) {
    out += '[';
    const char* separator = "";
    for (const Json& item : value) {
      out += separator;
      append_json(out, item);
      separator = ", ";
    }
    out += ']';
  } else {
    out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

void append_contact(std::string& out, std::uint32_t part_vertex, std::uint32_t blank_edge,
                    double multiplier) {
  fmt::format_to(std::back_inserter(out), R"({{"part_vertex": {}, "blank_edge": {}, "multiplier": )",
                 part_vertex, blank_edge);
  append_number(out, multiplier);
  out += '}';
}

void append_vertex_touch(std::string& out, const locate::Touch& touch) {
  append_contact(out, touch.part_edge, touch.blank_edge, touch.multiplier);
}

/// Certificates hold up to millions of intervals, so they go to text without a tree in between.
void append_interval(std::string& out, const locate::CertificateInterval& interval) {
  out += R"({"from": )";
  append_number(out, interval.from);
  out += R"(, "to": )";
  append_number(out, interval.to);
  out += R"(, "contacts": )";
  const char* separator = "[";
  for (const locate::Contact& contact : interval.contacts) {
    out += separator;
    append_contact(out, contact.part_vertex, contact.blank_edge, contact.multiplier);
    separator = ", ";
  }
  out += "]}";
}

/// A list of text items, one a line.
template <class Items, class AppendItem>
void append_list(std::string& out, const Items& items, AppendItem append_item) {
  const char* separator = "[\n    ";
  for (const auto& item : items) {
    out += separator;
    append_item(out, item);
    separator = ",\n    ";
  }
  out += items.empty() ? "[]" : "\n  ]";
}

Json to_json(const FileRecord& file) { return {{"path", file.path}, {"sha256", file.sha256}}; }

Json to_json(const InputRecord& input) {
  Json json{{"role", input.role}, {"path", input.file.path}, {"sha256", input.file.sha256}};
  if (input.unit) {
    json["units"] = *input.unit == LengthUnit::inch ? "inch" : "mm";
    json["points"] = input.points;
    json["dropped"] = input.dropped;
  }
  return json;
}

Json to_json(const locate::Placement& placement) {
  return {{"x", placement.x},
          {"y", placement.y},
          {"theta", placement.theta},
          {"theta_deg", placement.theta * kDegreesPerRadian},
          {"clearance", placement.clearance}};
}

Json to_json(const TrimRecord& trim) {
  Json contour = Json::array();
  for (const geom::Point& p : trim.contour) contour.push_back({p.x, p.y});
  return {{"tolerance", trim.tolerance}, {"loss", trim.loss}, {"contour", std::move(contour)}};
}

Json to_json(const NcRecord& nc) {
  return {{"mode", nc.mode},
          {"scan_frame", nc.scan_frame},
          {"work_offset", nc.work_offset},
          {"rounding_mm", nc.rounding_mm},
          {"clearance", nc.clearance},
          {"motions", nc.motions},
          {"notes", nc.notes},
          {"output", to_json(nc.output)}};
}

Json to_json(const ComparisonRecord& comparison) {
  return {{"same_part", comparison.same_part},
          {"dx", comparison.dx},
          {"dy", comparison.dy},
          {"dtheta", comparison.dtheta},
          {"dtheta_deg", comparison.dtheta * kDegreesPerRadian},
          {"largest_shift", comparison.largest_shift},
          {"last_clearance", comparison.last_clearance},
          {"last_pose_clearance", comparison.last_pose_clearance}};
}

Json to_json(const DeviationsRecord& deviations) {
  return {{"path", deviations.file.path},
          {"sha256", deviations.file.sha256},
          {"points", deviations.points},
          {"least", deviations.least},
          {"greatest", deviations.greatest}};
}

Json certificate_file_json(const LocateDocument& d) {
  if (!d.certificate_file) return nullptr;
  Json json = to_json(*d.certificate_file);
  json["intervals"] = d.certificate_intervals;
  return json;
}

/// Writes the fields of one object, one a line (list items one a line too).
class ObjectText {
 public:
  void field(const char* key, const Json& value) { append_json(begin(key), value); }
  template <class Items, class AppendItem>
  void list(const char* key, const Items& items, AppendItem append_item) {
    append_list(begin(key), items, append_item);
  }
  template <class Append>
  void text(const char* key, Append append) {
    append(begin(key));
  }
  [[nodiscard]] std::string finish() && {
    text_ += "\n}\n";
    return std::move(text_);
  }

 private:
  std::string& begin(const char* key) {
    text_ += text_.empty() ? "{\n  \"" : ",\n  \"";
    text_ += key;
    text_ += "\": ";
    return text_;
  }
  std::string text_;
};

constexpr auto kAsJson = [](std::string& out, const auto& item) { append_json(out, to_json(item)); };
constexpr auto kAsText = [](std::string& out, const std::string& item) { out += json_string(item); };

void append_head(ObjectText& out, const LocateDocument& d) {
  out.field("format", {{"name", "lekalo-locate"}, {"version", 1}});
  out.field("status", d.status);
  out.field("units", "mm");
  out.list("inputs", d.inputs, kAsJson);
  out.list("warnings", d.warnings, kAsText);
  out.field("seed", d.seed);
  out.field("work", d.work);
  out.field("version", kVersion);
  out.field("method", d.method);
}

void append_placement(ObjectText& out, const LocateDocument& d) {
  const locate::Placement& p = d.placement;
  out.field("x", p.x);
  out.field("y", p.y);
  out.field("theta", p.theta);
  out.field("theta_deg", p.theta * kDegreesPerRadian);
  out.field("mirrored", d.mirrored);
  out.field("clearance", p.clearance);
  out.field("upper_bound", d.upper_bound ? Json(*d.upper_bound) : Json(nullptr));
  out.field("gap", d.upper_bound ? Json(difference_rounded_up(*d.upper_bound, p.clearance)) : Json(nullptr));
  out.field("min_allowance", d.min_allowance);
  out.field("shortfall", d.shortfall);
  out.field("window_deg", {d.window_from_deg, d.window_to_deg});
}

void append_point(std::string& out, geom::Point p) {
  out += '[';
  append_number(out, p.x);
  out += ", ";
  append_number(out, p.y);
  out += ']';
}

void append_touch(std::string& out, const locate::Touch& touch) {
  fmt::format_to(std::back_inserter(out), R"({{"part_edge": {}, "blank_edge": {}, "part_at": )",
                 touch.part_edge, touch.blank_edge);
  append_point(out, touch.part);
  out += R"(, "blank_at": )";
  append_point(out, touch.blank);
  out += R"(, "distance": )";
  append_number(out, touch.distance);
  out += R"(, "multiplier": )";
  append_number(out, touch.multiplier);
  out += '}';
}

const char* name_of(locate::CoverTree::Axis axis) {
  switch (axis) {
    case locate::CoverTree::Axis::theta:
      return "theta";
    case locate::CoverTree::Axis::x:
      return "x";
    case locate::CoverTree::Axis::y:
      return "y";
    case locate::CoverTree::Axis::leaf:
      break;
  }
  return "";
}

void append_node(std::string& out, const locate::CoverTree& tree, const locate::CoverTree::Node& node) {
  if (node.axis != locate::CoverTree::Axis::leaf) {
    fmt::format_to(std::back_inserter(out), R"(["{}", )", name_of(node.axis));
    append_number(out, node.at);
    out += ']';
    return;
  }
  out += R"({"contacts": [)";
  for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
    const locate::BallTerm& t = tree.terms[k];
    const char* separator = k == node.first ? "[" : ", [";
    for (const double value : {t.part_centre.x, t.part_centre.y, t.part_radius, t.blank_centre.x,
                               t.blank_centre.y, t.blank_radius, t.multiplier}) {
      out += separator;
      append_number(out, value);
      separator = ", ";
    }
    if (t.cap) fmt::format_to(std::back_inserter(out), ", {}", *t.cap);
    out += ']';
  }
  out += "]}";
}

void append_cover(std::string& out, geom::Point pivot, const std::vector<locate::CoverTree>& trees) {
  out += R"({"pivot": )";
  append_point(out, pivot);
  out += R"(, "trees": [)";
  const char* next = "";
  for (const locate::CoverTree& tree : trees) {
    fmt::format_to(std::back_inserter(out), R"({}{{"mirrored": {}, "theta": )", next, tree.mirrored);
    append_point(out, {tree.theta_from, tree.theta_to});
    out += R"(, "x": )";
    append_point(out, {tree.box.low.x, tree.box.high.x});
    out += R"(, "y": )";
    append_point(out, {tree.box.low.y, tree.box.high.y});
    out += R"(, "nodes": )";
    append_list(out, tree.nodes, [&](std::string& text, const locate::CoverTree::Node& node) {
      append_node(text, tree, node);
    });
    out += '}';
    next = ", ";
  }
  out += "]}";
}

const char* name_of(locate::Mirror mirror) {
  switch (mirror) {
    case locate::Mirror::no:
      return "no";
    case locate::Mirror::yes:
      return "yes";
    case locate::Mirror::either:
      break;
  }
  return "either";
}

Json or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

Json to_json(const locate::Feature& f) {
  return {{"name", f.name},
          {"edges", f.edges},
          {"minimum", f.minimum},
          {"target", or_null(f.target)},
          {"maximum", or_null(f.maximum)},
          {"scale", f.scale},
          {"finished", or_null(f.finished)}};
}

Json to_json(const locate::TradeOff& point) {
  Json json = to_json(point.at);
  json["mirrored"] = point.mirrored;
  json["margin"] = point.margin;
  json["largest"] = point.largest;
  json["largest_bound"] = point.largest_bound;
  return json;
}

Json to_json(const locate::SmallestLargest& second) {
  Json proof = nullptr;
  if (second.proof)
    proof = {{"grown_for", second.proof->grown_for},
             {"most", second.proof->most},
             {"shift", second.proof->shift},
             {"bound", second.proof->bound}};
  return {{"margin", second.margin}, {"found", second.found}, {"bound", second.bound},
          {"gap", second.gap},       {"kept", second.kept},   {"proof", std::move(proof)}};
}

Json to_json(const DemandRecord& d) {
  Json features = Json::array(), curve = Json::array();
  for (const locate::Feature& f : d.features) features.push_back(to_json(f));
  for (const locate::TradeOff& point : d.curve) curve.push_back(to_json(point));
  return {{"minimum", d.minimum},
          {"features", std::move(features)},
          {"criterion", d.criterion.name},
          {"give_up", d.give_up},
          {"margin", d.margin},
          {"margin_bound", d.margin_bound},
          {"margin_found", d.margin_found},
          {"margin_gap", d.margin_gap},
          {"largest", d.largest},
          {"smallest_largest", d.second ? to_json(*d.second) : Json(nullptr)},
          {"deviation", d.deviation},
          {"trade_off", std::move(curve)},
          {"grown_for", d.grown_for},
          {"shift", d.shift},
          {"bound", d.bound}};
}

Json to_json(const ScanRecord& scan) {
  return {{"points", scan.points},   {"proved", scan.proved},
          {"ordered", scan.ordered}, {"guard", scan.guard},
          {"step", scan.step},       {"median_spacing", scan.median_spacing},
          {"widest", scan.widest},   {"deepest", scan.deepest},
          {"loss", scan.loss},       {"assumptions", scan.assumptions},
          {"unknown", scan.unknown}, {"dropped", scan.dropped}};
}

template <class T>
Json or_null(const std::optional<T>& record) {
  return record ? to_json(*record) : Json(nullptr);
}

/// Gives the proof of the bound of largest allowances, if there is one and it is here.
const locate::DemandProof* largest_proof(const LocateDocument& d) {
  if (!d.demands || !d.demands->second || !d.demands->second->proof) return nullptr;
  const locate::DemandProof& proof = *d.demands->second->proof;
  return proof.certificate.empty() ? nullptr : &proof;
}

void append(ObjectText& out, const LocateDocument& d, const locate::PoseProof& proof) {
  out.field("mirror", name_of(d.mirror));
  if (d.locked.x || d.locked.y) {
    out.field("locked", {{"x", or_null(d.locked.x)}, {"y", or_null(d.locked.y)}});
  } else {
    out.field("locked", nullptr);
  }
  out.field("part_cut", d.part_cut);
  out.field("scan", or_null(d.scan));
  out.field("demands", or_null(d.demands));
  out.field("tolerances", {{"part", d.part_tolerance}, {"blank", d.blank_tolerance}});
  out.text("regions", [&](std::string& text) {
    text += R"({"part": )" + regions_json(d.part) + R"(, "blank": )" + regions_json(d.blank) + "}";
  });
  out.list("contacts", d.contacts, append_touch);
  const auto cover = [&](const char* key, geom::Point pivot, const std::vector<locate::CoverTree>* trees) {
    if (trees == nullptr || trees->empty()) return out.field(key, nullptr);
    out.text(key, [&](std::string& text) { append_cover(text, pivot, *trees); });
  };
  const locate::DemandProof* const largest = largest_proof(d);
  cover("certificate", proof.pivot, &proof.trees);
  cover("largest_certificate", largest != nullptr ? largest->pivot : geom::Point{},
        largest != nullptr ? &largest->certificate : nullptr);
  out.field("certificate_file", certificate_file_json(d));
}

void append(ObjectText& out, const LocateDocument& d, const locate::AngleProof& proof) {
  out.list("contacts", d.contacts, append_vertex_touch);
  if (proof.intervals.empty()) {
    out.field("certificate", nullptr);
  } else {
    out.list("certificate", proof.intervals, append_interval);
  }
  out.field("certificate_file", certificate_file_json(d));
  out.list("alternatives", d.alternatives, kAsJson);
  out.field("alternatives_complete", d.alternatives_complete);
}

std::size_t size_of(const locate::AngleProof& proof) { return proof.intervals.size(); }
std::size_t size_of(const std::vector<locate::CoverTree>& trees) {
  std::size_t leaves = 0;
  for (const locate::CoverTree& tree : trees) leaves += tree.nodes.size() / 2 + 1;
  return leaves;
}
std::size_t size_of(const locate::PoseProof& proof) { return size_of(proof.trees); }

void append_certificates(std::string& text, const LocateDocument& d, const locate::PoseProof& proof) {
  text += "\"certificate\": ";
  append_cover(text, proof.pivot, proof.trees);
  if (const locate::DemandProof* const largest = largest_proof(d)) {
    text += ",\n\"largest_certificate\": ";
    append_cover(text, largest->pivot, largest->certificate);
  }
  text += "\n}\n";
}

/// Millions of intervals: nothing but their text is held.
void append_certificates(std::string& text, const LocateDocument&, const locate::AngleProof& proof) {
  text += "\"intervals\": [";
  const char* separator = "\n";
  for (const locate::CertificateInterval& interval : proof.intervals) {
    text += separator;
    append_interval(text, interval);
    separator = ",\n";
  }
  text += "\n]}\n";
}

const Json& member(const Json& object, const char* key) {
  static const Json null;
  if (!object.is_object()) return null;
  const auto found = object.find(key);
  return found == object.end() ? null : *found;
}

/// Reads fields one after another and keeps the first complaint.
class FieldReader {
 public:
  explicit FieldReader(const std::string& name) : name_(name) {}

  double number(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    complain(key, "a number");
    return 0;
  }
  std::string text(const Json& object, const char* key) {
    const Json& value = member(object, key);
    if (value.is_string()) return value.get<std::string>();
    complain(key, "a text");
    return {};
  }
  FileRecord file(const Json& object) { return {text(object, "path"), text(object, "sha256")}; }
  std::optional<FileRecord> optional_file(const Json& object) {
    if (object.is_null()) return std::nullopt;
    return file(object);
  }
  void complain(const char* key, const char* wanted) {
    if (complaint_.empty()) {
      complaint_ = fmt::format("{}: field \"{}\" is not {}, so this is not a result of lekalo locate", name_,
                               key, wanted);
    }
  }
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  const std::string& name_;
  std::string complaint_;
};

}  // namespace

std::string result_json(const LocateDocument& d) {
  ObjectText out;
  append_head(out, d);
  append_placement(out, d);
  std::visit([&](const auto& proof) { append(out, d, proof); }, d.proof);
  out.field("trim", or_null(d.trim));
  out.field("nc", or_null(d.nc));
  out.field("comparison", or_null(d.comparison));
  out.field("deviations", or_null(d.deviations));
  out.field("run", {{"seconds", d.seconds}, {"threads", d.threads}});
  return std::move(out).finish();
}

std::size_t proof_size(const LocateDocument& d) {
  const locate::DemandProof* const largest = largest_proof(d);
  return std::visit([](const auto& proof) { return size_of(proof); }, d.proof) +
         (largest != nullptr ? size_of(largest->certificate) : 0);
}

bool has_proof(const LocateDocument& d) noexcept {
  const auto* const angles = std::get_if<locate::AngleProof>(&d.proof);
  return angles != nullptr ? !angles->intervals.empty() : !std::get<locate::PoseProof>(d.proof).trees.empty();
}

std::string certificate_text(const LocateDocument& d) {
  std::string text = "{\"format\": {\"name\": \"lekalo-certificate\", \"version\": 1},\n";
  std::visit([&](const auto& proof) { append_certificates(text, d, proof); }, d.proof);
  return text;
}

const char* name_of(locate::Status status) noexcept {
  switch (status) {
    case locate::Status::optimal:
      return "optimal";
    case locate::Status::stopped:
      return "stopped";
    case locate::Status::infeasible:
      break;
  }
  return "infeasible";
}

const char* name_of(nc::RewriteMode mode) noexcept {
  switch (mode) {
    case nc::RewriteMode::coordinates:
      return "coordinates";
    case nc::RewriteMode::offset:
      return "offset";
    case nc::RewriteMode::g68:
      break;
  }
  return "g68";
}

const char* name_of(nc::ScanFrame frame) noexcept {
  return frame == nc::ScanFrame::machine ? "machine" : "wcs";
}

const InputRecord* WrittenResult::input(std::string_view role) const noexcept {
  for (const InputRecord& record : inputs) {
    if (record.role == role) return &record;
  }
  return nullptr;
}

Result<WrittenResult> read_result(std::string_view bytes, const std::string& name) {
  const Json json = Json::parse(bytes, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) {
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: not JSON, so this is not a result of lekalo locate", name));
  }
  if (member(member(json, "format"), "name") != "lekalo-locate" ||
      member(member(json, "format"), "version") != 1) {
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: field \"format\" does not say lekalo-locate version 1, so this is not a result of "
                    "lekalo locate that this program reads",
                    name));
  }
  FieldReader read(name);
  WrittenResult result;
  result.status = read.text(json, "status");
  result.method = read.text(json, "method");
  if (!member(json, "inputs").is_array()) read.complain("inputs", "a list");
  for (const Json& input : member(json, "inputs")) {
    result.inputs.push_back({read.text(input, "role"), read.file(input), std::nullopt, 0, {}});
  }
  result.placement = {read.number(json, "x"), read.number(json, "y"), read.number(json, "theta"),
                      read.number(json, "clearance")};
  const Json& mirrored = member(json, "mirrored");
  if (!mirrored.is_boolean()) read.complain("mirrored", "true or false");
  result.mirrored = mirrored == true;
  result.certificate_file = read.optional_file(member(json, "certificate_file"));
  const Json& nc = member(json, "nc");
  if (!nc.is_null()) result.nc_output = read.optional_file(member(nc, "output"));
  if (!read.complaint().empty()) return failure(ErrorCode::bad_input, read.complaint());
  return result;
}

}  // namespace lekalo::io
