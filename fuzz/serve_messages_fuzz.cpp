#include "io_contour_check.hpp"
#include "lekalo/base/plain_text.hpp"
#include "server/messages.hpp"

// What clients say, as any bytes: a sentence, or a message within its limits; targets of requests likewise.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lekalo;
  using fuzz::must;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto message = server::parse_client_message(bytes);
  if (!message) {
    must(message.error().code == ErrorCode::bad_input && !message.error().message.empty());
    must(is_plain_text(message.error().message));
  } else if (const auto* command = std::get_if<server::CommandMessage>(&*message)) {
    must(command->seq <= server::kLargestCount && is_plain_text(command->text));
  } else if (const auto* select = std::get_if<server::SelectMessage>(&*message)) {
    must(select->ids.size() <= server::kMostSelected);
    for (const std::uint64_t id : select->ids) must(id <= server::kLargestCount);
  }
  if (const auto target = server::parse_target(bytes)) {
    must(!target->path.empty() && target->path.front() == '/' && target->path.size() <= size);
    for (const auto& [name, value] : target->fields) must(target->find(name) != nullptr);
  }
  return 0;
}
