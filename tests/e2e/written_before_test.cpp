#include <csignal>
#include <sstream>

#include "cli_run.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "server/store/store.hpp"

/// What lekalo 0.1 wrote (tests/corpus/data/written-0.1) is read, confirmed and opened as it was then.
namespace lekalo::test::written_before_test {
namespace {

/// A copy of the files of 0.1, which commands may write into.
class WrittenBefore : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy(fs::path(cases::source_dir()) / "tests/corpus/data/written-0.1", folder_.path(),
             fs::copy_options::recursive);
  }
  [[nodiscard]] std::string bytes(const std::string& name) const { return read_bytes(folder_ / name); }
  TemporaryFolder folder_;
};

struct Answer {
  int status = 0;
  Words words;
  std::string told;
};

/// The lines of answers.txt: exit status | command line | words on stderr.
std::vector<Answer> answers(const std::string& text) {
  std::vector<Answer> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t first = line.find(" | "), second = line.find(" | ", first + 1);
    std::istringstream command(line.substr(first + 3, second - first - 3));
    all.push_back(
        {std::stoi(line), {std::istream_iterator<std::string>(command), {}}, line.substr(second + 3)});
  }
  return all;
}

TEST_F(WrittenBefore, EveryFileGetsTheAnswerThatItGotThen) {
  const std::vector<Answer> then = answers(bytes("answers.txt"));
  ASSERT_GE(then.size(), 50U);
  for (const Answer& answer : then) {
    const Ran ran = run(folder_.path(), answer.words);
    const std::string asked = testing::PrintToString(answer.words);
    EXPECT_EQ(ran.status, answer.status) << asked << ran.err;
    EXPECT_NE(ran.err.find(answer.told), std::string::npos) << asked << " says\n"
                                                            << ran.err << "and not\n"
                                                            << answer.told;
  }
}

TEST_F(WrittenBefore, EveryResultIsRead) {
  int results = 0;
  for (const auto& [name, text] : folder_.files()) {
    if (text.find("\"name\": \"lekalo-locate\"") == std::string::npos) continue;
    ++results;
    const Json written = Json::parse(text);
    const Result<io::WrittenResult> read = io::read_result(text, name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->status, written["status"]) << name;
    EXPECT_EQ(read->method, written["method"]) << name;
    EXPECT_EQ(read->mirrored, written["mirrored"]) << name;
    EXPECT_EQ(read->placement.x, written["x"]) << name;
    EXPECT_EQ(read->placement.theta, written["theta"]) << name;
    EXPECT_EQ(read->placement.clearance, written["clearance"]) << name;
    EXPECT_EQ(read->certificate_file.has_value(), !written["certificate_file"].is_null()) << name;
    for (const Json& input : written["inputs"]) {
      const io::InputRecord* found = read->input(input["role"].get<std::string>());
      ASSERT_NE(found, nullptr) << name;
      EXPECT_EQ(found->file.path, input["path"]) << name;
    }
  }
  EXPECT_EQ(results, 24);
}

TEST_F(WrittenBefore, EveryLayoutIsReadAndWrittenAgainToTheSameBytes) {
  for (const std::string name : {"shoes-edited", "small-edited", "shoes-broken", "bags-nested",
                                 "begun-nested", "order-nested", "strip-nested"}) {
    const std::string text = bytes(name + ".json");
    const Result<io::LayoutFile> layout = io::read_layout(text, name);
    ASSERT_TRUE(layout) << layout.error().message;
    EXPECT_TRUE(layout->notices.empty()) << name << ": " << layout->notices.front();
    EXPECT_EQ(io::write_layout(layout->document), text) << name;
  }
}

