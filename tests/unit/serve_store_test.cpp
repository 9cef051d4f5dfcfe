#include "server/store/store.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/layout/workspace.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"
#include "support/layout_commands.hpp"
#include "support/places.hpp"

namespace lekalo::server::serve_store_test {
namespace {

namespace fs = std::filesystem;

class StoreFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lekalo-store-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    path_ = (folder_ / "store.sqlite").string();
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] Store open() const {
    Result<Store> store = Store::open(path_);
    if (!store) throw std::runtime_error(store.error().message);
    return std::move(*store);
  }
  fs::path folder_;
  std::string path_;
};

/// Moves placement 1 to the right by `steps` grid steps, as the next revision.
StoredChange step_right(layout::Document& d, Revision revision, std::int64_t steps) {
  StoredChange change;
  change.revision = revision;
  change.text = "move";
  change.author = "tester";
  layout::Placement after = d.placements[0];
  after.at.x += steps;
  change.change.placements.push_back({d.placements[0], after});
  change.change.next_id_before = change.change.next_id_after = d.next_id;
  d.placements[0] = after;
  return change;
}

TEST_F(StoreFile, IsReadableByItsOwnerAloneWithItsLog) {
  Store store = open();
  ASSERT_TRUE(store.create("a", cases::two_squares()));
  for (const auto& entry : fs::directory_iterator(folder_)) {
    struct stat about {};
    ASSERT_EQ(stat(entry.path().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777, 0600u) << entry.path();
  }
}

TEST_F(StoreFile, GivesBackWhatItWasGivenAfterOpeningAgain) {
  const layout::Document document = cases::random_layout(3, 0, 12);
  LayoutId id = 0;
  {
    Store store = open();
    id = store.create("some name, Київ", document, "digest").value();
  }
  Store store = open();
  const StoredLayout layout = store.load(id).value();
  EXPECT_EQ(layout.name, "some name, Київ");
  EXPECT_EQ(layout.revision, 0);
  EXPECT_EQ(layout.document, document);
  EXPECT_EQ(store.find_origin("digest").value(), id);
  EXPECT_FALSE(store.find_origin("another").value());
  EXPECT_FALSE(store.find_origin("").value());
}

TEST_F(StoreFile, RestoresAnyRevisionAcrossSnapshots) {
  layout::Document document = cases::two_squares();
  const layout::Document first = document;
  Store store = open();
  const LayoutId id = store.create("a", document).value();
  constexpr Revision kLast = 2 * kSnapshotEvery + 5;
  for (Revision r = 1; r <= kLast; ++r) {
    const StoredChange change = step_right(document, r, 1);
    ASSERT_TRUE(store.append(id, change, document));
  }
  for (const Revision r : {Revision{0}, Revision{1}, kSnapshotEvery - 1, kSnapshotEvery, kSnapshotEvery + 1,
                           2 * kSnapshotEvery, kLast}) {
    const layout::Document state = store.state_at(id, r).value();
    EXPECT_EQ(state.placements[0].at.x, first.placements[0].at.x + r);
    EXPECT_EQ(state.placements[1], first.placements[1]);
  }
  EXPECT_EQ(store.load(id)->document, document);
  EXPECT_EQ(store.state_at(id, kLast + 1).error().code, ErrorCode::usage);
  EXPECT_EQ(store.state_at(id, -1).error().code, ErrorCode::usage);
  EXPECT_EQ(store.change_at(id, 7)->change.placements.size(), 1u);
  EXPECT_EQ(store.change_at(id, kLast + 1).error().code, ErrorCode::usage);
}

TEST_F(StoreFile, TakesNoRevisionOutOfTurn) {
  layout::Document document = cases::two_squares();
  Store store = open();
  const LayoutId id = store.create("a", document).value();
  layout::Document moved = document;
  EXPECT_FALSE(store.append(id, step_right(moved, 2, 1), moved));
  EXPECT_FALSE(store.append(id + 1, step_right(moved, 1, 1), moved));
  EXPECT_EQ(store.load(id)->document, document);
  EXPECT_TRUE(store.history(id)->empty());
}

TEST_F(StoreFile, KnowsWhatIsUndone) {
  layout::Document document = cases::two_squares();
  Store store = open();
  const LayoutId id = store.create("a", document).value();
  ASSERT_TRUE(store.append(id, step_right(document, 1, 5), document));
  StoredChange back = step_right(document, 2, -5);
  back.kind = ChangeKind::undo;
  back.target = 1;
  ASSERT_TRUE(store.append(id, back, document));
  EXPECT_TRUE(store.history(id)->at(0).undone);
  StoredChange again = step_right(document, 3, 5);
  again.kind = ChangeKind::redo;
  again.target = 1;
  ASSERT_TRUE(store.append(id, again, document));
  const auto history = store.history(id).value();
  EXPECT_FALSE(history[0].undone);
  EXPECT_EQ(history[2].kind, ChangeKind::redo);
  EXPECT_EQ(history[2].author, "tester");
}

TEST_F(StoreFile, CopiesRenamesRemovesAndListsTheNewestFirst) {
  layout::Document document = cases::two_squares();
  Store store = open();
  const LayoutId a = store.create("a", document).value();
  const LayoutId b = store.create("b", document).value();
  ASSERT_TRUE(store.append(a, step_right(document, 1, 5), document));
  EXPECT_EQ(store.list()->front().id, a);
  EXPECT_EQ(store.list()->front().revision, 1);
  EXPECT_EQ(store.list()->front().placements, 2);
  const LayoutId c = store.copy(a, "c").value();
  EXPECT_EQ(store.load(c)->document, document);
  EXPECT_EQ(store.load(c)->revision, 0);
  ASSERT_TRUE(store.rename(b, "other"));
  EXPECT_EQ(store.load(b)->name, "other");
  ASSERT_TRUE(store.remove(c));
  EXPECT_EQ(store.list()->size(), 2u);
  EXPECT_GT(store.create("d", document).value(), c);  // an id is never given twice
  for (const LayoutId gone : {c, LayoutId{999}}) {
    EXPECT_EQ(store.load(gone).error().code, ErrorCode::usage);
    EXPECT_EQ(store.rename(gone, "x").error().code, ErrorCode::usage);
    EXPECT_EQ(store.remove(gone).error().code, ErrorCode::usage);
    EXPECT_EQ(store.copy(gone, "x").error().code, ErrorCode::usage);
    EXPECT_EQ(store.history(gone).error().code, ErrorCode::usage);
  }
}

TEST_F(StoreFile, BelongsToOneServer) {
  Store store = open();
  const Result<Store> second = Store::open(path_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::environment);
  EXPECT_NE(second.error().message.find("another program uses"), std::string::npos) << second.error().message;
}

TEST_F(StoreFile, RefusesWhatIsNoStore) {
  std::ofstream(path_) << std::string(5000, 'x');
  EXPECT_EQ(Store::open(path_).error().code, ErrorCode::environment);
  EXPECT_EQ(Store::open(folder_.string()).error().code, ErrorCode::environment);
  EXPECT_EQ(Store::open((folder_ / "no" / "such").string()).error().code, ErrorCode::environment);
  const std::string other = (folder_ / "other.sqlite").string();
  std::ofstream(other).flush();
  {
    Database database = Database::open(other).value();
    ASSERT_TRUE(database.run("CREATE TABLE mine (a)"));
  }
  EXPECT_NE(Store::open(other).error().message.find("another program"), std::string::npos);
}

TEST_F(StoreFile, RefusesANewerFormat) {
  { Store store = open(); }
  {
    Database database = Database::open(path_).value();
    ASSERT_TRUE(database.run("PRAGMA user_version=6"));
  }
  const Result<Store> store = Store::open(path_);
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().message.find("format 6"), std::string::npos);
}

