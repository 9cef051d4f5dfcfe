#include <memory>

#include "layout_words.hpp"
#include "option_forms.hpp"

namespace lekalo::cli {
namespace {

/// As typed.
struct EditWords {
  LayoutWords layout;
  std::string commands, output;
};

}  // namespace

Typed add_edit_form(Form& form) {
  auto words = std::make_shared<EditWords>();
  add_layout_source(form, words->layout);
  const OptionAdder add(form);
  add("--commands", words->commands, "FILE", "The commands, a line each; the first line is lekalo-commands/1")
      .required = true;
  add("-o,--output", words->output, "FILE", "Write the layout to this file [stdout]");
  form.footer =
      "Exit codes: 0 no rule is broken, 1 some are, 2 a command cannot be carried out,\n"
      "3 a file cannot be read, 4 a command would break a rule (mode strict), 5 disk or memory.\n"
      "With 2 to 5 nothing is written. The commands: docs/design/layout-commands.md";
  return [words] {
    return to_layout_source(words->layout).map([&](LayoutSource&& source) {
      return Command(EditOptions{std::move(source), words->commands, words->output});
    });
  };
}

}  // namespace lekalo::cli
