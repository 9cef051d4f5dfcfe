// `lekalo serve` under attack: slow rooms, large exports, half-sent uploads and idle connections all at once.
// A fresh client is answered meanwhile, and the server ends when it is told to.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <thread>

#include "serve_client.hpp"
#include "support/cases.hpp"

namespace lekalo::test::serve_starving_test {
namespace {

using std::chrono::milliseconds;

/// A server under a sanitizer needs several times as long for the same order; a smaller one shows the same.
#if defined(LEKALO_SANITIZE_ADDRESS) || defined(LEKALO_SANITIZE_THREAD)
constexpr int kShare = 2;
#else
constexpr int kShare = 1;
#endif

/// Rows of wheels with many teeth that nearly touch, on a sheet: whatever moves one has much to look at.
std::string wheels(int rows) {
  constexpr int kTeeth = 100;
  constexpr double kPitch = 10.3, kPi = 3.14159265358979;
  const std::string side = std::to_string(kPitch * (rows + 1));
  std::string text = R"({"format": "lekalo-layout/1", "units": "mm", "rules": {"gap": 0.1},
"stocks": [{"id": "sheet", "kind": "sheet", "outline": {"polygon": {"outer": [[0,0],[)" +
                     side + ",0],[" + side + "," + side + "],[0," + side + R"(]]}}}],
"parts": [{"id": "wheel", "outline": {"polygon": {"outer": [)";
  for (int k = 0; k < 2 * kTeeth; ++k) {
    const double radius = k % 2 == 0 ? 4.6 : 5, angle = kPi * k / kTeeth;
    text += std::string(k == 0 ? "[" : ",[") + std::to_string(radius * std::cos(angle)) + "," +
            std::to_string(radius * std::sin(angle)) + "]";
  }
  text += R"(]}}}], "placements": [)";
  for (int i = 0; i < rows * rows; ++i)
    text += std::string(i == 0 ? "" : ",") +
            R"({"part": "wheel", "stock": "sheet", "rotation_deg": 0, "x": )" +
            std::to_string(5.5 + kPitch * (i % rows)) + R"(, "y": )" +
            std::to_string(5.5 + kPitch * (i / rows)) + "}";
  return text + "]}";
}

double since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Threads that do something again and again until they are told to stop or the server is gone.
class Attackers {
 public:
  ~Attackers() { stop(); }
  void add(std::function<void(const std::atomic<bool>&)> act) {
    threads_.emplace_back([this, act = std::move(act)] {
      try {
        act(over_);
      } catch (const std::exception&) {  // the server ended
      }
    });
  }
  void stop() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  std::atomic<bool> over_ = false;
  std::vector<std::thread> threads_;
};

/// A connection from another address of this machine, as if of another peer.
tcp::socket connected_from(asio::io_context& io, const char* address, unsigned short port) {
  tcp::socket socket(io);
  socket.open(tcp::v4());
  beast::error_code error;
  socket.bind({asio::ip::make_address(address), 0}, error);
  socket.connect({asio::ip::make_address("127.0.0.1"), port}, error);
  return socket;
}

/// The time that a gesture of a client takes which comes for it and leaves again.
double fresh_gesture_ms(const ServerProcess& server, int layout, int number) {
  Client client(server, layout);
  client.hear("layout");
  const auto begin = Clock::now();
  const Json said = client.command(number % 2 == 0 ? "move 1 by 1 0" : "move 1 by -1 0");
  const double time = since(begin);
  EXPECT_EQ(said["type"], "done") << said;
  return time;
}

struct Times {
  std::vector<double> ms;
  [[nodiscard]] double share(double part) {
    std::sort(ms.begin(), ms.end());
    return ms[static_cast<std::size_t>(part * static_cast<double>(ms.size() - 1))];
  }
  void print(const char* what) {
    std::printf("%s: %zu gestures, median %.1f ms, 99 %% %.1f ms, most %.1f ms\n", what, ms.size(),
                share(0.5), share(0.99), share(1));
  }
};

TEST(ServeStarving, AFreshClientIsAnsweredWhileOthersTakeAllTheyCan) {
  const bool full = std::getenv("LEKALO_FULL") != nullptr;
  const TemporaryFolder folder, calm_folder;
  ServerProcess server(folder.path()), calm(calm_folder.path());
  const unsigned rooms = 2 * std::max(1U, std::thread::hardware_concurrency());
  const int fresh = create(server), calm_layout = create(calm);
  const auto post = [&](const std::string& name, const std::string& file) {
    const Answer made = ask(server, http::verb::post, "/api/layouts?name=" + name, file);
    EXPECT_EQ(made.status, 201u) << made.body;
    return static_cast<int>(Json::parse(made.body)["id"]);
  };
  const int large = post("large", wheels(100 / kShare));
  const std::string room_file = wheels(40 / kShare);

  Attackers attackers;
  std::atomic<long> slow_gestures = 0, exports = 0;
  std::vector<int> slow_rooms;
  for (unsigned i = 0; i < rooms; ++i) slow_rooms.push_back(post("slow", room_file));
  for (const int room : slow_rooms)
    attackers.add([&server, &slow_gestures, room](const std::atomic<bool>& over) {
      Client client(server, room);
      client.hear("layout");
      while (!over) {
        client.ask({{"type", "preview"}, {"mode", "strict"}, {"text", "push 1 by 100 0"}});
        ++slow_gestures;
      }
    });
  for (int i = 0; i < 4; ++i)
    attackers.add([&server, &exports, large, i](const std::atomic<bool>& over) {
      const std::string form = i % 2 == 0 ? "pdf" : "dxf";
      while (!over) {
        ask(server, http::verb::get, "/api/layouts/" + std::to_string(large) + "/export?form=" + form);
        ++exports;
      }
    });
  asio::io_context io;
  std::vector<tcp::socket> held;
  const std::string half(std::size_t{4} << 20, ' ');
  for (int i = 0; i < 24; ++i) {
    held.push_back(connected(io, server.port()));
    const std::string head = "POST /api/layouts?name=half HTTP/1.1\r\nHost: " + server.host() +
                             "\r\nContent-Length: " + std::to_string(2 * half.size()) + "\r\n\r\n";
    beast::error_code error;
    asio::write(held.back(), asio::buffer(head + half), error);
  }
  for (int i = 0; i < 512; ++i)
    held.push_back(connected_from(io, i % 2 == 0 ? "127.0.0.2" : "127.0.0.3", server.port()));
  std::this_thread::sleep_for(milliseconds(1500));  // so long a silent connection keeps its place

  Times under_attack, alone;
  const int gestures = full ? 400 : 30;
  for (int i = 0; i < gestures; ++i) {
    under_attack.ms.push_back(fresh_gesture_ms(server, fresh, i));
    alone.ms.push_back(fresh_gesture_ms(calm, calm_layout, i));
  }
  under_attack.print("under attack      ");
  alone.print("an idle server too");
  std::printf("meanwhile: %ld slow gestures in %u rooms, %ld exports; %ld MB in memory\n",
              slow_gestures.load(), rooms, exports.load(), server.resident_kb() / 1024);
  // A machine that does other things as well is slow for the idle server too.
  EXPECT_LE(under_attack.share(0.5), 100 + 4 * alone.share(0.9));
  if (full) {
    EXPECT_LE(under_attack.share(0.99), 100);
  }

  const auto begin = Clock::now();
  EXPECT_EQ(server.end(SIGTERM), 0);
  const double ended = since(begin) / 1000;
  std::printf("SIGTERM: ended after %.2f s\n", ended);
  EXPECT_LE(ended, full ? 3 : 6);
  attackers.stop();
}

/// The processor time that the server takes from now on until it is idle. \param hang_up  is called when it
/// has computed for so many seconds
double seconds_until_idle(const ServerProcess& server, double seconds, const std::function<void()>& hang_up) {
  const double begin = server.processor_seconds();
  while (server.processor_seconds() - begin < seconds) std::this_thread::sleep_for(milliseconds(5));
  hang_up();
  for (double before = 0;;) {
    const double now = server.processor_seconds();
    if (now - before < 0.02) return now - begin;
    before = now;
    std::this_thread::sleep_for(milliseconds(500));
  }
}

TEST(ServeStarving, WorkOfAClientWhoHasGoneEnds) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const int rows = std::getenv("LEKALO_FULL") != nullptr ? 60 : 30;
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts?name=large", wheels(rows / kShare)).status, 201u);
  const auto whole = [&](const std::function<void()>& work) {
    const double begin = server.processor_seconds();
    work();
    return server.processor_seconds() - begin;
  };
  // A PDF is compressed inside the library that draws it, which hears no stop (docs/limits.md).
  const std::string target = "/api/layouts/1/export?form=gcode&kerf=0.02&feed=1000";
  const double all = whole([&] { EXPECT_EQ(ask(server, http::verb::get, target).status, 200u); });
  asio::io_context io;
  tcp::socket socket = connected(io, server.port());
  asio::write(socket, asio::buffer("GET " + target + " HTTP/1.1\r\nHost: " + server.host() + "\r\n\r\n"));
  const double some = seconds_until_idle(server, all / 10, [&] { socket.close(); });
  std::printf("an export: %.2f s, of a client who has gone %.2f s\n", all, some);
  EXPECT_LT(some, 0.7 * all);

  const Json push{{"type", "preview"}, {"mode", "strict"}, {"text", "push 1 by 100 0"}};
  auto client = std::make_unique<Client>(server, 1);
  client->hear("layout");
  const double gesture = whole([&] { client->ask(push); });
  Json again = push;
  again["seq"] = 1000;
  client->send(again.dump());
  const double part = seconds_until_idle(server, gesture / 10, [&] { client.reset(); });
  std::printf("a gesture: %.2f s, of a client who has gone %.2f s\n", gesture, part);
  EXPECT_LT(part, 0.7 * gesture);
}

}  // namespace
}  // namespace lekalo::test::serve_starving_test