TEST_F(StoreFile, OpensAStoreOfFormat3Or4AndMarksItForWhatComes) {
  const layout::Document document = cases::two_squares();
  { ASSERT_TRUE(open().create("a", document)); }
  const auto format = [&] { return Database::open(path_)->number("PRAGMA user_version").value(); };
  for (const int old : {3, 4}) {
    ASSERT_TRUE(Database::open(path_)->run(("PRAGMA user_version=" + std::to_string(old)).c_str()));
    {
      Store store = Store::open(path_, StoreUse::inspect).value();
      EXPECT_EQ(store.load(1)->document, document);
    }
    EXPECT_EQ(format(), old) << "an inspection changes nothing";
    {
      Store store = open();
      EXPECT_TRUE(store.notices().empty());
      EXPECT_EQ(store.load(1)->document, document);
    }
    EXPECT_EQ(format(), kStoreFormat);
  }
}

TEST_F(StoreFile, NoticesDamage) {
  LayoutId id = 0;
  {
    Store store = open();
    layout::Document document = cases::two_squares();
    id = store.create("a", document).value();
    ASSERT_TRUE(store.append(id, step_right(document, 1, 5), document));
    ASSERT_TRUE(store.append(id, step_right(document, 2, 5), document));
  }
  {
    Database database = Database::open(path_).value();
    ASSERT_TRUE(database.run("DELETE FROM change WHERE revision = 1"));
  }
  Store store = open();
  EXPECT_EQ(store.load(id).error().code, ErrorCode::environment);
}

