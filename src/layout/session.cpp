#include "lekalo/layout/session.hpp"

#include <fmt/core.h>

namespace lekalo::layout {
namespace {

constexpr std::string_view kFirstLine = "lekalo-commands/1";

std::string_view name_of(Mode mode) noexcept { return mode == Mode::strict ? "mode strict" : "mode free"; }

}  // namespace

Result<Change> Session::apply(const Command& command) {
  auto change = plan(workspace_, command, mode_);
  if (!change || change->is_nothing()) return change;
  std::string text = to_text(command, document());
  carry_out(workspace_, *change);
  entries_.resize(done_);
  entries_.push_back({std::move(text), mode_, *change});
  ++done_;
  return change;
}

void Session::undo() {
  --done_;
  take_back(workspace_, entries_[done_].change);
}

void Session::redo() {
  carry_out(workspace_, entries_[done_].change);
  ++done_;
}

std::string Session::log() const {
  std::string text = fmt::format("{}\n", kFirstLine);
  Mode mode = Mode::strict;
  for (std::size_t i = 0; i < done_; ++i) {
    if (entries_[i].mode != mode) text += fmt::format("{}\n", name_of(entries_[i].mode));
    mode = entries_[i].mode;
    text += entries_[i].text + '\n';
  }
  return text;
}

Result<Session> replay(Document document, std::string_view log) {
  Session session(std::move(document));
  std::size_t number = 0;
  const auto fault = [&](const Error& error) {
    return failure(error.code, fmt::format("line {}: {}", number, error.message));
  };
  while (!log.empty()) {
    ++number;
    const std::size_t end = std::min(log.find('\n'), log.size());
    std::string_view line = log.substr(0, end);
    log.remove_prefix(std::min(end + 1, log.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (number == 1) {
      if (line != kFirstLine)
        return fault({ErrorCode::bad_input, fmt::format("a log of commands begins with '{}'", kFirstLine)});
      continue;
    }
    if (line.empty() || line.front() == '#') continue;
    if (line == name_of(Mode::strict) || line == name_of(Mode::free)) {
      session.set_mode(line == name_of(Mode::strict) ? Mode::strict : Mode::free);
      continue;
    }
    auto command = command_from_text(line, session.document());
    if (!command) return fault(command.error());
    if (auto change = session.apply(*command); !change) return fault(change.error());
  }
  if (number == 0)
    return failure(ErrorCode::bad_input, fmt::format("an empty log; it begins with '{}'", kFirstLine));
  return session;
}

}  // namespace lekalo::layout
