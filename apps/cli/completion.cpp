#include "completion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace lekalo::cli {
namespace {

std::vector<const CLI::Option*> long_options(const CLI::App& command) {
  std::vector<const CLI::Option*> found;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_lnames().empty()) found.push_back(option);
  }
  return found;
}

/// "a|b|c" as "a b c"; empty for a type that is not a list of words.
std::string choices(const CLI::Option& option) {
  std::string type = option.get_type_name();
  if (type.find('|') == std::string::npos) return {};
  std::replace(type.begin(), type.end(), '|', ' ');
  return type;
}

std::string bash_script(const CLI::App& app) {
  std::string commands, words_of_command, words_of_option;
  for (const CLI::App* command : app.get_subcommands({})) {
    std::string options;
    for (const CLI::Option* option : long_options(*command)) {
      options += " --" + option->get_lnames().front();
      const std::string words = choices(*option);
      if (!words.empty()) {
        words_of_option += fmt::format("    --{}) COMPREPLY=($(compgen -W '{}' -- \"$cur\")); return ;;\n",
                                       option->get_lnames().front(), words);
      }
    }
    commands += " " + command->get_name();
    words_of_command += fmt::format("    {}) words='{}' ;;\n", command->get_name(), options.substr(1));
  }
  return fmt::format(
      "_lekalo() {{\n"
      "  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} words=''\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$cur\")); return\n"
      "  fi\n"
      "  case $prev in\n{}  esac\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  case $cur in\n"
      "    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$cur\")) ;;\n"
      "    *) COMPREPLY=($(compgen -f -- \"$cur\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o filenames -F _lekalo lekalo\n",
      commands.substr(1), words_of_option, words_of_command);
}

std::string fish_script(const CLI::App& app) {
  std::string script;
  for (const CLI::App* command : app.get_subcommands({})) {
    script += fmt::format("complete -c lekalo -n __fish_use_subcommand -f -a {} -d \"{}\"\n",
                          command->get_name(), command->get_description());
    for (const CLI::Option* option : long_options(*command)) {
      const std::string words = choices(*option);
      script += fmt::format("complete -c lekalo -n '__fish_seen_subcommand_from {}' -l {}{}{} -d \"{}\"\n",
                            command->get_name(), option->get_lnames().front(),
                            option->get_expected_min() > 0 ? " -r" : "",
                            words.empty() ? "" : " -f -a '" + words + "'", option->get_description());
    }
  }
  return script;
}

}  // namespace

Result<std::string> completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_script(app);
  if (shell == "zsh")
    return "autoload -U +X compinit bashcompinit && compinit && bashcompinit\n" + bash_script(app);
  if (shell == "fish") return fish_script(app);
  return failure(ErrorCode::usage, fmt::format("completion: \"{}\" is not one of bash, zsh, fish", shell));
}

}  // namespace lekalo::cli
