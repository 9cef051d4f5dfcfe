#include "options.hpp"

#include "command_line.hpp"
#include "completion.hpp"
#include "option_forms.hpp"

namespace lekalo::cli {
namespace {

struct CommandForm {
  const char* name;
  const char* help;
  Typed (*add)(Form& form);
};
constexpr CommandForm kForms[] = {
    {"locate", "Place a part in a probed blank with the largest possible minimum allowance, and prove it",
     add_locate_form},
    {"verify", "Recheck a result against its files with exact arithmetic, independently of the solver",
     add_verify_form},
    {"pocket", "Make the NC program that clears a pocket with bounded engagement", add_pocket_form},
    {"simulate", "Say what an NC program cuts of a pocket: coverage, gouges, engagement, time",
     add_simulate_form},
    {"check", "Say which rules a cutting layout breaks, exactly, and where", add_check_form},
    {"show", "Show a cutting layout: material used, parts, kits, picture", add_show_form},
    {"export", "Write a layout or a job of another program in another form", add_export_form},
    {"edit", "Carry out a file of commands on a layout: move, slide, settle, ...", add_edit_form},
    {"nest", "Place parts on strips, sheets and hides, densely", add_nest_form},
    {"serve", "Correct layouts in a browser, with a live exact check", add_serve_form},
};

}  // namespace

Result<Command> parse_command_line(int argc, char** argv) {
  std::vector<Form> forms;
  std::vector<Typed> typed;
  for (const CommandForm& command : kForms) {
    Form& form = forms.emplace_back(Form{command.name, command.help, {}, {}});
    typed.push_back(command.add(form));
  }
  std::string shell;
  Form& completion = forms.emplace_back(Form{"completion", "Print a completion script for a shell", {}, {}});
  OptionAdder{completion}("shell", shell, "SHELL", "bash, zsh or fish").required = true;
  completion.footer = "For bash: eval \"$(lekalo completion bash)\"";
  typed.push_back([&] {
    return completion_script(forms, shell).map([](std::string&& text) {
      return Command(PrintText{std::move(text)});
    });
  });

  LEKALO_TRY(const Asked asked, read_command_line(forms, argc, argv));
  if (const auto* const text = std::get_if<std::string>(&asked)) return PrintText{*text};
  return typed[std::get<std::size_t>(asked)]();
}

}  // namespace lekalo::cli
