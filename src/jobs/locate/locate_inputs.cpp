#include "locate_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/locate/feature_file.hpp"

namespace lekalo::jobs {
namespace {

/// Angles in radians that hold the window in degrees for certain: the product is within 2^-51 of the exact
/// one.
locate::AngleWindow window_of(const LocateOptions& options) {
  if (options.window_from_deg == 0 && options.window_to_deg == 360) return {};
  constexpr double kBound = 0x1p-51;
  const double from = options.window_from_deg * kDegree;
  const double to = options.window_to_deg * kDegree;
  return {from - kBound * std::abs(from), to + kBound * std::abs(to)};
}

/// A measured outline has crossings that no blank has, and is off by what nobody has said yet.
constexpr const char* kLooksMeasured =
    "it looks like a scan: --uncertainty MM says how well it was measured, and then the blank is proved from "
    "it";

/// Names an option that only convex outlines can have and that the job asks for; nullptr if there is none.
const char* only_convex_has(const LocateJob& job) {
  if (job.options.method != LocateMethod::certified) return "--method ipopt or icp";
  if (job.options.trim) return "--trim";
  if (job.options.alternatives) return "--alternatives";
  if (!job.outputs.deviations.empty()) return "--deviations";
  if (job.earlier) return "--compare";
  return nullptr;
}

/// Says whether part and blank are the same bytes, read in the same way.
bool is_one_file(const LocateJob& job) {
  const io::OutlineOptions &part = job.options.part, &blank = job.options.blank;
  return job.part.bytes == job.blank.bytes && part.units == blank.units && part.join == blank.join &&
         part.curve == blank.curve && part.repair == blank.repair && part.strict == blank.strict &&
         part.layers == blank.layers && !part.scan && !blank.scan;
}

bool asks_for_regions(const LocateJob& job) {
  const LocateOptions& o = job.options;
  return o.mirror != locate::Mirror::no || o.locked.x || o.locked.y || job.features ||
         o.criterion.choose != nullptr || o.trade_off > 0;
}

Result<void> read_outlines(const LocateJob& job, LocateInputs& in) {
  // A part that is larger than it is meant to be lies in the blank all the more.
  io::OutlineOptions how = job.options.part;
  how.may_lack_holes = true;
  io::OutlineFile part(job.part.bytes, job.part.name, how);
  io::OutlineFile blank(job.blank.bytes, job.blank.name, job.options.blank);
  const char* const convex_thing = only_convex_has(job);
  const bool wanted = convex_thing != nullptr;
  if (!asks_for_regions(job) && part.is_convex(wanted) && blank.is_convex(wanted)) {
    LEKALO_TRY(in.part, part.as_convex());
    LEKALO_TRY(in.blank, blank.as_convex(job.options.trim));
    return {};
  }
  if (wanted)
    return failure(
        ErrorCode::usage,
        fmt::format("{} is for convex contours; the part or the blank here is of another shape, or "
                    "is placed with demands as one",
                    convex_thing));
  for (const auto& [file, to, name] :
       {std::tuple{&part, &in.part, &job.part.name}, {&blank, &in.blank, &job.blank.name}}) {
    auto read = file->as_regions();
    if (file == &blank && blank.looks_measured()) {
      if (!read)
        return failure(read.error().code, fmt::format("{}; {}", read.error().message, kLooksMeasured));
      read->notices.push_back(fmt::format("{} is taken as exact; {}", *name, kLooksMeasured));
    }
    LEKALO_TRY(*to, std::move(read));
    if (!to->open.empty())
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: the edge from ({:.6g}, {:.6g}) is said to be open; only pockets have open "
                      "edges, take the word out",
                      *name, to->open[0].from.x, to->open[0].from.y));
  }
  return {};
}

Result<void> read_earlier(const LocateJob& job, LocateInputs& in) {
  if (!job.earlier) return {};
  LEKALO_TRY(in.earlier, io::read_result(job.earlier->bytes, job.earlier->name));
  if (in.earlier->solid_pose)
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: this is a result for solids; an outline in the plane is compared with a "
                               "result for outlines",
                               job.earlier->name));
  const locate::Placement& pose = in.earlier->placement;
  if (std::abs(pose.theta) <= geom::kMaxAngle &&
      std::max(std::abs(pose.x), std::abs(pose.y)) <= limits::kLargestCoordinate)
    return {};
  return failure(ErrorCode::bad_input, fmt::format("{}: the pose ({}, {}) mm, {} rad is out of all measure",
                                                   job.earlier->name, pose.x, pose.y, pose.theta));
}

/// The numbers that a feature's edges have in the rest of the part.
Result<void> renumber(locate::Feature& feature, const io::RestOfPart& rest, const std::string& name) {
  std::vector<std::uint32_t> left;
  for (std::uint32_t k = 0; k < rest.edge_of.size(); ++k)
    if (rest.edge_of[k] && std::count(feature.edges.begin(), feature.edges.end(), *rest.edge_of[k]) > 0)
      left.push_back(k);
  feature.edges = std::move(left);
  if (!feature.edges.empty()) return {};
  return failure(ErrorCode::bad_input,
                 fmt::format("{}, feature \"{}\": all of it is ignored", name, feature.name));
}

/// Finds the features' edges, and takes off what is ignored.
Result<void> apply_features(const LocateJob& job, locate::Demands& demands, LocateInputs& in) {
  if (!job.features) return {};
  const std::string& name = job.features->name;
  LEKALO_TRY(const io::FeatureFile file,
             io::parse_features(job.features->bytes, name, job.options.part.units));
  if (file.minimum) demands.minimum = std::max(demands.minimum, *file.minimum);
  locate::Outline& part = in.part.outline;
  LEKALO_TRY(demands.features, io::find_features(file, part.regions, part.labels));
  if (file.ignored.empty()) return {};
  LEKALO_TRY(io::RestOfPart rest, io::without_ignored(file, part.regions));
  for (locate::Feature& feature : demands.features) LEKALO_CHECK(renumber(feature, rest, name));
  part.regions = std::move(rest.regions);
  part.tolerance += rest.tolerance;
  in.part_cut = true;
  return {};
}

}  // namespace

Result<LocateInputs> read_inputs(const LocateJob& job) {
  const LocateOptions& o = job.options;
  LocateInputs in;
  LEKALO_CHECK(read_outlines(job, in));
  LEKALO_CHECK(read_earlier(job, in));
  locate::Demands demands{{}, o.min_allowance, o.criterion, o.give_up, o.trade_off};
  LEKALO_CHECK(apply_features(job, demands, in));
  const bool plain = demands.features.empty() && demands.minimum == o.min_allowance && !in.part_cut &&
                     o.trade_off == 0 && o.criterion.choose == nullptr;
  in.problem = {std::move(in.part.outline),
                std::move(in.blank.outline),
                window_of(o),
                o.mirror,
                o.locked,
                {},
                is_one_file(job)};
  if (!plain) in.problem.demands = std::move(demands);
  return in;
}

}  // namespace lekalo::jobs
