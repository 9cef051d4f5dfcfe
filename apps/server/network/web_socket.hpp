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

/// One WebSocket that carries text frames; messages are read and written one at a time. Beast's stream stands
/// behind it. The compiler needs long for the operations of that stream, so they stand in files of their own
/// (web_socket.cpp, web_socket_read.cpp, web_socket_write.cpp) and nobody else sees them.
///
/// Only the network's thread uses it. Each operation calls back once, later, and says whether it was done.
/// What the operation uses has to live until then.
class WebSocket {
 public:
  using Done = std::function<void(bool done)>;
  struct Limits {
    /// The subprotocol that the handshake agrees on.
    std::string subprotocol;
    /// The largest message, in bytes. A larger one ends the connection.
    std::size_t message = 0;
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
  /// Waits for a message, which `message` returns once it is there.
  void read(Done done);
  [[nodiscard]] Message message();
  /// \param bytes  has to live until it is called back
  void write(std::string_view bytes, Done done);
  /// Closes the connection with a closing frame.
  void close(Close reason, Done done);
  /// Ends the connection at once, whatever waits to be sent.
  void cut();

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace lekalo::server
