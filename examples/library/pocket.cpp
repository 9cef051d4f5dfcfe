// Writes the program that clears a pocket with a 6 mm tool, judged by the checker: pocket POCKET.json > FILE
#include <iostream>
#include <string>
#include <utility>

#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/pocket.hpp"

namespace {

lekalo::Result<lekalo::jobs::Pocketed> clear(const std::string& path) {
  lekalo::jobs::PocketJob job;
  job.pocket.name = path;
  LEKALO_TRY(job.pocket.bytes, lekalo::disk::read_file(path));
  job.options.path.tool_diameter = 6;
  job.options.path.depth = 4;
  job.options.path.step_down = 2;
  return lekalo::jobs::pocket(std::move(job));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: pocket POCKET.json\n";
    return 2;
  }
  const auto made = clear(argv[1]);
  if (!made) {
    std::cerr << made.error().message << '\n';
    return lekalo::exit_status(made.error().code);
  }
  std::cout << made->program;
  std::cerr << "cut: " << made->report.coverage_percent << " % of what the tool can reach, gouge "
            << made->report.gouge_mm << " mm\n";
}
