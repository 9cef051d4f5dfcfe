#include "completion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace lekalo::cli {
namespace {

/// Without its dashes; empty for a word that is known by its place.
std::string long_name(const FormOption& option) {
  const std::size_t dashes = option.names.find("--");
  return dashes == std::string::npos ? "" : option.names.substr(dashes + 2);
}

/// Completion offers every flag and option with a long name.
std::vector<FormOption> long_options(const Form& form) {
  std::vector<FormOption> found{{kHelpFlag, static_cast<bool*>(nullptr), {}, kHelpFlagHelp, {}}};
  std::copy_if(form.options.begin(), form.options.end(), std::back_inserter(found),
               [](const FormOption& option) { return !long_name(option).empty(); });
  return found;
}

/// "a|b|c" as "a b c"; empty for a type that is not a list of words.
std::string choices(const FormOption& option) {
  if (option.type.find('|') == std::string::npos) return {};
  std::string words = option.type;
  std::replace(words.begin(), words.end(), '|', ' ');
  return words;
}

std::string bash_script(const std::vector<Form>& forms) {
  std::string commands, words_of_command, words_of_option;
  for (const Form& form : forms) {
    std::string options;
    for (const FormOption& option : long_options(form)) {
      options += " --" + long_name(option);
      const std::string words = choices(option);
      if (!words.empty()) {
        words_of_option += fmt::format("    --{}) COMPREPLY=($(compgen -W '{}' -- \"$cur\")); return ;;\n",
                                       long_name(option), words);
      }
    }
    commands += " " + form.name;
    words_of_command += fmt::format("    {}) words='{}' ;;\n", form.name, options.substr(1));
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

std::string fish_script(const std::vector<Form>& forms) {
  std::string script;
  for (const Form& form : forms) {
    script +=
        fmt::format("complete -c lekalo -n __fish_use_subcommand -f -a {} -d \"{}\"\n", form.name, form.help);
    for (const FormOption& option : long_options(form)) {
      const std::string words = choices(option);
      script +=
          fmt::format("complete -c lekalo -n '__fish_seen_subcommand_from {}' -l {}{}{} -d \"{}\"\n",
                      form.name, long_name(option), std::holds_alternative<bool*>(option.to) ? "" : " -r",
                      words.empty() ? "" : " -f -a '" + words + "'", option.help);
    }
  }
  return script;
}

}  // namespace

Result<std::string> completion_script(const std::vector<Form>& forms, const std::string& shell) {
  if (shell == "bash") return bash_script(forms);
  if (shell == "zsh")
    return "autoload -U +X compinit bashcompinit && compinit && bashcompinit\n" + bash_script(forms);
  if (shell == "fish") return fish_script(forms);
  return failure(ErrorCode::usage, fmt::format("completion: \"{}\" is not one of bash, zsh, fish", shell));
}

}  // namespace lekalo::cli
