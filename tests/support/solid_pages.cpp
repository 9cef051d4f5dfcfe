// Writes pages of placed solids into a folder, for the test of the page in a browser: solid_pages FOLDER.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/locate/solid_allowance.hpp"
#include "support/solid_cases.hpp"

namespace {

using namespace lekalo;

draw::SolidScene placed(const cases::SolidCase& one) {
  locate::SolidProblem problem;
  problem.part = one.part, problem.blank = one.blank;
  draw::SolidScene scene;
  scene.part_name = "part.stl", scene.blank_name = "casting.ply", scene.status = "unproved",
  scene.method = "climb";
  scene.placement = locate::place_solid(problem, {}).value();
  const locate::MeasuredPart measured =
      locate::measured_part(one.part, one.blank, locate::motion_of(scene.placement.pose), 5000);
  scene.part = measured.mesh, scene.allowances = measured.allowances, scene.blank = one.blank;
  return scene;
}

void write(const std::string& path, const draw::SolidScene& scene) {
  std::ofstream(path, std::ios::binary) << draw::solid_page(scene);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::puts("solid_pages FOLDER");
    return EXIT_FAILURE;
  }
  const std::string folder = std::string(words[1]) + "/";
  Random random(7);
  write(folder + "wavy.html", placed(cases::wavy_part(random)));
  draw::SolidScene cored = placed(cases::cored_block(random));
  cored.min_allowance = 2, cored.status = "infeasible", cored.unknown = {0, 1, 2, 3},
  cored.unknown_area = 120;
  cored.part_name = "<!--<script><b>\"&Корпус";
  cored.notes = {"</script><script>window.ran = 1</script>", "<img src=x onerror='window.ran = 2'>"};
  write(folder + "cored.html", cored);
  draw::SolidScene bare = cored;
  bare.allowances.clear(), bare.placement.contacts.clear(), bare.unknown.clear();
  write(folder + "bare.html", bare);
  return EXIT_SUCCESS;
}
