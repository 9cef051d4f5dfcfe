#include <memory>

#include "layout_words.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

constexpr std::array kExportFormats{Word<jobs::LayoutForm>{"layout", jobs::LayoutForm::layout},
                                    Word<jobs::LayoutForm>{"placements", jobs::LayoutForm::placements},
                                    Word<jobs::LayoutForm>{"dxf", jobs::LayoutForm::machine},
                                    Word<jobs::LayoutForm>{"svg", jobs::LayoutForm::machine},
                                    Word<jobs::LayoutForm>{"pdf", jobs::LayoutForm::pdf},
                                    Word<jobs::LayoutForm>{"hpgl", jobs::LayoutForm::machine},
                                    Word<jobs::LayoutForm>{"gcode", jobs::LayoutForm::machine}};

/// The words as they were typed.
struct ExportWords {
  LayoutWords layout;
  std::string format, output, instance_name;
  std::vector<io::ExportWord> machine;  ///< words that io::read_export_words understands
};

void add_machine_words(Form& form, ExportWords& w) {
  for (const io::ExportWordHelp& help : io::export_words()) w.machine.emplace_back(help.name, "");
  const OptionAdder add(form, "For machines and other programs");
  for (std::size_t i = 0; i < w.machine.size(); ++i)
    add("--" + w.machine[i].first, w.machine[i].second, io::export_words()[i].type,
        io::export_words()[i].help);
}

Result<Command> to_export(const ExportWords& w) {
  jobs::ExportOptions form;
  form.instance_name = w.instance_name;
  WordReader reader;
  if (!w.format.empty()) reader.choice("--format", w.format, kExportFormats, form.form);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  std::vector<io::ExportWord> given;
  for (const io::ExportWord& word : w.machine)
    if (!word.second.empty()) given.push_back(word);
  if (form.form == jobs::LayoutForm::machine) {
    LEKALO_TRY(form.machine, io::read_export_words(*io::export_form(w.format), given, "--"));
  } else if (!given.empty()) {
    return failure(ErrorCode::usage, fmt::format("--{} has no meaning for the form {}", given.front().first,
                                                 w.format.empty() ? "layout" : w.format));
  }
  return to_layout_source(w.layout).map([&](LayoutSource&& source) {
    return Command(ExportOptions{std::move(source), w.output, std::move(form)});
  });
}

}  // namespace

Typed add_export_form(Form& form) {
  auto words = std::make_shared<ExportWords>();
  add_layout_source(form, words->layout);
  const OptionAdder add(form);
  add("--format", words->format, "FORM", list_of(kExportFormats, "|"));
  add("-o,--output", words->output, "FILE", "Write to this file [stdout]");
  add("--instance-name", words->instance_name, "NAME",
      "What placements give as the file of their items [as the input says, or itself]");
  add_machine_words(form, *words);
  form.footer =
      "Exit codes: 0 done, whatever rules are broken, 2 wrong command line, 3 a file cannot be read,\n"
      "5 disk or memory.";
  return [words] { return to_export(*words); };
}

}  // namespace lekalo::cli
