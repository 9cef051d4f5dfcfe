#include "web_socket_stream.hpp"

namespace lekalo::server {

void WebSocket::write(std::string_view bytes, Done done) {
  stream_->socket.async_write(
      boost::asio::buffer(bytes.data(), bytes.size()),
      [done = std::move(done)](boost::system::error_code error, std::size_t) { done(!error); });
}

void WebSocket::close(Close reason, Done done) {
  using boost::beast::websocket::close_code;
  stream_->socket.async_close(reason == Close::policy ? close_code::policy_error : close_code::going_away,
                              [done = std::move(done)](boost::system::error_code error) { done(!error); });
}

}  // namespace lekalo::server
