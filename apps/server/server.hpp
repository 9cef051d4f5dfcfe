#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "lekalo/base/error.hpp"
#include "store/store.hpp"

namespace lekalo::server {

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6
  std::uint16_t port = 0;             ///< 0 for any that is free
  /// The token that requests must carry; empty when none is asked for.
  /// \pre not empty unless the address is loopback
  std::string token;
  /// True when the address that is told holds the token, because nobody knows it yet.
  bool tells_token = false;
};

/// Says whether an address is one of this machine alone. Fails with ErrorCode::usage for a text that is no
/// address.
[[nodiscard]] Result<bool> is_loopback(const std::string& address);
/// Returns 128 bits from the system's source of randomness, as text.
[[nodiscard]] Result<std::string> random_token();

/// Serves docs/protocol.md until SIGINT or SIGTERM, then says goodbye to the clients and returns. One thread
/// serves the network and up to four the layouts, each of which is changed by one thread at a time.
[[nodiscard]] Result<void> serve(const ServerOptions& options, Store store,
                                 const std::function<Result<void>(const std::string& url)>& listening);

}  // namespace lekalo::server
