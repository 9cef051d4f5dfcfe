#include <fmt/core.h>

#include <memory>

#include "option_forms.hpp"

namespace lekalo::cli {
namespace {

/// As typed.
struct StoreWords {
  std::string action, file, output;
};

Result<Command> to_store(const StoreWords& w) {
  StoreOptions options{StoreAction::check, w.file, w.output};
  if (w.action == "backup")
    options.action = StoreAction::backup;
  else if (w.action == "restore")
    options.action = StoreAction::restore;
  else if (w.action != "check")
    return failure(ErrorCode::usage,
                   fmt::format("\"{}\" is nothing to do with a store; it is check, backup or restore (see "
                               "lekalo store --help)",
                               w.action));
  const bool writes = options.action != StoreAction::check;
  if (writes && w.output.empty())
    return failure(ErrorCode::usage, fmt::format("-o FILE is missing: where the {} goes (see lekalo store "
                                                 "--help)",
                                                 writes && w.action == "backup" ? "copy" : "store"));
  if (!writes && !w.output.empty())
    return failure(ErrorCode::usage, "-o: a check writes nothing; leave it out (see lekalo store --help)");
  return Command(std::move(options));
}

}  // namespace

Typed add_store_form(Form& form) {
  auto words = std::make_shared<StoreWords>();
  const OptionAdder add(form);
  add("action", words->action, "check|backup|restore",
      "Say what is damaged; copy the store into one file; make a store of such a copy")
      .required = true;
  add("file", words->file, "FILE", "The store, or for restore the copy; no server may be running on it")
      .required = true;
  add("-o,--output", words->output, "FILE",
      "The copy (replaced), or the store that is made (must not be there)");
  form.footer =
      "A backup is made of a store without damage alone. A restore of one with damage takes the newest "
      "whole\n"
      "state of each layout, and says what is lost.\n"
      "Exit codes: 0 done, no damage; 1 damage was found; 2 wrong command line; 3 the file is not there;\n"
      "5 it is no store, is in use, or cannot be written.";
  return [words] { return to_store(*words); };
}

}  // namespace lekalo::cli
