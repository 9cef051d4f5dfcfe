#include <csignal>
#include <exception>
#include <new>
#include <variant>

#include "check_command.hpp"
#include "edit_command.hpp"
#include "export_command.hpp"
#include "lekalo/base/error.hpp"
#include "locate_command.hpp"
#include "nest_command.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "pocket_command.hpp"
#include "serve_command.hpp"
#include "show_command.hpp"
#include "simulate_command.hpp"
#include "verify_command.hpp"

namespace lekalo::cli {
namespace {

Result<int> run(const LocateOptions& options) { return run_locate(options); }
Result<int> run(const VerifyOptions& options) { return run_verify(options); }
Result<int> run(const PocketOptions& options) { return run_pocket(options); }
Result<int> run(const SimulateOptions& options) { return run_simulate(options); }
Result<int> run(const CheckOptions& options) { return run_check(options); }
Result<int> run(const ShowOptions& options) { return run_show(options); }
Result<int> run(const ExportOptions& options) { return run_export(options); }
Result<int> run(const EditOptions& options) { return run_edit(options); }
Result<int> run(const NestOptions& options) { return run_nest(options); }
Result<int> run(const ServeOptions& options) { return run_serve(options); }
Result<int> run(const PrintText& command) {
  return print(command.text).map([] { return 0; });
}

int run_command_line(int argc, char** argv) {
  const Result<int> status = parse_command_line(argc, argv).and_then([](const Command& command) {
    return std::visit([](const auto& options) { return run(options); }, command);
  });
  if (status) return *status;
  complain(status.error().message);
  return exit_status(status.error().code);
}

}  // namespace
}  // namespace lekalo::cli

int main(int argc, char** argv) {
  // A reader of stdout that went away is an error to report, after which half-written files are removed.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return lekalo::cli::run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    lekalo::cli::complain("not enough memory for this input");
  } catch (const std::exception& error) {
    lekalo::cli::complain(std::string("unexpected: ") + error.what());
  }
  return lekalo::exit_status(lekalo::ErrorCode::environment);
}
