// `lekalo serve` on a small disk of its own that fills up: nothing that was acknowledged is lost, and who
// sits at the page makes room again.

#include <sys/mount.h>

#include <fstream>

#include "serve_client.hpp"

namespace lekalo::test::serve_disk_test {
namespace {

class SmallDisk {
 public:
  SmallDisk() : path_(folder_ / "disk") {
    fs::create_directory(path_);
    mounted_ = mount("tmpfs", path_.c_str(), "tmpfs", 0, "size=16m") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount(path_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool mounted() const { return mounted_; }
  [[nodiscard]] const fs::path& path() const { return path_; }
  /// Takes what is left of it, as another program does.
  void fill() const {
    std::ofstream rest(path_ / "rest", std::ios::binary | std::ios::app);
    while (rest.write(std::string(4096, 'r').data(), 4096).flush()) continue;
    rest.clear();
    while (rest.put('r').flush()) continue;
  }

 private:
  TemporaryFolder folder_;
  fs::path path_;
  bool mounted_ = false;
};

/// A request as the page makes it.
Answer from_page(const ServerProcess& server, http::verb method, const std::string& target,
                 const std::string& body = "") {
  return ask(server, method, target, body,
             {{"Origin", "http://" + server.host()}, {"Sec-Fetch-Site", "same-origin"}});
}

/// So many squares on one another: a layout that takes room.
std::string large_layout() {
  Json all = Json::parse(squares());
  const Json one = all["placements"][0];
  while (all["placements"].size() < 5000) all["placements"].push_back(one);
  return all.dump();
}

TEST(ServeDisk, AFullOneIsFreedFromThePage) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "a disk cannot be mounted here";
  Json acknowledged;
  {
    ServerProcess server(disk.path());
    const int kept = create(server);
    Client client(server, kept);
    client.hear("layout");
    const std::string file = large_layout();
    std::vector<int> large;
    Answer last;
    for (int i = 0; i < 100; ++i) {
      last = from_page(server, http::verb::post, "/api/layouts?name=large", file);
      if (last.status != 201) break;
      large.push_back(Json::parse(last.body)["id"]);
    }
    ASSERT_EQ(last.status, 503U) << last.body;
    EXPECT_NE(last.body.find("full"), std::string::npos) << last.body;
    ASSERT_GT(large.size(), 4U);

    for (int round = 0; round < 2; ++round) {
      disk.fill();
      Json said{{"type", "done"}};
      for (int i = 0; i < 3000 && said["type"] == "done"; ++i)
        said = client.command(i % 2 == 0 ? "move 1 by 1 0" : "move 1 by -1 0");
      ASSERT_EQ(said["type"], "refused") << "the disk is not full";
      EXPECT_NE(said["message"].get<std::string>().find("full"), std::string::npos) << said;
      // What others read is still there.
      EXPECT_EQ(from_page(server, http::verb::get, "/api/layouts").status, 200U);

      const std::string at = "/api/layouts/" + std::to_string(large.back());
      large.pop_back();
      const Answer removed = from_page(server, http::verb::delete_, at);
      ASSERT_EQ(removed.status, 200U) << removed.body;
      EXPECT_EQ(from_page(server, http::verb::get, at + "/history").status, 404U);
      EXPECT_GT(fs::space(disk.path()).available, 100'000U) << "the room is given back to the disk";
      EXPECT_TRUE(fs::exists(disk.path() / "store.sqlite-reserve")) << "and kept for the next time";
      EXPECT_EQ(client.command("move 2 by 1 0")["type"], "done");
      client.hear("change");  // it comes after the acknowledgement
    }
    EXPECT_EQ(from_page(server, http::verb::post, "/api/layouts?name=small", squares()).status, 201U);
    acknowledged = client.document();
    server.end(SIGKILL);
  }
  ServerProcess server(disk.path());
  EXPECT_EQ(server.line(), "listening http://" + server.host() + "/");
  Client client(server, 1);
  client.hear("layout");
  EXPECT_EQ(client.document(), acknowledged);
  EXPECT_EQ(server.end(SIGTERM), 0);
  EXPECT_EQ(run(disk.path(), {"store", "check", "store.sqlite"}).status, 0);
}

}  // namespace
}  // namespace lekalo::test::serve_disk_test
