#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/layout/command.hpp"

namespace lekalo::layout {

/// A document with the history of its commands. Undo and redo have no limit; undoing all gives the first
/// bytes, redoing all the last ones.
class Session {
 public:
  explicit Session(Document document, Mode mode = Mode::strict)
      : workspace_(std::move(document)), mode_(mode) {}

  [[nodiscard]] const Workspace& workspace() const noexcept { return workspace_; }
  [[nodiscard]] const Document& document() const noexcept { return workspace_.document(); }

  /// Carries a command out, or fails as plan() does and changes nothing. Commands that had been undone are
  /// forgotten. A command that moves nothing leaves no trace.
  [[nodiscard]] Result<Change> apply(const Command& command);
  [[nodiscard]] bool can_undo() const noexcept { return done_ > 0; }
  [[nodiscard]] bool can_redo() const noexcept { return done_ < entries_.size(); }
  /// \pre can_undo(), can_redo()
  void undo();
  void redo();

  /// Sets the mode of the commands to come.
  void set_mode(Mode mode) noexcept { mode_ = mode; }

  /// Returns the commands carried out and not undone, a line each: first "lekalo-commands/1", and "mode
  /// strict" or "mode free" wherever the mode changes.
  [[nodiscard]] std::string log() const;

 private:
  struct Entry {
    std::string text;
    Mode mode;
    Change change;
  };
  Workspace workspace_;
  Mode mode_;
  std::vector<Entry> entries_;
  std::size_t done_ = 0;
};

/// Carries out a log on the document it was begun with. Fails with bad_input, naming the line, where a line
/// cannot be read, and as plan() does, naming it too, where a command is refused.
[[nodiscard]] Result<Session> replay(Document document, std::string_view log);

}  // namespace lekalo::layout
