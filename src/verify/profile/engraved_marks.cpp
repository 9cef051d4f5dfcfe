#include "engraved_marks.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lekalo::verify {
namespace {

/// Words of a program have three decimals of a millimetre or more, or four of an inch; arcs are rounded in
/// their ends and their centre, and those that are nearly lines are lines.
constexpr Likeness kEngraved{0.004, 0.004};

std::vector<const DrawnLine*> lines_to_engrave(const PlacedSheet& sheet) {
  std::vector<const DrawnLine*> lines;
  for (const PlacedSheet::Part& part : sheet.parts)
    for (const PlacedInside& inside : part.inside)
      if (inside.is_engraved)
        for (const DrawnLine& line : inside.lines) lines.push_back(&line);
  return lines;
}

}  // namespace

EngravedMarks::EngravedMarks(const PlacedSheet& sheet) : sheet_(sheet), marks_(lines_to_engrave(sheet)) {}

bool EngravedMarks::follows(const CutChain& chain) {
  if (!std::all_of(chain.edges.begin(), chain.edges.end(),
                   [&](const Stroke& edge) { return marks_.holds(edge, kEngraved); }))
    return false;
  chains_.push_back({"", chain.edges, false});
  return true;
}

std::string EngravedMarks::note() const {
  std::vector<const DrawnLine*> engraved;
  for (const DrawnLine& chain : chains_) engraved.push_back(&chain);
  const EdgeSet edges(engraved);
  std::size_t all = 0, done = 0;
  for (const PlacedSheet::Part& part : sheet_.parts)
    for (const PlacedInside& inside : part.inside) {
      ++all;
      const bool is_done = std::all_of(inside.lines.begin(), inside.lines.end(), [&](const DrawnLine& line) {
        return std::all_of(line.edges.begin(), line.edges.end(),
                           [&](const Stroke& edge) { return edges.holds(edge, kEngraved); });
      });
      if (is_done) ++done;
    }
  if (all == 0) return "";
  return fmt::format("{} of {} lines and texts on the parts are engraved all along, and nothing else", done,
                     all);
}

}  // namespace lekalo::verify
