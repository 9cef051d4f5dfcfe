#include "server.hpp"

#include <fmt/core.h>
#include <sys/random.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "network/service.hpp"
#include "network/visit.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using boost::system::error_code;

/// After a signal the last words to clients may take this long, and what was begun this long in all.
constexpr std::chrono::milliseconds kFarewell{500}, kLastWork{1000};
constexpr auto kSweepEvery = std::chrono::milliseconds(250);

class Acceptor {
 public:
  Acceptor(Service& service, tcp::acceptor&& socket)
      : service_(service), socket_(std::move(socket)), pause_(service.io) {}
  /// Waits for the next connection, unless it does so already.
  void next() {
    if (waits_ || !socket_.is_open()) return;
    socket_.async_accept([this](error_code error, tcp::socket socket) {
      waits_ = false;
      if (error == asio::error::operation_aborted || !socket_.is_open()) return;
      if (error) return wait();  // out of descriptors, most likely
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      start_visit(service_, std::move(socket));
      next();
    });
    waits_ = true;
  }
  void close() {
    error_code ignored;
    socket_.close(ignored);
    pause_.cancel();
  }

 private:
  void wait() {
    pause_.expires_after(std::chrono::milliseconds(100));
    pause_.async_wait([this](error_code error) {
      if (!error) next();
    });
  }
  Service& service_;
  tcp::acceptor socket_;
  asio::steady_timer pause_;
  bool waits_ = false;
};

/// Ends the connections whose clients are too slow.
class Sweeper {
 public:
  explicit Sweeper(Service& service) : service_(service), timer_(service.io) {}
  /// Waits for the next time, unless it does so already.
  void next() {
    if (waits_ || service_.stopping) return;
    timer_.expires_after(kSweepEvery);
    timer_.async_wait([this](error_code error) {
      waits_ = false;
      if (error) return;
      service_.places.sweep(std::chrono::steady_clock::now());
      next();
    });
    waits_ = true;
  }
  void close() { timer_.cancel(); }

 private:
  Service& service_;
  asio::steady_timer timer_;
  bool waits_ = false;
};

/// Listens until a signal comes. Returns when it came.
Result<LaneTime> run_until_signal(Service& service, tcp::acceptor&& socket, const ServerOptions& options,
                                  const std::function<Result<void>(const std::string& url)>& listening) {
  Acceptor acceptor(service, std::move(socket));
  Sweeper sweeper(service);
  LaneTime signalled = std::chrono::steady_clock::now();
  asio::signal_set signals(service.io, SIGINT, SIGTERM);
  asio::steady_timer farewell(service.io);
  const auto stop = [&] {
    if (service.stopping) return;
    service.stopping = true;
    signalled = std::chrono::steady_clock::now();
    farewell.expires_after(kFarewell);
    farewell.async_wait([&](error_code) {
      service.places.cut_all();
      service.io.stop();
    });
    acceptor.close();
    sweeper.close();
    const auto talks = service.talks;  // one that is slow may go meanwhile
    for (const auto& [number, weak] : talks)
      if (const std::shared_ptr<Talk> talk = weak.lock())
        talk->say_goodbye("the server stops; everything that was acknowledged is kept");
  };
  signals.async_wait([&](error_code problem, int) {
    if (problem) return;
    signals.clear(problem);  // a second signal ends the program as usual
    stop();
  });

  const std::string host =
      options.address.find(':') != std::string::npos ? "[" + options.address + "]" : options.address;
  const std::string query = options.tells_token ? "?token=" + options.token : "";
  if (Result<void> said = listening(fmt::format("http://{}:{}/{}", host, service.rules.port, query)); !said)
    return tl::unexpected(said.error());
  for (;;) {
    try {
      acceptor.next();
      sweeper.next();
      service.io.run();
      return signalled;
    } catch (const std::bad_alloc&) {  // it ends the connection whose turn it was, and no other
    }
  }
}

}  // namespace

Result<bool> is_loopback(const std::string& address) {
  error_code error;
  const auto parsed = asio::ip::make_address(address, error);
  if (error)
    return failure(ErrorCode::usage,
                   fmt::format("\"{}\" is no address to listen on; it has to be one like 127.0.0.1, 0.0.0.0 "
                               "or ::1",
                               address));
  return parsed.is_loopback();
}

Result<std::string> random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    return failure(ErrorCode::environment, "the system gives no random bytes for a token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

Result<void> serve(const ServerOptions& options, Store store,
                   const std::function<Result<void>(const std::string& url)>& listening) {
  Service service(options, std::move(store));
  error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) return failure(ErrorCode::usage, options.address + " is no address to listen on");
  tcp::acceptor socket(service.io);
  const tcp::endpoint wanted(address, options.port);
  socket.open(wanted.protocol(), error);
  if (!error) socket.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) socket.bind(wanted, error);
  if (!error) socket.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use)
    return failure(ErrorCode::environment,
                   fmt::format("port {} of {} is in use; choose another with --port, or 0 for any",
                               options.port, options.address));
  if (error)
    return failure(ErrorCode::environment, fmt::format("cannot listen on port {} of {}: {}", options.port,
                                                       options.address, error.message()));
  service.rules.port = socket.local_endpoint().port();
  service.rules.any_host = address.is_unspecified();

  LEKALO_TRY(const LaneTime signalled, run_until_signal(service, std::move(socket), options, listening));
  if (service.end(signalled + kLastWork)) return {};
  // Work that nobody waits for is still under way, and does not hear that it should stop. What was
  // acknowledged is on the disk, so the process may end under it as it may be killed.
  std::fflush(nullptr);
  std::_Exit(0);
}

}  // namespace lekalo::server
