#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <string>

#include "service.hpp"

namespace lekalo::server {

/// The WebSocket side of docs/protocol.md on the network.

/// What clients of a WebSocket have to offer.
inline constexpr std::string_view kSubprotocol = "lekalo.1";
/// How long the head of a request or the handshake of a WebSocket may take.
inline constexpr auto kHeaderTime = std::chrono::seconds(30);

/// Takes a connection over. \param request  the upgrade that was read from it
void start_talk(Service& service, boost::asio::ip::tcp::socket&& socket, LayoutId layout, std::string author,
                const boost::beast::http::request<boost::beast::http::string_body>& request);

}  // namespace lekalo::server
