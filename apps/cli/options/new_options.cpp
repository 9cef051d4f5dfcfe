#include <memory>

#include "option_forms.hpp"
#include "order_words.hpp"

namespace lekalo::cli {
namespace {

struct NewWords {
  LayoutWords layout;
  OrderWords order;
  std::string output;
};

}  // namespace

Typed add_new_form(Form& form) {
  auto words = std::make_shared<NewWords>();
  NewWords& w = *words;
  add_drawings_reading(form, w.layout);
  add_order(form, w.order);
  OptionAdder{form}("-o,--output", w.output, "FILE", "Write the layout to this file [stdout]");
  form.footer =
      "The layout has the parts, sheets and rules of the order, and nothing placed: lekalo nest places,\n"
      "lekalo serve opens it in a browser.\n"
      "Exit codes: 0 written, 2 wrong command line, 3 a file cannot be read, 5 disk or memory.";
  return [words]() -> Result<Command> {
    LEKALO_TRY(std::optional<OrderSource> order, to_order(words->order, words->layout));
    return Command(NewOptions{std::move(order).value_or(OrderSource{}), words->output});
  };
}

}  // namespace lekalo::cli
