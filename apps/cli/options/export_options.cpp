#include <memory>
#include <optional>
#include <utility>

#include "layout_words.hpp"
#include "machine_words.hpp"
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
  std::string processes, material, thickness;
  MachineWords machine;  ///< words that io::read_export_words understands
  MachineWords labels;   ///< words that jobs::read_label_words understands
};

/// Fails for words that are given though another form than theirs is asked for.
Result<void> no_words(const std::vector<io::ExportWord>& given, const std::string& format) {
  if (given.empty()) return {};
  return failure(ErrorCode::usage, fmt::format("--{} has no meaning for the form {}", given.front().first,
                                               format.empty() ? "layout" : format));
}

/// The process that the words ask for; nothing where they do not name a file.
Result<std::optional<jobs::ProcessChoice>> to_process(const ExportWords& w,
                                                      std::vector<io::ExportWord> given) {
  jobs::ProcessChoice process{
      {w.processes, {}}, w.material, 0,
      std::move(given),  "--",       w.format == "hpgl" ? io::ExportForm::hpgl : io::ExportForm::gcode};
  WordReader reader;
  for (const auto& [option, word] :
       {std::pair{"--processes", &w.processes}, {"--material", &w.material}, {"--thickness", &w.thickness}}) {
    if (word->empty()) continue;
    reader.require(
        w.format == "gcode" || w.format == "hpgl",
        fmt::format("{} has no meaning for the form {}", option, w.format.empty() ? "layout" : w.format));
    reader.require(!w.processes.empty(),
                   fmt::format("{} says which process to take, and --processes FILE from where", option));
  }
  if (!w.processes.empty()) {
    reader.require(!w.material.empty(), "--material is missing: which of the processes to take");
    reader.require(!w.thickness.empty(), "--thickness is missing: which of the processes to take");
  }
  reader.number("--thickness", w.thickness, 0.001, 1000.0, "a thickness from 0.001 to 1000 mm",
                process.thickness_mm);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  if (w.processes.empty()) return std::optional<jobs::ProcessChoice>();
  return std::optional(std::move(process));
}

Result<Command> to_export(const ExportWords& w) {
  jobs::ExportOptions form;
  form.instance_name = w.instance_name;
  WordReader reader;
  if (!w.format.empty()) reader.choice("--format", w.format, kExportFormats, form.form);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  const std::vector<io::ExportWord> machine = w.machine.given(), labels = w.labels.given();
  LEKALO_TRY(form.process, to_process(w, machine));
  if (form.form == jobs::LayoutForm::machine) {
    // The file of processes, which is not read yet, may have what is missing on the line.
    if (!form.process) {
      LEKALO_TRY(form.machine, io::read_export_words(*io::export_form(w.format), machine, "--"));
    }
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
  const std::string machines = "For machines and other programs";
  words->machine.add_to(form, machines, io::export_words());
  const OptionAdder add_process(form, machines);
  add_process("--processes", words->processes, "FILE",
              "gcode, hpgl: take from this file what is not given here");
  add_process("--material", words->material, "NAME", "gcode, hpgl: the material of the process to take");
  add_process("--thickness", words->thickness, "MM", "gcode, hpgl: the thickness of the process to take");
  words->labels.add_to(form, "For labels", jobs::label_words());
  form.footer =
      "Exit codes: 0 done, whatever rules are broken, 2 wrong command line, 3 a file cannot be read,\n"
      "5 disk or memory.";
  return [words] { return to_export(*words); };
}

}  // namespace lekalo::cli
