#include "solid_documents.hpp"

#include <fmt/core.h>

#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/draw/solid_report.hpp"
#include "lekalo/locate/solid_allowance.hpp"
#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::jobs {
namespace {

using solid::Vector;

/// One line for each corner of the part.
std::string allowances_csv(const SolidInputs& in, const io::SolidDocument& d) {
  const solid::TriangleTree blank(in.problem.blank);
  const solid::Motion motion = motion_of(d.pose);
  std::string text = "index,x_part,y_part,z_part,x_blank,y_blank,z_blank,allowance_mm,blank_triangle\n";
  std::optional<std::uint32_t> near;
  for (std::size_t k = 0; k < in.problem.part.vertices.size(); ++k) {
    ask();
    const Vector p = in.problem.part.vertices[k], q = motion(p);
    const solid::Nearest nearest = *blank.nearest(q, std::numeric_limits<double>::infinity(), near);
    near = nearest.triangle;
    const double inside =
                     d.scan ? blank.least_sum(q, in.problem.blank_widths, -1, -d.scan->widest) : nearest.low,
                 allowance = blank.holds(q) ? inside : -nearest.high;
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", k, p.x, p.y, p.z, q.x, q.y, q.z, allowance,
                        in.blank.numbers[nearest.triangle]);
  }
  return text;
}

/// Says which triangles of a surface lie in the rim of a finished face, by their middles.
std::vector<bool> in_rims(const SolidInputs& in, const solid::Mesh& surface) {
  std::vector<bool> made(surface.triangles.size());
  for (const locate::SolidNear& near : in.problem.nears) {
    if (!(near.rim > 0)) continue;
    solid::Mesh face{in.problem.part.vertices, {}};
    for (const std::uint32_t t : near.triangles) face.triangles.push_back(in.problem.part.triangles[t]);
    const solid::TriangleTree finished(face);
    for (std::size_t t = 0; t < made.size(); ++t) {
      const auto& [a, b, c] = surface.triangles[t];
      const Vector middle = 1.0 / 3 * (surface.vertices[a] + surface.vertices[b] + surface.vertices[c]);
      made[t] = made[t] || finished.nearest(middle, near.rim).has_value();
    }
  }
  return made;
}

/// Gives each vertex what is left over the demand of its triangles instead of its allowance, and no number
/// where they are as cast, finished, or in a rim. A vertex of triangles with several demands stands once for
/// each.
void count_from_demands(const SolidInputs& in, const std::vector<std::uint32_t>& numbers,
                        draw::SolidScene& scene) {
  std::map<std::tuple<std::uint32_t, double, double>, std::uint32_t> known;
  solid::Mesh split;
  std::vector<double> left;
  const std::vector<bool> of_rim = in_rims(in, scene.part);
  for (std::size_t t = 0; t < scene.part.triangles.size(); ++t) {
    std::optional<locate::SolidDemand> demand = in.problem.demands[numbers[t]];
    if (of_rim[t]) demand.reset();
    const auto [minimum, scale] = demand.value_or(locate::SolidDemand{0, 0});
    solid::Triangle corners = scene.part.triangles[t];
    for (std::uint32_t& v : corners) {
      const auto [at, added] =
          known.try_emplace({v, minimum, scale}, static_cast<std::uint32_t>(split.vertices.size()));
      if (added) {
        split.vertices.push_back(scene.part.vertices[v]);
        left.push_back(demand ? (scene.allowances[v] - minimum) / scale
                              : std::numeric_limits<double>::quiet_NaN());
      }
      v = at->second;
    }
    split.triangles.push_back(corners);
  }
  scene.part = std::move(split), scene.allowances = std::move(left);
}

/// All measured points but for those that are left out, or all corners of the blank, with their numbers in
/// the file of points or in the order in which the blank's file first names them.
std::string deviations_of(const SolidInputs& in, const io::SolidDocument& d, SolidPointsForm form) {
  const std::vector<Vector>& points = in.meshed ? in.points : in.problem.blank.vertices;
  const std::vector<double> deviations =
      locate::deviations_from(in.problem.part, motion_of(d.pose), points, d.threads);
  if (form == SolidPointsForm::ply) return draw::solid_points(points, deviations);
  std::string text = "index,x,y,z,deviation\n";
  std::size_t index = 0, left_out = 0;
  for (std::size_t k = 0; k < points.size(); ++k, ++index) {
    ask();
    while (d.scan && left_out < d.scan->left_out.size() && d.scan->left_out[left_out] == index)
      ++left_out, ++index;
    text += fmt::format("{},{},{},{},{}\n", index, points[k].x, points[k].y, points[k].z, deviations[k]);
  }
  return text;
}

