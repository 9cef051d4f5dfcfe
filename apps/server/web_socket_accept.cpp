#include "web_socket_stream.hpp"

namespace lekalo::server {

void WebSocket::accept(const Upgrade& request, Done done) {
  stream_->socket.async_accept(request,
                               [done = std::move(done)](boost::system::error_code error) { done(!error); });
}

}  // namespace lekalo::server
