#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lekalo::cli {

/// An option of a command, or a word that is known by its place, with the flag, the word or the list of words
/// that takes up what is typed. Words become values after the whole line is read (option_words.hpp).
struct FormOption {
  std::string names;  ///< as "-o,--output"; without dashes: known by its place
  std::variant<bool*, std::string*, std::vector<std::string>*> to;
  std::string type;     ///< what people are to type, as "FILE" or "mm|inch"; flags have none
  std::string help;     ///< one line
  std::string heading;  ///< of the help, under which it stands; may be empty
  bool required = false;
  int count = 0;                 ///< of a list: exactly so many words; 0: one or more
  bool one_word_a_time = false;  ///< of a list: the option is given again for every further word
  char delimiter = '\0';         ///< of a list: words may also be written with this between them
};

/// Every command has this flag besides the options of its form.
inline constexpr const char* kHelpFlag = "-h,--help";
inline constexpr const char* kHelpFlagHelp = "Print this help message and exit";

/// A command's form says what can be typed behind its name. The words that its options fill in outlive it.
struct Form {
  std::string name, help;  ///< of the command; help: one line
  std::vector<FormOption> options;
  std::string footer;  ///< of the command's help
};

/// Adds options to a form, under one heading of the help. The option it returns may be changed until the
/// next one is added.
class OptionAdder {
 public:
  explicit OptionAdder(Form& form, std::string heading = {}) : form_(&form), heading_(std::move(heading)) {}

  FormOption& operator()(std::string names, std::string& word, std::string type, std::string help) const {
    return add({std::move(names), &word, std::move(type), std::move(help), heading_});
  }
  FormOption& operator()(std::string names, std::vector<std::string>& words, std::string type,
                         std::string help) const {
    return add({std::move(names), &words, std::move(type), std::move(help), heading_});
  }
  FormOption& operator()(std::string names, bool& flag, std::string help) const {
    return add({std::move(names), &flag, {}, std::move(help), heading_});
  }

 private:
  FormOption& add(FormOption option) const { return form_->options.emplace_back(std::move(option)); }

  Form* form_;
  std::string heading_;
};

}  // namespace lekalo::cli
