// Places a part given as a tree of primitives in a blank given as regions, and says what is proved:
//   place PART.json BLANK.json
#include <iostream>
#include <string>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/shape/shape_tree.hpp"
#include "lekalo/locate/region.hpp"

namespace {

/// The true outline of a region file lies within this many times its error of one coordinate.
constexpr double kOutlinePerCoordinate = 2;

lekalo::Result<lekalo::locate::RegionProblem> read_problem(const std::string& part_path,
                                                           const std::string& blank_path) {
  const auto part_bytes = lekalo::disk::read_file(part_path);
  if (!part_bytes) return tl::unexpected(part_bytes.error());
  auto part = lekalo::io::parse_shape_tree(*part_bytes, part_path);
  if (!part) return tl::unexpected(part.error());
  const auto blank_bytes = lekalo::disk::read_file(blank_path);
  if (!blank_bytes) return tl::unexpected(blank_bytes.error());
  auto blank = lekalo::io::parse_regions(*blank_bytes, blank_path, {});
  if (!blank) return tl::unexpected(blank.error());

  lekalo::locate::RegionProblem problem;
  problem.part = std::move(part->regions);
  problem.blank = std::move(blank->regions);
  problem.part_tolerance = part->tolerance;
  problem.blank_tolerance = kOutlinePerCoordinate * blank->coordinate_error;
  return problem;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: place PART.json BLANK.json\n";
    return 2;
  }
  const auto found = read_problem(argv[1], argv[2]).and_then([](const auto& problem) {
    return lekalo::locate::locate_regions(problem, {});
  });
  if (!found) {
    std::cerr << found.error().message << '\n';
    return 3;
  }
  std::cout << "x " << found->best.x << " mm, y " << found->best.y << " mm, turned by " << found->best.theta
            << " rad\nclearance " << found->best.clearance << " mm, and no placement has more than "
            << found->upper_bound << " mm\n";
  return found->best.clearance >= 0 ? 0 : 1;
}
