// Contacts of a certificate prove no more of a part that is grown, or has rims taken off, than is true.

#include "verify/locate/cover_tree.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lekalo::verify::verify_cover_tree_test {
namespace {

Shape square(double from, double to) {
  const std::string text = fmt::format(
      R"({{"outer": [{{"line": {{"from": [{0}, {0}], "to": [{1}, {0}]}}}}, {{"line": {{"from": [{1}, {0}], "to": [{1}, {1}]}}}}, )"
      R"({{"line": {{"from": [{1}, {1}], "to": [{0}, {1}]}}}}, {{"line": {{"from": [{0}, {1}], "to": [{0}, {0}]}}}}]}})",
      from, to);
  std::string complaint;
  Shape read = read_shape(*parse_json(text, "shape"), "shape", complaint);
  EXPECT_EQ(complaint, "");
  return read;
}

/// Says whether one contact proves the bound for a square of 10 that lies in the lower left corner of one of
/// 100.
bool proves(const std::string& contact, double bound, const std::vector<double>& growth) {
  const Shape part = square(0, 10), blank = square(0, 100);
  const Vec origin{just(0), just(0)};
  const CoverTree::Problem problem{part,      blank,     origin,    0,      bound, Decimal{},
                                   Decimal{}, Decimal{}, Decimal{}, growth, {}};
  std::vector<std::string> findings;
  std::string complaint;
  const std::string tree = fmt::format(
      R"({{"mirrored": false, "theta": [0, 0], "x": [0, 0], "y": [0, 0], "nodes": [{{"contacts": [{}]}}]}})",
      contact);
  CoverTree(problem, findings).check(*parse_json(tree, "tree"), "tree", complaint);
  EXPECT_EQ(complaint, "");
  return findings.empty();
}

TEST(CoverTree, AMinimumThatReachesOverTheEdgeBesideItIsMissing) {
  // The upper side grows by 15, over the lower one and 5 beyond it, so that 5 are missing there.
  const std::vector<double> growth{0, 0, 15, 0};
  EXPECT_TRUE(proves("[5, 5, 10, 5, -1000, 1000, 1]", -5 + 1e-9, growth));
  EXPECT_FALSE(proves("[5, 5, 10, 5, -1000, 1000, 1]", -5 - 1e-9, growth));
  EXPECT_FALSE(proves("[5, 5, 11, 5, -1000, 1000, 1]", -5.5, growth));
}

/// Its ball once counted as one of radius 0, and so as a point of the part.
TEST(CoverTree, APlaceThatIsInNoGrowthIsNoPointOfThePart) {
  EXPECT_FALSE(proves("[5, -500, 3, 5, -1000, 1000, 1]", -400, {0, 0, 15, 0}));
  EXPECT_FALSE(proves("[5, -500, 0, 5, -1000, 1000, 1]", -400, {0, 0, 15, 0}));
}

/// Where two rims of 1 mm meet in a corner, the material behind them is further from the corner than either
/// is wide, and the corner once counted as 1 mm off it.
TEST(CoverTree, TheMaterialBehindTwoRimsIsFurtherThanEitherIsWide) {
  const std::vector<double> rims{-1, -1, -1, -1};
  const std::string corner = "[0, 0, 0, -1000, -1000, 1414.2135623730950, 1]";
  EXPECT_FALSE(proves(corner, 1.2, rims));
  EXPECT_TRUE(proves(corner, 2.3, rims));
  const std::string behind = "[0.9999999999, 0.9999999999, 0, -1000, -1000, 1414.2135623730950, 1]";
  EXPECT_FALSE(proves(behind, 1.41421356, rims));
  EXPECT_TRUE(proves(behind, 1.41421357, rims));
}

}  // namespace
}  // namespace lekalo::verify::verify_cover_tree_test
