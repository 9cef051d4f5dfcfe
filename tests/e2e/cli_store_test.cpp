// `lekalo store` as people use it, on stores of today and of 0.1, whole and damaged.

#include <gtest/gtest.h>

#include "cli_run.hpp"
#include "support/places.hpp"

namespace lekalo::test::cli_store_test {
namespace {

const fs::path kData = fs::path(cases::source_dir()) / "tests/corpus/data";

bool says(const std::string& text, const std::string& words) { return text.find(words) != text.npos; }

class StoreCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy(kData / "written-0.1/store.sqlite", folder_ / "old.sqlite");
    fs::copy(kData / "attack/store_flip/ok.sqlite", folder_ / "flipped.sqlite");
    for (const char* name : {"old.sqlite", "flipped.sqlite"})
      fs::permissions(folder_ / name, fs::perms::owner_read | fs::perms::owner_write);
  }
  [[nodiscard]] Ran store(const Words& words) const { return run(folder_.path(), Words{"store"} + words); }
  /// Turns one bit of a digit of an outline, as the attack did.
  void flip() const {
    std::string bytes = read_bytes(folder_ / "flipped.sqlite");
    ASSERT_EQ(bytes.at(63246), '2');
    bytes[63246] = '3';
    write_bytes(folder_ / "flipped.sqlite", bytes);
  }
  /// Serves the store for a moment. \return what stderr said
  [[nodiscard]] std::string served(const std::string& file) const {
    Program server(folder_.path(), {"serve", "--store", file, "--port", "0"});
    server.send_when_caught(SIGTERM);
    const Ran ran = server.wait();
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.err;
  }
  TemporaryFolder folder_;
};