TEST_F(WrittenBefore, ExportsAreReadBack) {
  const auto opened = [&](const std::string& name) {
    Result<io::LayoutFile> layout = disk::open_layout((folder_ / name).string());
    EXPECT_TRUE(layout) << layout.error().message;
    return layout ? std::move(layout->document) : layout::Document{};
  };
  EXPECT_EQ(opened("strip-placements.json").placements.size(), 7U);
  for (const std::string name : {"shoes-edited.dxf", "shoes-edited.svg"}) {
    const layout::Document drawn = opened(name);
    EXPECT_EQ(drawn.parts.size(), 10U) << name;
    EXPECT_EQ(drawn.stocks.size(), 1U) << name;
  }
  for (const bool dxf : {true, false}) {
    const std::string name = dxf ? "placed.dxf" : "placed.svg";
    const Result<io::Drawing> drawing =
        dxf ? io::parse_dxf(bytes(name), name) : io::parse_svg(bytes(name), name);
    ASSERT_TRUE(drawing) << drawing.error().message;
    for (const std::string layer : {"PART", "BLANK"}) {
      io::DrawingOptions only;
      only.take = {layer};
      const Result<io::DrawnRegions> regions = io::make_regions(*drawing, only);
      ASSERT_TRUE(regions) << regions.error().message;
      EXPECT_EQ(regions->regions.size(), 1U) << name << ' ' << layer;
    }
  }
}

TEST_F(WrittenBefore, TheStoreOpensWithItsHistory) {
  Result<server::Store> store = server::Store::open((folder_ / "store.sqlite").string());
  ASSERT_TRUE(store) << store.error().message;
  const auto list = store->list();
  ASSERT_TRUE(list);
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ((*list)[0].name, "second");
  EXPECT_EQ((*list)[1].name, "Derby shoes, size 42, on one hide");

  const auto history = store->history(1);
  ASSERT_TRUE(history) << history.error().message;
  std::string told;
  for (const server::HistoryEntry& entry : *history)
    told += entry.author + " " + server::name_of(entry.kind) + " " + std::to_string(entry.target) + " " +
            entry.text.substr(0, entry.text.find(" outline")) + (entry.undone ? " (undone)\n" : "\n");
  EXPECT_EQ(told,
            "anna command 0 move 1 by 0.5 0\n"
            "anna command 0 add-defect \"hide\" \"scar\" 2\n"
            "boris command 0 fit \"tongue\" \"hide\" 0\n"
            "anna undo 2 add-defect \"hide\" \"scar\" 2\n"
            "anna redo 2 add-defect \"hide\" \"scar\" 2\n"
            "boris command 0 lock 2 (undone)\n"
            "boris undo 6 lock 2\n"
            "anna command 0 grade-defect \"hide\" \"scar\" 5\n"
            "boris command 0 remove 3\n");
}

TEST_F(WrittenBefore, EveryStateOfTheStoreIsThereAgain) {
  Result<server::Store> store = server::Store::open((folder_ / "store.sqlite").string());
  ASSERT_TRUE(store) << store.error().message;
  std::vector<std::size_t> placements, defects;
  for (server::Revision revision = 0; revision <= 9; ++revision) {
    const Result<layout::Document> state = store->state_at(1, revision);
    ASSERT_TRUE(state) << state.error().message;
    placements.push_back(state->placements.size());
    defects.push_back(state->stocks[0].defects.size());
    EXPECT_EQ(state->placements[1].locked, revision == 6) << revision;
  }
  EXPECT_EQ(placements, (std::vector<std::size_t>{10, 10, 10, 11, 11, 11, 11, 11, 11, 10}));
  const std::size_t before = defects[0];
  EXPECT_EQ(defects, (std::vector<std::size_t>{before, before, before + 1, before + 1, before, before + 1,
                                               before + 1, before + 1, before + 1, before + 1}));
  // The first state is the file that the layout was made of.
  EXPECT_EQ(io::write_layout(*store->state_at(1, 0)), bytes("shoes-edited.json"));
  // The copy went back to where it began, and has its photograph.
  EXPECT_EQ(io::write_layout(*store->state_at(2, 2)), io::write_layout(*store->state_at(2, 0)));
  EXPECT_EQ(store->state_at(2, 1)->placements.size() + 1, store->state_at(2, 0)->placements.size());
  const auto photos = store->photos(2);
  ASSERT_TRUE(photos);
  ASSERT_EQ(photos->size(), 1U);
  EXPECT_EQ((*photos)[0].type, "image/png");
  EXPECT_EQ((*photos)[0].scale.mm[2], 200.5);
}

TEST_F(WrittenBefore, TheServerGoesOnWithTheLayoutOfAFileThatItKnows) {
  Program server(folder_.path(), {"serve", "shoes-edited.json", "--store", "store.sqlite", "--port", "0"});
  server.send_when_caught(SIGTERM);
  const Ran ran = server.wait();
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.out.find("?layout=1\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.err.find("was opened before"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace lekalo::test::written_before_test
