#include <memory>

#include "layout_words.hpp"
#include "option_forms.hpp"

namespace lekalo::cli {
namespace {

/// A layout that is read, told and drawn.
template <class Options>
Typed add_drawn(Form& form, const char* footer) {
  auto words = std::make_shared<LayoutWords>();
  add_layout_source(form, *words);
  add_layout_outputs(form, *words);
  form.footer = footer;
  return [words]() -> Result<Command> {
    LEKALO_CHECK(fine_picture(words->picture));
    return to_layout_source(*words).map([&](LayoutSource&& source) {
      return Command(Options{std::move(source), words->picture, words->json});
    });
  };
}

}  // namespace

Typed add_check_form(Form& form) {
  return add_drawn<CheckOptions>(
      form,
      "Exit codes: 0 valid, 1 violations, 2 wrong command line, 3 a file cannot be read,\n"
      "4 the engine and the independent checker do not agree, 5 disk or memory.");
}

Typed add_show_form(Form& form) {
  return add_drawn<ShowOptions>(
      form,
      "Exit codes: 0 done, whatever rules are broken, 2 wrong command line, 3 a file cannot be read,\n"
      "5 disk or memory.");
}

}  // namespace lekalo::cli
