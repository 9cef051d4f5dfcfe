#include "web_socket.hpp"

#include "web_socket_stream.hpp"

namespace lekalo::server {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

}  // namespace

WebSocket::WebSocket(boost::asio::ip::tcp::socket&& socket, const Limits& limits)
    : stream_(std::make_unique<Stream>(std::move(socket))) {
  auto& stream = stream_->socket;
  websocket::stream_base::timeout times{};
  times.handshake_timeout = limits.handshake;
  times.idle_timeout = limits.silence;
  times.keep_alive_pings = true;
  stream.set_option(times);
  stream.set_option(websocket::stream_base::decorator(
      [subprotocol = limits.subprotocol](websocket::response_type& response) {
        response.set(beast::http::field::sec_websocket_protocol, subprotocol);
      }));
  stream.read_message_max(limits.message);
  stream.auto_fragment(false);
  stream.text(true);
}

WebSocket::~WebSocket() = default;

void WebSocket::accept(const Upgrade& request, Done done) {
  stream_->socket.async_accept(request,
                               [done = std::move(done)](boost::system::error_code error) { done(!error); });
}

WebSocket::Message WebSocket::message() {
  Message message{beast::buffers_to_string(stream_->incoming.data()), stream_->socket.got_text()};
  stream_->incoming.consume(stream_->incoming.size());
  return message;
}

void WebSocket::cut() { beast::get_lowest_layer(stream_->socket).close(); }

}  // namespace lekalo::server
