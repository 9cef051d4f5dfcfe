#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <utility>

#include "web_socket.hpp"

namespace lekalo::server {

/// The stream behind a WebSocket, for the files that implement it.
struct WebSocket::Stream {
  explicit Stream(boost::asio::ip::tcp::socket&& connection) : socket(std::move(connection)) {}
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket;
  boost::beast::flat_buffer incoming;
};

}  // namespace lekalo::server
