// `lekalo serve` as a process of its own, with real sockets: nothing acknowledged is lost when it is killed,
// clients agree, strangers are refused.

#include <algorithm>
#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <mutex>

#include "cli_run.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/io/layout_json.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"

namespace lekalo::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;

/// Twelve squares of 10 on a sheet of 200.
std::string squares() {
  std::string text =
      R"({"format": "lekalo-layout/1", "units": "mm", "rules": {"gap": 1},
"stocks": [{"id": "sheet", "kind": "sheet", "outline": {"polygon": {"outer": [[0,0],[200,0],[200,200],[0,200]]}}}],
"parts": [{"id": "square", "outline": {"polygon": {"outer": [[0,0],[10,0],[10,10],[0,10]]}}}],
"placements": [)";
  for (int i = 0; i < 12; ++i)
    text += std::string(i == 0 ? "" : ",") +
            R"({"part": "square", "stock": "sheet", "rotation_deg": 0, "x": )" +
            std::to_string(20 + 40 * (i % 4)) + R"(, "y": )" + std::to_string(20 + 40 * (i / 4)) + "}";
  return text + "]}";
}

class ServerProcess {
 public:
  explicit ServerProcess(const fs::path& folder, const Words& more = {}) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    Words words =
        Words{cases::program(), "serve", "--store", (folder / "store.sqlite").string(), "--port", "0"} + more;
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], 1);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    char c = 0;
    while (read(ends[0], &c, 1) == 1 && c != '\n') line_ += c;
    close(ends[0]);
    const std::size_t colon = line_.rfind(':');
    if (colon != std::string::npos) port_ = static_cast<unsigned short>(std::atoi(line_.c_str() + colon + 1));
  }
  ~ServerProcess() { end(SIGKILL); }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  int end(int signal_number) {
    if (process_ <= 0) return 0;
    kill(process_, signal_number);
    int state = 0;
    waitpid(process_, &state, 0);
    process_ = 0;
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
  }
  void kill_now() const { kill(process_, SIGKILL); }
  [[nodiscard]] unsigned short port() const { return port_; }
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] long resident_kb() const {
    std::ifstream lines("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("VmRSS:", 0) == 0) return std::atol(line.c_str() + 6);
    return 0;
  }

 private:
  pid_t process_ = 0;
  unsigned short port_ = 0;
  std::string line_;
};

tcp::socket connected(asio::io_context& io, unsigned short port) {
  tcp::socket socket(io);
  socket.connect({asio::ip::make_address("127.0.0.1"), port});
  return socket;
}

struct Answer {
  unsigned status = 0;
  std::string body;
};

Answer ask(const ServerProcess& server, http::verb method, const std::string& target,
           const std::string& body = "", const std::map<std::string, std::string>& headers = {}) {
  asio::io_context io;
  tcp::socket socket = connected(io, server.port());
  http::request<http::string_body> request(method, target, 11);
  request.set(http::field::host, server.host());
  for (const auto& [name, value] : headers) request.set(name, value);
  request.body() = body;
  request.prepare_payload();
  beast::error_code error;
  http::write(socket, request, error);  // an answer may come before all is sent
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(std::uint64_t{1} << 28);
  http::read(socket, buffer, parser, error);
  return {parser.get().result_int(), parser.get().body()};
}

int create(const ServerProcess& server) {
  const Answer made = ask(server, http::verb::post, "/api/layouts?name=squares", squares());
  EXPECT_EQ(made.status, 201u) << made.body;
  return Json::parse(made.body)["id"];
}

