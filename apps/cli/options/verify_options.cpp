#include <memory>

#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {

Typed add_verify_form(CLI::App& app) {
  auto o = std::make_shared<VerifyOptions>();
  app.add_option("result", o->result, "Result written by lekalo locate -o")->required()->type_name("FILE");
  const WordAdder add(app);
  add("--part", o->part, "FILE", "Where the part file is now, when not where the result says");
  add("--blank", o->blank, "FILE", "Where the blank file is now");
  add("--certificate", o->certificate, "FILE", "Where the certificate file is now");
  app.add_flag("--json", o->json, "Print the report as JSON on stdout");
  app.footer(
      "Exit codes: 0 confirmed, 1 clearance confirmed but there is no proof of the bound, 4 refuted,\n"
      "2 wrong command line, 3 a file cannot be read.");
  return [o] { return Result<Command>(*o); };
}

}  // namespace lekalo::cli
