#include "server/room.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "lekalo/layout/check.hpp"
#include "server/network/outbox.hpp"
#include "support/json.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::server::serve_room_test {
namespace {

namespace fs = std::filesystem;
using cases::Json;

/// Squares of 10 at (20, 40) and (60, 40) on a sheet of 100; two clients.
class TwoClients : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lekalo-room-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    store_ = std::make_unique<Store>(Store::open((folder_ / "store.sqlite").string()).value());
    first_ = cases::two_squares();
    id_ = store_->create("test", first_).value();
    reopen();
  }
  void TearDown() override {
    room_.reset();
    store_.reset();
    fs::remove_all(folder_);
  }
  void reopen() {
    room_ = std::make_unique<Room>(*store_, id_, store_->load(id_).value());
    heard_.clear();
    hear(room_->join(1, "anna").value());
    hear(room_->join(2, "").value());
  }
  void hear(const Outbound& out) {
    for (const Outgoing& one : out) heard_.emplace_back(one.to, Json::parse(*one.text));
  }
  /// What a client hears of it.
  std::vector<Json> say(ClientNumber client, const ClientMessage& message) {
    const std::size_t before = heard_.size();
    hear(room_->handle(client, message));
    std::vector<Json> mine;
    for (std::size_t i = before; i < heard_.size(); ++i)
      if (heard_[i].first == client) mine.push_back(heard_[i].second);
    return mine;
  }
  std::vector<Json> command(ClientNumber client, const std::string& text,
                            layout::Mode mode = layout::Mode::strict) {
    return say(client, CommandMessage{7, mode, text, false});
  }
  fs::path folder_;
  std::unique_ptr<Store> store_;
  std::unique_ptr<Room> room_;
  LayoutId id_ = 0;
  layout::Document first_;
  std::vector<std::pair<ClientNumber, Json>> heard_;
};

TEST_F(TwoClients, WhatNobodyWaitsForIsNotDone) {
  const std::atomic<bool> gone = true;
  EXPECT_TRUE(
      room_->handle(1, CommandMessage{1, layout::Mode::strict, "move 1 by 1 0", false}, gone).empty());
  EXPECT_EQ(room_->revision(), 0);
  EXPECT_EQ(command(1, "move 1 by 1 0").front()["type"], "done");
}

TEST_F(TwoClients, GetTheLayoutWhenTheyComeIn) {
  EXPECT_EQ(heard_[0].second["type"], "layout");
  EXPECT_EQ(heard_[0].second["client"], 1);
  EXPECT_EQ(heard_[0].second["revision"], 0);
  EXPECT_EQ(heard_[0].second["document"]["placements"].size(), 2u);
}

TEST_F(TwoClients, BothHearOfAChangeTheSenderAfterItIsDone) {
  const auto heard = command(1, "move 1 by 1 0");
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0]["type"], "done");
  EXPECT_EQ(heard[0]["revision"], 1);
  EXPECT_EQ(heard[1]["type"], "change");
  EXPECT_EQ(heard[1]["placements"][0]["after"]["x"], 21);
  EXPECT_EQ(heard_.back().first, 2u);
  EXPECT_EQ(heard_.back().second, heard[1]);
  EXPECT_EQ(store_->load(id_)->document, room_->document());
}

TEST_F(TwoClients, AreRefusedWithViolationsInStrictModeAndNotInFreeMode) {
  const auto heard = command(1, "move 1 by 35 0");
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0]["type"], "refused");
  EXPECT_EQ(heard[0]["violations"][0]["kind"], "overlap");
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(command(1, "move 1 by 35 0", layout::Mode::free)[0]["type"], "done");
  EXPECT_EQ(command(1, "no such 3")[0]["type"], "refused");
  EXPECT_EQ(command(1, "move 99 by 1 1")[0]["type"], "refused");
}

TEST_F(TwoClients, APreviewChangesNothing) {
  const auto heard = say(1, CommandMessage{3, layout::Mode::free, "move 1 by 35 0", true});
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0]["type"], "preview");
  EXPECT_EQ(heard[0]["placements"][0]["after"]["x"], 55);
  EXPECT_EQ(heard[0]["violations"].size(), 1u);
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(room_->revision(), 0);
}

TEST_F(TwoClients, NothingMovedIsDoneWithoutARevision) {
  const auto heard = command(1, "move 1 by 0 0");
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0]["nothing"], true);
  EXPECT_EQ(heard[0]["revision"], 0);
}

