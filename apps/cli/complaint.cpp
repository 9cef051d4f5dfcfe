#include "complaint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace lekalo::cli {
namespace {

/// Letters to insert, drop or replace until one word is the other (Levenshtein).
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

const CLI::App& chosen_command(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
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
  const int wanted = option->get_expected_max();
  const std::size_t given = option->results().size();
  if (wanted == 1 && given > 1) return name + ": given more than once";
  return fmt::format("{}: needs {} after it ({})", name,
                     wanted == 1 ? "a value" : fmt::format("{} values", wanted), option->get_type_name());
}

/// The names as "a, b and c".
std::string command_names(const CLI::App& app) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  std::string names;
  for (std::size_t i = 0; i < commands.size(); ++i)
    names += (i == 0 ? "" : i + 1 == commands.size() ? " and " : ", ") + commands[i]->get_name();
  return names;
}

/// One line out of CLI11's message, whose own ends are sometimes line breaks.
std::string sentence(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '.')) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kFarthest = 3;
  std::size_t best = std::min(kFarthest, word.size() / 3) + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    const std::size_t distance = edits(word, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string complaint(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
  const CLI::App& command = chosen_command(app);
  if (&command == &app) {
    if (argc <= 1)
      return fmt::format("a command is missing; there are {} (see lekalo --help)", command_names(app));
    return fmt::format("there is no command \"{}\", only {} (see lekalo --help)", argv[1],
                       command_names(app));
  }
  const std::string hint = fmt::format(" (see lekalo {} --help)", command.get_name());
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return unexpected_word(command) + hint;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return wrong_count(command, sentence(error.what())) + hint;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && command.get_option_no_throw("layout") &&
      command["layout"]->empty())
    return "the file of the layout is missing" + hint;
  return sentence(error.what()) + hint;
}

}  // namespace lekalo::cli
