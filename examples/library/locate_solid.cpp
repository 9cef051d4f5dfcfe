// Places a solid part in a solid blank (STL, OBJ, PLY) and says what is proved; the result is what `lekalo
// verify` reads:
//   locate_solid PART BLANK RESULT.json
#include <fstream>
#include <iostream>

#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/locate_solid.hpp"

namespace {

lekalo::Result<lekalo::jobs::LocatedSolid> placed(const std::string& part, const std::string& blank) {
  lekalo::jobs::SolidLocateJob job;
  LEKALO_TRY(const std::string part_bytes, lekalo::disk::read_file(part));
  LEKALO_TRY(const std::string blank_bytes, lekalo::disk::read_file(blank));
  job.part = {part, part_bytes}, job.blank = {blank, blank_bytes};
  job.options.gap = 0.05;  // mm
  return lekalo::jobs::locate_solid(job);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: locate_solid PART BLANK RESULT.json\n";
    return 2;
  }
  const auto made = placed(argv[1], argv[2]);
  if (!made) {
    std::cerr << made.error().message << '\n';
    return lekalo::exit_status(made.error().code);
  }
  const auto& found = made->document;
  if (found.inside()) std::cout << "clearance " << *found.clearance << " mm, and ";
  std::cout << "no placement has more than " << *found.upper_bound << " mm\n";
  std::ofstream(argv[3], std::ios::binary) << made->result;
  return made->holds() ? 0 : 1;
}
