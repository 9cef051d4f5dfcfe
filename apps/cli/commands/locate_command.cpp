#include "locate_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "contours.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/draw/picture.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/locate/allowance.hpp"
#include "lekalo/verify/verify.hpp"
#include "locate_regions.hpp"
#include "outputs.hpp"
#include "program.hpp"
#include "report.hpp"
#include "shapes.hpp"
#include "solve.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// Up to this many intervals a certificate stands in the result itself.
constexpr std::size_t kInlineIntervals = 10'000;

/// A pose that is compared with may lie this far out, mm; a thousand kilometres, beyond any machine.
constexpr double kFarthestPose = 1e9;

struct Inputs {
  std::string part_bytes, blank_bytes, nc_bytes, last_bytes;
  Contour part, blank;
  std::optional<io::WrittenResult> last;
};

/// Everything a run makes, before any of it is written.
struct Product {
  io::LocateDocument document;
  std::string result_text, certificate_text, program_text, deviations_text, picture_bytes;
  ReportFiles reports;
  bool program_withheld = false;
};

Result<void> check_paths(const LocateOptions& o) {
  return check_outputs({{"-o", o.output},
                        {"--certificate", o.certificate},
                        {"--picture", o.picture},
                        {"--report", o.report},
                        {"--allowances", o.allowances},
                        {"--drawing", o.drawing},
                        {"--deviations", o.deviations},
                        {"--nc-out", o.nc_out}},
                       {{"--part", o.part},
                        {"--blank", o.blank},
                        {"--nc", o.nc},
                        {"--compare", o.compare},
                        {"--features", o.features}});
}

Result<std::string> read_if_named(const std::string& path) {
  if (path.empty()) return std::string();
  return disk::read_file(path);
}

struct Files {
  std::string part, blank;
};

Result<Files> read_files(const LocateOptions& o) {
  Result<std::string> part = disk::read_file(o.part);
  if (!part) return tl::unexpected(part.error());
  Result<std::string> blank = disk::read_file(o.blank);
  if (!blank) return tl::unexpected(blank.error());
  return Files{std::move(*part), std::move(*blank)};
}

Result<Inputs> read_inputs(const LocateOptions& o, Files files) {
  Result<std::string> nc_bytes = read_if_named(o.nc);
  if (!nc_bytes) return tl::unexpected(nc_bytes.error());
  Result<std::string> last_bytes = read_if_named(o.compare);
  if (!last_bytes) return tl::unexpected(last_bytes.error());

  Result<Contour> part = read_contour(files.part, o.part, o.units, std::nullopt);
  if (!part) return tl::unexpected(part.error());
  Result<Contour> blank = read_contour(files.blank, o.blank, o.units, o.trim);
  if (!blank) return tl::unexpected(blank.error());
  std::optional<io::WrittenResult> last;
  if (!o.compare.empty()) {
    Result<io::WrittenResult> read = io::read_result(*last_bytes, o.compare);
    if (!read) return tl::unexpected(read.error());
    const locate::Placement& pose = read->placement;
    if (!(std::abs(pose.theta) <= geom::kMaxAngle &&
          std::max(std::abs(pose.x), std::abs(pose.y)) <= kFarthestPose)) {
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: the pose ({}, {}) mm, {} rad is out of all measure", o.compare, pose.x,
                                 pose.y, pose.theta));
    }
    last = std::move(*read);
  }
  return Inputs{std::move(files.part), std::move(files.blank), std::move(*nc_bytes), std::move(*last_bytes),
                std::move(*part),      std::move(*blank),      std::move(last)};
}

io::InputRecord contour_record(const char* role, const std::string& path, std::string_view bytes,
                               const Contour& contour) {
  return {role, {path, io::sha256(bytes)}, contour.file.unit, contour.file.points.size(), contour.dropped};
}

