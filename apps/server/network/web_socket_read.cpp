#include "web_socket_stream.hpp"

namespace lekalo::server {

void WebSocket::read(Done done) {
  stream_->socket.async_read(stream_->incoming, [done = std::move(done)](boost::system::error_code error,
                                                                         std::size_t) { done(!error); });
}

}  // namespace lekalo::server
