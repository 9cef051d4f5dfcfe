// `lekalo serve` and somebody who tries what the protocol does not mean: it is refused, and others go on.

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <functional>
#include <sstream>
#include <thread>

#include "lekalo/base/random.hpp"
#include "serve_client.hpp"
#include "support/cases.hpp"

namespace lekalo::test::serve_attack_test {
namespace {

/// A frame of a client, masked with zeros. \param first  its flags and what it is
std::string frame(unsigned char first, const std::string& bytes, bool masked = true) {
  std::string all(1, static_cast<char>(first));
  const auto mask = static_cast<unsigned char>(masked ? 0x80 : 0);
  const std::size_t size = bytes.size();
  if (size < 126) {
    all += static_cast<char>(mask | size);
  } else {
    all += static_cast<char>(mask | 126U);
    all += static_cast<char>(size >> 8U);
    all += static_cast<char>(size & 0xffU);
  }
  return all + (masked ? std::string(4, '\0') : "") + bytes;
}

constexpr unsigned char kText = 0x1, kGoesOn = 0x0, kPing = 0x9, kLast = 0x80;

TEST(ServeAttack, FragmentsAreOneMessageAndHaveAnEnd) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const int layout = create(server);
  Client other(server, layout);
  other.hear("layout");
  {
    Client client(server, layout);
    client.hear("layout");
    const std::string said = R"({"type": "command", "seq": 1, "mode": "strict", "text": "move 1 by 1 0"})";
    std::string frames;
    for (std::size_t i = 0; i < said.size(); ++i) {
      frames +=
          frame(static_cast<unsigned char>((i == 0 ? kText : kGoesOn) | (i + 1 == said.size() ? kLast : 0)),
                said.substr(i, 1));
      frames += frame(kLast | kPing, "between");
    }
    asio::write(client.socket().next_layer(), asio::buffer(frames));
    EXPECT_EQ(client.hear("done")["seq"], 1);
  }
  std::string endless = frame(kText, std::string(60'000, ' '));
  for (int i = 0; i < 20; ++i) endless += frame(kGoesOn, std::string(60'000, ' '));
  const std::map<std::string, std::string> wrong{
      {"no end", endless},
      {"a length of 2^63 - 1", "\x81\xff\x7f" + std::string(7, '\xff') + std::string(4, '\0')},
      {"not masked", frame(kLast | kText, "{}", false)},
      {"reserved bits", frame(0xf1, "{}")},
      {"a long ping", frame(kLast | kPing, std::string(126, ' '))},
      {"no UTF-8", frame(kLast | kText, "\xff\xfe")},
      {"goes on with nothing", frame(kLast | kGoesOn, "{}")},
      {"one text within another", frame(kText, "{") + frame(kLast | kText, "}")},
      {"an unknown kind", frame(kLast | 0x5, "{}")}};
  for (const auto& [what, bytes] : wrong) {
    SCOPED_TRACE(what);
    Client client(server, layout);
    client.hear("layout");
    beast::error_code error;
    asio::write(client.socket().next_layer(), asio::buffer(bytes), error);
    EXPECT_THROW(for (;;) client.hear(), std::exception);
  }
  EXPECT_EQ(other.command("move 2 by 1 0")["type"], "done");
}

TEST(ServeAttack, ARequestThatCanBeReadInTwoWaysIsRefused) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  create(server);
  const std::string post = "POST /api/layouts?name=a HTTP/1.1\r\n", get = "GET /api/layouts HTTP/1.1\r\n",
                    host = "Host: " + server.host() + "\r\n";
  std::string fields;
  for (int i = 0; i < 65; ++i) fields += "&f" + std::to_string(i);
  const std::map<std::string, std::string> wrong{
      {"two lengths", post + host + "Content-Length: 5\r\nContent-Length: 6\r\n\r\nabcdef"},
      {"a length and chunks",
       post + host + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"},
      {"a length below 0", post + host + "Content-Length: -1\r\n\r\nabcdef"},
      {"a length of 2^64 - 1", post + host + "Content-Length: 18446744073709551615\r\n\r\nabcdef"},
      {"a chunk of 2^64 - 1", post + host + "Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFF\r\nabcde"},
      {"a body where none is", get + host + "Transfer-Encoding: chunked\r\n\r\n5\r\nabcde\r\n0\r\n\r\n"},
      {"two hosts", get + host + "Host: evil.example\r\n\r\n"},
      {"no host", get + "\r\n"},
      {"a host whose name was made to lead here", get + "Host: evil.example\r\n\r\n"},
      {"two origins", get + host + "Origin: null\r\nOrigin: http://" + server.host() + "\r\n\r\n"},
      {"no origin that has a name", get + host + "Origin: null\r\n\r\n"},
      {"a whole address", "GET http://" + server.host() + "/api/layouts HTTP/1.1\r\n" + host + "\r\n"},
      {"a way to another", "CONNECT evil.example:80 HTTP/1.1\r\n" + host + "\r\n"},
      {"a null byte", std::string("GET /\0 HTTP/1.1\r\n", 17) + host + "\r\n"},
      {"too many fields", "GET /api/layouts?a" + fields + " HTTP/1.1\r\n" + host + "\r\n"},
      {"headers of 17,000 bytes", get + host + "X: " + std::string(17'000, 'a') + "\r\n\r\n"},
      {"a link to a file of the API", get + host +
                                          "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\n" +
                                          "Sec-Fetch-Dest: document\r\n\r\n"}};
  for (const auto& [what, bytes] : wrong) {
    SCOPED_TRACE(what);
    asio::io_context io;
    tcp::socket socket = connected(io, server.port());
    beast::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
    socket.shutdown(tcp::socket::shutdown_send, error);
    std::string said;
    asio::read(socket, asio::dynamic_buffer(said), error);  // until the server ends the connection
    if (!said.empty()) {
      EXPECT_EQ(said.substr(0, 10), "HTTP/1.1 4") << said.substr(0, 100);
    }
    EXPECT_EQ(said.find("HTTP/1.1", 8), std::string::npos) << "one answer, to one request";
  }
  EXPECT_EQ(Json::parse(ask(server, http::verb::get, "/api/layouts").body)["layouts"].size(), 1U);
}

TEST(ServeAttack, HalfHeadsOfOneAddressLeaveRoomForOthers) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const int layout = create(server);
  asio::io_context io;
  std::vector<tcp::socket> held;
  for (int i = 0; i < 600; ++i) {
    tcp::socket& socket = held.emplace_back(io);
    beast::error_code error;
    socket.open(tcp::v4(), error);
    socket.bind({asio::ip::make_address("127.0.0.2"), 0}, error);
    socket.connect({asio::ip::make_address("127.0.0.1"), server.port()}, error);
    asio::write(socket, asio::buffer(std::string("GET / HTTP/1.1\r\nHost: ")), error);
  }
  Client client(server, layout);
  client.hear("layout");
  EXPECT_EQ(client.command("move 1 by 1 0")["type"], "done");
  EXPECT_EQ(ask(server, http::verb::get, "/api/layouts").status, 200U);
}

/// What a client does; how far it was acknowledged. It ends where the server does.
struct Session {
  int layout = 0;
  long acknowledged = 0;
  void run(const ServerProcess& server) {
    try {
      const Answer made = ask(server, http::verb::post, "/api/layouts?name=squares", squares());
      if (made.status != 201) return;
      layout = Json::parse(made.body)["id"];
      for (int visit = 0; visit < 4; ++visit) {
        try {
          Client client(server, layout, "anna");
          client.hear("layout");
          for (int i = 0; i < 4; ++i) {
            const Json said = i == 2 ? client.ask({{"type", "undo"}})
                                     : client.command("move " + std::to_string(1 + visit) + " by 1 0");
            if (said["type"] == "done") acknowledged = said["revision"];
          }
        } catch (const std::exception&) {  // this connection ended, perhaps not the server
        }
        const std::string at = "/api/layouts/" + std::to_string(layout);
        ask(server, http::verb::get, at + "/export?form=dxf");
        const Answer restored = ask(server, http::verb::post, at + "/restore?revision=0");
        if (restored.status == 200) acknowledged = Json::parse(restored.body)["revision"];
      }
    } catch (const std::exception&) {  // the server ended
    }
  }
};

TEST(ServeAttack, MemoryThatEndsLosesNothingThatWasAcknowledged) {
  if (cases::faults_library().empty()) GTEST_SKIP() << "this build has no library that makes calls fail";
  const auto served = [](const fs::path& folder, const std::string& fault, Session& session) {
    Words environment{"LD_PRELOAD=" + cases::faults_library(),
                      "LEKALO_FAULT_REPORT=" + (folder / "report").string()};
    if (!fault.empty()) environment.push_back("LEKALO_FAULT=" + fault);
    ServerProcess server(folder, {}, 0, environment);
    if (server.port() != 0) session.run(server);
    return server.end(SIGTERM);
  };
  std::size_t calls = 0;
  {
    const TemporaryFolder folder;
    Session session;
    ASSERT_EQ(served(folder.path(), "", session), 0);
    ASSERT_EQ(session.acknowledged, 20);
    std::istringstream(read_bytes(folder / "report")) >> calls;
    ASSERT_GT(calls, 1000U);
  }
  std::map<int, int> ends;
  Random random(cases::seed(), 5);
  const std::size_t tried = cases::case_count(16);
  for (std::size_t i = 0; i < tried && !HasFailure(); ++i) {
    const std::size_t first = i * calls / tried, next = (i + 1) * calls / tried;
    const std::string fault = "memory:" + std::to_string(1 + first + random.below(next - first)) + ":12" +
                              (random.below(4) == 0 ? "+" : "");
    SCOPED_TRACE(fault);
    const TemporaryFolder folder;
    Session session;
    ++ends[served(folder.path(), fault, session)];
    ServerProcess server(folder.path());
    ASSERT_NE(server.port(), 0);
    if (session.layout != 0) {
      Client client(server, session.layout);
      client.hear("layout");
      EXPECT_GE(client.revision(), session.acknowledged) << "a gesture that was acknowledged is lost";
      EXPECT_EQ(client.command("move 9 by 1 0")["type"], "done");
    }
    server.end(SIGTERM);
    const Ran check = run(folder.path(), {"store", "check", "store.sqlite"});
    EXPECT_EQ(check.status, 0) << check.out << check.err;
  }
  for (const auto& [status, count] : ends) std::printf("status %d: %d of %zu\n", status, count, tried);
}

TEST(ServeAttack, WhoIsSlowLosesThePlace) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  asio::io_context io;
  tcp::socket dripping = connected(io, server.port());
  asio::write(dripping, asio::buffer("POST /api/layouts?name=half HTTP/1.1\r\nHost: " + server.host() +
                                     "\r\nContent-Length: 1000000\r\n\r\n"));
  const auto begin = Clock::now();
  const auto since = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - begin).count(); };
  beast::error_code error;
  while (!error && since() < 60'000) {
    asio::write(dripping, asio::buffer(" ", 1), error);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  std::printf("one byte each 0.1 s: cut after %.1f s\n", since() / 1000);
  EXPECT_TRUE(error);
  EXPECT_GE(since(), 4'000);
}

}  // namespace
}  // namespace lekalo::test::serve_attack_test
