#include "options.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "command_line.hpp"
#include "completion.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

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
    {"fit", "Say what pressing a hub on a shaft does to their surfaces", add_fit_form},
    {"heat", "Say what the heat of milling does to the walls of a pocket", add_heat_form},
    {"check", "Say which rules a cutting layout breaks, exactly, and where", add_check_form},
    {"show", "Show a cutting layout: material used, parts, kits, picture", add_show_form},
    {"export", "Write a layout or a job of another program in another form", add_export_form},
    {"quote", "Say what cutting layouts takes and costs: time, material, a quote to print", add_quote_form},
    {"edit", "Carry out a file of commands on a layout: move, slide, settle, ...", add_edit_form},
    {"nest", "Place parts on strips, sheets and hides, densely", add_nest_form},
    {"new", "Write the layout that an order of drawings and sheets describes, to be edited", add_new_form},
    {"stock", "Keep sheets and their remnants in a file, and give each to one order only", add_stock_form},
    {"serve", "Correct layouts in a browser, with a live exact check", add_serve_form},
    {"store", "Check, copy and put back the layouts of a server", add_store_form},
};

/// The commands whose work is counted in steps.
constexpr std::string_view kWorkInSteps[] = {"verify", "pocket", "simulate", "fit",   "heat",
                                             "check",  "show",   "export",   "quote", "edit"};
bool counts_steps(std::string_view command) {
  return std::find(std::begin(kWorkInSteps), std::end(kWorkInSteps), command) != std::end(kWorkInSteps);
}

}  // namespace

Result<CommandLine> parse_command_line(int argc, char** argv) {
  std::vector<Form> forms;
  std::vector<Typed> typed;
  std::string steps;
  for (const CommandForm& command : kForms) {
    Form& form = forms.emplace_back(Form{command.name, command.help, {}, {}});
    typed.push_back(command.add(form));
    if (counts_steps(command.name))
      OptionAdder{form}(
          "--work", steps, "N",
          fmt::format("Give up after N steps of work, each a microsecond or less [{}]", kUsualSteps));
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
  if (const auto* const text = std::get_if<std::string>(&asked)) return CommandLine{PrintText{*text}};
  LEKALO_TRY(CommandLine line, typed[std::get<std::size_t>(asked)]().map(
                                   [](Command&& command) { return CommandLine{std::move(command)}; }));
  if (counts_steps(forms[std::get<std::size_t>(asked)].name)) line.steps = kUsualSteps;
  WordReader read;
  read.number("--work", steps, std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max(),
              "a whole number from 1 to 2^64 - 1", line.steps);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return line;
}

}  // namespace lekalo::cli
