#include "e2e/cli_run.hpp"
#include "support/layout_texts.hpp"
#include "support/places.hpp"

namespace lekalo::test::cli_nest_test {
namespace {

using cases::add_part;
using cases::outline_json;
using cases::rectangle;

Json order() {
  Json layout = cases::empty_layout();
  layout["stocks"][0]["outline"] = outline_json(rectangle(0, 0, 100, 100));
  add_part(layout, "square", outline_json(rectangle(0, 0, 30, 30)))["demand"] = 5;
  add_part(layout, "bar", outline_json(rectangle(0, 0, 60, 10)))["demand"] = 3;
  return layout;
}

TEST(CliNest, PlacesEverythingAndTheCheckAgrees) {
  const TemporaryFolder folder;
  write_bytes(folder / "order.json", order().dump());
  const Ran ran =
      run(folder.path(), {"nest", "order.json", "-o", "layout.json", "--work", "300000", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json report = ran.json();
  EXPECT_EQ(report["status"], "complete");
  EXPECT_TRUE(report["unplaced"].empty());
  EXPECT_EQ(report["stocks"].size(), 1u);
  EXPECT_GE(report["work"].get<std::uint64_t>(), 300000u);
  EXPECT_EQ(run(folder.path(), {"check", "layout.json"}).status, 0);
}

TEST(CliNest, TheSameBytesWithOneThreadAndTwo) {
  const TemporaryFolder folder;
  write_bytes(folder / "order.json", order().dump());
  for (const std::string threads : {"1", "2"})
    ASSERT_EQ(run(folder.path(), {"nest", "order.json", "-o", "layout" + threads + ".json", "--work",
                                  "900000", "--seed", "3", "--threads", threads})
                  .status,
              0);
  EXPECT_EQ(read_bytes(folder / "layout1.json"), read_bytes(folder / "layout2.json"));
}

TEST(CliNest, CtrlCKeepsTheBest) {
  const TemporaryFolder folder;
  write_bytes(folder / "order.json", order().dump());
  Program program(folder.path(), {"nest", "order.json", "-o", "layout.json", "--time", "600"});
  program.send_after_work(SIGINT, 0.5);
  EXPECT_EQ(program.wait().status, 0);
  EXPECT_EQ(run(folder.path(), {"check", "layout.json"}).status, 0);
}

TEST(CliNest, SaysWhatIsNotPlacedAndWhy) {
  const TemporaryFolder folder;
  Json layout = order();
  add_part(layout, "long", outline_json(rectangle(0, 0, 200, 5)))["demand"] = 2;
  write_bytes(folder / "order.json", layout.dump());
  const Ran ran = run(folder.path(), {"nest", "order.json", "--work", "1000", "--json"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  const Json unplaced = ran.json()["unplaced"];
  ASSERT_EQ(unplaced.size(), 1u);
  EXPECT_EQ(unplaced[0]["part"], "long");
  EXPECT_EQ(unplaced[0]["count"], 2);
  EXPECT_EQ(unplaced[0]["reason"], "too-large");
}

TEST(CliNest, LeavesAloneWhatCannotBeBetter) {
  const TemporaryFolder folder;
  Json best = order();
  best["parts"].erase(1);
  best["parts"][0]["demand"] = 2;  // squares of 30: no box from the corner that holds them is smaller
  for (int k = 0; k < 2; ++k)
    best["placements"].push_back(
        {{"id", k + 1}, {"part", "square"}, {"stock", "s"}, {"c", 1}, {"s", 0}, {"x", 30 * k}, {"y", 0}});
  best["next_id"] = 3;
  write_bytes(folder / "best.json", best.dump());
  ASSERT_EQ(run(folder.path(), {"nest", "best.json", "-o", "again.json", "--work", "100000"}).status, 0);
  EXPECT_EQ(Json::parse(read_bytes(folder / "again.json"))["placements"], best["placements"]);
}

TEST(CliNest, ImprovesWhatLiesThereAndKeepsItsIds) {
  const TemporaryFolder folder;
  write_bytes(folder / "order.json", order().dump());
  ASSERT_EQ(run(folder.path(), {"nest", "order.json", "-o", "whole.json", "--work", "1"}).status, 0);
  Json first = Json::parse(read_bytes(folder / "whole.json"));
  ASSERT_EQ(first["placements"].size(), 8u);
  for (int k = 0; k < 3; ++k) first["placements"].erase(first["placements"].size() - 1);
  write_bytes(folder / "first.json", first.dump());
  ASSERT_EQ(run(folder.path(),
                {"nest", "first.json", "-o", "second.json", "--work", "200000", "--stream", "now.json"})
                .status,
            0);
  const Json second = Json::parse(read_bytes(folder / "second.json"));
  ASSERT_EQ(second["placements"].size(), 8u);
  for (std::size_t i = 0; i < first["placements"].size(); ++i) {
    EXPECT_EQ(first["placements"][i]["id"], second["placements"][i]["id"]);
    EXPECT_EQ(first["placements"][i]["part"], second["placements"][i]["part"]);
  }
  EXPECT_EQ(read_bytes(folder / "now.json"), read_bytes(folder / "second.json")) << "the last one streamed";
  ASSERT_EQ(run(folder.path(), {"nest", "second.json", "--from-scratch", "-o", "fourth.json", "--work", "1"})
                .status,
            0);
  const Json fourth = Json::parse(read_bytes(folder / "fourth.json"));
  EXPECT_GT(fourth["placements"][0]["id"].get<int>(), second["placements"].back()["id"].get<int>())
      << "all are new";
}

TEST(CliNest, TheWorkOfAStoppedRunRepeatsIt) {
  const TemporaryFolder folder;
  // A strip may always be shorter. The time is enough for a first layout of all pieces under a sanitizer, too;
  // what comes after a time that is not is placed without counting.
  Json strip = order();
  strip["stocks"] = Json::array({{{"id", "s"}, {"kind", "strip"}, {"height", 100}}});
  write_bytes(folder / "order.json", strip.dump());
  const Ran ran = run(folder.path(), {"nest", "order.json", "-o", "a.json", "--time", "1", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  ASSERT_EQ(run(folder.path(), {"nest", "order.json", "-o", "b.json", "--threads", "1", "--work",
                                std::to_string(ran.json()["work"].get<std::uint64_t>())})
                .status,
            0);
  EXPECT_EQ(read_bytes(folder / "a.json"), read_bytes(folder / "b.json"));
}

TEST(CliNest, WrongWordsAreRefused) {
  const TemporaryFolder folder;
  write_bytes(folder / "order.json", order().dump());
  for (const Words& words : {Words{"--time", "nan"},
                             {"--time", "-1"},
                             {"--work", "0"},
                             {"--threads", "0"},
                             {"--angles", "361"},
                             {"--seed", "x"},
                             {"--stream", "order.json"},
                             {"-o", "order.json"}})
    EXPECT_EQ(run(folder.path(), Words{"nest", "order.json"} + words).status, 2) << words[1];
  write_bytes(folder / "empty.json", cases::empty_layout().dump());
  EXPECT_EQ(run(folder.path(), {"nest", "empty.json"}).status, 3);
}

}  // namespace
}  // namespace lekalo::test::cli_nest_test
