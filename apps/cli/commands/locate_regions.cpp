#include "locate_regions.hpp"

#include <fmt/format.h>

#include <chrono>

#include "interrupt.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/draw/picture.hpp"
#include "lekalo/io/locate/feature_file.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/locate/demand.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/verify/verify.hpp"
#include "outputs.hpp"
#include "program.hpp"
#include "report.hpp"
#include "shapes.hpp"
#include "solve.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// Certificates of up to this many cells stand in the result itself.
constexpr std::size_t kInlineCells = 10'000;
constexpr double kRegionGap = 1e-3;  ///< mm
/// Work after which a search that does not close stops by itself: some minutes and some gigabytes.
constexpr std::uint64_t kRegionWork = 2'000'000;

struct Product {
  io::LocateDocument document;
  std::string result_text, certificate_text, program_text, picture_bytes;
  ReportFiles reports;
  bool program_withheld = false;
};

/// What convex contours alone can have.
Result<void> check_options(const LocateOptions& o) {
  const auto refuse = [](const char* option) {
    return failure(
        ErrorCode::usage,
        fmt::format(
            "{} is for convex contours; the part or the blank here is of another shape, or is placed with "
            "demands as one",
            option));
  };
  if (o.method != Method::certified) return refuse("--method ipopt or icp");
  if (o.trim) return refuse("--trim");
  if (o.alternatives) return refuse("--alternatives");
  if (!o.deviations.empty()) return refuse("--deviations");
  if (!o.compare.empty()) return refuse("--compare");
  return {};
}

/// What was read, with the features found in it.
struct Shapes {
  Shape part, blank;
  std::vector<locate::Feature> features;
  double minimum = 0;     ///< of edges without a feature, mm
  bool part_cut = false;  ///< something of the part is ignored
};

/// Finds the features' edges, and takes off what is ignored.
Result<void> apply_features(const LocateOptions& o, const std::string& bytes, Shapes& s) {
  s.minimum = o.min_allowance;
  if (o.features.empty()) return {};
  const Result<io::FeatureFile> file = io::parse_features(bytes, o.features, o.units);
  if (!file) return tl::unexpected(file.error());
  if (file->minimum) s.minimum = std::max(s.minimum, *file->minimum);
  Result<std::vector<locate::Feature>> features = io::find_features(*file, s.part.regions, s.part.labels);
  if (!features) return tl::unexpected(features.error());
  s.features = std::move(*features);
  if (file->ignored.empty()) return {};
  Result<io::RestOfPart> rest = io::without_ignored(*file, s.part.regions);
  if (!rest) return tl::unexpected(rest.error());
  for (locate::Feature& feature : s.features) {
    std::vector<std::uint32_t> left;
    for (std::uint32_t k = 0; k < rest->edge_of.size(); ++k)
      if (rest->edge_of[k] && std::count(feature.edges.begin(), feature.edges.end(), *rest->edge_of[k]) > 0)
        left.push_back(k);
    feature.edges = std::move(left);
    if (feature.edges.empty())
      return failure(ErrorCode::bad_input,
                     fmt::format("{}, feature \"{}\": all of it is ignored", o.features, feature.name));
  }
  s.part.regions = std::move(rest->regions);
  s.part.tolerance += rest->tolerance;
  s.part_cut = true;
  return {};
}

/// One of the two ways to place regions, and what the document needs of it.
struct Found {
  locate::Status status = locate::Status::stopped;
  locate::Placement best;
  bool mirrored = false;
  std::vector<locate::RegionTouch> contacts;
  std::vector<locate::CoverTree> certificate;
  geom::Point pivot;
  std::optional<double> upper_bound;
  double shortfall = 0;
  std::optional<io::DemandRecord> demands;
  std::uint64_t work = 0;
};

Found found_plainly(locate::RegionResult&& r) {
  return {r.status, r.best,        r.mirrored,  std::move(r.contacts), std::move(r.certificate),
          r.pivot,  r.upper_bound, r.shortfall, std::nullopt,          r.work};
}