TEST_F(TwoClients, UndoTheirOwnCommandsAlone) {
  command(1, "move 1 by 1 0");
  command(2, "move 2 by 1 0");
  command(1, "move 1 by 0 3");
  EXPECT_EQ(say(1, UndoMessage{1, false})[1]["kind"], "undo");
  EXPECT_EQ(say(1, UndoMessage{2, false})[0]["revision"], 5);
  EXPECT_EQ(room_->document().placements[0], first_.placements[0]);
  EXPECT_NE(room_->document().placements[1], first_.placements[1]);
  EXPECT_EQ(say(1, UndoMessage{3, false})[0]["type"], "refused");
  EXPECT_EQ(say(1, UndoMessage{4, true})[0]["type"], "done");
  EXPECT_EQ(say(1, UndoMessage{5, true})[1]["text"], "move 1 by 0 3");
  EXPECT_EQ(say(1, UndoMessage{6, true})[0]["type"], "refused");
}

TEST_F(TwoClients, AreRefusedToUndoWhatALaterCommandStandsOn) {
  command(1, "move 1 by 1 0");
  command(2, "move 1 by 0 5");
  auto heard = say(1, UndoMessage{1, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  const std::string why = heard[0]["message"].get<std::string>();
  EXPECT_NE(why.find("client 2"), std::string::npos) << why;
  EXPECT_NE(why.find("move 1 by 0 5"), std::string::npos) << why;
  EXPECT_EQ(say(2, UndoMessage{1, false})[0]["type"], "done");
  EXPECT_EQ(say(1, UndoMessage{2, false})[0]["type"], "done");
  EXPECT_EQ(room_->document(), first_);
}

TEST_F(TwoClients, AreRefusedToUndoIntoAPlaceThatAnotherTookSince) {
  command(1, "move 1 by 0 20");
  command(2, "move 2 by -35 0");  // where placement 1 was
  const auto heard = say(1, UndoMessage{1, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  EXPECT_NE(heard[0]["message"].get<std::string>().find("move 2 by -35 0"), std::string::npos);
}

TEST_F(TwoClients, NeverGiveTheNumberOfAPlacementAgain) {
  command(1, "place square sheet 0 1 0 0 0 upright");
  EXPECT_EQ(room_->document().placements.back().id, 3u);
  say(1, UndoMessage{1, false});
  command(2, "place square sheet 0 1 0 0 80 upright");
  EXPECT_EQ(room_->document().placements.back().id, 4u);
  EXPECT_EQ(say(1, UndoMessage{2, true})[0]["type"], "done");
  EXPECT_EQ(room_->document().placements.size(), 4u);
}

TEST_F(TwoClients, AnAuthorUndoesWhatWasDoneBeforeARestart) {
  command(1, "move 1 by 1 0");
  command(1, "move 1 by 1 0");
  say(1, UndoMessage{1, false});
  command(2, "move 2 by 1 0");
  reopen();
  EXPECT_EQ(say(1, UndoMessage{1, false})[0]["type"], "done");
  EXPECT_EQ(room_->document().placements[0], first_.placements[0]);
  EXPECT_EQ(say(1, UndoMessage{1, true})[0]["type"], "done");
  EXPECT_EQ(say(1, UndoMessage{1, true})[0]["type"], "done");
  EXPECT_EQ(say(2, UndoMessage{1, false})[0]["type"], "refused");  // nobody in particular
}

TEST_F(TwoClients, RestoreAnyRevisionAsANewOne) {
  command(1, "move 1 by 1 0");
  command(2, "remove 2");
  hear(room_->restore(0).value());
  EXPECT_EQ(room_->revision(), 3);
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(heard_.back().second["kind"], "restore");
  EXPECT_TRUE(room_->restore(3)->empty());
  EXPECT_FALSE(room_->restore(4));
  EXPECT_EQ(store_->load(id_)->document, first_);
}

TEST_F(TwoClients, SeeWhatTheOtherSelects) {
  hear(room_->handle(1, SelectMessage{{2, 2, 99}}));
  EXPECT_EQ(heard_.back().first, 2u);
  EXPECT_EQ(heard_.back().second["clients"], Json::parse(R"([{"client": 1, "ids": [2]}])"));
  EXPECT_TRUE(room_->handle(1, SelectMessage{{2}}).empty());
  hear(room_->leave(1));
  EXPECT_EQ(heard_.back().second["clients"], Json::array());
}

TEST_F(TwoClients, HearOfANewNameAndOfTheEnd) {
  hear(room_->rename("other").value());
  EXPECT_EQ(heard_.back().second["name"], "other");
  hear(room_->remove().value());
  EXPECT_EQ(heard_.back().second["type"], "bye");
  EXPECT_FALSE(room_->join(3, ""));
  EXPECT_TRUE(room_->empty());
}

TEST_F(TwoClients, WhatCannotBeStoredIsNotDone) {
  ASSERT_TRUE(store_->remove(id_));  // stands for any failure of the store
  const auto heard = command(1, "move 1 by 1 0");
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0]["type"], "refused");
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(room_->revision(), 0);
}

constexpr const char* kScar = "add-defect sheet scar 1 outline 22 42 24 42 24 44";

TEST_F(TwoClients, HearOfADefectAndWhatLiesOnIt) {
  const auto heard = command(1, kScar);
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0]["type"], "done");
  EXPECT_EQ(heard[0]["violations"][0]["kind"], "defect");
  EXPECT_EQ(heard[0]["violations"][0]["feature"], "scar");
  EXPECT_EQ(heard[1]["placements"], Json::array());
  const Json& feature = heard[1]["features"][0];
  EXPECT_EQ(feature["stock"], "sheet");
  EXPECT_EQ(feature["kind"], "defect");
  EXPECT_EQ(feature["id"], "scar");
  EXPECT_EQ(feature["index"], 0);
  EXPECT_EQ(feature["after"]["severity"], 1);
  EXPECT_EQ(feature["after"]["outline"]["polygon"]["outer"], Json::parse("[[22, 42], [24, 42], [24, 44]]"));
  EXPECT_EQ(heard_.back().second, heard[1]);
  EXPECT_EQ(store_->load(id_)->document, room_->document());
  EXPECT_EQ(command(2, "remove-defect sheet scar")[1]["features"][0]["after"], nullptr);
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(command(1, "add-defect sheet x 1 outline 0 0 4 4 4 0 0 4")[0]["type"], "refused");
  const auto preview = say(1, CommandMessage{3, layout::Mode::strict, kScar, true});
  ASSERT_EQ(preview.size(), 1u);
  EXPECT_EQ(preview[0]["features"].size(), 1u);
  EXPECT_EQ(preview[0]["violations"].size(), 1u);
  EXPECT_EQ(room_->document(), first_);
}

