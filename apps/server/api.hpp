#pragma once

#include <functional>
#include <string>

#include "messages.hpp"
#include "room.hpp"
#include "store.hpp"

namespace lekalo::server {

/// The HTTP side of docs/protocol.md without the network.

struct ApiAnswer {
  int status = 200;
  std::string body;
  std::string type = "application/json";
  std::string file_name;  ///< not empty: to be saved under this name
  std::string allow;      ///< with 405: the methods that there are
};

[[nodiscard]] ApiAnswer api_error(int status, const std::string& sentence);

/// Runs a change of a layout where nobody else changes it, with the layout opened, and hands what it says to
/// the clients.
using ChangeRoom = std::function<Result<void>(LayoutId, const std::function<Result<Outbound>(Room&)>&)>;

/// Answers a request whose path begins with /api. \param method  as HTTP has it
[[nodiscard]] ApiAnswer answer_api(Store& store, const ChangeRoom& change_room, const std::string& method,
                                   const Target& target, const std::string& body);

}  // namespace lekalo::server
