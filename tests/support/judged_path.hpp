#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/verify/simulate.hpp"

/// A path of a 6 mm tool as a program, and what the independent checker finds in it.
namespace lekalo::mill {

struct JudgedPath {
  PocketPath path;
  verify::SimulateReport report;
  std::vector<std::size_t> move_of_line;
};

inline JudgedPath judged(const PocketPath& path, const std::string& pocket) {
  JudgedPath result{path, {}, {}};
  const std::string program = program_of(path, {}, &result.move_of_line);
  verify::SimulateOptions machining;
  machining.tool_diameter = 6;
  const auto report = verify::simulate({"p.ngc", program}, {"pocket.json", pocket}, machining);
  EXPECT_TRUE(report) << (report ? "" : report.error().message);
  if (report) result.report = *report;
  return result;
}

/// Of each move.
inline std::vector<std::vector<MoveLoad>> loads_of(const JudgedPath& of) {
  std::vector<std::vector<MoveLoad>> loads(of.path.moves.size());
  for (const verify::EngagementSample& s : of.report.samples)
    if (const std::size_t move = of.move_of_line[s.line - 1]; move != kNoMove)
      loads[move].push_back({s.length, s.engagement, s.left});
  return loads;
}

inline bool same(const PocketPath& a, const PocketPath& b) {
  return std::equal(a.moves.begin(), a.moves.end(), b.moves.begin(), b.moves.end(),
                    [](const PathMove& m, const PathMove& n) { return m.to == n.to && m.z == n.z; });
}

}  // namespace lekalo::mill
