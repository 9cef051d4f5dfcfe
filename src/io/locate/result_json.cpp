#include "lekalo/io/locate/result_json.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "io/shape/region_text.hpp"
#include "io/text/json_tree.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "result_lines.hpp"

namespace lekalo::io {
namespace {

using detail::JsonKind;
using detail::JsonTree;
using detail::JsonValue;
using detail::line_of;
using detail::lines;
using detail::list_of_lines;

void write(JsonWriter& json, geom::Point p) { json.list({p.x, p.y}); }

void write(JsonWriter& json, const FileRecord& file) {
  json.object({{"path", file.path}, {"sha256", file.sha256}});
}

void write(JsonWriter& json, const InputRecord& input) {
  json.begin_object().fields(
      {{"role", input.role}, {"path", input.file.path}, {"sha256", input.file.sha256}});
  if (input.unit) {
    json.fields({{"units", *input.unit == LengthUnit::inch ? "inch" : "mm"}, {"points", input.points}});
    json.key("dropped").list(input.dropped);
  }
  json.end();
}

JsonWriter& begin_placement(JsonWriter& json, const locate::Placement& placement) {
  return json.begin_object().fields({{"x", placement.x},
                                     {"y", placement.y},
                                     {"theta", placement.theta},
                                     {"theta_deg", placement.theta * kDegreesPerRadian},
                                     {"clearance", placement.clearance}});
}

void write(JsonWriter& json, const TrimRecord& trim) {
  json.begin_object().fields({{"tolerance", trim.tolerance}, {"loss", trim.loss}});
  json.key("contour").list(trim.contour, [&](geom::Point p) { write(json, p); }).end();
}

void write(JsonWriter& json, const ComparisonRecord& comparison) {
  json.object({{"same_part", comparison.same_part},
               {"dx", comparison.dx},
               {"dy", comparison.dy},
               {"dtheta", comparison.dtheta},
               {"dtheta_deg", comparison.dtheta * kDegreesPerRadian},
               {"largest_shift", comparison.largest_shift},
               {"last_clearance", comparison.last_clearance},
               {"last_pose_clearance", comparison.last_pose_clearance}});
}

void write(JsonWriter& json, const DeviationsRecord& deviations) {
  json.object({{"path", deviations.file.path},
               {"sha256", deviations.file.sha256},
               {"points", deviations.points},
               {"least", deviations.least},
               {"greatest", deviations.greatest}});
}

void write_certificate_file(JsonWriter& json, const LocateDocument& d) {
  line_of(json, "certificate_file");
  if (!d.certificate_file) {
    json.value(nullptr);
    return;
  }
  json.object({{"path", d.certificate_file->path},
               {"sha256", d.certificate_file->sha256},
               {"intervals", d.certificate_intervals}});
}

void write_head(JsonWriter& json, const LocateDocument& d) {
  line_of(json, "format").object({{"name", "lekalo-locate"}, {"version", 1}});
  lines(json, {{"status", d.status}, {"units", "mm"}});
  list_of_lines(line_of(json, "inputs"), d.inputs, [&](const InputRecord& one) { write(json, one); });
  list_of_lines(line_of(json, "warnings"), d.warnings, [&](const std::string& one) { json.value(one); });
  lines(json, {{"seed", d.seed}, {"work", d.work}, {"version", kVersion}, {"method", d.method}});
}

void write_placement(JsonWriter& json, const LocateDocument& d) {
  const locate::Placement& p = d.placement;
  std::optional<double> gap;
  if (d.upper_bound) gap = difference_rounded_up(*d.upper_bound, p.clearance);
  lines(json, {{"x", p.x},
               {"y", p.y},
               {"theta", p.theta},
               {"theta_deg", p.theta * kDegreesPerRadian},
               {"mirrored", d.mirrored},
               {"clearance", p.clearance},
               {"upper_bound", d.upper_bound},
               {"gap", gap},
               {"min_allowance", d.min_allowance},
               {"shortfall", d.shortfall}});
  line_of(json, "window_deg").list({d.window_from_deg, d.window_to_deg});
}

void write_contact(JsonWriter& json, std::uint32_t part_vertex, std::uint32_t blank_edge, double multiplier) {
  json.object({{"part_vertex", part_vertex}, {"blank_edge", blank_edge}, {"multiplier", multiplier}});
}

void write(JsonWriter& json, const locate::CertificateInterval& interval) {
  json.begin_object().fields({{"from", interval.from}, {"to", interval.to}});
  json.key("contacts").list(interval.contacts, [&](const locate::Contact& contact) {
    write_contact(json, contact.part_vertex, contact.blank_edge, contact.multiplier);
  });
  json.end();
}

void write(JsonWriter& json, const locate::Touch& touch) {
  json.begin_object().fields({{"part_edge", touch.part_edge}, {"blank_edge", touch.blank_edge}});
  write(json.key("part_at"), touch.part);
  write(json.key("blank_at"), touch.blank);
  json.fields({{"distance", touch.distance}, {"multiplier", touch.multiplier}}).end();
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

void write(JsonWriter& json, const locate::CoverTree& tree, const locate::CoverTree::Node& node) {
  if (node.axis != locate::CoverTree::Axis::leaf) {
    json.list({name_of(node.axis), node.at});
    return;
  }
  json.begin_object().key("contacts").begin_list();
  for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
    const locate::BallTerm& t = tree.terms[k];
    json.begin_list();
    for (const double value : {t.part_centre.x, t.part_centre.y, t.part_radius, t.blank_centre.x,
                               t.blank_centre.y, t.blank_radius, t.multiplier})
      json.value(value);
    if (t.cap) json.value(*t.cap);
    json.end();
  }
  json.end().end();
}

const char* name_of(locate::OwnOutline own) {
  return own == locate::OwnOutline::file ? "same file" : "same outline";
}

void write_cover(JsonWriter& json, geom::Point pivot, const std::vector<locate::CoverTree>& trees) {
  write(json.begin_object().key("pivot"), pivot);
  json.key("trees").list(trees, [&](const locate::CoverTree& tree) {
    json.begin_object().field("mirrored", tree.mirrored);
    json.key("theta").list({tree.theta_from, tree.theta_to});
    json.key("x").list({tree.box.low.x, tree.box.high.x});
    json.key("y").list({tree.box.low.y, tree.box.high.y});
    list_of_lines(json.key("nodes"), tree.nodes,
                  [&](const locate::CoverTree::Node& node) { write(json, tree, node); });
    json.end();
  });
  json.end();
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

void write(JsonWriter& json, const locate::Feature& f) {
  json.begin_object().field("name", f.name).key("edges").list(f.edges);
  json.fields({{"minimum", f.minimum},
               {"target", f.target},
               {"maximum", f.maximum},
               {"scale", f.scale},
               {"finished", f.finished}});
  json.end();
}

void write(JsonWriter& json, const locate::TradeOff& point) {
  begin_placement(json, point.at)
      .fields({{"mirrored", point.mirrored},
               {"margin", point.margin},
               {"largest", point.largest},
               {"largest_bound", point.largest_bound}})
      .end();
}

void write(JsonWriter& json, const locate::LargestProof& proof) {
  json.object(
      {{"grown_for", proof.grown_for}, {"most", proof.most}, {"shift", proof.shift}, {"bound", proof.bound}});
}

void write(JsonWriter& json, const locate::SmallestLargest& second) {
  json.begin_object().fields({{"margin", second.margin},
                              {"found", second.found},
                              {"bound", second.bound},
                              {"gap", second.gap},
                              {"kept", second.kept}});
  json.key("proof");
  second.proof ? write(json, *second.proof) : void(json.value(nullptr));
  json.end();
}

void write(JsonWriter& json, const DemandRecord& d) {
  json.begin_object().field("minimum", d.minimum);
  json.key("features").list(d.features, [&](const locate::Feature& one) { write(json, one); });
  json.fields({{"criterion", d.criterion.name},
               {"give_up", d.give_up},
               {"margin", d.margin},
               {"margin_bound", d.margin_bound},
               {"margin_found", d.margin_found},
               {"margin_gap", d.margin_gap},
               {"largest", d.largest}});
  json.key("smallest_largest");
  d.second ? write(json, *d.second) : void(json.value(nullptr));
  json.field("deviation", d.deviation);
  json.key("trade_off").list(d.curve, [&](const locate::TradeOff& one) { write(json, one); });
  json.fields({{"grown_for", d.grown_for}, {"shift", d.shift}, {"bound", d.bound}}).end();
}

void write(JsonWriter& json, const ScanRecord& scan) {
  json.begin_object().fields({{"points", scan.points},
                              {"proved", scan.proved},
                              {"ordered", scan.ordered},
                              {"guard", scan.guard},
                              {"step", scan.step},
                              {"median_spacing", scan.median_spacing},
                              {"widest", scan.widest},
                              {"deepest", scan.deepest},
                              {"loss", scan.loss}});
  json.key("assumptions").list(scan.assumptions);
  json.key("unknown").list(scan.unknown);
  json.key("dropped").list(scan.dropped);
  json.fields({{"units", scan.unit == LengthUnit::inch ? "inch" : "mm"},
               {"min_radius", scan.min_radius},
               {"max_dip", scan.max_dip}});
  json.key("slice");
  if (scan.slice)
    json.object({{"height", scan.slice->height}, {"thickness", scan.slice->thickness}});
  else
    json.value(nullptr);
  json.key("left_out").list(scan.left_out).key("outlines");
  if (scan.ordered)
    json.value(nullptr);
  else
    json.list(scan.outlines, [&](const std::vector<std::uint32_t>& outline) { json.list(outline); });
  json.end();
}

void write(JsonWriter& json, const DrawingRecord& drawing) {
  json.begin_object().key("layers").list(drawing.layers);
  json.field("join", drawing.join).key("set_aside");
  json.list(drawing.specks, [&](geom::Point p) { write(json, p); });
  // These are there only where a drawing has them, so that the documents of clean drawings stay as they were.
  if (!drawing.marks.empty())
    json.key("marks").list(drawing.marks, [&](const geom::Edge& edge) { detail::write_edge(json, edge); });
  if (!drawing.set_aside.empty())
    json.key("set_aside_curves").list(drawing.set_aside, [&](const geom::Edge& edge) {
      detail::write_edge(json, edge);
    });
  if (drawing.loose_error > 0) json.field("loose_error", drawing.loose_error);
  json.end();
}

template <class Record>
void write_or_null(JsonWriter& json, const std::optional<Record>& record) {
  record ? write(json, *record) : void(json.value(nullptr));
}

/// Gives the proof of the bound of largest allowances, if there is one and it is here.
const locate::DemandProof* largest_proof(const LocateDocument& d) {
  if (!d.demands || !d.demands->second || !d.demands->second->proof) return nullptr;
  const locate::DemandProof& proof = *d.demands->second->proof;
  return proof.certificate.empty() ? nullptr : &proof;
}

void write(JsonWriter& json, const LocateDocument& d, const locate::PoseProof& proof) {
  lines(json, {{"mirror", name_of(d.mirror)}});
  line_of(json, "locked");
  if (d.locked.x || d.locked.y)
    json.object({{"x", d.locked.x}, {"y", d.locked.y}});
  else
    json.value(nullptr);
  lines(json, {{"part_cut", d.part_cut}});
  write_or_null(line_of(json, "scan"), d.scan);
  line_of(json, "drawings").begin_object();
  write_or_null(json.key("part"), d.part_drawing);
  write_or_null(json.key("blank"), d.blank_drawing);
  json.end();
  write_or_null(line_of(json, "demands"), d.demands);
  line_of(json, "tolerances").object({{"part", d.part_tolerance}, {"blank", d.blank_tolerance}});
  line_of(json, "regions").begin_object();
  json.key("part").raw() += regions_json(d.part);
  json.key("blank").raw() += regions_json(d.blank);
  json.end();
  list_of_lines(line_of(json, "contacts"), d.contacts, [&](const locate::Touch& one) { write(json, one); });
  const auto cover = [&](const char* key, geom::Point pivot, const std::vector<locate::CoverTree>* trees) {
    line_of(json, key);
    trees != nullptr && !trees->empty() ? write_cover(json, pivot, *trees) : void(json.value(nullptr));
  };
  const locate::DemandProof* const largest = largest_proof(d);
  if (proof.own_outline != locate::OwnOutline::no)
    line_of(json, "certificate").value(name_of(proof.own_outline));
  else
    cover("certificate", proof.pivot, &proof.trees);
  cover("largest_certificate", largest != nullptr ? largest->pivot : geom::Point{},
        largest != nullptr ? &largest->certificate : nullptr);
  write_certificate_file(json, d);
}

void write(JsonWriter& json, const LocateDocument& d, const locate::AngleProof& proof) {
  list_of_lines(line_of(json, "contacts"), d.contacts, [&](const locate::Touch& touch) {
    write_contact(json, touch.part_edge, touch.blank_edge, touch.multiplier);
  });
  line_of(json, "certificate");
  if (proof.intervals.empty())
    json.value(nullptr);
  else
    list_of_lines(json, proof.intervals, [&](const locate::CertificateInterval& one) { write(json, one); });
  write_certificate_file(json, d);
  list_of_lines(line_of(json, "alternatives"), d.alternatives,
                [&](const locate::Placement& one) { begin_placement(json, one).end(); });
  lines(json, {{"alternatives_complete", d.alternatives_complete}});
}

std::size_t size_of(const locate::AngleProof& proof) { return proof.intervals.size(); }
std::size_t size_of(const std::vector<locate::CoverTree>& trees) {
  std::size_t leaves = 0;
  for (const locate::CoverTree& tree : trees) leaves += tree.nodes.size() / 2 + 1;
  return leaves;
}
std::size_t size_of(const locate::PoseProof& proof) {
  return size_of(proof.trees) + (proof.own_outline == locate::OwnOutline::no ? 0 : 1);
}

void write_certificates(JsonWriter& json, const LocateDocument& d, const locate::PoseProof& proof) {
  json.line(0).key("certificate");
  if (proof.own_outline != locate::OwnOutline::no)
    json.value(name_of(proof.own_outline));
  else
    write_cover(json, proof.pivot, proof.trees);
  if (const locate::DemandProof* const largest = largest_proof(d))
    write_cover(json.line(0).key("largest_certificate"), largest->pivot, largest->certificate);
  json.line(0).end();
}

/// Millions of intervals: nothing but their text is held.
void write_certificates(JsonWriter& json, const LocateDocument&, const locate::AngleProof& proof) {
  json.line(0).key("intervals").begin_list();
  for (const locate::CertificateInterval& interval : proof.intervals) write(json.line(0), interval);
  json.line(0).end().end();
}

std::optional<JsonValue> member(std::optional<JsonValue> object, const char* key) {
  return object ? object->find(key) : std::nullopt;
}

bool is_null(std::optional<JsonValue> value) { return !value || value->kind() == JsonKind::null; }

/// Reads fields one after another and keeps the first complaint. What is no object has no fields.
class FieldReader {
 public:
  explicit FieldReader(const std::string& name) : name_(name) {}

  double number(JsonValue object, const char* key) {
    const auto value = object.find(key);
    if (value && value->is_number()) return value->number();
    complain(key, "a number");
    return 0;
  }
  std::string text(JsonValue object, const char* key) {
    const auto value = object.find(key);
    if (value && value->kind() == JsonKind::text) return std::string(value->text());
    complain(key, "a text");
    return {};
  }
  bool truth(JsonValue object, const char* key) {
    const auto value = object.find(key);
    if (value && value->kind() == JsonKind::boolean) return value->truth();
    complain(key, "true or false");
    return false;
  }
  template <std::size_t N>
  std::array<double, N> numbers(JsonValue object, const char* key) {
    std::array<double, N> all{};
    const auto list = object.find(key);
    std::size_t count = 0;
    if (list && list->kind() == JsonKind::list)
      for (const JsonValue item : *list) {
        if (count < N && item.is_number()) all[count] = item.number();
        count = item.is_number() ? count + 1 : N + 1;
      }
    if (count != N) complain(key, "a list of numbers");
    return all;
  }
  FileRecord file(JsonValue object) { return {text(object, "path"), text(object, "sha256")}; }
  std::optional<FileRecord> optional_file(std::optional<JsonValue> object) {
    if (is_null(object)) return std::nullopt;
    return file(*object);
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
  JsonWriter json(JsonLayout::spaced);
  json.begin_object();
  write_head(json, d);
  write_placement(json, d);
  std::visit([&](const auto& proof) { write(json, d, proof); }, d.proof);
  write_or_null(line_of(json, "trim"), d.trim);
  detail::write_nc(line_of(json, "nc"), d.nc);
  write_or_null(line_of(json, "comparison"), d.comparison);
  write_or_null(line_of(json, "deviations"), d.deviations);
  line_of(json, "run").object({{"seconds", d.seconds}, {"threads", d.threads}});
  json.line(0).end();
  return json.take() + "\n";
}

void write_record(JsonWriter& json, const std::optional<DrawingRecord>& drawing) {
  write_or_null(json, drawing);
}
void write_record(JsonWriter& json, const std::optional<ScanRecord>& scan) { write_or_null(json, scan); }

std::size_t proof_size(const LocateDocument& d) {
  const locate::DemandProof* const largest = largest_proof(d);
  return std::visit([](const auto& proof) { return size_of(proof); }, d.proof) +
         (largest != nullptr ? size_of(largest->certificate) : 0);
}

bool has_proof(const LocateDocument& d) noexcept {
  const auto* const angles = std::get_if<locate::AngleProof>(&d.proof);
  return angles != nullptr ? !angles->intervals.empty() : size_of(std::get<locate::PoseProof>(d.proof)) > 0;
}

std::string certificate_text(const LocateDocument& d) {
  JsonWriter json(JsonLayout::spaced);
  json.begin_object().key("format").object({{"name", "lekalo-certificate"}, {"version", 1}});
  std::visit([&](const auto& proof) { write_certificates(json, d, proof); }, d.proof);
  return json.take() + "\n";
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

void detail::write_nc(JsonWriter& json, const std::optional<NcRecord>& nc) {
  if (!nc) return void(json.value(nullptr));
  json.begin_object().fields({{"mode", nc->mode},
                              {"scan_frame", nc->scan_frame},
                              {"control", nc->control},
                              {"work_offset", nc->work_offset},
                              {"rounding_mm", nc->rounding_mm},
                              {"clearance", nc->clearance},
                              {"motions", nc->motions}});
  json.key("notes").list(nc->notes);
  write(json.key("output"), nc->output);
  json.end();
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
  const auto tree = JsonTree::parse(bytes, name);
  // A key that stands twice or lists in lists 64 deep are refused with this too: lekalo writes no such thing.
  if (!tree)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: not JSON, so this is not a result of lekalo locate", name));
  const JsonValue root = tree->root();
  const auto format = root.find("format"), format_name = member(format, "name"),
             version = member(format, "version");
  if (!format_name || !format_name->text_is("lekalo-locate") || !version || !version->is_number() ||
      version->number() != 1)
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: field \"format\" does not say lekalo-locate version 1, so this is not a result of "
                    "lekalo locate that this program reads",
                    name));
  FieldReader read(name);
  WrittenResult result;
  result.status = read.text(root, "status");
  result.method = read.text(root, "method");
  const auto inputs = root.find("inputs");
  if (!inputs || inputs->kind() != JsonKind::list)
    read.complain("inputs", "a list");
  else
    for (const JsonValue input : *inputs)
      result.inputs.push_back({read.text(input, "role"), read.file(input), std::nullopt, 0, {}});
  if (root.find("quaternion")) {
    result.solid_pose = {read.numbers<4>(root, "quaternion"),
                         {read.number(root, "x"), read.number(root, "y"), read.number(root, "z")}};
  } else {
    result.placement = {read.number(root, "x"), read.number(root, "y"), read.number(root, "theta"),
                        read.number(root, "clearance")};
    result.mirrored = read.truth(root, "mirrored");
  }
  result.certificate_file = read.optional_file(root.find("certificate_file"));
  result.deviations = read.optional_file(root.find("deviations"));
  if (const auto nc = root.find("nc"); !is_null(nc))
    result.nc_output = read.optional_file(nc->find("output"));
  if (!read.complaint().empty()) return failure(ErrorCode::bad_input, read.complaint());
  return result;
}

}  // namespace lekalo::io
