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
                                    Word<jobs::LayoutForm>{"labels", jobs::LayoutForm::labels},
                                    Word<jobs::LayoutForm>{"hpgl", jobs::LayoutForm::machine},
                                    Word<jobs::LayoutForm>{"gcode", jobs::LayoutForm::machine}};

/// The words as they were typed.
struct ExportWords {
  LayoutWords layout;
  std::string format, output, instance_name;
  std::vector<io::ExportWord> machine;  ///< words that io::read_export_words understands
  std::vector<io::ExportWord> labels;   ///< words that jobs::read_label_words understands
};

void add_words(Form& form, const std::string& heading, const std::vector<io::ExportWordHelp>& known,
               std::vector<io::ExportWord>& words) {
  for (const io::ExportWordHelp& help : known) words.emplace_back(help.name, "");
  const OptionAdder add(form, heading);
  for (std::size_t i = 0; i < words.size(); ++i)
    add("--" + words[i].first, words[i].second, known[i].type, known[i].help);
}

std::vector<io::ExportWord> given_of(const std::vector<io::ExportWord>& words) {
  std::vector<io::ExportWord> given;
  for (const io::ExportWord& word : words)
    if (!word.second.empty()) given.push_back(word);
  return given;
}

/// Fails for words that are given though another form than theirs is asked for.
Result<void> no_words(const std::vector<io::ExportWord>& given, const std::string& format) {
  if (given.empty()) return {};
  return failure(ErrorCode::usage, fmt::format("--{} has no meaning for the form {}", given.front().first,
                                               format.empty() ? "layout" : format));
}

Result<Command> to_export(const ExportWords& w) {
  jobs::ExportOptions form;
  form.instance_name = w.instance_name;
  WordReader reader;
  if (!w.format.empty()) reader.choice("--format", w.format, kExportFormats, form.form);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  const std::vector<io::ExportWord> machine = given_of(w.machine), labels = given_of(w.labels);
  if (form.form == jobs::LayoutForm::machine) {
    LEKALO_TRY(form.machine, io::read_export_words(*io::export_form(w.format), machine, "--"));
  } else {
    LEKALO_CHECK(no_words(machine, w.format));
  }
  if (form.form == jobs::LayoutForm::labels) {
    LEKALO_TRY(form.labels, jobs::read_label_words(labels, "--"));
  } else {
    LEKALO_CHECK(no_words(labels, w.format));
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
  add_words(form, "For machines and other programs", io::export_words(), words->machine);
  add_words(form, "For labels", jobs::label_words(), words->labels);
  form.footer =
      "Exit codes: 0 done, whatever rules are broken, 2 wrong command line, 3 a file cannot be read,\n"
      "5 disk or memory.";
  return [words] { return to_export(*words); };
}

}  // namespace lekalo::cli
