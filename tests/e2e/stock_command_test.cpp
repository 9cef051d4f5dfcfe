// `lekalo stock`, and `lekalo nest --stock`, as people use them: orders one after the other, at the same
// moment, killed, and everything that is told in one sentence.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <set>
#include <string>

#include "cli_run.hpp"
#include "support/schemas.hpp"

namespace lekalo::test::stock_command_test {
namespace {

std::string square_of(int side) {
  const std::string s = std::to_string(side);
  return "<svg xmlns='http://www.w3.org/2000/svg' width='" + s + "mm' height='" + s + "mm' viewBox='0 0 " +
         s + " " + s + "'><rect width='" + s + "' height='" + s + "'/></svg>";
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != text.npos; }

/// A shop with squares of 100 and 300 to cut, and two sheets of 1000 x 500 of steel.
class StockCommand : public testing::Test {
 protected:
  void SetUp() override {
    write_bytes(folder_ / "small.svg", square_of(100));
    write_bytes(folder_ / "large.svg", square_of(300));
    const Ran added = stock({"add", "shop", "--sheet", "1000x500=2@steel:2", "--remnant-min", "150x100"});
    ASSERT_EQ(added.status, 0) << added.err;
  }
  [[nodiscard]] Ran lekalo(const Words& words) const { return run(folder_.path(), words); }
  [[nodiscard]] Ran stock(const Words& words) const { return lekalo(Words{"stock"} + words); }
  [[nodiscard]] static Words nest_words(const std::string& part, const std::string& order) {
    return {"nest",         "--part", part + "@steel:2", "--stock", "shop",       "--gap", "5",
            "--work",       "1000",   "--rotations",     "0",       "--allocate", order,   "-o",
            order + ".json"};
  }
  [[nodiscard]] Ran nest(const std::string& part, const std::string& order) const {
    return lekalo(nest_words(part, order));
  }
  [[nodiscard]] Json book() const {
    const Ran ran = stock({"list", "shop", "--json"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.json();
  }
  void expect_true() const {
    const Ran ran = stock({"check", "shop"});
    EXPECT_EQ(ran.status, 0) << ran.out << ran.err;
  }
  TemporaryFolder folder_;
};

TEST_F(StockCommand, TheRemnantOfOneOrderIsCutForTheNext) {
  const Ran first = nest("large.svg=2", "A1");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(says(first.err, "order A1: allocated S1")) << first.err;
  const Ran cut = stock({"cut", "shop", "A1"});
  ASSERT_EQ(cut.status, 0) << cut.err;
  EXPECT_TRUE(says(cut.err, "R3")) << cut.err;
  const Ran next = nest("small.svg=2", "A2");
  ASSERT_EQ(next.status, 0) << next.err;
  EXPECT_TRUE(says(next.err, "order A2: allocated R3")) << next.err;
  // The layout names the piece, and what was checked is what was written.
  EXPECT_EQ(Json::parse(read_bytes(folder_ / "A2.json"))["placements"][0]["stock"], "R3");
  EXPECT_EQ(lekalo({"check", "A2.json"}).status, 0);
  EXPECT_EQ(stock({"cut", "shop", "A2"}).status, 0);
  expect_true();

  const Ran list = stock({"list", "shop", "--json", "--picture", "shop.svg"});
  ASSERT_EQ(list.status, 0) << list.err;
  write_bytes(folder_ / "shop.json", list.out);
  EXPECT_EQ(lekalo({"verify", "shop.json"}).status, 0);
  if (!cases::python_with_jsonschema().empty()) {
    EXPECT_EQ(cases::schema_verdicts("lekalo-stock-1.schema.json", {list.out}), Words{"ok"});
  }
  const std::string picture = read_bytes(folder_ / "shop.svg");
  EXPECT_TRUE(says(picture, "S2"));
  EXPECT_FALSE(says(picture, "density") || says(picture, "violation")) << picture;
  EXPECT_TRUE(says(stock({"list", "shop"}).out, "S2"));
}

TEST_F(StockCommand, NewTakesTheSameStockAndALayoutIsAllocatedByHand) {
  const Ran made =
      lekalo({"new", "--part", "large.svg=2", "--stock", "shop", "--gap", "5", "-o", "job.json"});
  ASSERT_EQ(made.status, 0) << made.err;
  ASSERT_EQ(lekalo({"nest", "job.json", "--work", "1000", "-o", "out.json"}).status, 0);
  const Ran allocated = stock({"take", "shop", "A1", "out.json"});
  ASSERT_EQ(allocated.status, 0) << allocated.err;
  EXPECT_EQ(book()["items"][0]["order"], "A1");
  EXPECT_EQ(stock({"cancel", "shop", "A1"}).status, 0);
  EXPECT_EQ(book()["items"][0]["state"], "free");
  expect_true();
}

TEST_F(StockCommand, ALayoutThatWasCorrectedByHandIsTheOneThatIsCut) {
  ASSERT_EQ(nest("small.svg", "A1").status, 0);
  const double before = Json::parse(read_bytes(folder_ / "A1.json"))["placements"][0]["x"];
  write_bytes(folder_ / "by", "lekalo-commands/1\nmove 1 by 400 0\n");
  ASSERT_EQ(lekalo({"edit", "A1.json", "--commands", "by", "-o", "moved.json"}).status, 0);
  ASSERT_EQ(stock({"cut", "shop", "A1", "moved.json"}).status, 0);
  const Json all = book();
  EXPECT_EQ(all["orders"][0]["layouts"][0]["layout"]["placements"][0]["x"], before + 400);
  expect_true();
}

TEST_F(StockCommand, OutlinesWithDefectsAreStockToo) {
  write_bytes(
      folder_ / "hide.json",
      R"({"format": "lekalo-layout/1", "units": "mm", "stocks": [{"id": "h", "kind": "hide", "count": 2,
 "outline": {"polygon": {"outer": [[0, 0], [900, 100], [700, 800], [100, 600]]}},
 "defects": [{"id": "hole", "severity": 2, "outline": {"polygon": {"outer": [[600, 500], [620, 500], [610, 520]]}}}]}]})");
  const Ran added =
      stock({"add", "hides", "--sheet", "hide.json@leather:2", "--cost", "80", "--remnant-min", "0.01m2"});
  ASSERT_EQ(added.status, 0) << added.err;
  Words words = nest_words("small.svg=2", "A1");
  words[2] = "small.svg=2@leather:2", words[4] = "hides";
  ASSERT_EQ(lekalo(words).status, 0);
  const Ran cut = stock({"cut", "hides", "A1"});
  ASSERT_EQ(cut.status, 0) << cut.err;
  const Json all = stock({"list", "hides", "--json"}).json();
  ASSERT_EQ(all["items"].size(), 3u);
  EXPECT_EQ(all["items"][2]["from"], "S1");
  EXPECT_EQ(all["items"][2]["stock"]["defects"][0]["id"], "hole");
  EXPECT_EQ(stock({"check", "hides"}).status, 0);
}

TEST_F(StockCommand, TwoOrdersAtTheSameMomentGetOtherSheets) {
  Program one(folder_.path(), nest_words("large.svg=2", "A1")),
      other(folder_.path(), nest_words("large.svg=2", "A2"));
  const Ran first = one.wait(), second = other.wait();
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(second.status, 0) << second.err;
  const Json all = book();
  EXPECT_EQ((std::set<std::string>{all["items"][0]["order"], all["items"][1]["order"]}),
            (std::set<std::string>{"A1", "A2"}));
  expect_true();
}

TEST_F(StockCommand, ForTheLastPieceOneOrderGetsItAndTheOtherOneSentence) {
  ASSERT_EQ(nest("large.svg=2", "A0").status, 0);
  Program one(folder_.path(), nest_words("large.svg=2", "A1")),
      other(folder_.path(), nest_words("large.svg=2", "A2"));
  const Ran first = one.wait(), second = other.wait();
  const Ran& refused = first.status == 0 ? second : first;
  EXPECT_EQ((first.status == 0 ? first : second).status, 0);
  EXPECT_EQ(refused.status, 3) << refused.err;
  EXPECT_TRUE(says(refused.err, "is allocated to order") || says(refused.err, "no piece in it is free"))
      << refused.err;
  EXPECT_EQ(fs::exists(folder_ / "A1.json") + fs::exists(folder_ / "A2.json"), 1);
  expect_true();
}

TEST_F(StockCommand, AnOrderThatIsKilledIsAllocatedWithItsLayoutOrNotAtAll) {
  for (int i = 0; i < 6; ++i) {
    const std::string order = "K" + std::to_string(i);
    Program program(folder_.path(), nest_words("small.svg", order));
    program.send_after_work(SIGKILL, 0.004 * i);
    (void)program.wait();
    expect_true();
    const Json now = book();
    for (const Json& one : now["orders"])
      if (one["id"] == order) {
        EXPECT_EQ(stock({"cancel", "shop", order}).status, 0);
      }
  }
  const Json left = book();
  for (const Json& item : left["items"]) EXPECT_EQ(item["state"], "free");
}

TEST_F(StockCommand, BadInputGetsOneSentenceAndChangesNothing) {
  ASSERT_EQ(nest("large.svg=2", "A1").status, 0);
  ASSERT_EQ(nest("large.svg=2", "A2").status, 0);
  ASSERT_EQ(stock({"cut", "shop", "A2"}).status, 0);
  write_bytes(folder_ / "text", "no database at all, but long enough that nobody takes it for an empty one");
  write_bytes(folder_ / "broken", read_bytes(folder_ / "shop").substr(0, 9000));
  write_bytes(folder_ / "strip.json", R"({"format": "lekalo-layout/1", "units": "mm",
 "stocks": [{"id": "felt", "kind": "strip", "height": 100}]})");
  ASSERT_EQ(lekalo({"new", "--part", "small.svg", "--sheet", "777x333", "-o", "empty.json"}).status, 0);
  ASSERT_EQ(lekalo({"nest", "empty.json", "--work", "1", "-o", "other.json"}).status, 0);
  const std::string before = read_bytes(folder_ / "shop");
  struct Case {
    Words words;
    int status;
    std::string said;
  };
  const std::vector<Case> bad{
      {{"stock", "list", "nowhere"}, 3, "there is no such stock file"},
      {{"stock", "list", "text"}, 3, "no stock file"},
      {{"stock", "check", "broken"}, 3, "damaged"},
      {{"stock", "list", "."}, 3, "a plain file"},
      {{"stock", "cut", "shop", "B9"}, 3, "there is no order 'B9'"},
      {{"stock", "cancel", "shop", "A2"}, 3, "what was cut does not come back"},
      {{"stock", "cut", "shop", "A2"}, 3, "was cut already"},
      {{"stock", "take", "shop", "A1", "A1.json"}, 3, "order A1 is allocated already"},
      {{"stock", "take", "shop", "A3", "A1.json"}, 3, "is allocated to order A1"},
      {{"stock", "take", "shop", "A3", "empty.json"}, 3, "nothing is placed"},
      {{"stock", "take", "shop", "A3", "other.json"}, 3, "no piece of this stock file"},
      {{"stock", "take", "shop", "A3", "gone.json"}, 3, "gone.json"},
      {{"stock", "add", "shop", "--remnant-min", "2000x100"}, 3, "large enough for a remnant of 2000x100 mm"},
      {{"stock", "add", "shop", "--sheet", "strip.json"}, 3, "is a strip"},
      {{"stock", "add", "shop", "--sheet", "gone.dxf"}, 3, "nor a file that is there"},
      {{"stock", "add", "shop", "--sheet", "100x100=100000"}, 3, "more than the 10000"},
      {{"stock", "add", "shop", "--remnant-min", "5kg"}, 2, "--remnant-min: \"5kg\""},
      {{"stock", "add", "shop", "--sheet", "100x100", "--cost", "-1"}, 2, "--cost"},
      {{"stock", "add", "shop"}, 2, "nothing is added"},
      {{"stock", "throw", "shop"}, 2, "is not one of add, list, take"},
      {{"stock", "cut", "shop"}, 2, "the id of the order is missing"},
      {{"stock", "take", "shop", "A3"}, 2, "the layout is missing"},
      {{"stock", "check", "shop", "A1"}, 2, "does not take \"A1\""},
      {{"stock", "list", "shop", "--cost", "5"}, 2, "are for lekalo stock add"},
      {{"nest", "--part", "small.svg@oak:9", "--stock", "shop"}, 3, "there is no sheet of oak, 9 mm"},
      {{"nest", "--part", "small.svg", "--stock", "shop", "--sheet", "9x9"}, 2, "--stock takes its sheets"},
      {{"nest", "--part", "small.svg", "--sheet", "900x900", "--allocate", "A4"},
       2,
       "--allocate says for which"}};
  for (const Case& one : bad) {
    const Ran ran = lekalo(one.words);
    std::string line;
    for (const std::string& word : one.words) line += word + ' ';
    EXPECT_EQ(ran.status, one.status) << line << ran.err;
    EXPECT_TRUE(says(ran.err, one.said)) << line << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << line << ran.err;
  }
  EXPECT_EQ(read_bytes(folder_ / "shop"), before);
}

}  // namespace
}  // namespace lekalo::test::stock_command_test