std::vector<io::InputRecord> input_records(const LocateOptions& o, const Inputs& in) {
  std::vector<io::InputRecord> records{contour_record("part", o.part, in.part_bytes, in.part),
                                       contour_record("blank", o.blank, in.blank_bytes, in.blank)};
  if (!o.nc.empty()) records.push_back({"nc", {o.nc, io::sha256(in.nc_bytes)}, std::nullopt, 0, {}});
  if (in.last)
    records.push_back({"last-result", {o.compare, io::sha256(in.last_bytes)}, std::nullopt, 0, {}});
  return records;
}

std::vector<std::string> first_warnings(const LocateOptions& o, const Inputs& in) {
  std::vector<std::string> warnings = o.warnings;
  warnings.insert(warnings.end(), in.part.notices.begin(), in.part.notices.end());
  warnings.insert(warnings.end(), in.blank.notices.begin(), in.blank.notices.end());
  for (const std::string& path : {o.part, o.blank, o.nc, o.compare, o.nc_out, o.certificate, o.deviations}) {
    if (io::as_utf8(path) != path) {
      warnings.push_back("the file name " + io::as_utf8(path) +
                         " is not UTF-8, so the result holds it with replaced characters and verify must be "
                         "told where the file is");
    }
  }
  return warnings;
}

io::LocateDocument begin_document(const LocateOptions& o, const Inputs& in, const Solution& found) {
  io::LocateDocument d;
  d.status = found.status;
  d.method = name_of(o.method);
  d.inputs = input_records(o, in);
  d.warnings = first_warnings(o, in);
  d.seed = o.seed;
  d.work = found.work;
  d.placement = found.best;
  d.upper_bound = found.upper_bound;
  d.min_allowance = o.min_allowance;
  d.shortfall = found.shortfall;
  d.window_from_deg = o.window_from_deg;
  d.window_to_deg = o.window_to_deg;
  d.contacts = found.contacts;
  d.alternatives = found.alternatives;
  d.alternatives_complete = found.alternatives_complete;
  d.trim = in.blank.trim;
  d.seconds = found.seconds;
  return d;
}

std::string certificate_document(const std::vector<locate::CertificateInterval>& intervals) {
  io::CertificateText text;
  for (const locate::CertificateInterval& interval : intervals) text.add(interval);
  return std::move(text).finish();
}

void add_certificate(const LocateOptions& o, const Solution& found, Product& product) {
  io::LocateDocument& d = product.document;
  if (o.method != Method::certified) return;
  const bool too_long = found.certificate.size() > kInlineIntervals;
  if (o.certificate.empty() && !too_long) {
    d.certificate = found.certificate;
    return;
  }
  product.certificate_text = certificate_document(found.certificate);
  if (o.certificate.empty()) {
    d.warnings.push_back(
        fmt::format("the certificate has {} intervals, more than the {} that go into a result, and is not "
                    "kept; --certificate FILE keeps it",
                    found.certificate.size(), kInlineIntervals));
    return;
  }
  d.certificate_file = io::FileRecord{o.certificate, io::sha256(product.certificate_text)};
  d.certificate_intervals = found.certificate.size();
}

void add_comparison(const Inputs& in, Product& product) {
  if (!in.last) return;
  io::LocateDocument& d = product.document;
  const locate::Placement& last = in.last->placement;
  const locate::Placement& now = d.placement;
  const io::InputRecord* last_part = in.last->input("part");
  io::ComparisonRecord c;
  c.same_part = last_part != nullptr && last_part->file.sha256 == d.inputs.front().file.sha256;
  if (!c.same_part) d.warnings.push_back("the earlier result was made from another part file");
  const locate::PlacementShift shift = locate::placement_shift(in.part.polygon.vertices(), last, now);
  c.dx = shift.dx;
  c.dy = shift.dy;
  c.dtheta = shift.dtheta;
  c.largest_shift = shift.largest;
  c.last_clearance = last.clearance;
  c.last_pose_clearance = safe_clearance(in.part, in.blank, last);
  d.comparison = c;
}

/// One line for every probed point; index counts from 0 in file order.
std::string deviations_csv(const geom::Ring& probed, const std::vector<double>& deviations) {
  std::string text = "index,x,y,deviation\n";
  for (std::size_t k = 0; k < probed.size(); ++k) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", k, probed[k].x, probed[k].y, deviations[k]);
  }
  return text;
}

