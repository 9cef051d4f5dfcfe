#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/limits.hpp"
#include "lekalo/jobs/bill.hpp"

namespace lekalo::jobs::jobs_bill_test {
namespace {

Result<io::OrderTable> built(const std::string& table, const std::vector<Build>& builds) {
  auto read = io::read_order(table, "b.csv");
  EXPECT_TRUE(read) << read.error().message;
  return ordered_rows(*std::move(read), "b.csv", builds, "--");
}

std::map<std::string, std::int64_t> pieces(const std::string& table, const std::vector<Build>& builds) {
  const auto order = built(table, builds);
  EXPECT_TRUE(order) << order.error().message;
  std::map<std::string, std::int64_t> all;
  if (!order) return all;
  for (const io::OrderRow& row : order->rows)
    EXPECT_TRUE(all.emplace(row.file, row.quantity).second) << row.file << " stands twice";
  return all;
}

/// The sentence with which a bill is refused, after its code.
std::string refusal(const std::string& table, const std::vector<Build>& builds) {
  const auto order = built(table, builds);
  EXPECT_FALSE(order) << table;
  if (order) return "";
  return (order.error().code == ErrorCode::usage ? "usage: " : "input: ") + order.error().message;
}

const std::string kBookcase =
    "assembly,file,quantity\n"
    "bookcase,frame,1\n"
    "bookcase,shelf set,2\n"
    "bookcase,screw.svg,4\n"
    "frame,side.svg,2\n"
    "frame,brace,3\n"
    "brace,screw.svg,5\n"
    "brace,a.svg,\n"
    "shelf set,a.svg,3\n"
    "shelf set,brace,1\n";

/// Ten bookcases have 10 frames and 20 shelf sets, so 10 * 3 + 20 = 50 braces; that makes 20 sides,
/// 10 * 4 + 50 * 5 = 290 screws and 50 + 20 * 3 = 110 pieces of a.
TEST(JobsBill, ThreeLevelsAreMultipliedOut) {
  EXPECT_EQ(pieces(kBookcase, {{"bookcase", 10}}),
            (std::map<std::string, std::int64_t>{{"side.svg", 20}, {"screw.svg", 290}, {"a.svg", 110}}));
  // One frame has 3 braces; with two loose ones that is 25 screws.
  EXPECT_EQ(pieces(kBookcase, {{"frame", 1}, {"brace", 2}}),
            (std::map<std::string, std::int64_t>{{"side.svg", 2}, {"screw.svg", 25}, {"a.svg", 5}}));
  EXPECT_EQ(pieces(kBookcase, {{"brace", 1}, {"brace", 1}}),
            (std::map<std::string, std::int64_t>{{"screw.svg", 10}, {"a.svg", 2}}));
}

TEST(JobsBill, PartsThatDifferInAWordStandForThemselves) {
  const auto order = built(
      "assembly;file;quantity;material;label\n"
      "desk;a.svg;2;birch;\n"
      "desk;a.svg;3;birch;\n"
      "desk;a.svg;4;steel;\n"
      "desk;a.svg;5;birch;left\n",
      {{"desk", 2}});
  ASSERT_TRUE(order) << order.error().message;
  ASSERT_EQ(order->rows.size(), 3u);
  EXPECT_EQ(order->rows[0].quantity, 10);
  EXPECT_EQ(order->rows[0].said_in, "b.csv: line 2");
  EXPECT_EQ(order->rows[1].quantity, 8);
  EXPECT_EQ(order->rows[1].material.name, "steel");
  EXPECT_EQ(order->rows[2].quantity, 10);
  EXPECT_EQ(order->rows[2].purpose.label, "left");
}

TEST(JobsBill, WhatALineOfAnAssemblySaysBesidesIsTold) {
  const auto order = built("assembly,file,material\ndesk,drawer,birch\ndrawer,a.svg,steel\n", {{"desk", 1}});
  ASSERT_TRUE(order) << order.error().message;
  ASSERT_EQ(order->notices.size(), 1u);
  EXPECT_NE(order->notices[0].find("b.csv: line 2: 'drawer' is an assembly"), std::string::npos);
  EXPECT_TRUE(built(kBookcase, {{"frame", 1}})->notices.empty());
}

/// Twenty thousand levels, each with one of the next.
TEST(JobsBill, DepthHasNoLimit) {
  std::string table = "assembly,file,quantity\n";
  for (int i = 0; i < 20'000; ++i)
    table += "level " + std::to_string(i) + ",level " + std::to_string(i + 1) + ",1\n";
  table += "level 20000,a.svg,7\n";
  EXPECT_EQ(pieces(table, {{"level 0", 3}}), (std::map<std::string, std::int64_t>{{"a.svg", 21}}));
}

TEST(JobsBill, AsManyAsAPartMayBeWantedAndNoMore) {
  const std::string head = "assembly,file,quantity\nrow,plate,1000\nplate,a.svg,";
  EXPECT_EQ(pieces(head + "1000000\n", {{"row", 1}}).at("a.svg"), limits::kMostCount);
  EXPECT_EQ(refusal(head + "1000001\n", {{"row", 1}}),
            "input: b.csv: line 3: 1000 of 'plate', with 1000001 of 'a.svg' each, come to more than "
            "1000000000 pieces "
            "of it; build fewer");
  EXPECT_EQ(refusal(head + "1\n", {{"row", 1'000'000'000}}).substr(0, 27), "input: b.csv: line 2: 10000");
  EXPECT_NE(refusal("assembly,file,quantity\nrow,a.svg,600000000\nrow,a.svg,600000000\n", {{"row", 1}})
                .find("b.csv: line 3: 1 of 'row', with 600000000 of 'a.svg' each, come to more than"),
            std::string::npos)
      << "the sum over two rows";
  EXPECT_NE(
      refusal(head + "1\n", {{"row", 600'000'000}, {"row", 600'000'000}}).find("is to be built more than"),
      std::string::npos);
}

TEST(JobsBill, AnAssemblyIsNoPartOfItself) {
  const std::string head = "assembly,file,quantity\ndesk,frame,1\n";
  EXPECT_EQ(refusal(head + "frame,brace,2\nbrace,a.svg,1\nbrace,frame,1\n", {{"desk", 1}}),
            "input: b.csv: line 3: 'brace' is a part of itself ('brace' in 'frame', 'frame' in 'brace'); "
            "take one of "
            "these lines out");
  EXPECT_NE(
      refusal(head + "frame,frame,1\n", {{"desk", 1}}).find("b.csv: line 3: 'frame' is a part of itself"),
      std::string::npos);
  EXPECT_NE(
      refusal(head + "frame,a.svg,1\nleg,foot,1\nfoot,leg,1\n", {{"desk", 1}}).find("b.csv: line 4: 'foot'"),
      std::string::npos)
      << "wherever it is";
  std::string round = "assembly,file,quantity\n";
  for (int i = 0; i < 1000; ++i) round += std::to_string(i) + "," + std::to_string((i + 1) % 1000) + ",1\n";
  const std::string told = refusal(round, {{"0", 1}});
  EXPECT_NE(told.find("b.csv: line 2: '1' is a part of itself"), std::string::npos) << told;
  EXPECT_LT(told.size(), 300u);
}

TEST(JobsBill, BillsAndBuildsBelongTogether) {
  EXPECT_EQ(
      refusal(kBookcase, {}),
      "usage: b.csv is a bill of materials, with the column assembly; say how many are built, as in --build "
      "cabinet=2; in no other assembly: 'bookcase'");
  EXPECT_EQ(refusal(kBookcase, {{"bokcase", 1}}),
            "usage: --build: 'bokcase' is no assembly of b.csv, which has 'bookcase', 'frame', 'brace', "
            "'shelf set'");
  EXPECT_NE(refusal("file,quantity\na.svg,1\n", {{"desk", 1}}).find("--build: b.csv is no bill of materials"),
            std::string::npos);
  EXPECT_EQ(pieces("file,quantity\na.svg,4\n", {}).at("a.svg"), 4);
  const auto missing = io::read_order("assembly,file\n,a.svg\n", "b.csv");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("line 2: the assembly is missing"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_bill_test