Found found_with_demands(const locate::DemandProblem& problem, locate::DemandResult&& r) {
  io::DemandRecord record;
  record.minimum = problem.minimum, record.features = problem.features;
  record.criterion = problem.criterion, record.give_up = problem.give_up;
  record.margin = r.margin, record.margin_bound = r.margin_bound;
  record.margin_found = r.margin_found, record.margin_gap = r.margin_gap;
  record.largest = r.largest, record.deviation = r.deviation;
  record.second = std::move(r.second);
  if (record.second && record.second->proof) record.second->proof->grown.clear();
  record.curve = std::move(r.curve);
  record.grown_for = r.proof.grown_for, record.shift = r.proof.shift, record.bound = r.proof.bound;
  return {r.status,
          r.best,
          r.mirrored,
          std::move(r.contacts),
          std::move(r.proof.certificate),
          r.proof.pivot,
          std::nullopt,
          std::max(0.0, -r.margin),
          std::move(record),
          r.work};
}

Result<Found> solve_regions(const Shapes& s, const LocateOptions& o, double& seconds) {
  const StopRequests stop(o.seconds);
  ProgressLine line("searching");
  locate::RegionOptions options;
  options.gap = o.gap.value_or(kRegionGap);
  options.min_allowance = o.min_allowance;
  options.run.stop = stop.flag();
  options.run.progress = [&line](const Progress& progress) { line.show(progress); };
  options.run.work_limit = std::min(o.work, kRegionWork);
  const locate::RegionProblem shapes{s.part.regions,   s.blank.regions,   window_of(o), o.mirror,
                                     s.part.tolerance, s.blank.tolerance, o.locked,     {}};
  const auto start = std::chrono::steady_clock::now();
  const auto taken = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  if (s.features.empty() && !s.part_cut && o.criterion == locate::Criterion::smallest && o.trade_off == 0) {
    auto found = locate::locate_regions(shapes, options);
    seconds = taken();
    if (!found) return tl::unexpected(std::move(found.error()));
    return found_plainly(std::move(*found));
  }
  const locate::DemandProblem problem{shapes, s.features, s.minimum, o.criterion, o.give_up, o.trade_off};
  auto found = locate::locate_demands(problem, options);
  seconds = taken();
  if (!found) return tl::unexpected(std::move(found.error()));
  return found_with_demands(problem, std::move(*found));
}

io::LocateDocument document_of(const LocateOptions& o, const Shapes& s, Found&& found) {
  io::LocateDocument d;
  d.status = name_of(found.status);
  d.method = name_of(o.method);
  d.warnings = o.warnings;
  for (const Shape* shape : {&s.part, &s.blank})
    d.warnings.insert(d.warnings.end(), shape->notices.begin(), shape->notices.end());
  d.seed = o.seed;
  d.work = found.work;
  d.placement = found.best;
  d.upper_bound = found.upper_bound;
  d.min_allowance = o.min_allowance;
  d.shortfall = found.shortfall;
  d.window_from_deg = o.window_from_deg;
  d.window_to_deg = o.window_to_deg;
  d.regions = io::RegionRecord{
      s.part.regions, s.blank.regions, s.part.tolerance,          s.blank.tolerance,
      o.mirror,       found.mirrored,  std::move(found.contacts), std::move(found.certificate),
      found.pivot,    o.locked,        std::move(found.demands),  s.part_cut,
      s.blank.scan};
  return d;
}

std::size_t cells(const std::vector<locate::CoverTree>& trees) {
  std::size_t count = 0;
  for (const locate::CoverTree& tree : trees) count += tree.nodes.size() / 2 + 1;
  return count;
}

void add_certificate(const LocateOptions& o, Product& product) {
  io::LocateDocument& d = product.document;
  io::RegionRecord& r = *d.regions;
  locate::LargestProof* const largest =
      r.demands && r.demands->second && r.demands->second->proof ? &*r.demands->second->proof : nullptr;
  const std::size_t more = largest != nullptr ? cells(largest->certificate) : 0;
  d.certificate_intervals = cells(r.certificate) + more;
  if (o.certificate.empty() && d.certificate_intervals <= kInlineCells) return;
  product.certificate_text = io::cover_text(r);
  const std::size_t first = cells(r.certificate);
  if (largest != nullptr) largest->certificate.clear();
  if (o.certificate.empty() && first <= kInlineCells) {
    d.certificate_intervals = first;
    d.warnings.push_back(fmt::format(
        "the certificates have {} cells, more than the {} that go into a result, so that of largest "
        "allowances is not kept; --certificate FILE keeps it",
        first + more, kInlineCells));
    return;
  }
  r.certificate.clear();
  if (o.certificate.empty()) {
    d.warnings.push_back(
        fmt::format("the certificate has {} cells, more than the {} that go into a result, and is not kept; "
                    "--certificate FILE keeps it",
                    d.certificate_intervals, kInlineCells));
    return;
  }
  d.certificate_file = io::FileRecord{o.certificate, io::sha256(product.certificate_text)};
}

