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
#include <memory>
#include <utility>

#include "network/service.hpp"
#include "network/visit.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostConnections = 512;
/// The last words to clients may take this long.
constexpr auto kFarewell = std::chrono::seconds(1);

class Acceptor {
 public:
  Acceptor(Service& service, tcp::acceptor&& socket)
      : service_(service), socket_(std::move(socket)), pause_(service.io) {}
  void next() {
    socket_.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted || !socket_.is_open()) return;
      if (error) return wait();  // out of descriptors, most likely
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      if (service_.connections < kMostConnections) start_visit(service_, std::move(socket));
      next();
    });
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
};

/// Listens until a signal comes.
Result<void> run_until_signal(Service& service, tcp::acceptor&& socket, const ServerOptions& options,
                              const std::function<Result<void>(const std::string& url)>& listening) {
  Acceptor acceptor(service, std::move(socket));
  asio::signal_set signals(service.io, SIGINT, SIGTERM);
  asio::steady_timer farewell(service.io);
  const auto stop = [&] {
    if (service.stopping) return;
    service.stopping = true;
    acceptor.close();
    for (const auto& [number, weak] : service.talks)
      if (const std::shared_ptr<Talk> talk = weak.lock())
        talk->say_goodbye("the server stops; everything that was acknowledged is kept");
    farewell.expires_after(kFarewell);
    farewell.async_wait([&](error_code) { service.io.stop(); });
  };
  signals.async_wait([&](error_code problem, int) {
    if (problem) return;
    signals.clear(problem);  // a second signal ends the program as usual
    stop();
  });

  const std::string host =
      options.address.find(':') != std::string::npos ? "[" + options.address + "]" : options.address;
  const std::string query = options.token.empty() ? "" : "?token=" + options.token;
  if (Result<void> said = listening(fmt::format("http://{}:{}/{}", host, service.rules.port, query)); !said)
    return said;
  acceptor.next();
  service.io.run();
  return {};
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

  Result<void> done = run_until_signal(service, std::move(socket), options, listening);
  service.end();
  return done;
}

}  // namespace lekalo::server
