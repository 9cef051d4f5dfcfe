// Writes where, when and how much a program heats a workpiece, for the test that holds `lekalo heat` against
// CalculiX: heat_cuts PROGRAM POCKET STOCK TOOL TEETH RPM MATERIAL WEAR, JSON on stdout. It is the source of
// heat alone: the work of each contact, and the way of the tool.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "lekalo/disk/files.hpp"
#include "lekalo/heat/material.hpp"
#include "lekalo/jobs/heat_source.hpp"

namespace {

using namespace lekalo;

Result<std::string> cuts(char** words) {
  jobs::HeatSourceJob job;
  LEKALO_TRY(job.program.bytes, disk::read_file(words[1]));
  LEKALO_TRY(job.pocket.bytes, disk::read_file(words[2]));
  job.program.name = words[1], job.pocket.name = words[2];
  job.stock.block = heat::read_stock(words[3]);
  job.machining.tool_diameter = std::strtod(words[4], nullptr);
  job.cutting.teeth = std::atoi(words[5]);
  job.cutting.spindle_rpm = std::strtod(words[6], nullptr);
  heat::MaterialWords material{words[7], {}};
  material.stated[static_cast<std::size_t>(heat::Property::share)] = heat::Interval{1, 1};
  LEKALO_TRY(const heat::Material figures, heat::material_of(material));
  job.cutting.cutting_force = figures[heat::Property::cutting_force];
  job.cutting.force_exponent = figures[heat::Property::force_exponent];
  job.cutting.share = {1, 1};
  const double wear = std::strtod(words[8], nullptr);
  job.cutting.wear = {wear, wear};
  LEKALO_TRY(const jobs::HeatSource source, jobs::heat_source(job));

  const auto place = [](const std::array<double, 3>& p) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p[0], p[1], p[2]);
  };
  const heat::StockBox& box = source.stock.box;
  std::string text = fmt::format("{{\"low\": [{:.17g}, {:.17g}, {:.17g}], \"high\": [{:.17g}, {:.17g}, 0],\n",
                                 box.low_x, box.low_y, -box.thickness, box.high_x, box.high_y);
  text += fmt::format("\"seconds\": {:.17g},\n\"pieces\": [", source.work.seconds);
  const char* comma = "\n";
  for (const heat::ToolPiece& p : source.pieces) {
    text += fmt::format("{}[{:.17g}, {:.17g}, {}, {}, {}]", comma, p.start, p.seconds, place(p.from),
                        place(p.to), p.line > 0 && !p.rapid);
    comma = ",\n";
  }
  text += "],\n\"cuts\": [";
  comma = "\n";
  for (const heat::CutStep& s : source.work.steps) {
    text += fmt::format("{}[{:.17g}, {:.17g}, {}, {}, {}, {:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}]",
                        comma, s.start, s.seconds, place(s.from), place(s.to), s.floor, s.low_z, s.high_z,
                        s.begin, s.end, s.work_j.middle());
    comma = ",\n";
  }
  return text + "]}\n";
}

}  // namespace

int main(int count, char** words) {
  if (count != 9) {
    std::puts("heat_cuts PROGRAM POCKET STOCK TOOL TEETH RPM MATERIAL WEAR");
    return EXIT_FAILURE;
  }
  const auto text = cuts(words);
  if (!text) {
    fmt::print(stderr, "{}\n", text.error().message);
    return EXIT_FAILURE;
  }
  fmt::print("{}", *text);
  return EXIT_SUCCESS;
}