/// Puts the bytes about to be written before the independent checker, with the proof even where it is not
/// kept.
Result<void> self_check(const LocateOptions& o, const std::string& part_bytes, const std::string& blank_bytes,
                        const Product& product) {
  verify::LocateInputs inputs{
      {"result", product.result_text}, {o.part, part_bytes}, {o.blank, blank_bytes}, {}};
  std::string with_proof;
  if (!product.certificate_text.empty()) {
    inputs.certificate = {"certificate", product.certificate_text};
    if (!product.document.certificate_file) {
      io::LocateDocument document = product.document;
      document.certificate_file = io::FileRecord{"certificate", io::sha256(product.certificate_text)};
      with_proof = io::result_json(document);
      inputs.result.bytes = with_proof;
    }
  }
  const char* const ending = "; no file was written, and this is a mistake of lekalo worth reporting";
  const Result<verify::LocateReport> report = verify::verify_locate(inputs);
  if (!report) return failure(ErrorCode::refuted, "self-check: " + report.error().message + ending);
  if (report->verdict == verify::Verdict::confirmed) return {};
  return failure(ErrorCode::refuted,
                 "self-check refuted the result: " +
                     (report->findings.empty() ? "the proof is not complete" : report->findings.front()) +
                     ending);
}

Result<void> add_program(const LocateOptions& o, const std::string& nc_bytes, Product& product) {
  if (o.nc.empty()) return {};
  if (const auto& scan = product.document.regions->scan; scan && !scan->proved) {
    product.program_withheld = true;
    product.document.warnings.push_back(
        "no NC program was written, because stretches of the blank are unknown");
    return {};
  }
  if (product.document.regions->mirrored) {
    product.program_withheld = true;
    product.document.warnings.push_back(
        "no NC program was written, because the part lies mirrored and a program for it would have to be "
        "mirrored too");
    return {};
  }
  Result<RewrittenProgram> program = rewrite_for(o, nc_bytes, product.document);
  if (!program) return tl::unexpected(program.error());
  product.program_text = std::move(program->text);
  product.program_withheld = program->withheld;
  return {};
}

Result<void> add_picture(const LocateOptions& o, Product& product) {
  if (o.picture.empty()) return {};
  const io::LocateDocument& d = product.document;
  const io::RegionRecord& r = *d.regions;
  draw::RegionPicture picture;
  picture.part_name = io::as_utf8(o.part);
  picture.blank_name = io::as_utf8(o.blank);
  picture.status = d.status;
  picture.part = r.part;
  picture.blank = r.blank;
  picture.result = d.placement;
  picture.mirrored = r.mirrored;
  picture.upper_bound = d.upper_bound;
  if (r.demands) picture.margin = r.demands->margin, picture.margin_bound = r.demands->margin_bound;
  picture.min_allowance = d.min_allowance;
  picture.shortfall = d.shortfall;
  picture.contacts = r.contacts;
  if (o.picture.ends_with(".svg")) {
    product.picture_bytes = draw::picture_svg(picture);
    return {};
  }
  Result<std::string> png = draw::picture_png(picture);
  if (!png) return tl::unexpected(png.error());
  product.picture_bytes = std::move(*png);
  return {};
}

