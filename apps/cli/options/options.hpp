#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/formats/part_file.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/jobs/fit.hpp"
#include "lekalo/jobs/heat.hpp"
#include "lekalo/jobs/locate.hpp"
#include "lekalo/jobs/locate_solid.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/order_words.hpp"
#include "lekalo/jobs/pocket.hpp"
#include "lekalo/jobs/quote.hpp"
#include "lekalo/jobs/stock.hpp"
#include "lekalo/verify/claims.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

/// Holds what `lekalo locate` was asked for, checked. An empty path means: not asked for.
struct LocateOptions {
  std::string part, blank, nc, allow, compare, features, start, nominal;
  std::string offset_out;  ///< the name of the lines of a work offset
  std::string output, picture, report, allowances, drawing,
      mesh;  ///< the other outputs are named in `outputs`
  jobs::LocateOptions job;
  jobs::LocateOutputs outputs;
  jobs::SolidLocateOptions solid;
  /// A sentence about words that cannot be obeyed where the files are outlines, and one where they are
  /// solids; empty: there are none.
  std::string not_for_outlines, not_for_solids;
  std::uint64_t work = std::numeric_limits<std::uint64_t>::max();
  std::optional<double> seconds;
  bool json = false;
  std::vector<std::string> warnings;  ///< options that have no effect here
};

/// A program that ran before with a tool of its own.
struct EarlierFile {
  std::string path;
  double tool_diameter = 0;  ///< mm
};

struct VerifyOptions {
  std::string result;
  /// Instead of the paths in the result; may be empty.
  std::string part, blank, features, program, earlier, start, points, nominal, certificate;
  /// Files that one which is no placement was made from; may be empty.
  std::string layout, pocket;
  /// The place where the program of a report is now; may be empty.
  std::string cut_program;
  std::optional<double> tool_diameter;
  verify::SimulateOptions machining;
  std::vector<EarlierFile> after;
  verify::ExportWords export_words;
  std::optional<double> kerf, tolerance, pierce_diameter, joint_width;
  bool common_line = false;
  /// The words of a plot for a knife: mm, degrees, mm.
  std::optional<double> blade_offset, turn_above, knife_tolerance;
  bool json = false;
};

/// A file that holds a layout, or something that becomes one, and how it is read.
struct LayoutSource {
  std::string path;
  std::string instance;  ///< of placements: the file of the items; empty: where they say
  io::PartOptions parts;
  std::string layer_rules;  ///< the file of `parts.layer_rules`, which are not read yet; may be empty
};

/// Files of parts as they were typed: a file, a folder or a pattern, and how many of each outline are wanted.
struct PartWord {
  std::string files;
  std::optional<std::int64_t> count;
  layout::Material material{};
};

/// A job that is made of drawings.
struct OrderSource {
  std::vector<PartWord> parts;
  std::string table;  ///< a file of rows; may be empty
  std::string stock;  ///< a stock file, whose free pieces are cut; may be empty
  jobs::OrderTerms terms;
  io::PartOptions reading;
  std::string layer_rules;  ///< the file of `reading.layer_rules`, which are not read yet; may be empty
};

struct SimulateOptions {
  std::string program, pocket;
  std::vector<EarlierFile> after;
  verify::SimulateOptions machining;
  std::string samples, picture, animation;  ///< files; may be empty
  bool json = false;
};

/// The files and words of the command, and with them how the pocket is to be cleared.
struct PocketOptions : jobs::PocketOptions {
  std::string pocket, output;      ///< output may be empty: stdout
  std::string picture, animation;  ///< may be empty
  std::string images;              ///< prefix of the M-images of the source's methods; may be empty
  bool json = false;
  std::vector<EarlierFile> after;
};

/// The parts that are pressed, and the file of the result. The job has the names of the profile's files.
struct FitOptions {
  jobs::FitJob job;
  std::string output, picture;  ///< may be empty
  bool json = false;
};

/// A program whose heat moves walls. The job has all but the bytes of files, and what its words become.
struct HeatOptions {
  jobs::HeatJob job;
  std::string program, pocket;
  std::string stock;  ///< the file of its outline; empty for a block
  std::vector<EarlierFile> after;
  heat::MaterialWords material;
  std::string cooling;                                              ///< empty: dry
  std::string output, picture, maps, report, animation, corrected;  ///< may be empty
  std::optional<double> finish;                                     ///< mm
  bool json = false;
};

struct CheckOptions {
  LayoutSource source;
  std::string picture;  ///< may be empty
  bool json = false;
};

struct ShowOptions {
  LayoutSource source;
  std::string picture;  ///< may be empty
  bool json = false;
};

struct ExportOptions {
  LayoutSource source;
  std::string output;        ///< empty: stdout
  jobs::ExportOptions form;  ///< a file of processes is named there, and not read yet
};

/// Layouts, or reports of orders that name them, and what is asked of them. Of the job's files only the names
/// are known.
struct QuoteOptions {
  std::vector<LayoutSource> sources;
  jobs::QuoteOptions job;
  std::string pdf, csv, programs;  ///< may be empty
  bool json = false;
};

struct EditOptions {
  LayoutSource source;
  std::string commands, output;  ///< output may be empty: stdout
};

struct NestOptions {
  LayoutSource source;
  std::optional<OrderSource> order;  ///< instead of the source
  std::string output, picture;       ///< may be empty; output: stdout, unless the report goes there
  std::string stream;                ///< every better layout; may be empty
  std::string allocate;              ///< the order to which the stock is allocated; empty: none
  jobs::NestOptions search;
  std::optional<double> seconds;
  std::uint64_t work = std::numeric_limits<std::uint64_t>::max();
  bool json = false;
};

struct NewOptions {
  OrderSource order;
  std::string output;  ///< empty: stdout
};

struct ServeOptions {
  LayoutSource source;  ///< an empty path: none
  std::string store;    ///< empty: among the user's data
  std::string listen = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any
  std::string token_file;     ///< empty: none given
};

enum class StoreAction : std::uint8_t { check, backup, restore };
struct StoreOptions {
  StoreAction action = StoreAction::check;
  std::string file, output;  ///< output is empty for a check
};

enum class StockAction : std::uint8_t { add, list, take, cut, cancel, check };
struct StockOptions {
  StockAction action = StockAction::list;
  std::string file, order;
  std::vector<std::string> layouts;
  std::vector<jobs::StockWord> pieces;
  std::optional<layout::RemnantRule> rule;
  std::optional<double> cost, grain;
  io::PartOptions reading;
  std::string picture;
  bool json = false;
};

/// Text for stdout and nothing else to do: help, version, a completion script.
struct PrintText {
  std::string text;
};

using Command = std::variant<LocateOptions, VerifyOptions, PocketOptions, SimulateOptions, FitOptions,
                             HeatOptions, CheckOptions, ShowOptions, ExportOptions, QuoteOptions, EditOptions,
                             NestOptions, NewOptions, ServeOptions, StoreOptions, StockOptions, PrintText>;

/// The steps of work (base/stop.hpp) after which a command that does not search gives up, so that no input
/// takes for ever: docs/limits.md.
inline constexpr std::uint64_t kUsualSteps = 20'000'000'000;

/// A command and how much work it may take. Searches have a limit of their own, which counts their own units.
struct CommandLine {
  Command command;
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max();
};

/// ErrorCode::usage with one sentence for everything that is not a command line of lekalo.
[[nodiscard]] Result<CommandLine> parse_command_line(int argc, char** argv);

}  // namespace lekalo::cli