void add_deviations(const LocateOptions& o, const Inputs& in, Product& product) {
  if (o.deviations.empty()) return;
  const geom::Ring& probed = in.blank.file.points;
  const std::vector<double> deviations =
      locate::deviations(probed, in.part.polygon.vertices(), product.document.placement);
  const auto [least, greatest] = std::minmax_element(deviations.begin(), deviations.end());
  product.deviations_text = deviations_csv(probed, deviations);
  product.document.deviations = io::DeviationsRecord{
      {o.deviations, io::sha256(product.deviations_text)}, deviations.size(), *least, *greatest};
}

Result<void> add_program(const LocateOptions& o, const Inputs& in, Product& product) {
  if (o.nc.empty()) return {};
  Result<RewrittenProgram> program = rewrite_for(o, in.nc_bytes, product.document);
  if (!program) return tl::unexpected(program.error());
  product.program_text = std::move(program->text);
  product.program_withheld = program->withheld;
  return {};
}

Result<void> add_picture(const LocateOptions& o, const Inputs& in, const Solution& found, Product& product) {
  if (o.picture.empty()) return {};
  draw::LocatePicture picture;
  picture.title = "lekalo locate";
  picture.part_name = io::as_utf8(o.part);
  picture.blank_name = io::as_utf8(o.blank);
  picture.method = product.document.method;
  picture.status = product.document.status;
  picture.part = in.part.polygon.vertices();
  picture.blank = in.blank.polygon.vertices();
  if (in.last) picture.start = in.last->placement;
  picture.result = found.best;
  picture.min_allowance = product.document.min_allowance;
  picture.shortfall = product.document.shortfall;
  picture.has_upper_bound = found.upper_bound.has_value();
  picture.upper_bound = found.upper_bound.value_or(0);
  picture.contacts = found.polygon_contacts;
  picture.vertex_numbers = in.part.vertex_in_result;
  picture.edge_numbers = in.blank.edge_in_result;
  if (o.picture.ends_with(".svg")) {
    product.picture_bytes = draw::picture_svg(picture);
    return {};
  }
  Result<std::string> png = draw::picture_png(picture);
  if (!png) return tl::unexpected(png.error());
  product.picture_bytes = std::move(*png);
  return {};
}

/// Puts the bytes about to be written before the independent checker. Where a proof was made it has to hold,
/// also one that is too long to be kept.
Result<void> self_check(const LocateOptions& o, const Inputs& in, const Solution& found,
                        const Product& product) {
  verify::LocateInputs inputs{
      {"result", product.result_text}, {o.part, in.part_bytes}, {o.blank, in.blank_bytes}, {}};
  std::string result_with_proof;
  const bool proof_not_kept = !product.certificate_text.empty() && !product.document.certificate_file;
  if (proof_not_kept) {
    io::LocateDocument with_proof = product.document;
    with_proof.certificate_file = io::FileRecord{"certificate", io::sha256(product.certificate_text)};
    with_proof.certificate_intervals = found.certificate.size();
    result_with_proof = io::result_json(with_proof);
    inputs.result.bytes = result_with_proof;
  }
  if (!product.certificate_text.empty()) inputs.certificate = {"certificate", product.certificate_text};
  const Result<verify::LocateReport> report = verify::verify_locate(inputs);
  const char* const ending = "; no file was written, and this is a mistake of lekalo worth reporting";
  if (!report) {
    return failure(ErrorCode::refuted, "self-check: " + report.error().message + ending);
  }
  const auto wanted = o.method == Method::certified ? verify::Verdict::confirmed : verify::Verdict::unproved;
  if (report->verdict == wanted) return {};
  const std::string finding =
      report->findings.empty() ? "the proof is not complete" : report->findings.front();
  return failure(ErrorCode::refuted, "self-check refuted the result: " + finding + ending);
}

