// What a store says of damage: told, or harmless, and never another layout.

#include <gtest/gtest.h>
#include <sys/mount.h>

#include <optional>

#include "lekalo/io/layout/layout_json.hpp"
#include "server/store/outside_revision.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/store_cases.hpp"

namespace lekalo::server::serve_store_damage_test {
namespace {

namespace fs = std::filesystem;
using cases::add_revisions;
using cases::file_bytes;
using cases::open_store;
using cases::StoreFolder;
using cases::write_file;

/// Everything that a store gives back of one layout.
struct Content {
  std::string name, document, history, photos;
  Revision revision = 0;
  friend bool operator==(const Content&, const Content&) = default;
};

std::string history_text(const std::vector<HistoryEntry>& entries) {
  std::string text;
  for (const HistoryEntry& e : entries)
    text += std::to_string(e.revision) + e.at + e.author + e.text + name_of(e.kind) +
            std::to_string(e.target) + (e.undone ? "u\n" : "\n");
  return text;
}

bool any_damaged(const std::vector<HistoryEntry>& entries) {
  return std::any_of(entries.begin(), entries.end(), [](const HistoryEntry& e) { return e.damaged; });
}

/// The content of one layout; nothing where damage of it was told.
std::optional<Content> content_of(Store& store, LayoutId id) {
  Content content;
  const Result<StoredLayout> layout = store.load(id);
  const Result<std::vector<HistoryEntry>> history = store.history(id);
  const Result<std::vector<Photo>> photos = store.photos(id);
  if (!layout || !history || any_damaged(*history) || !photos) return std::nullopt;
  content.name = layout->name;
  content.revision = layout->revision;
  content.document = io::write_layout(layout->document);
  content.history = history_text(*history);
  for (const Photo& photo : *photos) {
    const Result<std::string> image = store.photo_image(id, photo.stock);
    if (!image) return std::nullopt;
    content.photos += photo.stock + photo.type + std::to_string(photo.scale.mm[2]) + *image;
  }
  return content;
}

using Contents = std::map<LayoutId, Content>;

/// What is wrong with a store that was opened: empty where all is told or as it was.
std::string wrong_with(Store& store, const Contents& wanted) {
  const Result<std::vector<LayoutSummary>> list = store.list();
  if (!list) return {};
  bool told = !store.notices().empty();
  Contents found;
  for (const LayoutSummary& one : *list) {
    if (one.damaged) {
      told = true;
      continue;
    }
    const std::optional<Content> content = content_of(store, one.id);
    if (!content) {
      told = true;
      continue;
    }
    const auto at = wanted.find(one.id);
    if (at == wanted.end()) return "a layout that was never there";
    if (!(*content == at->second)) return "another layout";
    if (one.name != content->name || one.revision != content->revision) return "another entry in the list";
    found.emplace(one.id, *content);
  }
  if (found.size() < wanted.size() && !told) return "a layout is gone, and nothing was said";
  return {};
}

/// Two layouts with changes, one of them past a snapshot, and a photograph. \return what the store holds
Contents fill(const std::string& path) {
  Random random(cases::seed(), 71);
  Store store = open_store(path);
  layout::Document squares = cases::two_squares();
  const LayoutId a = store.create("squares", squares, "digest of a file").value();
  add_revisions(store, a, squares, 0, 20, random);
  layout::Document order = cases::random_layout(3, 0, 6);
  const LayoutId b = store.create("order, Київ", order).value();
  add_revisions(store, b, order, 0, static_cast<int>(kSnapshotEvery) + 4, random);
  const std::string image = "\x89PNG\r\n\x1a\n" + std::string(3000, 'p');
  const Photo photo{squares.stocks[0].id, "image/png", static_cast<std::int64_t>(image.size()), {}};
  EXPECT_TRUE(store.set_photo(a, photo, image));
  Contents contents;
  for (const LayoutId id : {a, b}) contents[id] = content_of(store, id).value();
  return contents;
}

TEST(StoreDamage, AnyBitThatIsTurnedIsToldOrHarmless) {
  const StoreFolder folder;
  const std::string path = folder / "store.sqlite", outside = OutsideRevision::path_of(path);
  const Contents wanted = fill(path);
  ASSERT_FALSE(fs::exists(path + "-wal"));
  const std::string whole = file_bytes(path), revision = file_bytes(outside);
  Random random(cases::seed(), 72);
  std::size_t refused = 0, told = 0, harmless = 0;
  // 25 in the quick suite; LEKALO_CASES=1000 for the full one.
  for (std::size_t n = 0; n < cases::case_count(25); ++n) {
    const std::size_t bit = random.below(8 * whole.size());
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    fs::remove(path + "-wal");
    write_file(path, bytes);
    write_file(outside, revision);
    Result<Store> store = Store::open(path);
    if (!store) {
      ++refused;
      EXPECT_NE(store.error().message.find(path), std::string::npos) << store.error().message;
      continue;
    }
    EXPECT_EQ(wrong_with(*store, wanted), "") << "bit " << bit % 8 << " of byte " << bit / 8;
    const bool all = [&] {
      for (const auto& [id, content] : wanted) {
        const auto now = content_of(*store, id);
        if (!now || !(*now == content)) return false;
      }
      return true;
    }();
    ++(all ? harmless : told);
  }
  std::printf("seed %llu: %zu refused, %zu told, %zu harmless\n",
              static_cast<unsigned long long>(cases::seed()), refused, told, harmless);
}

class Damaged : public testing::Test {
 protected:
  /// Changes rows of a store that is closed.
  void change(const char* sql) const {
    const Database database = Database::open(path_).value();
    const Result<void> done = database.run(sql);
    ASSERT_TRUE(done) << done.error().message;
  }
  StoreFolder folder_;
  std::string path_ = folder_ / "store.sqlite";
  Contents wanted_ = fill(path_);
};

TEST_F(Damaged, AChangeIsToldAndTheStateBeforeItCanBeOpened) {
  change(
      "UPDATE change SET placements = replace(placements, '-1 ', '+1 ') WHERE layout = 1 AND revision = 17");
  change("UPDATE change SET author = 'else' WHERE layout = 1 AND revision = 17");
  Store store = open_store(path_);
  const Result<StoredLayout> read = store.load(1);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::environment);
  EXPECT_NE(read.error().message.find("revision 17 of layout 1"), std::string::npos) << read.error().message;
  EXPECT_NE(read.error().message.find("copy?name=NAME&revision=16"), std::string::npos)
      << read.error().message;
  ASSERT_TRUE(store.state_at(1, 16));
  EXPECT_FALSE(store.state_at(1, 18));
  const Result<LayoutId> copy = store.copy(1, "saved", 16);
  ASSERT_TRUE(copy) << copy.error().message;
  EXPECT_EQ(io::write_layout(store.load(*copy)->document), io::write_layout(*store.state_at(1, 16)));
  const std::vector<HistoryEntry> history = store.history(1).value();
  ASSERT_EQ(history.size(), 20U);
  EXPECT_TRUE(history[16].damaged);
  EXPECT_FALSE(history[17].damaged);
  EXPECT_EQ(content_of(store, 2), wanted_.at(2));
  EXPECT_TRUE(store.remove(1));  // what is damaged can be taken away
}

TEST_F(Damaged, AChangeBeforeASnapshotHarmsNoLaterState) {
  change("DELETE FROM change WHERE layout = 2 AND revision = 17");
  Store store = open_store(path_);
  EXPECT_EQ(io::write_layout(store.load(2)->document), wanted_.at(2).document);
  EXPECT_FALSE(store.state_at(2, 20));
  EXPECT_TRUE(any_damaged(store.history(2).value()));
  EXPECT_FALSE(store.check()->damage.empty());
}

TEST_F(Damaged, ASnapshotIsPassedOverWhereTheChangesLeadToItsState) {
  change("UPDATE snapshot SET document = replace(document, '1', '2') WHERE layout = 2 AND revision = 256");
  Store store = open_store(path_);
  EXPECT_EQ(io::write_layout(store.load(2)->document), wanted_.at(2).document);
  EXPECT_FALSE(store.check()->damage.empty());
}

TEST_F(Damaged, AnEntryIsToldAtOpening) {
  change("UPDATE layout SET revision = 3 WHERE id = 1");
  Store store = open_store(path_);
  ASSERT_EQ(store.notices().size(), 1U);
  EXPECT_NE(store.notices()[0].find("layout 1"), std::string::npos) << store.notices()[0];
  EXPECT_FALSE(store.load(1));
  EXPECT_FALSE(store.rename(1, "whole again"));
  EXPECT_EQ(io::write_layout(*store.state_at(1, 20)), wanted_.at(1).document);
}

TEST_F(Damaged, APhotographIsToldAndCanBeReplaced) {
  change("UPDATE photo SET scale = replace(scale, '0', '1')");
  Store store = open_store(path_);
  const Result<std::vector<Photo>> photos = store.photos(1);
  ASSERT_FALSE(photos);
  EXPECT_NE(photos.error().message.find("lay it anew"), std::string::npos);
  EXPECT_TRUE(store.load(1));
}

TEST_F(Damaged, AStoreWithoutItsLogIsNoticed) {
  const std::string kept = folder_ / "kept";
  {
    Store store = open_store(path_);
    layout::Document now = store.load(1)->document;
    ASSERT_TRUE(store.append(1, cases::step_right(now, 21, 1), now));
    fs::copy_file(path_, kept);  // without the log
  }
  fs::copy_file(kept, path_, fs::copy_options::overwrite_existing);
  const Result<Store> store = Store::open(path_);
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().message.find("older than what was acknowledged"), std::string::npos);
  EXPECT_NE(store.error().message.find("lekalo store restore"), std::string::npos);
  EXPECT_FALSE(open_store(path_, StoreUse::inspect).check()->damage.empty());
}

