#include "web_socket_stream.hpp"

namespace lekalo::server {

void WebSocket::close(Close reason, Done done) {
  using boost::beast::websocket::close_code;
  stream_->socket.async_close(reason == Close::policy ? close_code::policy_error : close_code::going_away,
                              [done = std::move(done)](boost::system::error_code error) { done(!error); });
}

}  // namespace lekalo::server