/// The search rounds a clearance down by more than the written pose loses, so that a part that just fits
/// seems to miss its demand by some last digits. The checker reads the same digits exactly: the demand is
/// claimed where it confirms the claim, and only there.
Solution claim_what_just_fits(const LocateOptions& o, const Inputs& in, Solution found) {
  const bool just = found.status == name_of(locate::Status::optimal) && found.shortfall > 0 &&
                    found.upper_bound && *found.upper_bound >= o.min_allowance;
  if (!just) return found;
  Solution claim = found;
  claim.best.clearance = o.min_allowance;
  claim.shortfall = 0;
  Product product;
  product.document = begin_document(o, in, claim);
  add_certificate(o, claim, product);
  product.result_text = io::result_json(product.document);
  return self_check(o, in, claim, product) ? claim : found;
}

/// All files, or none: they get their names only after stdout has taken the result.
Result<void> write_all(const LocateOptions& o, const Product& product) {
  disk::AtomicFiles files;
  const auto add = [&files](const std::string& path, const std::string& bytes) -> Result<void> {
    if (path.empty()) return {};
    return files.add(path, bytes);
  };
  Result<void> done = add(o.output, product.result_text)
                          .and_then([&] { return add(o.certificate, product.certificate_text); })
                          .and_then([&] { return add(o.picture, product.picture_bytes); })
                          .and_then([&] { return add(o.report, product.reports.report); })
                          .and_then([&] { return add(o.allowances, product.reports.allowances); })
                          .and_then([&] { return add(o.drawing, product.reports.drawing); })
                          .and_then([&] { return add(o.deviations, product.deviations_text); });
  if (done && product.document.nc) done = add(o.nc_out, product.program_text);
  if (done && o.json) done = print(product.result_text);
  if (done) done = files.commit();
  return done;
}

std::vector<std::string> written_files(const LocateOptions& o, const Product& product) {
  std::vector<std::string> files;
  for (const std::string& path :
       {o.output, o.certificate, o.picture, o.report, o.allowances, o.drawing, o.deviations}) {
    if (!path.empty()) files.push_back(path);
  }
  if (product.document.nc) files.push_back(o.nc_out);
  return files;
}

/// Outlines that are not convex keep to the reader of convex contours, and its words, where something is
/// asked for that only convex contours have.
bool takes_regions(const LocateOptions& o, const Files& files) {
  const Need part = need_of(files.part, o.part, o.of_part()),
             blank = need_of(files.blank, o.blank, o.of_blank());
  if (o.mirror != locate::Mirror::no || has_demands(o) || part == Need::regions || blank == Need::regions)
    return true;
  return !needs_convex(o) && (part == Need::outline || blank == Need::outline);
}

}  // namespace

Result<int> run_locate(const LocateOptions& o) {
  if (Result<void> fine = check_paths(o); !fine) return tl::unexpected(fine.error());
  Result<Files> files = read_files(o);
  if (!files) return tl::unexpected(files.error());
  if (takes_regions(o, *files)) return run_locate_regions(o, files->part, files->blank);
  const Result<Inputs> in = read_inputs(o, std::move(*files));
  if (!in) return tl::unexpected(in.error());
  Result<Solution> found = solve(in->part, in->blank, o);
  if (!found) return tl::unexpected(found.error());
  *found = claim_what_just_fits(o, *in, std::move(*found));

  Product product;
  product.document = begin_document(o, *in, *found);
  add_certificate(o, *found, product);
  add_comparison(*in, product);
  add_deviations(o, *in, product);
  if (Result<void> fine = add_program(o, *in, product); !fine) return tl::unexpected(fine.error());
  if (Result<void> fine = add_picture(o, *in, *found, product); !fine) return tl::unexpected(fine.error());
  Result<ReportFiles> reports = make_reports(o, product.document, in->part, in->blank);
  if (!reports) return tl::unexpected(reports.error());
  product.reports = std::move(*reports);
  product.result_text = io::result_json(product.document);

  if (Result<void> fine = self_check(o, *in, *found, product); !fine) return tl::unexpected(fine.error());
  if (Result<void> fine = write_all(o, product); !fine) return tl::unexpected(fine.error());
  tell(locate_summary(product.document, written_files(o, product)));
  return product.document.shortfall > 0 || product.program_withheld ? 1 : 0;
}

}  // namespace lekalo::cli
