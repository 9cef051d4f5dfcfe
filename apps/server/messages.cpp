#include "messages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "lekalo/base/plain_text.hpp"
#include "lekalo/io/text/json_events.hpp"

namespace lekalo::server {
namespace {

/// Takes one flat object as the parser meets its parts. It builds no tree, because messages come from
/// strangers: the first thing that does not belong ends the reading. And its sentences name fields, as the
/// protocol has it, where those of JsonReader name the lines of a file.
class MessageReader final : public io::JsonEvents {
 public:
  bool null() override { return wrong_type(); }
  bool boolean(bool) override { return wrong_type(); }
  bool number(double, std::string_view) override { return stop("is no whole number below 2^53"); }
  bool integer(std::int64_t number) override {
    if (number < 0) return stop("is negative; it has to be a whole number");
    const auto value = static_cast<std::uint64_t>(number);
    if (value > kLargestCount) return stop("is no whole number below 2^53");
    if (in_list_) {
      if (ids_.size() == kMostSelected) return stop(fmt::format("has more than {} ids", kMostSelected));
      ids_.push_back(value);
      return true;
    }
    if (key_ != "seq") return wrong_type();
    seq_ = value;
    return true;
  }
  bool text(std::string_view value) override {
    if (!in_object_ || in_list_) return wrong_type();
    if (key_ == "type") {
      type_ = value;
    } else if (key_ == "mode") {
      mode_ = value;
    } else if (key_ == "text") {
      text_ = value;
    } else {
      return wrong_type();
    }
    return true;
  }
  bool begin_object() override {
    if (in_object_) return wrong_type();
    in_object_ = true;
    return true;
  }
  bool key(std::string_view value) override {
    key_ = value;
    const auto known = std::find(kKeys.begin(), kKeys.end(), key_);
    if (known == kKeys.end()) {
      fault_ = "the message has a field that is not known";
      return false;
    }
    const auto index = static_cast<std::size_t>(known - kKeys.begin());
    if (seen_[index]) return stop("stands twice");
    seen_[index] = true;
    return true;
  }
  bool end_object() override { return true; }
  bool begin_list() override {
    if (!in_object_ || in_list_ || key_ != "ids") return wrong_type();
    in_list_ = true;
    return true;
  }
  bool end_list() override {
    in_list_ = false;
    return true;
  }
  void broken(const io::JsonBreak& at) override {
    if (fault_.empty()) fault_ = fmt::format("the message is no JSON: trouble at byte {}", at.byte);
  }

  [[nodiscard]] Result<ClientMessage> message() {
    if (!fault_.empty()) return failure(ErrorCode::bad_input, fault_);
    const auto has = [&](std::string_view key) {
      return seen_[static_cast<std::size_t>(std::find(kKeys.begin(), kKeys.end(), key) - kKeys.begin())];
    };
    const auto exactly = [&](std::initializer_list<std::string_view> wanted) {
      for (const std::string_view key : kKeys) {
        const bool should = key == "type" || std::find(wanted.begin(), wanted.end(), key) != wanted.end();
        if (should && !has(key)) fault_ = fmt::format("a message of type {} needs the field {}", type_, key);
        if (!should && has(key)) fault_ = fmt::format("a message of type {} has no field {}", type_, key);
      }
      return fault_.empty();
    };
    if (!has("type")) return failure(ErrorCode::bad_input, "the message has no type");
    if (type_ == "command" || type_ == "preview") {
      if (!exactly({"seq", "mode", "text"})) return failure(ErrorCode::bad_input, fault_);
      if (mode_ != "strict" && mode_ != "free")
        return failure(ErrorCode::bad_input, "the mode has to be strict or free");
      if (!is_plain_text(text_))
        return failure(ErrorCode::bad_input, "the command's text has control characters; it is one line");
      return CommandMessage{seq_, mode_ == "strict" ? layout::Mode::strict : layout::Mode::free,
                            std::move(text_), type_ == "preview"};
    }
    if (type_ == "undo" || type_ == "redo") {
      if (!exactly({"seq"})) return failure(ErrorCode::bad_input, fault_);
      return UndoMessage{seq_, type_ == "redo"};
    }
    if (type_ == "stop") {
      if (!exactly({"seq"})) return failure(ErrorCode::bad_input, fault_);
      return StopMessage{seq_};
    }
    if (type_ == "select") {
      if (!exactly({"ids"})) return failure(ErrorCode::bad_input, fault_);
      return SelectMessage{std::move(ids_)};
    }
    return failure(ErrorCode::bad_input, "the type has to be command, preview, undo, redo, stop or select");
  }

 private:
  static constexpr std::array<std::string_view, 5> kKeys{"type", "seq", "mode", "text", "ids"};
  bool stop(const std::string& what) {
    fault_ =
        key_.empty() ? "the message has to be one JSON object" : fmt::format("the field {} {}", key_, what);
    return false;
  }
  bool wrong_type() { return stop("is of the wrong type"); }

  std::string key_, type_, mode_, text_, fault_;
  std::uint64_t seq_ = 0;
  std::vector<std::uint64_t> ids_;
  std::array<bool, kKeys.size()> seen_{};
  bool in_object_ = false, in_list_ = false;
};

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

Result<ClientMessage> parse_client_message(std::string_view bytes) {
  if (bytes.size() > kLargestMessage)
    return failure(ErrorCode::bad_input, fmt::format("the message has more than {} bytes", kLargestMessage));
  MessageReader reader;
  // Its word is in the reader, which keeps the first fault.
  static_cast<void>(io::parse_json(bytes, reader));
  return reader.message();
}

Result<void> check_author(std::string_view author) {
  constexpr std::size_t kLongest = 64;
  if (author.size() <= kLongest && is_plain_text(author)) return {};
  return failure(ErrorCode::bad_input, "an author has at most 64 bytes of UTF-8 without control characters");
}

Result<void> check_layout_name(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  if (name.empty()) return failure(ErrorCode::bad_input, "the name of a layout cannot be empty");
  if (name.size() > kLongest)
    return failure(ErrorCode::bad_input, fmt::format("the name of a layout has at most {} bytes", kLongest));
  if (!is_plain_text(name))
    return failure(ErrorCode::bad_input, "the name of a layout is UTF-8 without control characters");
  return {};
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value > kLargestCount)
    return std::nullopt;
  return value;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hexadecimal(text[i + 1]), low = hexadecimal(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

const std::string* Target::find(std::string_view name) const {
  for (const auto& [key, value] : fields)
    if (key == name) return &value;
  return nullptr;
}

std::optional<Target> parse_target(std::string_view target) {
  constexpr std::size_t kMostFields = 64;  // each is compared with those before it
  Target parsed;
  if (target.empty() || target.front() != '/' || target.find('#') != target.npos) return std::nullopt;
  const std::size_t mark = std::min(target.find('?'), target.size());
  parsed.path = target.substr(0, mark);
  target.remove_prefix(std::min(mark + 1, target.size()));
  while (!target.empty()) {
    const std::size_t end = std::min(target.find('&'), target.size());
    const std::string_view field = target.substr(0, end);
    target.remove_prefix(std::min(end + 1, target.size()));
    if (field.empty()) continue;
    const std::size_t equal = std::min(field.find('='), field.size());
    auto name = percent_decoded(field.substr(0, equal));
    auto value = percent_decoded(field.substr(std::min(equal + 1, field.size())));
    if (!name || !value || parsed.find(*name) != nullptr || parsed.fields.size() == kMostFields)
      return std::nullopt;
    parsed.fields.emplace_back(std::move(*name), std::move(*value));
  }
  return parsed;
}

}  // namespace lekalo::server
