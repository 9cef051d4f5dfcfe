#pragma once

// `lekalo serve` as a process of its own, and clients of it with real sockets.

#include <sys/resource.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <csignal>
#include <fstream>

#include "cli_run.hpp"
#include "support/places.hpp"

namespace lekalo::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;

/// Twelve squares of 10 on a sheet of 200.
inline std::string squares() {
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
  /// \param file_limit  bytes a file of the server may have, as on a disk that fills up; 0: no limit
  /// \param environment  NAME=VALUE, beside what the test itself runs in
  explicit ServerProcess(const fs::path& folder, const Words& more = {}, rlim_t file_limit = 0,
                         Words environment = {}) {
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
      for (std::string& one : environment) putenv(one.data());
      if (file_limit > 0) {
        const rlimit limit{file_limit, file_limit};
        setrlimit(RLIMIT_FSIZE, &limit);
        signal(SIGXFSZ, SIG_IGN);
      }
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
  /// The time that the server has computed.
  [[nodiscard]] double processor_seconds() const {
    std::ifstream file("/proc/" + std::to_string(process_) + "/stat");
    std::string word;
    for (int i = 0; i < 13; ++i) file >> word;
    double user = 0, system = 0;
    file >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
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

inline tcp::socket connected(asio::io_context& io, unsigned short port) {
  tcp::socket socket(io);
  socket.connect({asio::ip::make_address("127.0.0.1"), port});
  return socket;
}

struct Answer {
  unsigned status = 0;
  std::string body;
  std::string notes;  ///< the header Lekalo-Notes
};

inline Answer ask(const ServerProcess& server, http::verb method, const std::string& target,
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
  return {parser.get().result_int(), parser.get().body(), std::string(parser.get()["Lekalo-Notes"])};
}

inline int create(const ServerProcess& server) {
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
      features_.clear();
      for (const Json& stock : said["document"]["stocks"])
        for (const auto& [list, kind] : {std::pair{"defects", "defect"}, {"zones", "zone"}})
          if (stock.contains(list))
            for (const Json& one : stock[list])
              features_[{stock["id"].get<std::string>(), kind}].push_back(one);
    } else if (said["type"] == "change") {
      EXPECT_EQ(said["revision"].get<long>(), revision_ + 1);
      revision_ = said["revision"];
      for (const Json& one : said["placements"]) {
        if (one["after"].is_null())
          placements_.erase(one["id"]);
        else
          placements_[one["id"]] = one["after"];
      }
      for (const Json& one : said["features"]) {
        auto& list = features_[{one["stock"].get<std::string>(), one["kind"].get<std::string>()}];
        const auto at = std::find_if(list.begin(), list.end(),
                                     [&](const Json& known) { return known["id"] == one["id"]; });
        if (one["after"].is_null())
          list.erase(at);
        else if (at != list.end())
          *at = one["after"];
        else
          list.insert(list.begin() + std::min(one["index"].get<long>(), static_cast<long>(list.size())),
                      one["after"]);
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
      const bool on_the_way = said["type"] == "progress" || said["type"] == "improved";
      if (!on_the_way && said.contains("seq") && said["seq"] == seq_) return said;
    }
  }
  Json command(const std::string& text, const std::string& mode = "strict") {
    return ask({{"type", "command"}, {"mode", mode}, {"text", text}});
  }
  websocket::stream<tcp::socket>& socket() { return socket_; }
  [[nodiscard]] long revision() const { return revision_; }
  /// As it was told, by `layout` and the changes since.
  [[nodiscard]] Json document() const {
    Json all{{"placements", Json::array()}, {"features", Json::array()}};
    for (const auto& [id, one] : placements_) all["placements"].push_back(one);
    for (const auto& [where, list] : features_)
      if (!list.empty()) all["features"].push_back({where.first, where.second, list});
    return all;
  }

 private:
  asio::io_context io_;
  websocket::stream<tcp::socket> socket_;
  std::map<long, Json> placements_;
  std::map<std::pair<std::string, std::string>, std::vector<Json>> features_;  ///< by stock and kind
  long revision_ = -1;
  std::uint64_t seq_ = 0;
};

}  // namespace lekalo::test
