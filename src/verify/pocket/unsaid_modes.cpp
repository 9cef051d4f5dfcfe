#include "unsaid_modes.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/verify/simulate.hpp"
#include "nc_program.hpp"

namespace lekalo::verify {
namespace {

using words::Control;
using words::Group;

constexpr unsigned bit(Control control) { return 1U << static_cast<unsigned>(control); }
constexpr unsigned kLinuxcnc = bit(Control::linuxcnc), kAll = (1U << words::kControlWords.size()) - 1,
                   kAllButGrbl = kAll & ~bit(Control::grbl);

enum class Moves : unsigned char { any, with_feed, arcs };

/// A mode that a control keeps from one program to the next, the motions that depend on it, and the controls
/// that have words for more than one of its values: on the others it cannot be another one.
struct Mode {
  Group group;
  Moves moves;
  unsigned controls;
  std::string_view what;
};

/// G80 is not among them: a motion needs a word of the program's own, and each of these ends a cycle.
/// G61 is a claim on LinuxCNC alone; how far the other controls round corners is their set-up. Shifts,
/// rotations and scales of the control (G52, G68, G51, G92) belong to the work offset, which the operator
/// sets.
constexpr Mode kModes[] = {
    {Group::unit, Moves::any, kAll, "its unit (G20 or G21)"},
    {Group::distance, Moves::any, kAll, "from where it counts (G90 or G91)"},
    {Group::plane, Moves::arcs, kAll, "the plane of its arcs (G17)"},
    {Group::work_offset, Moves::any, kAll, "its work offset (G54)"},
    {Group::feed_mode, Moves::with_feed, kAll, "that F is a speed (G94)"},
    {Group::compensation, Moves::any, kAllButGrbl, "that no radius is taken off (G40)"},
    {Group::tool_length, Moves::any, kAll, "the length of its tool (G43 or G49)"},
    {Group::centre, Moves::arcs, kLinuxcnc, "from where it counts centres (G90.1 or G91.1)"},
    {Group::path_control, Moves::any, kLinuxcnc, "that its path is exact (G61)"}};

bool depends(Moves moves, const Motions& motions) {
  return moves == Moves::any || (moves == Moves::arcs ? motions.arcs : motions.with_feed);
}

/// Adds the sentences about one program.
Result<void> add_unsaid(const Document& program, const std::string& called, const SimulateOptions& options,
                        std::vector<std::string>& to) {
  LEKALO_TRY(const NcProgram read, read_program(program, {.control = options.control, .top = options.top}));
  UnsaidModes unsaid(options.control, called);
  for (const NcEvent& event : read.events) {
    if (event.first_move == event.end_move && !event.places) continue;
    const auto first = read.moves.begin() + static_cast<std::ptrdiff_t>(event.first_move),
               end = read.moves.begin() + static_cast<std::ptrdiff_t>(event.end_move);
    const bool feeds = std::any_of(first, end, [](const Move& move) { return !move.rapid; });
    const bool turns = event.upright || std::any_of(first, end, [](const Move& move) { return move.arc; });
    unsaid.look(event.line, event.said, {.with_feed = feeds, .arcs = turns});
  }
  to.insert(to.end(), unsaid.sentences().begin(), unsaid.sentences().end());
  return {};
}

}  // namespace

void UnsaidModes::look(std::size_t line, const SaidGroups& said, const Motions& motions) {
  for (const Mode& mode : kModes) {
    const bool is_kept = (mode.controls & bit(control_)) != 0;
    if (!is_kept || said.has(mode.group) || !depends(mode.moves, motions) || !told_.insert(mode.what).second)
      continue;
    const bool of_one = mode.controls == kLinuxcnc;
    sentences_.push_back(fmt::format(
        "{}: line {} moves where the program does not say {}; the control decides it{}", program_, line,
        mode.what, of_one ? " (--control says whose words these are, if not LinuxCNC's)" : ""));
  }
}

Result<std::vector<std::string>> unsaid_modes(const Document& program, const SimulateOptions& options,
                                              const std::vector<EarlierProgram>& earlier) {
  std::vector<std::string> unsaid;
  LEKALO_CHECK(add_unsaid(program, "program", options, unsaid));
  for (const EarlierProgram& other : earlier)
    LEKALO_CHECK(add_unsaid(other.program, other.program.name, options, unsaid));
  return unsaid;
}

}  // namespace lekalo::verify
