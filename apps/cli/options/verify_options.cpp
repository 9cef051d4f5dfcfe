#include <memory>

#include "option_forms.hpp"

namespace lekalo::cli {

Typed add_verify_form(Form& form) {
  auto o = std::make_shared<VerifyOptions>();
  const OptionAdder add(form);
  add("result", o->result, "FILE", "Result written by lekalo locate -o").required = true;
  add("--part", o->part, "FILE", "Where the part file is now, when not where the result says");
  add("--blank", o->blank, "FILE", "Where the blank file is now");
  add("--features", o->features, "FILE", "Where the file of features is now");
  add("--nc", o->program, "FILE", "Where the NC program that was moved is now");
  add("--compare", o->earlier, "FILE", "Where the earlier result is now");
  add("--certificate", o->certificate, "FILE", "Where the certificate file is now");
  add("--json", o->json, "Print the report as JSON on stdout");
  form.footer =
      "Exit codes: 0 confirmed, 1 clearance confirmed but there is no proof of the bound or a claim was not\n"
      "rechecked, 4 refuted, 2 wrong command line, 3 a file cannot be read.";
  return [o] { return Result<Command>(*o); };
}

}  // namespace lekalo::cli