class Client {
 public:
  Client(const ServerProcess& server, int layout, const std::string& author = "",
         const std::map<std::string, std::string>& headers = {})
      : socket_(connected(io_, server.port())) {
    socket_.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      request.set(http::field::sec_websocket_protocol, "lekalo.1");
      for (const auto& [name, value] : headers) request.set(name, value);
    }));
    socket_.read_message_max(0);
    socket_.handshake(server.host(),
                      "/ws?layout=" + std::to_string(layout) + (author.empty() ? "" : "&author=" + author));
  }
  Json hear() {
    beast::flat_buffer buffer;
    socket_.read(buffer);
    Json said = Json::parse(beast::buffers_to_string(buffer.data()));
    // Revisions have no holes.
    if (said["type"] == "layout") {
      revision_ = said["revision"];
      placements_.clear();
      for (const Json& one : said["document"]["placements"]) placements_[one["id"]] = one;
    } else if (said["type"] == "change") {
      EXPECT_EQ(said["revision"].get<long>(), revision_ + 1);
      revision_ = said["revision"];
      for (const Json& one : said["placements"]) {
        if (one["after"].is_null())
          placements_.erase(one["id"]);
        else
          placements_[one["id"]] = one["after"];
      }
    }
    return said;
  }
  Json hear(const std::string& type) {
    for (;;) {
      Json said = hear();
      if (said["type"] == type) return said;
    }
  }
  void send(const std::string& bytes) { socket_.write(asio::buffer(bytes)); }
  /// The answer to a message with a seq.
  Json ask(Json message) {
    message["seq"] = ++seq_;
    send(message.dump());
    for (;;) {
      Json said = hear();
      if (said.contains("seq") && said["seq"] == seq_) return said;
    }
  }
  Json command(const std::string& text, const std::string& mode = "strict") {
    return ask({{"type", "command"}, {"mode", mode}, {"text", text}});
  }
  websocket::stream<tcp::socket>& socket() { return socket_; }
  [[nodiscard]] long revision() const { return revision_; }
  [[nodiscard]] const std::map<long, Json>& placements() const { return placements_; }

 private:
  asio::io_context io_;
  websocket::stream<tcp::socket> socket_;
  std::map<long, Json> placements_;
  long revision_ = -1;
  std::uint64_t seq_ = 0;
};

std::string random_command(Random& random) {
  const auto step = [&] { return std::to_string(static_cast<int>(random.below(31)) - 15); };
  const std::string id = std::to_string(1 + random.below(12));
  switch (random.below(4)) {
    case 0:
      return "slide " + id + " towards " + std::to_string(1 + random.below(9)) + " " + step();
    case 1:
      return "nearest " + id + " by " + step() + " " + step();
    default:
      return "move " + id + " by " + step() + " " + step();
  }
}

TEST(Serve, TwoClientsOnOneLayoutStayInStep) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path());
  ASSERT_EQ(server.line(), "listening http://" + server.host() + "/");
  const int layout = create(server);
  Client a(server, layout, "anna"), b(server, layout);
  EXPECT_EQ(a.hear("layout")["revision"], 0);
  b.hear("layout");
  EXPECT_EQ(a.command("move 1 by 3 0")["type"], "done");
  const Json change = b.hear("change");
  EXPECT_EQ(change["placements"][0]["after"]["x"], 23);
  EXPECT_EQ(b.command("move 1 by 0 3")["revision"], 2);
  const Json refused = a.ask({{"type", "undo"}});
  EXPECT_EQ(refused["type"], "refused");
  EXPECT_NE(refused["message"].get<std::string>().find("move 1 by 0 3"), std::string::npos) << refused;
  EXPECT_EQ(a.command("move 1 by 38 0")["violations"].size(), 1u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts/1/restore?revision=0").status, 200u);
  EXPECT_EQ(b.hear("change").value("kind", ""), "command");
  EXPECT_EQ(b.hear("change")["kind"], "restore");
  EXPECT_EQ(server.end(SIGTERM), 0);
  EXPECT_EQ(b.hear("bye")["type"], "bye");
}

