#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lekalo::server {

/// The request that asks for a WebSocket.
using Upgrade = boost::beast::http::request<boost::beast::http::string_body>;

/// One WebSocket, text frames of messages that are read and written one at a time. Beast's stream stands
/// behind it: the compiler needs long for its operations, so they stand in files of their own
/// (web_socket.cpp, web_socket_read.cpp, web_socket_write.cpp) and nobody else sees them.
///
/// On the network's thread alone. Each operation calls back once, later, with whether it was done; what it
/// uses has to live until then.
class WebSocket {
 public:
  using Done = std::function<void(bool done)>;
  struct Limits {
    std::string subprotocol;  ///< agreed on in the handshake
    std::size_t message = 0;  ///< largest message, bytes; a larger one ends the connection
    std::chrono::seconds handshake{}, silence{};
  };
  enum class Close {
    policy,     ///< the client broke the rules
    going_away  ///< the server stops
  };
  struct Message {
    std::string bytes;
    bool is_text = false;
  };

  WebSocket(boost::asio::ip::tcp::socket&& socket, const Limits& limits);
  ~WebSocket();
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  /// Answers the request. \pre it is an upgrade
  void accept(const Upgrade& request, Done done);
  /// Waits for a message; `message` gives it then.
  void read(Done done);
  [[nodiscard]] Message message();
  /// \param bytes  has to live until it is called back
  void write(std::string_view bytes, Done done);
  /// Says goodbye.
  void close(Close reason, Done done);
  /// Ends the connection at once, whatever waits.
  void cut();

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace lekalo::server
