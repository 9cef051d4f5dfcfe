#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "service.hpp"

namespace lekalo::server {

/// Serves HTTP on a connection until it ends or becomes a WebSocket (talk.hpp).
void start_visit(Service& service, boost::asio::ip::tcp::socket&& socket);

}  // namespace lekalo::server