/// No file of the process grows beyond what it is: what a full disk looks like to the store.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    before_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &limit_);
    rlimit lower = limit_;
    lower.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &lower);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    signal(SIGXFSZ, before_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit limit_{};
  void (*before_)(int);
};

TEST_F(StoreFile, OnAFullDiskSaysSoAndKeepsWhatItHad) {
  layout::Document document = cases::two_squares();
  LayoutId id = 0;
  {
    Store store = open();
    id = store.create("a", document).value();
    Revision kept = 0;
    {
      const FullDisk full(100'000);
      Result<void> done;
      layout::Document next = document;
      for (Revision r = 1; r < 1000 && done; ++r) {
        next = document;
        done = store.append(id, step_right(next, r, 1), next);
        if (done) {
          document = next;
          kept = r;
        }
      }
      ASSERT_FALSE(done);
      EXPECT_EQ(done.error().code, ErrorCode::environment);
      EXPECT_NE(done.error().message.find("full"), std::string::npos) << done.error().message;
      EXPECT_EQ(store.load(id)->document, document);
    }
    ASSERT_GT(kept, 0);
    // With room again it goes on.
    ASSERT_TRUE(store.append(id, step_right(document, kept + 1, 1), document));
  }
  Store store = open();
  EXPECT_EQ(store.load(id)->document, document);
}

TEST_F(StoreFile, KeepsDefectsAndZonesThatWereDrawn) {
  layout::Document first = cases::two_squares();
  layout::Workspace now(first);
  Random random(cases::seed(), 77);
  std::vector<layout::Document> states{first};
  LayoutId id = 0;
  {
    Store store = open();
    id = store.create("a", first).value();
    while (states.size() < 40) {
      const auto change =
          plan(now, cases::some_feature_command(now.document(), random), layout::Mode::strict);
      if (!change || change->is_nothing()) continue;
      carry_out(now, *change);
      StoredChange stored;
      stored.revision = static_cast<Revision>(states.size());
      stored.change = *change;
      ASSERT_TRUE(store.append(id, stored, now.document()));
      states.push_back(now.document());
    }
  }
  Store store = open();
  for (std::size_t r = 0; r < states.size(); ++r)
    EXPECT_EQ(store.state_at(id, static_cast<Revision>(r)).value(), states[r]) << r;
}

TEST_F(StoreFile, OfTheFirstFormatIsTakenOver) {
  fs::copy_file(fs::path(cases::source_dir()) / "tests/corpus/data/written-0.1/store.sqlite", path_);
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write);
  {
    Database database = Database::open(path_).value();
    ASSERT_TRUE(database.run("DROP TABLE photo; PRAGMA user_version=1"));
  }
  std::string first;
  {
    Store store = open();
    EXPECT_EQ(store.notices().size(), 1U);
    first = io::write_layout(store.load(1)->document);
    EXPECT_TRUE(store.photos(2)->empty());
  }
  Store store = open();
  EXPECT_TRUE(store.notices().empty());
  EXPECT_EQ(io::write_layout(store.load(1)->document), first);
  EXPECT_TRUE(fs::exists(path_ + ".format-1"));
  // An id that was given before is not given again.
  EXPECT_GT(store.create("new", cases::two_squares()).value(), 2);
}

TEST(ChangeText, CountsWhatHappensToEachPart) {
  const auto of = [](std::uint64_t id, std::uint32_t part) {
    layout::Placement p;
    p.id = id;
    p.part = part;
    return p;
  };
  layout::Change change;
  change.placements = {{of(3, 2), std::nullopt}, {of(4, 0), of(4, 0)}, {std::nullopt, of(5, 2)},
                       {of(6, 2), of(6, 2)},     {of(7, 2), of(7, 2)}, {std::nullopt, of(9, 1)}};
  change.features = {{0, 0, std::nullopt,
                      layout::Feature{layout::FeatureKind::defect, "scar", 3,
                                      cases::outline_of({cases::box_loop(0, 0, 1, 7)})}}};
  const std::vector<TouchedPart> all = touched_parts(change_text(change));
  const auto expect = [&](std::size_t i, std::uint64_t first, std::int64_t placed, std::int64_t changed,
                          std::int64_t removed) {
    EXPECT_EQ(all[i].part, i);
    EXPECT_EQ(all[i].first, first);
    EXPECT_EQ(std::tuple(all[i].placed, all[i].changed, all[i].removed),
              std::tuple(placed, changed, removed));
  };
  ASSERT_EQ(all.size(), 3U);
  expect(0, 4, 0, 1, 0);
  expect(1, 9, 1, 0, 0);
  expect(2, 3, 1, 2, 1);
}