TEST_F(Damaged, ARevisionOutsideThatLagsOrIsGoneRaisesNoAlarm) {
  const std::string outside = OutsideRevision::path_of(path_);
  const std::string before = file_bytes(outside);
  {
    Store store = open_store(path_);
    layout::Document now = store.load(1)->document;
    ASSERT_TRUE(store.append(1, cases::step_right(now, 21, 1), now));
  }
  write_file(outside, before);
  EXPECT_TRUE(open_store(path_).notices().empty());
  fs::remove(outside);
  EXPECT_TRUE(open_store(path_).notices().empty());
  write_file(outside, before.substr(0, before.size() / 2));
  EXPECT_EQ(open_store(path_).notices().size(), 1U);  // unreadable: told, and written anew
  EXPECT_TRUE(open_store(path_).notices().empty());
}

TEST_F(Damaged, ACopyIsTheSameStore) {
  const std::string copy = folder_ / "copy.sqlite";
  {
    Store store = open_store(path_, StoreUse::inspect);
    const StoreCheck check = store.check().value();
    EXPECT_TRUE(check.damage.empty()) << check.damage[0];
    EXPECT_EQ(check.layouts, 2);
    EXPECT_EQ(check.revisions, 20 + kSnapshotEvery + 4);
    EXPECT_EQ(check.photos, 1);
    ASSERT_TRUE(store.write_copy(copy));
  }
  fs::permissions(copy, fs::perms::owner_read);
  Store store = open_store(copy, StoreUse::inspect);
  EXPECT_EQ(wrong_with(store, wanted_), "");
  EXPECT_TRUE(store.notices().empty());
}

