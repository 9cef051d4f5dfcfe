#include "options.hpp"

#include <CLI/CLI.hpp>

#include "complaint.hpp"
#include "completion.hpp"
#include "lekalo/base/version.hpp"
#include "option_forms.hpp"

namespace lekalo::cli {
namespace {

struct Form {
  const char* name;
  const char* help;
  Typed (*add)(CLI::App& app);
};
constexpr Form kForms[] = {
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

std::string first_empty_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_expected_min() == 0) continue;  // flags
    for (const std::string& word : option->results()) {
      if (word.empty()) return option->get_name();
    }
  }
  return {};
}

}  // namespace

Result<Command> parse_command_line(int argc, char** argv) {
  CLI::App app(
      "lekalo: geometry for cutting shops, with proofs: parts in blanks, layouts on sheets and hides.",
      "lekalo");
  app.set_version_flag("--version", std::string("lekalo ") + kVersion, "Print the version and stop");
  app.footer("lekalo COMMAND --help explains a command.");
  app.require_subcommand(1);

  std::vector<std::pair<CLI::App*, Typed>> commands;
  for (const Form& form : kForms) {
    CLI::App& command = *app.add_subcommand(form.name, form.help);
    commands.emplace_back(&command, form.add(command));
  }
  std::string shell;
  CLI::App& completion = *app.add_subcommand("completion", "Print a completion script for a shell");
  completion.add_option("shell", shell, "bash, zsh or fish")->required()->type_name("SHELL");
  completion.footer("For bash: eval \"$(lekalo completion bash)\"");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return PrintText{std::string(version.what()) + "\n"};
  } catch (const CLI::CallForHelp&) {
    return PrintText{app.help()};
  } catch (const CLI::ParseError& error) {
    return failure(ErrorCode::usage, complaint(app, error, argc, argv));
  }
  for (const CLI::App* command : app.get_subcommands()) {
    const std::string empty = first_empty_option(*command);
    if (!empty.empty()) {
      return failure(ErrorCode::usage, empty + ": the value is empty (see lekalo --help)");
    }
  }
  for (const auto& [command, typed] : commands)
    if (*command) return typed();
  return completion_script(app, shell).map([](std::string&& text) {
    return Command(PrintText{std::move(text)});
  });
}

}  // namespace lekalo::cli