TEST_F(StoreCommand, ChecksAStoreOfBeforeWithoutChangingIt) {
  const std::string before = read_bytes(folder_ / "old.sqlite");
  const Ran ran = store({"check", "old.sqlite"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_TRUE(says(ran.out, "2 layouts, 11 changes, 1 photograph; everything is as it was written"))
      << ran.out;
  EXPECT_EQ(read_bytes(folder_ / "old.sqlite"), before);
  EXPECT_FALSE(fs::exists(folder_ / "old.sqlite-revision"));
}

TEST_F(StoreCommand, ServingBringsAStoreOfBeforeForwardAfterACopy) {
  const std::string before = read_bytes(folder_ / "old.sqlite");
  EXPECT_TRUE(says(served("old.sqlite"), "old.sqlite.format-2 is the store as it was"));
  EXPECT_EQ(served("old.sqlite"), "");
  EXPECT_EQ(store({"check", "old.sqlite"}).status, 0);
  // The copy is the old store, which opens as it did.
  const Ran copy = store({"check", "old.sqlite.format-2"});
  EXPECT_EQ(copy.status, 0) << copy.err;
  EXPECT_EQ(copy.out.substr(copy.out.find(':')), store({"check", "old.sqlite"}).out.substr(10));
}

TEST_F(StoreCommand, BacksUpAndRestores) {
  ASSERT_EQ(served("old.sqlite").find("damaged"), std::string::npos);
  const Ran backup = store({"backup", "old.sqlite", "-o", "copy.sqlite"});
  EXPECT_EQ(backup.status, 0) << backup.err;
  EXPECT_EQ(store({"backup", "old.sqlite", "-o", "copy.sqlite"}).status, 0);  // each night
  EXPECT_EQ(store({"backup", "old.sqlite", "-o", "old.sqlite"}).status, 2);
  const Ran onto = store({"restore", "copy.sqlite", "-o", "old.sqlite"});
  EXPECT_EQ(onto.status, 5);
  EXPECT_TRUE(says(onto.err, "move it away")) << onto.err;
  // What stays beside a store that is gone does not count for the one that is put back.
  fs::remove(folder_ / "old.sqlite");
  const Ran restored = store({"restore", "copy.sqlite", "-o", "old.sqlite"});
  EXPECT_EQ(restored.status, 0) << restored.err;
  EXPECT_EQ(served("old.sqlite"), "");
  EXPECT_EQ(store({"check", "old.sqlite"}).status, 0);
}

TEST_F(StoreCommand, TellsOneTurnedBitOfAStoreOfBeforeAndPutsTheLayoutBack) {
  EXPECT_EQ(store({"check", "flipped.sqlite"}).status, 0);
  flip();
  const Ran ran = store({"check", "flipped.sqlite"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_TRUE(says(ran.err, "layout 3 'l2' a point of the outline of part 'vamp'")) << ran.err;
  EXPECT_TRUE(says(ran.err, "becomes layout 4 'l2 (put back)' by lekalo serve, or by lekalo store restore"))
      << ran.err;
  const std::string said = served("flipped.sqlite");
  EXPECT_TRUE(says(said, "is layout 4 'l2 (put back)'")) << said;
  const Ran backup = store({"backup", "flipped.sqlite", "-o", "copy.sqlite"});
  EXPECT_EQ(backup.status, 1);
  EXPECT_FALSE(fs::exists(folder_ / "copy.sqlite"));
  EXPECT_EQ(store({"restore", "flipped.sqlite", "-o", "new.sqlite"}).status, 1);
}

TEST_F(StoreCommand, ALayoutThatIsNotPutBackYetIsNotCounted) {
  EXPECT_TRUE(says(store({"check", "flipped.sqlite"}).out, ": 3 layouts, "));
  flip();
  const Ran check = store({"check", "flipped.sqlite"});
  EXPECT_TRUE(says(check.out, ": 3 layouts, ")) << check.out;
  EXPECT_TRUE(says(check.out, ", 1 can be put back\n")) << check.out;
  // Whoever restores or serves it has it.
  const Ran restored = store({"restore", "flipped.sqlite", "-o", "new.sqlite"});
  EXPECT_TRUE(says(restored.out, ": 4 layouts, ")) << restored.out;
  EXPECT_TRUE(says(served("flipped.sqlite"), "is layout 4"));
  for (const char* file : {"new.sqlite", "flipped.sqlite"}) {
    const Ran after = store({"check", file});
    EXPECT_TRUE(says(after.out, ": 4 layouts, ")) << after.out;
    EXPECT_FALSE(says(after.out, "put back")) << after.out;
  }
}

TEST_F(StoreCommand, TakesWhatIsWholeOutOfADamagedFile) {
  ASSERT_EQ(served("old.sqlite").find("damaged"), std::string::npos);
  std::string bytes = read_bytes(folder_ / "old.sqlite");
  // A byte in the header of a page of a table's changes.
  const std::size_t at = bytes.find("add-defect \"hide\" \"scar\"") / 4096 * 4096 + 3;
  bytes[at] = static_cast<char>(bytes[at] + 1);
  write_bytes(folder_ / "old.sqlite", bytes);
  const Ran check = store({"check", "old.sqlite"});
  EXPECT_EQ(check.status, 1) << check.out << check.err;
  const Ran refused = run(folder_.path(), {"serve", "--store", "old.sqlite", "--port", "0"});
  EXPECT_EQ(refused.status, 5);
  EXPECT_TRUE(says(refused.err, "lekalo store restore old.sqlite -o NEW")) << refused.err;
  const Ran taken = store({"restore", "old.sqlite", "-o", "new.sqlite"});
  EXPECT_EQ(taken.status, 1) << taken.err;
  const Ran whole = store({"check", "new.sqlite"});
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_TRUE(says(whole.out, "2 layouts")) << taken.err;
}

TEST_F(StoreCommand, NothingIsWrittenThroughALinkBesideTheStore) {
  const std::string precious = "what somebody else wrote\n";
  write_bytes(folder_ / "victim", precious);
  for (const char* name : {"new.sqlite-reserve", "new.sqlite-revision", "copy.sqlite.lekalo-new"})
    fs::create_symlink("victim", folder_ / name);
  const Ran refused = run(folder_.path(), {"serve", "--store", "new.sqlite", "--port", "0"});
  EXPECT_EQ(refused.status, 5);
  EXPECT_TRUE(says(refused.err, "new.sqlite-revision")) << refused.err;
  fs::remove(folder_ / "new.sqlite-revision");
  EXPECT_EQ(served("new.sqlite"), "");
  EXPECT_EQ(store({"backup", "new.sqlite", "-o", "copy.sqlite"}).status, 0);
  EXPECT_EQ(fs::status(folder_ / "copy.sqlite").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(read_bytes(folder_ / "victim"), precious);
}

TEST_F(StoreCommand, SaysWhatIsWrongWithTheCommandLine) {
  EXPECT_EQ(store({}).status, 2);
  EXPECT_TRUE(says(store({"mend", "old.sqlite"}).err, "check, backup or restore"));
  EXPECT_EQ(store({"mend", "old.sqlite"}).status, 2);
  EXPECT_EQ(store({"backup", "old.sqlite"}).status, 2);
  EXPECT_EQ(store({"check", "old.sqlite", "-o", "x"}).status, 2);
  const Ran missing = store({"check", "nowhere.sqlite"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_TRUE(says(missing.err, "nowhere.sqlite")) << missing.err;
  EXPECT_FALSE(fs::exists(folder_ / "nowhere.sqlite"));
  write_bytes(folder_ / "text", "no store");
  EXPECT_EQ(store({"check", "text"}).status, 5);
}

}  // namespace
}  // namespace lekalo::test::cli_store_test
