#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/layout/command.hpp"

namespace lekalo::server {

/// The messages of a client, as docs/protocol.md has them.

inline constexpr std::size_t kLargestMessage = std::size_t{1} << 20;
/// Most ids of a selection.
inline constexpr std::size_t kMostSelected = 100'000;
/// The largest `seq`, id and revision: JavaScript counts whole numbers up to here exactly.
inline constexpr std::uint64_t kLargestCount = (std::uint64_t{1} << 53) - 1;

struct CommandMessage {
  std::uint64_t seq = 0;
  layout::Mode mode = layout::Mode::strict;
  std::string text;
  bool preview = false;
};
struct UndoMessage {
  std::uint64_t seq = 0;
  bool redo = false;
};
/// Ends the client's own long command of this number early, with the best it has.
struct StopMessage {
  std::uint64_t seq = 0;
};
struct SelectMessage {
  std::vector<std::uint64_t> ids;
};
using ClientMessage = std::variant<CommandMessage, UndoMessage, SelectMessage, StopMessage>;

/// Reads one message. Fails with ErrorCode::bad_input and a sentence for anything else: not UTF-8, not one
/// JSON object, fields unknown, twice, missing or of another type, numbers out of range, texts with control
/// characters, lists within lists. Cost: O(bytes), and no more memory than a few times the bytes.
[[nodiscard]] Result<ClientMessage> parse_client_message(std::string_view bytes);

/// Fails with ErrorCode::bad_input unless the name has 1 to 200 bytes of UTF-8 without control characters.
[[nodiscard]] Result<void> check_layout_name(std::string_view name);
/// Fails likewise unless the name of an author has at most 64 bytes.
[[nodiscard]] Result<void> check_author(std::string_view author);

/// Reads the whole of a text as a number in [0, kLargestCount], digits only.
[[nodiscard]] std::optional<std::uint64_t> whole_number(std::string_view text);
/// Decodes %XX; returns nothing for a % that is not followed by two hexadecimal digits.
[[nodiscard]] std::optional<std::string> percent_decoded(std::string_view text);

/// A request's target, "/api/layouts/3?name=x": the path as it stands, and the decoded fields of the query.
struct Target {
  std::string path;
  std::vector<std::pair<std::string, std::string>> fields;
  /// The value of the field; none where it is absent.
  [[nodiscard]] const std::string* find(std::string_view name) const;
};
/// Returns nothing for a text that is no such target, or has a field twice.
[[nodiscard]] std::optional<Target> parse_target(std::string_view target);

}  // namespace lekalo::server
