#pragma once

#include <deque>
#include <string>
#include <vector>

#include "form.hpp"
#include "lekalo/io/layout/layout_export.hpp"

namespace lekalo::cli {

/// Words of a command line that a library names and reads; those without a type are flags.
class MachineWords {
 public:
  /// Adds them to a form that does not outlive this.
  void add_to(Form& form, const std::string& heading, const std::vector<io::ExportWordHelp>& known) {
    const OptionAdder add(form, heading);
    for (const io::ExportWordHelp& help : known) {
      TypedWord& word = typed_.emplace_back();
      word.name = help.name;
      if (help.type.empty())
        add("--" + help.name, word.is_set, help.help);
      else
        add("--" + help.name, word.value, help.type, help.help);
    }
  }
  [[nodiscard]] std::vector<io::ExportWord> given() const {
    std::vector<io::ExportWord> words;
    for (const TypedWord& word : typed_)
      if (word.is_set || !word.value.empty()) words.emplace_back(word.name, word.is_set ? "yes" : word.value);
    return words;
  }

 private:
  struct TypedWord {
    std::string name, value;
    bool is_set = false;
  };
  std::deque<TypedWord> typed_;  ///< the form points into it
};

}  // namespace lekalo::cli