TEST(ChangeText, SaysExactlyHowTheJobChanges) {
  std::size_t jobs = 0;
  for (std::size_t i = 0; i < cases::case_count(20); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << " seed " << cases::seed());
    Random random(cases::seed(), 60 + i);
    layout::Session session(cases::with_kits(cases::random_layout(cases::seed(), 40 + i, 10), random));
    for (int step = 0; step < 12; ++step) {
      const auto change = session.apply(cases::some_job_command(session.document(), random));
      if (!change) continue;
      const std::string text = change_text(*change);
      const auto read = change_from_text(text);
      ASSERT_TRUE(read) << text;
      EXPECT_EQ(*read, *change);
      jobs += change->job.is_nothing() ? 0 : 1;
      for (std::size_t cut = text.find('\n') + 1; cut + 1 < text.size(); cut += 1 + text.size() / 50) {
        const auto part = change_from_text(std::string_view(text).substr(0, cut));
        if (part) {  // whole lines alone
          EXPECT_EQ(change_text(*part), text.substr(0, cut));
        }
      }
    }
  }
  EXPECT_GT(jobs, 50u);
  EXPECT_TRUE(change_from_text("1 1\nr1 2 3 4 5 6\n"));
  EXPECT_TRUE(change_from_text("1 1\nr1 2 3 4 5 6\nc0 7\n"));
  EXPECT_FALSE(change_from_text("1 1\nc0 7\n"));
  EXPECT_TRUE(change_from_text("1 1\nk0 {\"id\": \"a\", \"pieces\": [{\"part\": 7}]}\n"));
  EXPECT_FALSE(change_from_text("1 1\nk0 {\"id\": \"a\", \"pieces\": [{\"part\": \"b\"}]}\n"));
  EXPECT_FALSE(change_from_text("1 1\nk0 {\"id\": \"a\", \"pieces\": []}\n"));
  EXPECT_FALSE(change_from_text("1 1\nr1 2 3\n"));
  EXPECT_FALSE(change_from_text("1 1\nr1 2 3 4 5 6\nr1 2 3 4 5 6\n"));
  EXPECT_FALSE(change_from_text("1 1\np0 {}\n"));
  EXPECT_FALSE(change_from_text("1 1\nS0 {\"id\": \"a\"}\n"));
  EXPECT_FALSE(change_from_text("1 1\nq0 {}\n"));
}

TEST(ChangeText, IsExactAndRefusesEverythingElse) {
  layout::Change change;
  layout::Placement p;
  p.id = 9007199254740991;
  p.at = {-5, 7};
  p.rotation = geom::rotation_from_degrees(37.3);
  p.locked = true;
  layout::Placement q = p;
  q.mirrored = true;
  layout::Placement r = p;
  r.id = 4;
  change.placements = {{std::nullopt, r}, {p, q}};
  change.next_id_before = 3;
  change.next_id_after = 5;
  layout::Feature scar{layout::FeatureKind::defect, "scar \"1\"", 3,
                       cases::outline_of({cases::box_loop(0, 0, 1.1, 7)})};
  layout::Feature worse = scar;
  worse.grade = 4;
  layout::Feature belly{layout::FeatureKind::zone, "belly", 1,
                        cases::outline_of({cases::box_loop(0, 0, 9, 7), cases::box_loop(1, 1, 2, 2)})};
  change.features = {
      {2, 0, scar, worse}, {0, 7, std::nullopt, belly}, {0, 7, belly, std::nullopt}, {2, 0, worse, scar}};
  const std::string text = change_text(change);
  EXPECT_EQ(change_from_text(text).value(), change);
  for (std::size_t cut = 0; cut + 1 < text.size(); ++cut) {
    const auto read = change_from_text(std::string_view(text).substr(0, cut));
    if (read) {  // whole lines alone
      EXPECT_EQ(change_text(*read), text.substr(0, cut));
    }
  }
  EXPECT_FALSE(change_from_text("1 1\n*1 0 0 0 0 0 0 0 0 0\n"));
  EXPECT_FALSE(change_from_text("1 1\n+1 0 0 0 0 0 0 0 0 2\n"));
  EXPECT_FALSE(change_from_text("1 1\n>0 0 0 {}\n"));
  EXPECT_FALSE(change_from_text("1 1\n>0 0 2 " + io::feature_json(scar) + "\n"));
  EXPECT_FALSE(change_from_text("1 1\n>0 0 1 " + io::feature_json(scar) + "\n"));
  EXPECT_FALSE(change_from_text("1 1\n>0 0 0 " + io::feature_json(scar)));
  EXPECT_FALSE(change_from_text("1 1\n+1 0 0 0 0 0 0 99999999999999999999 0 0\n"));
}

}  // namespace
}  // namespace lekalo::server::serve_store_test
