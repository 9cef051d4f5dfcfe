#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/sha256.hpp"

namespace lekalo::io_files_test {
namespace {

namespace fs = std::filesystem;

class IoFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lekalo-files-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string content(const std::string& name) const { return *disk::read_file(path(name)); }
  void put(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  /// Names in the folder, sorted, without those given.
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(IoFiles, ReadsWholeFilesAndPipes) {
  const std::string bytes = std::string(200'000, 'x') + '\0' + "end";
  put("a", bytes);
  EXPECT_EQ(*disk::read_file(path("a")), bytes);
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  if (::fork() == 0) {
    std::ofstream(path("pipe")) << bytes;
    ::_exit(0);
  }
  EXPECT_EQ(*disk::read_file(path("pipe")), bytes);
}

TEST_F(IoFiles, RefusesWhatIsNoFile) {
  put("empty", "");
  put("large", "x");
  fs::resize_file(path("large"), disk::kLargestFile + 1);
  const auto expect = [&](const std::string& name, const char* says) {
    const auto file = disk::read_file(path(name));
    ASSERT_FALSE(file.has_value()) << name;
    EXPECT_EQ(file.error().code, ErrorCode::bad_input);
    EXPECT_NE(file.error().message.find(path(name) + ": " + says), std::string::npos) << file.error().message;
  };
  expect("missing", "cannot be opened: No such file");
  expect("empty", "is empty");
  expect("large", "is larger than 1024 MiB");
  fs::create_directory(path("dir"));
  expect("dir", "is a folder");
}

TEST_F(IoFiles, FilesAppearAtCommitAndNotBefore) {
  put("old", "before");
  disk::AtomicFiles files;
  ASSERT_TRUE(files.add(path("old"), "after"));
  ASSERT_TRUE(files.add(path("new"), "fresh"));
  EXPECT_EQ(content("old"), "before");
  EXPECT_FALSE(fs::exists(path("new")));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(content("old"), "after");
  EXPECT_EQ(content("new"), "fresh");
  EXPECT_EQ(entries(), 2U) << "nothing else is left";
  ASSERT_TRUE(files.add(path("new"), "again"));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(content("new"), "again");
}

TEST_F(IoFiles, NothingIsLeftWithoutCommit) {
  put("old", "before");
  {
    disk::AtomicFiles files;
    ASSERT_TRUE(files.add(path("old"), "after"));
    ASSERT_TRUE(files.add(path("new"), "fresh"));
    EXPECT_EQ(entries(), 3U);
  }
  EXPECT_EQ(entries(), 1U);
  EXPECT_EQ(content("old"), "before");
}

TEST_F(IoFiles, ARenameThatFailsPutsTheOthersBack) {
  put("a", "old a");
  disk::AtomicFiles files;
  ASSERT_TRUE(files.add(path("a"), "new a"));
  ASSERT_TRUE(files.add(path("b"), "new b"));
  ASSERT_TRUE(files.add(path("c"), "new c"));
  fs::create_directories(path("c") + "/inside");  // a file cannot be renamed over it
  const auto done = files.commit();
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().code, ErrorCode::environment);
  EXPECT_NE(done.error().message.find(path("c")), std::string::npos);
  EXPECT_EQ(content("a"), "old a");
  EXPECT_FALSE(fs::exists(path("b")));
  EXPECT_EQ(entries(), 2U);
}

TEST_F(IoFiles, KeepsPermissionsOfAReplacedFileAndMakesNewOnesAsTheUmaskSays) {
  put("old", "x");
  fs::permissions(path("old"), fs::perms(0640));
  const mode_t mask = ::umask(027);
  disk::AtomicFiles files;
  ASSERT_TRUE(files.add(path("old"), "y"));
  ASSERT_TRUE(files.add(path("new"), "y"));
  ASSERT_TRUE(files.commit());
  ::umask(mask);
  EXPECT_EQ(fs::status(path("old")).permissions(), fs::perms(0640));
  EXPECT_EQ(fs::status(path("new")).permissions(), fs::perms(0640));
  fs::permissions(path("old"), fs::perms(0755));
  ASSERT_TRUE(files.add(path("old"), "z"));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(fs::status(path("old")).permissions(), fs::perms(0755));
}

TEST_F(IoFiles, FollowsLinks) {
  fs::create_directory(path("dir"));
  put("dir/real", "x");
  fs::create_symlink("dir/real", path("link"));
  fs::create_symlink("link", path("link-to-link"));
  fs::create_symlink("dir/not-yet", path("dangling"));
  disk::AtomicFiles files;
  ASSERT_TRUE(files.add(path("link-to-link"), "y"));
  ASSERT_TRUE(files.add(path("dangling"), "z"));
  ASSERT_TRUE(files.commit());
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_symlink(path("link-to-link")));
  EXPECT_EQ(content("dir/real"), "y");
  EXPECT_EQ(content("dir/not-yet"), "z");
  fs::create_symlink("loop", path("loop"));
  EXPECT_FALSE(files.add(path("loop"), "w").has_value());
}

TEST_F(IoFiles, RefusesTargetsThatCannotBe) {
  disk::AtomicFiles files;
  fs::create_directory(path("dir"));
  for (const std::string& target : {path("dir"), path("missing/file"), std::string("/dev/null")}) {
    const auto done = files.add(target, "x");
    ASSERT_FALSE(done.has_value()) << target;
    EXPECT_EQ(done.error().code, ErrorCode::environment);
    EXPECT_EQ(done.error().message.find(target), 0U);
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  put("a", "x");
  fs::create_symlink("a", path("b"));
  fs::create_hard_link(path("a"), path("c"));
  ASSERT_TRUE(files.add(path("a"), "1"));
  for (const char* again : {"a", "b", "c"}) {
    const auto done = files.add(path(again), "2");
    ASSERT_FALSE(done.has_value()) << again;
    EXPECT_EQ(done.error().code, ErrorCode::usage);
  }
}

TEST_F(IoFiles, AFullDiskLeavesNothing) {
  put("a", "old");
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit old_limit {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  struct rlimit limit = old_limit;
  limit.rlim_cur = 1000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  disk::AtomicFiles files;
  const auto done = files.add(path("a"), std::string(5000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().code, ErrorCode::environment);
  EXPECT_EQ(entries(), 1U);
  EXPECT_EQ(content("a"), "old");
  EXPECT_TRUE(files.commit());
}

TEST_F(IoFiles, TheLongestNameWorks) {
  const std::string name(255, 'n');
  disk::AtomicFiles files;
  ASSERT_TRUE(files.add(path(name), "x"));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(content(name), "x");
}

TEST(IoSha256, GivesThePublishedDigests) {
  // FIPS 180-2, appendix B.
  EXPECT_EQ(io::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(io::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(io::sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace lekalo::io_files_test
