#include <memory>
#include <utility>

#include "layout_words.hpp"
#include "lekalo/io/text/words.hpp"
#include "machine_words.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

/// The words as they were typed.
struct QuoteWords {
  LayoutWords reading;
  std::vector<std::string> layouts, outputs;
  std::string rates, processes, material, thickness, title, programs;
  MachineWords machine;  ///< words that io::read_export_words understands
  bool json = false;
};

/// The words of an export as G-code that a quote has a use for: it is of all sheets.
std::vector<io::ExportWordHelp> machine_words() {
  std::vector<io::ExportWordHelp> words = io::export_words();
  std::erase_if(words,
                [](const io::ExportWordHelp& word) { return word.name == "sheet" || word.name == "only"; });
  return words;
}

Result<Command> to_quote(const QuoteWords& w) {
  QuoteOptions o;
  LayoutWords words = w.reading;
  for (const std::string& path : w.layouts) {
    words.path = path;
    LEKALO_TRY(LayoutSource source, to_layout_source(words));
    o.sources.push_back(std::move(source));
  }
  WordReader reader;
  for (const std::string& output : w.outputs) {
    const std::string ending = io::ending_of(output);
    reader.require(
        ending == ".pdf" || ending == ".csv",
        fmt::format("--output {}: the name has to end in .pdf or .csv, which says what is written", output));
    std::string& to = ending == ".pdf" ? o.pdf : o.csv;
    reader.require(to.empty(), fmt::format("--output {}: one {} is written", output, ending.substr(1)));
    to = output;
  }
  o.job.rates.name = w.rates;
  if (!w.processes.empty()) o.job.processes = jobs::File{w.processes, {}};
  o.job.material = w.material;
  reader.number("--thickness", w.thickness, 0.001, 1000.0, "a thickness from 0.001 to 1000 mm",
                o.job.thickness_mm);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  o.job.words = w.machine.given();
  // The file of processes, which is not read yet, may have what is missing on the line.
  if (!o.job.processes) LEKALO_CHECK(io::read_export_words(io::ExportForm::gcode, o.job.words, "--"));
  o.job.prefix = "--", o.job.title = w.title;
  o.programs = w.programs, o.json = w.json;
  return Command(std::move(o));
}

}  // namespace

Typed add_quote_form(Form& form) {
  auto words = std::make_shared<QuoteWords>();
  const OptionAdder add(form);
  add("layout", words->layouts, "FILE",
      "Layouts, or whatever becomes one; of a report of an order (lekalo nest --json) all its layouts")
      .required = true;
  add("--rates", words->rates, "FILE", "What an hour, a pierce, a metre and the material cost").required =
      true;
  add("-o,--output", words->outputs, "FILE", "Write the quote: .pdf or .csv, or both [CSV on stdout]")
      .one_word_a_time = true;
  add("--gcode", words->programs, "FILE", "Write the programs that were timed, one for each sheet");
  add("--title", words->title, "TEXT", "Of the printed quote [the names of the layouts]");
  add("--json", words->json, "Print the quote as JSON on stdout");
  const std::string machines = "How it is cut, as of lekalo export --format gcode";
  const OptionAdder add_machine(form, machines);
  add_machine("--processes", words->processes, "FILE", "Take from this file what is not given here");
  add_machine("--material", words->material, "NAME", "Of stock that says none, and the process to take");
  add_machine("--thickness", words->thickness, "MM", "Likewise");
  words->machine.add_to(form, machines, machine_words());
  OptionAdder{form, "Reading"}("--instance", words->reading.instance, "FILE",
                               "Of placements: the file of the items, when not where they say");
  add_drawings_reading(form, words->reading);
  form.footer =
      "Exit codes: 0 done, whatever rules are broken, 2 wrong command line, 3 a file cannot be read,\n"
      "5 disk or memory.";
  return [words] { return to_quote(*words); };
}

}  // namespace lekalo::cli