Result<void> write_all(const LocateOptions& o, const Product& product) {
  disk::AtomicFiles files;
  const auto add = [&files](const std::string& path, const std::string& bytes) -> Result<void> {
    if (path.empty() || bytes.empty()) return {};
    return files.add(path, bytes);
  };
  Result<void> done = add(o.output, product.result_text)
                          .and_then([&] { return add(o.certificate, product.certificate_text); })
                          .and_then([&] { return add(o.picture, product.picture_bytes); })
                          .and_then([&] { return add(o.report, product.reports.report); })
                          .and_then([&] { return add(o.allowances, product.reports.allowances); })
                          .and_then([&] { return add(o.drawing, product.reports.drawing); })
                          .and_then([&] { return add(o.nc_out, product.program_text); });
  if (done && o.json) done = print(product.result_text);
  if (done) done = files.commit();
  return done;
}

}  // namespace

Result<int> run_locate_regions(const LocateOptions& o, const std::string& part_bytes,
                               const std::string& blank_bytes) {
  if (Result<void> fine = check_options(o); !fine) return tl::unexpected(fine.error());
  Shapes shapes;
  for (const auto& [to, bytes, path, how] : {std::tuple{&shapes.part, &part_bytes, &o.part, o.of_part()},
                                             {&shapes.blank, &blank_bytes, &o.blank, o.of_blank()}}) {
    Result<Shape> shape = read_shape(*bytes, *path, how);
    if (!shape) return tl::unexpected(shape.error());
    if (!shape->open.empty())
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: the edge from ({:.6g}, {:.6g}) is said to be open; only pockets have open "
                      "edges, take the word out",
                      *path, shape->open[0].from.x, shape->open[0].from.y));
    *to = std::move(*shape);
  }
  const auto read_if_named = [](const std::string& path) {
    return path.empty() ? Result<std::string>(std::string()) : disk::read_file(path);
  };
  const Result<std::string> nc_bytes = read_if_named(o.nc), feature_bytes = read_if_named(o.features);
  for (const auto* bytes : {&nc_bytes, &feature_bytes})
    if (!*bytes) return tl::unexpected(bytes->error());
  if (Result<void> fine = apply_features(o, *feature_bytes, shapes); !fine)
    return tl::unexpected(fine.error());

  double seconds = 0;
  Result<Found> found = solve_regions(shapes, o, seconds);
  if (!found) return tl::unexpected(found.error());
  Product product;
  product.document = document_of(o, shapes, std::move(*found));
  product.document.seconds = seconds;
  product.document.inputs = {{"part", {o.part, io::sha256(part_bytes)}, std::nullopt, 0, {}},
                             {"blank", {o.blank, io::sha256(blank_bytes)}, std::nullopt, 0, {}}};
  if (!o.nc.empty())
    product.document.inputs.push_back({"nc", {o.nc, io::sha256(*nc_bytes)}, std::nullopt, 0, {}});
  if (!o.features.empty())
    product.document.inputs.push_back(
        {"features", {o.features, io::sha256(*feature_bytes)}, std::nullopt, 0, {}});
  add_certificate(o, product);
  if (Result<void> fine = add_program(o, *nc_bytes, product); !fine) return tl::unexpected(fine.error());
  if (Result<void> fine = add_picture(o, product); !fine) return tl::unexpected(fine.error());
  Result<ReportFiles> reports = make_reports(o, product.document);
  if (!reports) return tl::unexpected(reports.error());
  product.reports = std::move(*reports);
  product.result_text = io::result_json(product.document);
  if (Result<void> fine = self_check(o, part_bytes, blank_bytes, product); !fine)
    return tl::unexpected(fine.error());
  if (Result<void> fine = write_all(o, product); !fine) return tl::unexpected(fine.error());

  std::vector<std::string> written;
  for (const auto& [path, bytes] : {std::pair{&o.output, &product.result_text},
                                    {&o.certificate, &product.certificate_text},
                                    {&o.picture, &product.picture_bytes},
                                    {&o.report, &product.reports.report},
                                    {&o.allowances, &product.reports.allowances},
                                    {&o.drawing, &product.reports.drawing},
                                    {&o.nc_out, &product.program_text}})
    if (!path->empty() && !bytes->empty()) written.push_back(*path);
  tell(locate_summary(product.document, written));
  const bool known = !product.document.regions->scan || product.document.regions->scan->proved;
  return product.document.shortfall > 0 || product.program_withheld || !known ? 1 : 0;
}

}  // namespace lekalo::cli
