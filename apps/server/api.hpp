#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/jobs/layout.hpp"
#include "messages.hpp"
#include "room.hpp"
#include "store/store.hpp"

namespace lekalo::server {

/// The HTTP side of docs/protocol.md without the network.

struct ApiAnswer {
  int status = 200;
  std::string body;
  std::string type = "application/json";
  /// The name under which a browser saves the body; empty when it does not.
  std::string file_name;
  /// With status 405, the methods that the path has.
  std::string allow;
  /// Notes about a file that was read: a JSON array of sentences in ASCII, or empty.
  std::string notes;
};

/// The most bytes of a photograph.
inline constexpr std::size_t kLargestPhoto = std::size_t{16} << 20;
/// Returns the type of an image by its first bytes: "image/png", "image/jpeg", or "" for all others.
[[nodiscard]] std::string image_type(std::string_view bytes);
/// Returns the most bytes of body that a request may have, 0 when it may have none.
[[nodiscard]] std::size_t most_body(std::string_view method, std::string_view path);

[[nodiscard]] ApiAnswer api_error(int status, const std::string& sentence);

/// Returns the layout that a request changes where nobody else does; nothing for requests that change none.
[[nodiscard]] std::optional<LayoutId> layout_changed_by(std::string_view method, std::string_view path);
/// Says whether a request is expected to take long: it reads a large file, or a whole layout from the store.
[[nodiscard]] bool takes_long(std::string_view method, std::string_view path, std::size_t body);

/// Changes the layout that the request changes, which is open and changed by nobody else meanwhile. What the
/// change says goes to the clients.
using ChangeRoom = std::function<Result<void>(const std::function<Result<Outbound>(Room&)>&)>;

/// A request may bring something that takes a while to read, so that it is read before the turn of the
/// layout's room comes.
struct ReadFirst {
  std::optional<Result<jobs::Layout>> additions;
};
/// Says whether read_first has something to read.
[[nodiscard]] bool is_read_first(std::string_view method, std::string_view path);
[[nodiscard]] ReadFirst read_first(const std::string& body);

/// Answers a request whose path begins with /api.
/// \param change_room  is called for the layout of layout_changed_by, and for no other
/// \param method  as HTTP has it
/// \param read  what read_first has read of the body, where is_read_first says so
/// \param given_up  set when nobody waits for the answer any more. A file that has been read by then makes no
/// layout.
[[nodiscard]] ApiAnswer answer_api(Store& store, const ChangeRoom& change_room, const std::string& method,
                                   const Target& target, const std::string& body, ReadFirst read,
                                   const std::atomic<bool>& given_up);

}  // namespace lekalo::server