/// A small disk of its own.
class SmallDisk {
 public:
  SmallDisk() : mounted_(mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, "size=16m") == 0) {}
  ~SmallDisk() {
    if (mounted_) umount(folder_.path().c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool mounted() const { return mounted_; }
  [[nodiscard]] std::string operator/(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::uintmax_t room() const { return fs::space(folder_.path()).available; }

 private:
  StoreFolder folder_;
  bool mounted_;
};

TEST(StoreOnAFullDisk, ALayoutCanBeRemovedAndGivesItsRoomBack) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "a disk cannot be mounted here";
  const std::string path = disk / "store.sqlite";
  Store store = open_store(path);
  layout::Document document = cases::two_squares();
  while (document.placements.size() < 5000) {
    document.placements.push_back(document.placements[0]);
    document.placements.back().id = document.next_id++;
  }
  std::vector<LayoutId> made;
  for (;;) {
    const Result<LayoutId> id = store.create("a", document);
    if (!id) {
      EXPECT_NE(id.error().message.find("full"), std::string::npos) << id.error().message;
      break;
    }
    made.push_back(*id);
    ASSERT_LT(made.size(), 60U) << "the disk is not full";
  }
  ASSERT_GT(made.size(), 4U);
  // What is left is filled up too, by somebody else.
  for (std::ofstream rest(disk / "rest", std::ios::binary); rest.put('r').flush();)
    rest << std::string(4096, 'r');
  const Result<void> removed = store.remove(made[0]);
  ASSERT_TRUE(removed) << removed.error().message;
  EXPECT_TRUE(store.remove(made[1]));
  EXPECT_GT(disk.room(), 400'000U);
  EXPECT_TRUE(store.load(made[2]));
  layout::Document small = cases::two_squares();
  EXPECT_TRUE(store.create("b", small));
}

}  // namespace
}  // namespace lekalo::server::serve_store_damage_test
