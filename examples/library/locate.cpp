// Places a part in a blank and says what is proved; the result is what `lekalo verify` reads:
//   locate PART BLANK RESULT.json
#include <fstream>
#include <iostream>

#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/locate.hpp"

namespace {

lekalo::Result<lekalo::jobs::Located> placed(const std::string& part, const std::string& blank) {
  lekalo::jobs::LocateJob job;
  LEKALO_TRY(const std::string part_bytes, lekalo::disk::read_file(part));
  LEKALO_TRY(const std::string blank_bytes, lekalo::disk::read_file(blank));
  job.part = {part, part_bytes}, job.blank = {blank, blank_bytes};
  return lekalo::jobs::locate(job);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: locate PART BLANK RESULT.json\n";
    return 2;
  }
  const auto made = placed(argv[1], argv[2]);
  if (!made) {
    std::cerr << made.error().message << '\n';
    return lekalo::exit_status(made.error().code);
  }
  const auto& found = made->document;
  std::cout << "x " << found.placement.x << " mm, y " << found.placement.y << " mm, turned by "
            << found.placement.theta << " rad\nclearance " << found.placement.clearance
            << " mm, and no placement has more than " << *found.upper_bound << " mm\n";
  std::ofstream(argv[3], std::ios::binary) << made->result;
  return made->holds() ? 0 : 1;
}