TEST(Serve, KilledAtAnyMomentItKeepsEveryAcknowledgedGesture) {
  const TemporaryFolder folder;
  Random random(cases::seed(), 1);
  auto server = std::make_unique<ServerProcess>(folder.path());
  const int layout = create(*server);
  long acknowledged = 0;
  std::size_t commands = 0;
  for (std::size_t round = 0; round < cases::case_count(3); ++round) {
    std::thread killer;
    try {
      Client client(*server, layout, "anna");
      client.hear("layout");
      ASSERT_GE(client.revision(), acknowledged) << "an acknowledged gesture is lost";
      ASSERT_LE(client.revision(), acknowledged + 1) << "more than the one gesture without an answer";
      const auto wait = std::chrono::microseconds(random.below(300'000));
      killer = std::thread([&server, wait] {
        std::this_thread::sleep_for(wait);
        server->kill_now();
      });
      acknowledged = client.revision();
      for (;;) {
        const Json said = random.below(5) == 0
                              ? client.ask({{"type", random.below(2) == 0 ? "undo" : "redo"}})
                              : client.command(random_command(random));
        if (said["type"] == "done") acknowledged = said["revision"];
        ++commands;
      }
    } catch (const std::exception&) {  // the connection ended
    }
    if (killer.joinable()) killer.join();
    server = std::make_unique<ServerProcess>(folder.path());
    const Answer exported = ask(*server, http::verb::get, "/api/layouts/1/export?form=layout");
    ASSERT_EQ(exported.status, 200u) << exported.body;
    write_bytes(folder / "now.json", exported.body);
    ASSERT_EQ(run(folder.path(), {"check", "now.json"}).status, 0);
    Client client(*server, layout);
    client.hear("layout");
    ASSERT_GE(client.revision(), acknowledged);
    ASSERT_LE(client.revision(), acknowledged + 1);
    acknowledged = client.revision();
  }
  EXPECT_GT(commands, 0u);
  std::printf("%zu gestures, %ld revisions\n", commands, acknowledged);
}

TEST(Serve, RefusesStrangersAndStaysUp) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path(), {"--token", "secret-99"});
  const std::map<std::string, std::string> known{{"Authorization", "Bearer secret-99"}};
  const auto status = [&](const std::string& target, std::map<std::string, std::string> headers) {
    return ask(server, http::verb::get, target, "", headers).status;
  };
  EXPECT_EQ(status("/api/layouts", {}), 403u);
  EXPECT_EQ(status("/api/layouts", {{"Authorization", "Bearer secret-98"}}), 403u);
  EXPECT_EQ(status("/api/layouts?token=secret-99", {}), 200u);
  EXPECT_EQ(status("/api/layouts", known), 200u);
  auto other = known;
  other["Host"] = "evil.example:80";
  EXPECT_EQ(status("/", other), 403u);
  other = known;
  other["Origin"] = "http://evil.example";
  EXPECT_EQ(status("/", other), 403u);
  for (const char* path :
       {"/../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/index.html/..",
        "/api/layouts/../1", "/api/layouts/1e3/history", "/api/layouts/-1/history",
        "/api/layouts/99999999999999999999/history", "/api/layouts/7/history"})
    EXPECT_EQ(status(path, known), 404u) << path;
  EXPECT_EQ(ask(server, http::verb::put, "/api/layouts", "", known).status, 405u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts?name=a", "no layout", known).status, 400u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts", squares(), known).status, 400u);
  EXPECT_EQ(ask(server, http::verb::patch, "/api/layouts/1?name=x", std::string(100, 'x'), known).status,
            413u);
  EXPECT_EQ(
      ask(server, http::verb::post, "/api/layouts?name=a", std::string((64u << 20) + 1, ' '), known).status,
      413u);
  EXPECT_THROW(Client(server, 1), std::exception);
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts?name=a", squares(), known).status, 201u);
  EXPECT_THROW(
      Client(server, 1, "", {{"Authorization", "Bearer secret-99"}, {"Origin", "http://evil.example"}}),
      std::exception);
  {
    Client client(server, 1, "", known);
    client.hear("layout");
    const std::string faults[] = {"",
                                  "{",
                                  "[]",
                                  "7",
                                  "{\"type\": \"command\"}",
                                  "{\"type\": \"delete\", \"seq\": 1}",
                                  "{\"type\": \"undo\", \"seq\": -1}",
                                  "{\"type\": \"undo\", \"seq\": 1, \"x\": 1}",
                                  "{\"type\": \"undo\", \"seq\": 1, \"seq\": 1}",
                                  std::string(100'000, '['),
                                  "{\"type\": \"select\", \"ids\": [[1]]}"};
    for (const std::string& fault : faults) {
      client.send(fault);
      EXPECT_FALSE(client.hear("error")["message"].get<std::string>().empty());
    }
    EXPECT_EQ(client.command("move 1 by 1 0")["type"], "done");
    EXPECT_THROW(
        for (int i = 0; i < 20; ++i) {
          client.send("x");
          client.hear("error");
        } client.hear(),
        std::exception);
    EXPECT_EQ(client.socket().reason().code, websocket::close_code::policy_error);
  }
  {
    Client client(server, 1, "", known);
    client.hear("layout");
    EXPECT_THROW(client.send(std::string((1u << 20) + 1, ' ')); for (;;) client.hear(), std::exception);
  }
  Random random(cases::seed(), 2);
  for (int i = 0; i < 16; ++i) {  // a million random bytes, some after a word that is understood
    asio::io_context io;
    tcp::socket socket = connected(io, server.port());
    std::string bytes = i % 2 == 0 ? "" : "GET /api/layouts HTTP/1.1\r\nHost: ";
    for (int k = 0; k < 65536; ++k) bytes += static_cast<char>(random.below(256));
    beast::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
  }
  EXPECT_EQ(status("/api/layouts", known), 200u);
}

TEST(Serve, SaysWhenThePortOrTheStoreIsTaken) {
  const TemporaryFolder folder, other;
  ServerProcess server(folder.path());
  const Ran port = run(folder.path(), {"serve", "--store", (other / "s.sqlite").string(), "--port",
                                       std::to_string(server.port())});
  EXPECT_EQ(port.status, 5);
  EXPECT_NE(port.err.find("is in use"), std::string::npos) << port.err;
  const Ran store = run(folder.path(), {"serve", "--store", "store.sqlite", "--port", "0"});
  EXPECT_EQ(store.status, 5);
  EXPECT_NE(store.err.find("another program uses"), std::string::npos) << store.err;
}

TEST(Serve, FortyClientsAgreeInTheEnd) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path());
  // 2 s in the quick suite; LEKALO_CASES=200 gives the 60 s of the full one.
  const auto time = std::chrono::milliseconds(std::min<std::size_t>(60'000, 700 * cases::case_count(3)));
  std::vector<int> layouts{create(server)};
  for (int i = 0; i < 20; ++i) layouts.push_back(create(server));
  std::mutex lock;
  std::vector<double> shared_ms, alone_ms;
  std::vector<std::map<long, Json>> ends;
  std::atomic<int> editing{20};
  const auto until = Clock::now() + time;
  std::vector<std::thread> threads;
  for (int i = 0; i < 40; ++i)
    threads.emplace_back([&, i] {
      Random random(cases::seed(), static_cast<std::uint64_t>(100 + i));
      const bool shared = i < 20;
      Client client(server, layouts[shared ? 0 : static_cast<std::size_t>(i - 19)]);
      client.hear("layout");
      std::vector<double> mine;
      while (Clock::now() < until) {
        const auto begin = Clock::now();
        client.command(random_command(random));
        mine.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
      }
      if (shared) {
        // When nobody edits any more, whoever has an answer has heard of everything before it.
        for (--editing; editing > 0;) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_EQ(client.command("move 1 by 0 0")["nothing"], true);
      }
      const std::lock_guard guard(lock);
      auto& all = shared ? shared_ms : alone_ms;
      all.insert(all.end(), mine.begin(), mine.end());
      if (shared) ends.push_back(client.placements());
    });
  std::this_thread::sleep_for(time / 3);
  const long early = server.resident_kb();
  for (std::thread& thread : threads) thread.join();
  const long late = server.resident_kb();
  const Answer exported = ask(server, http::verb::get, "/api/layouts/1/export?form=layout");
  std::map<long, Json> stored;
  const Json written = Json::parse(exported.body);
  for (const Json& one : written["placements"]) stored[one["id"]] = one;
  ASSERT_EQ(ends.size(), 20u);
  for (const auto& end : ends) EXPECT_EQ(end, stored);
  const auto table = [](const char* what, std::vector<double>& ms) {
    ASSERT_FALSE(ms.empty());
    std::sort(ms.begin(), ms.end());
    std::printf("%s: %zu gestures, median %.1f ms, 99 %% %.1f ms, most %.1f ms\n", what, ms.size(),
                ms[ms.size() / 2], ms[ms.size() * 99 / 100], ms.back());
  };
  table("20 on one layout", shared_ms);
  table("20 on their own ", alone_ms);
  std::printf("memory: %ld kB after a third, %ld kB at the end\n", early, late);
  EXPECT_LT(late, early + 64 * 1024);
}

}  // namespace
}  // namespace lekalo::test
