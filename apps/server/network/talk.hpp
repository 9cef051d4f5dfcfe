#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "service.hpp"
#include "web_socket.hpp"

namespace lekalo::server {

/// The WebSocket side of docs/protocol.md on the network.

/// The subprotocol that clients of a WebSocket have to offer.
inline constexpr std::string_view kSubprotocol = "lekalo.1";
/// The longest time for the head of a request, from the end of the last one, and for the handshake of a
/// WebSocket.
inline constexpr auto kHeaderTime = std::chrono::seconds(15);

/// Takes a connection over, with its place. \param request  the upgrade that was read from it
void start_talk(Service& service, boost::asio::ip::tcp::socket&& socket, std::unique_ptr<Place> place,
                LayoutId layout, std::string author, const Upgrade& request);

}  // namespace lekalo::server
