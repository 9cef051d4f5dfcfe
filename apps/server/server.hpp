#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "lekalo/base/error.hpp"
#include "store/store.hpp"

namespace lekalo::server {

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6
  std::uint16_t port = 0;             ///< 0: any that is free
  std::string token;                  ///< empty: none is asked for. \pre not empty unless address is loopback
};

/// Says whether an address is one of this machine alone. Fails with ErrorCode::usage for what is no address.
[[nodiscard]] Result<bool> is_loopback(const std::string& address);
/// 128 bits from the system's source of randomness, as text.
[[nodiscard]] Result<std::string> random_token();

/// Serves docs/protocol.md until SIGINT or SIGTERM, then says goodbye to the clients and returns. One thread
/// for the network, up to four for the layouts, each of which is changed by one thread at a time.
///
/// \param listening  called once, with the URL of the page, when connections are accepted; its failure ends
///                   the server
/// Fails with ErrorCode::environment where the port is in use or cannot be had.
[[nodiscard]] Result<void> serve(const ServerOptions& options, Store store,
                                 const std::function<Result<void>(const std::string& url)>& listening);

}  // namespace lekalo::server