TEST_F(TwoClients, UndoDefectsUnlessALaterCommandStandsOnThem) {
  command(1, kScar);
  command(2, "grade-defect sheet scar 3");
  auto heard = say(1, UndoMessage{1, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  std::string why = heard[0]["message"].get<std::string>();
  EXPECT_NE(why.find("client 2 changed defect 'scar' by 'grade-defect"), std::string::npos) << why;
  EXPECT_EQ(say(2, UndoMessage{1, false})[1]["features"][0]["after"]["severity"], 1);
  EXPECT_EQ(say(1, UndoMessage{2, false})[0]["type"], "done");
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(say(1, UndoMessage{3, true})[0]["type"], "done");
  // A part that was put where the defect had been.
  command(1, "remove-defect sheet scar");
  command(2, "move 1 by 0.5 0");
  heard = say(1, UndoMessage{4, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  why = heard[0]["message"].get<std::string>();
  EXPECT_NE(why.find("move 1 by 0.5 0"), std::string::npos) << why;
  // A defect where the part had been.
  command(2, "move 2 by 0 20");
  command(1, "add-defect sheet spot 1 outline 62 42 64 42 64 44");
  heard = say(2, UndoMessage{1, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  why = heard[0]["message"].get<std::string>();
  EXPECT_NE(why.find("add-defect"), std::string::npos) << why;
}

TEST_F(TwoClients, FindWhoChangedADefectBeforeARestart) {
  command(1, kScar);
  command(2, "grade-defect sheet scar 3");
  reopen();
  const auto heard = say(1, UndoMessage{1, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  EXPECT_NE(heard[0]["message"].get<std::string>().find("grade-defect"), std::string::npos);
}

TEST_F(TwoClients, RestoreDefectsInTheirOrder) {
  command(1, kScar);
  command(2, "add-defect sheet other 1 outline 82 82 84 82 84 84");
  const layout::Document both = room_->document();
  command(1, "remove-defect sheet scar");
  command(1, kScar);  // now the second
  hear(room_->restore(2).value());
  EXPECT_EQ(room_->document(), both);
  EXPECT_EQ(store_->load(id_)->document, both);
  hear(room_->restore(0).value());
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(store_->load(id_)->document, first_);
}

TEST_F(TwoClients, AreToldOfLongCommandsInShort) {
  std::string line = "add-defect sheet scar 1 outline";
  for (int i = 0; i < 400; ++i) line += " " + std::to_string(i % 100) + " " + std::to_string(i / 100);
  std::string round = "reshape-defect sheet scar outline 80 80";
  for (int i = 1; i < 300; ++i)
    round += " " + std::to_string(80 + i * 0.01) + " " + std::to_string(80 + i * i * 0.0001);
  EXPECT_EQ(command(1, line)[0]["type"], "refused");
  EXPECT_EQ(command(1, kScar)[0]["type"], "done");
  EXPECT_EQ(command(2, round)[0]["type"], "done");
  const auto heard = say(1, UndoMessage{1, false});
  ASSERT_EQ(heard[0]["type"], "refused");
  EXPECT_LT(heard[0]["message"].get<std::string>().size(), 400u);
}

/// What a job found when it is run here, to its end.
Result<layout::Change> ran(const JobStart& start, std::vector<layout::Change>* improved = nullptr) {
  JobContext context;
  context.run.stop = start.stop.get();
  context.improved = [&](const layout::Change& change) {
    if (improved != nullptr) improved->push_back(change);
  };
  return start.job(start.document, context);
}

TEST_F(TwoClients, GoOnWhileALongCommandOfOneIsUnderWay) {
  EXPECT_TRUE(command(1, "compact sheet 0 towards 0 -1").empty());
  EXPECT_TRUE(room_->is_busy(1));
  EXPECT_FALSE(room_->is_busy(2));
  const std::vector<JobStart> jobs = room_->take_jobs();
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_TRUE(room_->take_jobs().empty());
  hear(room_->job_progress(jobs[0].number, 0.25, 3.0));
  EXPECT_EQ(heard_.back().second,
            Json::parse(R"({"type": "progress", "seq": 7, "fraction": 0.25, "seconds_left": 3.0})"));
  EXPECT_EQ(command(2, "place square sheet 0 1 0 0 80 upright")[0]["type"], "done");  // not in its way
  const auto before = heard_.size();
  hear(room_->job_ended(jobs[0].number, ran(jobs[0])));
  EXPECT_EQ(heard_[before].second["type"], "done");
  EXPECT_EQ(heard_[before].second["revision"], 2);
  EXPECT_EQ(heard_[before + 1].second["placements"].size(), 2u);
  EXPECT_FALSE(room_->is_busy(1));
  EXPECT_LT(room_->document().placements[0].at.y, 10);
  EXPECT_EQ(store_->load(id_)->document, room_->document());
  EXPECT_EQ(say(1, UndoMessage{8, false})[0]["type"], "done");
  EXPECT_EQ(room_->document().placements[0], first_.placements[0]);
}

TEST_F(TwoClients, ALongCommandBeginsAgainWhereOthersChangedWhatItMoves) {
  command(1, "compact sheet 0 towards 0 -1");
  for (int attempt = 1; attempt <= 3; ++attempt) {
    const std::vector<JobStart> jobs = room_->take_jobs();
    ASSERT_EQ(jobs.size(), 1u);
    const auto found = ran(jobs[0]);
    command(2, "move 2 by 0 1");
    const auto before = heard_.size();
    hear(room_->job_ended(jobs[0].number, found));
    if (attempt < 3) {
      EXPECT_EQ(heard_.size(), before);
    } else {
      EXPECT_EQ(heard_[before].second["type"], "refused");
    }
  }
  EXPECT_FALSE(room_->is_busy(1));
  EXPECT_EQ(room_->document().placements[0], first_.placements[0]);
}

TEST_F(TwoClients, TwoFitsAtOnceDoNotMeet) {
  command(1, "fit square sheet 0");
  command(2, "fit square sheet 0");
  std::vector<JobStart> jobs = room_->take_jobs();
  ASSERT_EQ(jobs.size(), 2u);
  const auto a = ran(jobs[0]), b = ran(jobs[1]);  // the same place
  hear(room_->job_ended(jobs[0].number, a));
  hear(room_->job_ended(jobs[1].number, b));
  EXPECT_EQ(room_->document().placements.size(), 3u);
  jobs = room_->take_jobs();
  ASSERT_EQ(jobs.size(), 1u);
  hear(room_->job_ended(jobs[0].number, ran(jobs[0])));
  EXPECT_EQ(room_->document().placements.size(), 4u);
  EXPECT_EQ(room_->document().placements.back().id, 4u);
  EXPECT_TRUE(layout::check(room_->document()).empty());
}

TEST_F(TwoClients, StopALongCommandAndKeepWhatItHas) {
  command(1, "compact sheet 0 towards 0 -1");
  const std::vector<JobStart> jobs = room_->take_jobs();
  EXPECT_TRUE(room_->handle(2, StopMessage{7}).empty());  // not its own
  EXPECT_FALSE(*jobs[0].stop);
  EXPECT_TRUE(room_->handle(1, StopMessage{7}).empty());
  EXPECT_TRUE(*jobs[0].stop);
  const auto before = heard_.size();
  hear(room_->job_ended(jobs[0].number, ran(jobs[0])));
  EXPECT_EQ(heard_[before].second["stopped"], true);
  EXPECT_EQ(heard_[before + 1].second["placements"].size(), 1u);  // it had one
  // Whoever leaves wants nothing any more.
  command(1, "compact sheet 0 towards 1 0");
  const std::vector<JobStart> left = room_->take_jobs();
  hear(room_->leave(1));
  EXPECT_TRUE(*left[0].stop);
  EXPECT_TRUE(room_->job_ended(left[0].number, ran(left[0])).empty());
  EXPECT_EQ(room_->revision(), 1);
}

TEST(Jobs, CompactingAllSheetsShowsABetterLayoutAfterEach) {
  layout::Document document = cases::two_squares();
  document.stocks[0].count = 2;
  document.placements[1].copy = 1;
  const layout::Command command = layout::CompactCommand{std::nullopt, {0, -1}};
  const JobStart start{1, *job_of(command, layout::Mode::strict), document,
                       std::make_shared<std::atomic<bool>>(false)};
  std::vector<layout::Change> improved;
  const auto found = ran(start, &improved);
  ASSERT_TRUE(found);
  ASSERT_EQ(improved.size(), 2u);
  EXPECT_EQ(improved[0].placements.size(), 1u);
  EXPECT_EQ(improved[1], *found);
  EXPECT_EQ(*found, *plan(layout::Workspace(document), command, layout::Mode::strict));
}

/// A lid of 8 x 8, to be added.
layout::Additions a_lid() {
  layout::Additions additions;
  additions.parts.emplace_back();
  additions.parts[0].id = "lid";
  additions.parts[0].demand = 1;
  additions.parts[0].outline = cases::outline_of({cases::box_loop(0, 0, 8, 8)});
  return additions;
}

TEST_F(TwoClients, BothGetTheWholeLayoutWhenTheJobChanges) {
  const auto heard = command(1, "quantity square 6");
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0]["type"], "done");
  EXPECT_EQ(heard[0]["revision"], 1);
  EXPECT_FALSE(heard[0].contains("taken_off"));
  EXPECT_EQ(heard[1]["type"], "layout");
  EXPECT_EQ(heard[1]["client"], 1);
  EXPECT_EQ(heard[1]["revision"], 1);
  EXPECT_EQ(heard[1]["document"]["parts"][0]["demand"], 6);
  EXPECT_EQ(heard_.back().first, 2u);
  EXPECT_EQ(heard_.back().second["type"], "layout");
  EXPECT_EQ(heard_.back().second["client"], 2);
  EXPECT_EQ(store_->load(id_)->document, room_->document());
  EXPECT_EQ(command(2, "remove-part square")[0]["taken_off"], 2);
  EXPECT_TRUE(room_->document().placements.empty());
  EXPECT_EQ(store_->load(id_)->document, room_->document());
  const auto preview = say(1, CommandMessage{9, layout::Mode::free, "gap 4", true});
  EXPECT_EQ(preview[0]["type"], "refused");
  EXPECT_EQ(room_->document().rules.gap, 0);
}

TEST_F(TwoClients, UndoFindsPartsUnderTheNumbersThatTheyHaveNow) {
  std::vector<std::string> added;
  hear(room_->add("anna", a_lid(), added).value());
  EXPECT_EQ(added, std::vector<std::string>{"lid"});
  const layout::Document with_lid = room_->document();
  ASSERT_EQ(command(2, "place lid sheet 0 1 0 80 80 upright")[0]["type"], "done");
  // Others have placed what would go.
  const auto refused = say(1, UndoMessage{1, false});
  ASSERT_EQ(refused[0]["type"], "refused");
  EXPECT_EQ(
      refused[0]["message"],
      "'add \"lid\"' stands in the way of a later command: client 2 changed placement 3 by 'place \"lid\" "
      "\"sheet\" 0 1 0 80 80 upright' (revision 2) since");
  const layout::Document whole = room_->document();
  ASSERT_EQ(command(1, "remove-part square")[0]["taken_off"], 2);
  EXPECT_EQ(room_->document().placements[0].part, 0u);
  // The lid was part 1 when it was placed, and is part 0 now.
  ASSERT_EQ(say(2, UndoMessage{2, false})[0]["type"], "done");
  EXPECT_TRUE(room_->document().placements.empty());
  ASSERT_EQ(say(2, UndoMessage{3, true})[0]["type"], "done");
  ASSERT_EQ(room_->document().placements.size(), 1u);
  EXPECT_EQ(room_->document().parts[room_->document().placements[0].part].id, "lid");
  const std::vector<HistoryEntry> history = store_->history(id_).value();
  ASSERT_EQ(history.size(), 5u);
  EXPECT_EQ(history[1].parts[0].part, 0u);
  EXPECT_EQ(history[1].parts[0].gone, "");
  EXPECT_EQ(history[2].parts[0].gone, "square");
  EXPECT_EQ(history[2].parts[0].removed, 2);
  // After a restart, too, the numbers are found: by what the store says.
  reopen();
  ASSERT_EQ(say(1, UndoMessage{4, false})[0]["type"], "done");
  EXPECT_EQ(room_->document(), whole);
  EXPECT_EQ(store_->load(id_)->document, whole);
  hear(room_->restore(1).value());
  EXPECT_EQ(room_->document().parts, with_lid.parts);
  EXPECT_EQ(room_->document().placements, with_lid.placements);
  hear(room_->restore(0).value());
  EXPECT_EQ(room_->document().parts, first_.parts);
  EXPECT_EQ(room_->document().placements, first_.placements);
  EXPECT_EQ(store_->load(id_)->document, room_->document());
  EXPECT_TRUE(store_->check()->damage.empty());
}

TEST_F(TwoClients, AreToldWhoChangedThePartThatWouldGoBack) {
  command(1, "quantity square 6");
  command(2, "rotations square 0,90");
  const auto refused = say(1, UndoMessage{1, false});
  ASSERT_EQ(refused[0]["type"], "refused");
  EXPECT_EQ(refused[0]["message"],
            "'quantity \"square\" 6' stands in the way of a later command: client 2 changed part 'square' by "
            "'rotations \"square\" 0,90' (revision 2) since");
  command(1, "remove-part square");
  std::vector<std::string> added;
  layout::Additions another = a_lid();
  another.parts[0].id = "square";
  hear(room_->add("", another, added).value());
  EXPECT_EQ(added, std::vector<std::string>{"square"});
  EXPECT_EQ(say(1, UndoMessage{2, false})[0]["type"], "refused");
  command(1, "gap 1");
  command(2, "gap 2");
  EXPECT_EQ(say(1, UndoMessage{3, false})[0]["message"],
            "'gap 1' stands in the way of a later command: client 2 changed the rules by 'gap 2' (revision "
            "6) since");
}

TEST_F(TwoClients, APartThatComesBackIsInItsKitsAgainUnlessTheyAreOthersNow) {
  layout::Additions lids = a_lid();
  lids.parts.push_back(lids.parts[0]);
  lids.parts[1].id = "foot";
  bring_in(first_, added(first_, lids));
  first_.kits = {{"set", "", 1, 1, {{0, 1, std::nullopt}, {1, 2, std::nullopt}, {2, 1, std::nullopt}}},
                 {"feet", "", 1, 1, {{2, 4, std::nullopt}}}};
  id_ = store_->create("kits", first_).value();
  reopen();
  const auto done = command(1, "remove-part foot");
  EXPECT_EQ(done[0]["kits"], Json{"set"});
  EXPECT_EQ(done[0]["kits_gone"], Json{"feet"});
  EXPECT_FALSE(done[0].contains("taken_off"));
  ASSERT_EQ(room_->document().kits.size(), 1u);
  EXPECT_EQ(store_->load(id_)->document, room_->document());
  ASSERT_EQ(say(1, UndoMessage{1, false})[0]["type"], "done");
  EXPECT_EQ(room_->document(), first_);
  ASSERT_EQ(say(1, UndoMessage{2, true})[0]["type"], "done");
  // Another client takes a part of the same kit.
  ASSERT_EQ(command(2, "remove-part lid")[0]["type"], "done");
  EXPECT_EQ(say(1, UndoMessage{3, false})[0]["message"],
            "'remove-part \"foot\"' cannot be undone: part 'lid' is not there any more");
  ASSERT_EQ(say(2, UndoMessage{4, false})[0]["type"], "done");
  reopen();
  ASSERT_EQ(say(1, UndoMessage{5, false})[0]["type"], "done");
  EXPECT_EQ(room_->document(), first_);
  hear(room_->restore(4).value());
  EXPECT_EQ(room_->document().kits.size(), 1u);
  hear(room_->restore(0).value());
  EXPECT_EQ(room_->document(), first_);
  EXPECT_EQ(store_->load(id_)->document, first_);
  EXPECT_TRUE(store_->check()->damage.empty());
}

TEST_F(TwoClients, PiecesThatWereTakenOffComeBackOnlyWhereTheirPlaceIsFree) {
  command(2, "add-sheet 100x100=1");
  ASSERT_EQ(command(1, "remove-part square")[0]["taken_off"], 2);
  std::vector<std::string> added;
  hear(room_->add("", a_lid(), added).value());
  command(2, "place lid sheet 0 1 0 22 42 upright");
  const auto refused = say(1, UndoMessage{1, false});
  ASSERT_EQ(refused[0]["type"], "refused");
  EXPECT_NE(refused[0]["message"].get<std::string>().find("client 2 changed placement 3"), std::string::npos);
  command(2, "move 3 by 0 -30");
  EXPECT_EQ(say(1, UndoMessage{2, false})[0]["type"], "done");
  EXPECT_EQ(room_->document().placements.size(), 3u);
  EXPECT_TRUE(layout::check(room_->document()).empty());
}

TEST_F(TwoClients, ALongCommandThatKnowsAnOlderJobBeginsAgain) {
  command(1, "fit square sheet 0");
  std::vector<JobStart> jobs = room_->take_jobs();
  ASSERT_EQ(jobs.size(), 1u);
  command(2, "border 7");
  EXPECT_TRUE(room_->job_ended(jobs[0].number, ran(jobs[0])).empty());
  jobs = room_->take_jobs();
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0].document.rules.border_gap, 7 * geom::kGridPerMm);
  const auto found = ran(jobs[0]);
  command(2, "remove-part square");
  const std::size_t before = heard_.size();
  hear(room_->job_ended(jobs[0].number, found));
  EXPECT_EQ(heard_[before].second["type"], "refused");
  EXPECT_EQ(heard_[before].second["message"], "there is no part \"square\"; there are none");
  EXPECT_TRUE(room_->take_jobs().empty());
}

Outgoing sized(std::size_t bytes, Loss loss) {
  return {1, std::make_shared<const std::string>(bytes, 'x'), loss};
}

TEST(Outbox, DropsWhatAFreshLayoutSaysAndAsksForOneOnce) {
  Outbox box(100);
  box.push(sized(60, Loss::as_newer));
  box.push(sized(5, Loss::never));
  box.push(sized(60, Loss::as_newer));  // too much: both go
  box.push(sized(1, Loss::as_newer));   // a revision after a hole is of no use
  EXPECT_EQ(box.pop()->size(), 5u);
  EXPECT_TRUE(box.empty());
  EXPECT_TRUE(box.take_refresh());
  EXPECT_FALSE(box.take_refresh());
  box.push(sized(2, Loss::as_newer));  // said before the room heard that we ask
  EXPECT_TRUE(box.empty());
  box.push(sized(500, Loss::fresh));
  box.push(sized(3, Loss::never));
  EXPECT_EQ(box.pop()->size(), 500u);
  box.push(sized(60, Loss::as_newer));
  EXPECT_EQ(box.pop()->size(), 3u);
  EXPECT_EQ(box.pop()->size(), 60u);
  EXPECT_EQ(box.bytes(), 0u);
  EXPECT_FALSE(box.take_refresh());
}

}  // namespace
}  // namespace lekalo::server::serve_room_test
