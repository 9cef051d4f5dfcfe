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
#include "lekalo/io/scan/scan_file.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/pocket.hpp"
#include "lekalo/locate/demand.hpp"
#include "lekalo/locate/guaranteed_blank.hpp"
#include "lekalo/locate/reference.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/nc/rewrite.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::cli {

enum class Method { certified, ipopt, icp };

/// How a blank was measured.
struct ScanWords {
  locate::ScanOptions measurement;
  std::optional<io::ScanSlice> slice;
};

/// How a part's or a blank's file is read.
struct ShapeOptions {
  std::optional<LengthUnit> units;
  std::optional<double> join, curve;  ///< of drawings, mm
  std::vector<std::string> layers;    ///< of drawings; empty: all that are shown
  std::optional<ScanWords> scan;      ///< the file holds measured points
};

/// What `lekalo locate` was asked for, checked. An empty path means: not asked for.
struct LocateOptions {
  std::string part, blank;
  std::optional<LengthUnit> units;
  std::optional<double> trim;  ///< mm
  std::optional<double> join, curve;
  std::vector<std::string> part_layers, blank_layers;
  std::optional<ScanWords> scan;  ///< the blank is a scan
  double window_from_deg = 0, window_to_deg = 360;
  std::optional<double> gap;  ///< mm; each kind of shape has its own default
  double min_allowance = 0;   ///< mm
  locate::Mirror mirror = locate::Mirror::no;
  locate::LockedShift locked;
  std::string features;  ///< file
  locate::Criterion criterion = locate::Criterion::smallest;
  double give_up = 0;         ///< mm
  std::size_t trade_off = 0;  ///< points
  Method method = Method::certified;
  int starts = 10;
  locate::StartRule start_rule = locate::StartRule::random;
  std::uint64_t seed = 0;
  std::uint64_t work = std::numeric_limits<std::uint64_t>::max();
  std::optional<double> seconds;
  std::optional<double> alternatives;  ///< mm
  std::string nc, nc_out;
  nc::RewriteOptions rewrite;
  std::string output, certificate, picture, report, allowances, drawing, deviations, compare;
  bool json = false;
  std::vector<std::string> warnings;  ///< options that have no effect here

  [[nodiscard]] ShapeOptions of_part() const { return {units, join, curve, part_layers, {}}; }
  [[nodiscard]] ShapeOptions of_blank() const { return {units, join, curve, blank_layers, scan}; }
};

struct VerifyOptions {
  std::string result;
  std::string part, blank, certificate;  ///< instead of the paths in the result; may be empty
  bool json = false;
};

/// A file that holds a layout, or something that becomes one, and how it is read.
struct LayoutSource {
  std::string path;
  std::string instance;  ///< of placements: the file of the items; empty: where they say
  io::PartOptions parts;
};

/// A program that ran before with a tool of its own.
struct EarlierFile {
  std::string path;
  double tool_diameter = 0;  ///< mm
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
  ShapeOptions shape;
  std::vector<EarlierFile> after;
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
  std::string output;  ///< empty: stdout
  jobs::ExportOptions form;
};

struct EditOptions {
  LayoutSource source;
  std::string commands, output;  ///< output may be empty: stdout
};

struct NestOptions {
  LayoutSource source;
  std::string output, picture;  ///< may be empty; output: stdout, unless the report goes there
  std::string stream;           ///< every better layout; may be empty
  jobs::NestOptions search;
  std::optional<double> seconds;
  std::uint64_t work = std::numeric_limits<std::uint64_t>::max();
  bool json = false;
};

struct ServeOptions {
  LayoutSource source;  ///< an empty path: none
  std::string store;    ///< empty: among the user's data
  std::string listen = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any
  std::string token;          ///< empty: none given
};

/// Whether anything was asked for that takes the shapes as regions, convex or not.
[[nodiscard]] bool has_demands(const LocateOptions& options);

/// Whether anything was asked for that only convex contours have.
[[nodiscard]] bool needs_convex(const LocateOptions& options);

/// Text for stdout and nothing else to do: help, version, a completion script.
struct PrintText {
  std::string text;
};

using Command = std::variant<LocateOptions, VerifyOptions, PocketOptions, SimulateOptions, CheckOptions,
                             ShowOptions, ExportOptions, EditOptions, NestOptions, ServeOptions, PrintText>;

/// ErrorCode::usage with one sentence for everything that is not a command line of lekalo.
[[nodiscard]] Result<Command> parse_command_line(int argc, char** argv);

/// Names as they stand on the command line and in results.
[[nodiscard]] const char* name_of(Method method) noexcept;
[[nodiscard]] const char* name_of(nc::RewriteMode mode) noexcept;
[[nodiscard]] const char* name_of(nc::ScanFrame frame) noexcept;

}  // namespace lekalo::cli