draw::SolidScene scene_of(const SolidLocateJob& job, const SolidInputs& in, const io::SolidDocument& d) {
  locate::MeasuredPart part = locate::measured_part(in.problem.part, in.problem.blank, motion_of(d.pose),
                                                    40'000, d.threads, in.problem.blank_widths);
  draw::SolidScene scene;
  scene.part_name = job.part.name, scene.blank_name = job.blank.name;
  scene.status = d.status, scene.method = d.method;
  scene.part = std::move(part.mesh), scene.allowances = std::move(part.allowances);
  scene.blank = in.problem.blank;
  scene.placement = {d.pose, d.inside(), d.clearance.value_or(0), d.contacts, d.work};
  scene.unknown = in.unknown;
  scene.unknown_area = d.scan ? d.scan->unknown_area : 0;
  scene.upper_bound = d.upper_bound;
  if (d.demands) {
    scene.margin = {d.demands->margin, d.demands->margin_bound,
                    !d.demands->datums.empty() || !in.problem.nears.empty()};
    count_from_demands(in, part.numbers, scene);
  }
  scene.min_allowance = d.min_allowance, scene.shortfall = d.shortfall().value_or(0);
  return scene;
}

Result<std::string> picture_of(const draw::SolidScene& scene, SolidPictureForm form, unsigned threads) {
  if (form == SolidPictureForm::html) return draw::solid_page(scene);
  if (form == SolidPictureForm::ply) return draw::solid_surface(scene);
  return draw::solid_png(scene, 1600, threads);
}

Result<std::string> page_of(draw::SolidScene scene, const io::SolidDocument& d, PictureForm form) {
  draw::SolidReport report;
  report.scene = std::move(scene);
  report.freedom = d.freedom, report.shift = d.window.shift, report.turn_deg = d.window.turn_deg;
  report.farthest_turn_deg = d.window.farthest_turn_deg(d.freedom);
  for (const io::SolidInputRecord& input : d.inputs) {
    const bool points = input.role == "points";
    const std::string size =
        fmt::format("{} {}", points ? input.points : input.triangles, points ? "points" : "triangles");
    report.inputs.push_back(
        {input.role, input.file, input.unit ? fmt::format("{}, {}", size, io::name_of(*input.unit)) : ""});
  }
  const bool kept = d.certificate_file || !d.proof.trees.empty();
  report.certificate_boxes = kept ? d.certificate_boxes : 0, report.certificate_file = d.certificate_file;
  report.warnings = d.warnings, report.work = d.work;
  if (d.scan) {
    report.assumptions = d.scan->assumptions;
    if (d.scan->unknown_triangles > 0)
      report.assumptions.push_back(
          fmt::format("{} triangles of the scan are unknown, so nothing is proved of the blank",
                      d.scan->unknown_triangles));
  }
  if (form == PictureForm::pdf) return draw::solid_report_pdf(report, d.threads);
  if (form == PictureForm::png) return draw::solid_report_png(report, 1654, d.threads);
  return draw::solid_report_svg(report, d.threads);
}

}  // namespace

Result<void> add_pictures(const SolidLocateJob& job, const SolidInputs& in, LocatedSolid& made) {
  const SolidLocateOutputs& wanted = job.outputs;
  const io::SolidDocument& d = made.document;
  if (wanted.allowances) made.allowances = allowances_csv(in, d);
  if (wanted.deviations) made.deviations = deviations_of(in, d, *wanted.deviations);
  if (!wanted.picture && !wanted.report) return {};
  draw::SolidScene scene = scene_of(job, in, d);
  if (wanted.picture) {
    LEKALO_TRY(made.picture, picture_of(scene, *wanted.picture, d.threads));
  }
  if (wanted.report) {
    LEKALO_TRY(made.report, page_of(std::move(scene), d, *wanted.report));
  }
  return {};
}

}  // namespace lekalo::jobs
