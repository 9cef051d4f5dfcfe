#include <memory>

#include "layout_words.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

/// As typed.
struct ServeWords {
  LayoutWords layout;
  std::string store, listen = "127.0.0.1", port, token_file;
};

Result<Command> to_serve(const ServeWords& w) {
  LEKALO_TRY(LayoutSource source, to_layout_source(w.layout));
  WordReader read;
  std::uint16_t port = 8080;
  read.number("--port", w.port, std::uint16_t{0}, std::uint16_t{65535}, "a whole number from 0 to 65535",
              port);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(ServeOptions{std::move(source), w.store, w.listen, port, w.token_file});
}

}  // namespace

Typed add_serve_form(Form& form) {
  auto words = std::make_shared<ServeWords>();
  ServeWords& w = *words;
  add_layout_source(form, w.layout, false);
  const OptionAdder add(form);
  add("--store", w.store, "FILE",
      "The layouts and all that was done to them [lekalo/layouts.sqlite among the user's data]");
  add("--port", w.port, "N", "0: any that is free [8080]");
  add("--listen", w.listen, "ADDRESS", "Elsewhere than on this machine alone, with a token [127.0.0.1]");
  add("--token-file", w.token_file, "FILE",
      "Holds what whoever opens the page has to know [the variable LEKALO_TOKEN; made and printed with "
      "--listen]");
  form.footer =
      "The first line on stdout is \"listening URL\"; Ctrl-C stops it.\n"
      "Exit codes: 0 stopped, 2 wrong command line, 3 the file cannot be read, 5 the port or the store\n"
      "cannot be had.";
  return [words] { return to_serve(*words); };
}

}  // namespace lekalo::cli
