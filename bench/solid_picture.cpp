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

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Returns what a function returns, and adds the time that it took.
template <class Function>
auto timed(double& seconds, const Function& function) {
  const double start = processor_seconds();
  auto result = function();
  seconds += processor_seconds() - start;
  return result;
}

void draw_all(const std::string& folder, const char* name, const cases::SolidCase& one, double demand) {
  locate::SolidProblem problem;
  problem.part = one.part, problem.blank = one.blank;
  draw::SolidReport report;
  draw::SolidScene& scene = report.scene;
  scene.part_name = fmt::format("{}.stl", name), scene.blank_name = fmt::format("{}-casting.stl", name);
  scene.placement = locate::place_solid(problem, {}).value();
  scene.status = "unproved", scene.method = "climb", scene.min_allowance = demand;
  double measuring = 0, picture = 0, page = 0, printing = 0;
  const locate::MeasuredPart measured = timed(measuring, [&] {
    return locate::measured_part(one.part, one.blank, locate::motion_of(scene.placement.pose), 40'000, 1);
  });
  scene.part = measured.mesh, scene.allowances = measured.allowances, scene.blank = one.blank;
  const std::string png = timed(picture, [&] { return draw::solid_png(scene, 1600, 1).value(); });
  const std::string html = timed(page, [&] { return draw::solid_page(scene); });
  const std::string pdf = timed(printing, [&] { return draw::solid_report_pdf(report, 1).value(); });
  const auto write = [&](const char* ending, const std::string& bytes) {
    std::ofstream(folder + "/" + name + ending, std::ios::binary) << bytes;
  };
  write(".png", png), write(".html", html), write(".pdf", pdf);
  write("-report.png", draw::solid_report_png(report).value());
  fmt::print(
      "{}: {} and {} triangles: allowances {:.2f} s, PNG {:.2f} s ({} kB), page {:.2f} s ({} kB), report "
      "{:.2f} s "
      "({} kB)\n",
      name, scene.part.triangles.size(), scene.blank.triangles.size(), measuring, picture, png.size() / 1000,
      page, html.size() / 1000, printing, pdf.size() / 1000);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    fmt::print("bench_solid_picture FOLDER\n");
    return EXIT_FAILURE;
  }
  const std::string folder = words[1];
  Random random(7);
  draw_all(folder, "wavy", cases::wavy_part(random), 0);
  draw_all(folder, "cored", cases::cored_block(random), 0);
  draw_all(folder, "turned", cases::turned_part(random), 0);
  draw_all(folder, "missing", cases::cored_block(random), 1.5);
  draw_all(folder, "fine", cases::wavy_part(random, 157), 0);
  return EXIT_SUCCESS;
}
