#include <csignal>
#include <cstdint>
#include <exception>
#include <new>
#include <variant>

#include "commands/check_command.hpp"
#include "commands/edit_command.hpp"
#include "commands/export_command.hpp"
#include "commands/fit_command.hpp"
#include "commands/heat_command.hpp"
#include "commands/locate_command.hpp"
#include "commands/nest_command.hpp"
#include "commands/new_command.hpp"
#include "commands/pocket_command.hpp"
#include "commands/quote_command.hpp"
#include "commands/serve_command.hpp"
#include "commands/show_command.hpp"
#include "commands/simulate_command.hpp"
#include "commands/stock_command.hpp"
#include "commands/store_command.hpp"
#include "commands/verify_command.hpp"
#include "interrupt.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/verify/memory.hpp"
#include "options/options.hpp"
#include "outputs.hpp"

namespace lekalo::cli {
namespace {

Result<int> run(const LocateOptions& options) { return run_locate(options); }
Result<int> run(const VerifyOptions& options) { return run_verify(options); }
Result<int> run(const PocketOptions& options) { return run_pocket(options); }
Result<int> run(const SimulateOptions& options) { return run_simulate(options); }
Result<int> run(const FitOptions& options) { return run_fit(options); }
Result<int> run(const HeatOptions& options) { return run_heat(options); }
Result<int> run(const CheckOptions& options) { return run_check(options); }
Result<int> run(const ShowOptions& options) { return run_show(options); }
Result<int> run(const ExportOptions& options) { return run_export(options); }
Result<int> run(const QuoteOptions& options) { return run_quote(options); }
Result<int> run(const EditOptions& options) { return run_edit(options); }
Result<int> run(const NestOptions& options) { return run_nest(options); }
Result<int> run(const NewOptions& options) { return run_new(options); }
Result<int> run(const ServeOptions& options) { return run_serve(options); }
Result<int> run(const StoreOptions& options) { return run_store(options); }
Result<int> run(const StockOptions& options) { return run_stock(options); }
Result<int> run(const PrintText& command) {
  return print(command.text).map([] { return 0; });
}

/// A command that Ctrl-C and SIGTERM may end wherever it is.
template <class Options>
Result<int> run_until_stopped(const Options& options, std::uint64_t steps) {
  const StopRequests stop;
  RunControl control;
  control.stop = StopRequests::flag();
  control.work_limit = steps;
  const auto status = stoppable(control, [&] { return run(options); });
  if (status) return *status;
  complain(status.error().what());
  return status.error().out_of_work() ? exit_status(ErrorCode::bad_input) : 1;
}
/// The server has stops of its own, one for each of its jobs.
Result<int> run_until_stopped(const ServeOptions& options, std::uint64_t) { return run(options); }

int run_command_line(int argc, char** argv) {
  const Result<int> status = parse_command_line(argc, argv).and_then([](const CommandLine& line) {
    return std::visit([&](const auto& options) { return run_until_stopped(options, line.steps); },
                      line.command);
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
  lekalo::verify::let_numbers_throw_bad_alloc();
  try {
    return lekalo::cli::run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    lekalo::cli::complain("not enough memory for this input");
  } catch (const std::exception& error) {
    lekalo::cli::complain(std::string("unexpected: ") + error.what());
  }
  return lekalo::exit_status(lekalo::ErrorCode::environment);
}
