// What a stranger writes against the installed library: the lines of the README, and a contour read from
// text.
#undef NDEBUG
#include <cassert>
#include <iostream>

#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/jobs/locate.hpp"

namespace {

void as_in_the_readme() {
  const lekalo::jobs::File part{"part.csv", "0 0\n8 0\n8 8\n0 8\n"};
  const lekalo::jobs::File blank{"blank.csv", "10 10\n20 10\n20 20\n10 20\n"};
  const auto made = lekalo::jobs::locate({.part = part, .blank = blank});
  const auto& found = made->document;  // made->result is its bytes, confirmed by the independent checker
  assert(found.placement.clearance <= 1 && *found.upper_bound >= 1);  // the optimum is 1 mm
  assert(*found.upper_bound - found.placement.clearance <= 1e-9);     // and that is proved
}

}  // namespace

int main() {
  as_in_the_readme();
  const auto file =
      lekalo::io::parse_contour("0 0\n8 0\n8 8\n0 8\n", "part.csv", lekalo::LengthUnit::millimetre);
  assert(file.has_value());
  const auto contour = lekalo::io::make_convex(*file);
  assert(contour.has_value() && contour->polygon.size() == 4);
  std::cout << "found, compiled, linked, ran\n";
}
