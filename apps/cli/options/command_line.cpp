#include "command_line.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "lekalo/base/version.hpp"
#include "nearest_word.hpp"

namespace lekalo::cli {
namespace {

CLI::Option* add_target(CLI::App& command, const FormOption& option, bool& flag) {
  return command.add_flag(option.names, flag, option.help);
}

template <class Words>
CLI::Option* add_target(CLI::App& command, const FormOption& option, Words& words) {
  return command.add_option(option.names, words, option.help)->type_name(option.type);
}

void add(CLI::App& command, const FormOption& option) {
  CLI::Option* const added =
      std::visit([&](auto* to) { return add_target(command, option, *to); }, option.to);
  added->required(option.required);
  if (!option.heading.empty()) added->group(option.heading);
  if (option.count > 0) added->expected(option.count);
  if (option.one_word_a_time) added->allow_extra_args(false);
  if (option.delimiter != '\0') added->delimiter(option.delimiter);
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string unexpected_word(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining(true);
  const auto option =
      std::find_if(words.begin(), words.end(), [](const std::string& w) { return w.front() == '-'; });
  if (option == words.end()) {
    return fmt::format("\"{}\" is one word too many", words.empty() ? "" : words.front());
  }
  const std::string name = option->substr(0, option->find('='));
  const std::string meant = nearest_word(name, option_names(command));
  return fmt::format("there is no option {}{}", name, meant.empty() ? "" : ", did you mean " + meant + "?");
}

/// An option with too few or too many values.
std::string wrong_count(const CLI::App& command, const std::string& message) {
  const std::string name = message.substr(0, message.find(':'));
  const CLI::Option* const option = command.get_option_no_throw(name);
  if (option == nullptr) return message;
  // An option that takes any number of values needs one.
  const int wanted =
      option->get_expected_max() >= CLI::detail::expected_max_vector_size ? 1 : option->get_expected_max();
  const std::size_t given = option->results().size();
  if (wanted == 1 && given > 1) return name + ": given more than once";
  return fmt::format("{}: needs {} after it ({})", name,
                     wanted == 1 ? "a value" : fmt::format("{} values", wanted), option->get_type_name());
}

std::string first_empty_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_expected_min() == 0) continue;  // flags
    for (const std::string& word : option->results()) {
      if (word.empty()) return option->get_name();
    }
  }
  return {};
}

/// The names as "a, b and c".
std::string command_names(const std::vector<Form>& forms) {
  std::string names;
  for (std::size_t i = 0; i < forms.size(); ++i)
    names += (i == 0 ? "" : i + 1 == forms.size() ? " and " : ", ") + forms[i].name;
  return names;
}

/// One line out of CLI11's message, whose own ends are sometimes line breaks.
std::string sentence(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '.')) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

std::string no_command(const std::vector<Form>& forms, int argc, const char* const* argv) {
  if (argc <= 1)
    return fmt::format("a command is missing; there are {} (see lekalo --help)", command_names(forms));
  return fmt::format("there is no command \"{}\", only {} (see lekalo --help)", argv[1],
                     command_names(forms));
}

/// One sentence with the way out: CLI11's own do not know our words.
std::string complaint(const CLI::App& command, const CLI::ParseError& error) {
  const std::string hint = fmt::format(" (see lekalo {} --help)", command.get_name());
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return unexpected_word(command) + hint;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return wrong_count(command, sentence(error.what())) + hint;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && command.get_option_no_throw("layout") &&
      command["layout"]->empty())
    return "the file of the layout is missing" + hint;
  return sentence(error.what()) + hint;
}

}  // namespace

Result<Asked> read_command_line(const std::vector<Form>& forms, int argc, const char* const* argv) {
  CLI::App app(
      "lekalo: geometry for cutting shops, with proofs: parts in blanks, layouts on sheets and hides.",
      "lekalo");
  app.set_help_flag(kHelpFlag, kHelpFlagHelp);
  app.set_version_flag("--version", std::string("lekalo ") + kVersion, "Print the version and stop");
  app.footer("lekalo COMMAND --help explains a command.");
  app.require_subcommand(1);
  for (const Form& form : forms) {
    CLI::App& command = *app.add_subcommand(form.name, form.help);
    for (const FormOption& option : form.options) add(command, option);
    command.footer(form.footer);
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return std::string(version.what()) + "\n";
  } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::ParseError& error) {
    const auto commands = app.get_subcommands();
    return failure(ErrorCode::usage,
                   commands.empty() ? no_command(forms, argc, argv) : complaint(*commands.front(), error));
  }
  const CLI::App& command = *app.get_subcommands().front();
  const std::string empty = first_empty_option(command);
  if (!empty.empty()) return failure(ErrorCode::usage, empty + ": the value is empty (see lekalo --help)");
  std::size_t asked = 0;
  while (forms[asked].name != command.get_name()) ++asked;
  return asked;
}

}  // namespace lekalo::cli
