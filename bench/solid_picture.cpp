// Pictures of placed solids, and the processor time that they take: bench_solid_picture FOLDER. Into the
// folder go the picture, the report and the page of each case; the last one has 100,000 triangles of part and
// blank.

#include <fmt/core.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/draw/solid_report.hpp"
#include "lekalo/locate/solid_allowance.hpp"
#include "support/solid_cases.hpp"

namespace {

using namespace lekalo;

/// The case as it is placed, with the allowance over the whole surface.
draw::SolidScene placed(const cases::SolidCase& one, double seconds_of_search) {
  locate::SolidProblem problem;
  problem.part = one.part, problem.blank = one.blank;
  locate::SolidOptions options;
  options.gap = 0.01;
  draw::SolidScene scene;
  scene.part_name = one.kind + "-part.stl", scene.blank_name = one.kind + "-casting.stl";
  if (seconds_of_search > 0) {
    const auto result = locate::locate_solid(problem, options);
    if (!result) std::exit(EXIT_FAILURE);
    scene.placement = result->best, scene.upper_bound = result->upper_bound;
    scene.status = result->status == locate::Status::optimal ? "optimal" : "stopped";
    scene.method = "certified";
  } else {
    const auto climbed = locate::place_solid(problem, options);
    if (!climbed) std::exit(EXIT_FAILURE);
    scene.placement = *climbed, scene.status = "unproved", scene.method = "climb";
  }
  const auto measured = locate::measured_part(one.part, one.blank, locate::motion_of(scene.placement.pose));
  scene.part = measured.mesh, scene.allowances = measured.allowances;
  scene.blank = one.blank;
  return scene;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void draw_all(const std::string& stem, const draw::SolidScene& scene) {
  const double start = processor_seconds();
  const auto png = draw::solid_png(scene, 1600, 1);
  const double taken = processor_seconds() - start;
  if (!png) std::exit(EXIT_FAILURE);
  write(stem + ".png", *png);
  write(stem + ".html", draw::solid_page(scene));
  draw::SolidReport report;
  report.scene = scene, report.shift = 5, report.turn_deg = 5,
  report.certificate_boxes = scene.upper_bound ? 133 : 0;
  report.inputs = {{"part", {scene.part_name, std::string(64, 'a')}, "mm"},
                   {"blank", {scene.blank_name, std::string(64, 'b')}, "mm"}};
  report.assumptions = {"The blank is taken as drawn: its file states no uncertainty."};
  if (const auto page = draw::solid_report_png(report)) write(stem + "-report.png", *page);
  write(stem + "-report.svg", draw::solid_report_svg(report));
  fmt::print("{}: {} and {} triangles, PNG {:.2f} s, {} kB\n", stem, scene.part.triangles.size(),
             scene.blank.triangles.size(), taken, png->size() / 1000);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    fmt::print("bench_solid_picture FOLDER\n");
    return EXIT_FAILURE;
  }
  const std::string folder = std::string(words[1]) + "/";
  Random random(7);
  draw_all(folder + "wavy", placed(cases::wavy_part(random), 1));
  draw_all(folder + "cored", placed(cases::cored_block(random), 1));
  draw_all(folder + "turned", placed(cases::turned_part(random), 0));
  draw::SolidScene thick = placed(cases::cored_block(random), 0);
  thick.min_allowance = 1.5, thick.status = "infeasible";
  for (std::uint32_t k = 0; k < 40; ++k) thick.unknown.push_back(k);
  draw_all(folder + "missing", thick);
  draw_all(folder + "fine", placed(cases::wavy_part(random, 157), 0));
  return EXIT_SUCCESS;
}
