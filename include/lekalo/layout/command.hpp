#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/layout/feature.hpp"
#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// The commands of interactive correction: values, applied to a workspace by apply() (below) or, with
/// history, by a Session. What each does, and the text form: docs/design/layout-commands.md. Directions are
/// vectors of any length but 0; distances are grid steps. Ids name placements; a command with several moves
/// them as one.

struct PlaceCommand {  ///< a new placement; its id is the document's next
  std::uint32_t part = 0, stock = 0;
  std::int64_t copy = 0;
  geom::GridRotation rotation;
  bool mirrored = false;
  geom::GridPoint at;
  friend bool operator==(const PlaceCommand&, const PlaceCommand&) = default;
};
struct MoveCommand {
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  std::optional<Sheet> to;  ///< another sheet
  friend bool operator==(const MoveCommand&, const MoveCommand&) = default;
};
struct RotateCommand {  ///< about the middle of their boxes, counter-clockwise
  std::vector<std::uint64_t> ids;
  double degrees = 0;  ///< |degrees| <= 360,000
  friend bool operator==(const RotateCommand&, const RotateCommand&) = default;
};
struct FlipCommand {  ///< left becomes right, about the middle of their boxes
  std::vector<std::uint64_t> ids;
  friend bool operator==(const FlipCommand&, const FlipCommand&) = default;
};
struct RemoveCommand {
  std::vector<std::uint64_t> ids;
  friend bool operator==(const RemoveCommand&, const RemoveCommand&) = default;
};
struct SwapCommand {  ///< two placements change places: the middles of their boxes, and sheets
  std::uint64_t a = 0, b = 0;
  friend bool operator==(const SwapCommand&, const SwapCommand&) = default;
};
struct LockCommand {
  std::vector<std::uint64_t> ids;
  bool locked = true;
  friend bool operator==(const LockCommand&, const LockCommand&) = default;
};
struct SlideCommand {  ///< in a direction until something is in the way; gaps are kept
  std::vector<std::uint64_t> ids;
  geom::GridPoint direction;
  friend bool operator==(const SlideCommand&, const SlideCommand&) = default;
};
struct SlideAlongCommand {  ///< towards a shifted place, along whatever is in the way, gaps kept
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  friend bool operator==(const SlideAlongCommand&, const SlideAlongCommand&) = default;
};
struct SettleCommand {  ///< slides and slides along until it rests against what lies that way; `then` for a
                        ///< corner
  std::vector<std::uint64_t> ids;
  geom::GridPoint direction;
  std::optional<geom::GridPoint> then;
  friend bool operator==(const SettleCommand&, const SettleCommand&) = default;
};
struct PushCommand {  ///< moves, and what is in the way moves along; locked parts and borders stay and stop
                      ///< it
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  friend bool operator==(const PushCommand&, const PushCommand&) = default;
};
struct SnapCommand {  ///< the nearest edge of a neighbour or border within reach: turned parallel to it where
                      ///< the part's angles allow it, moved against it, corner to corner where one is within
                      ///< reach
  std::uint64_t id = 0;
  std::int64_t reach = 0;
  friend bool operator==(const SnapCommand&, const SnapCommand&) = default;
};
struct CompactCommand {  ///< everything on a sheet that is not locked settles in a direction, foremost first
  std::optional<Sheet> sheet;  ///< absent: every sheet that something lies on
  geom::GridPoint direction;
  friend bool operator==(const CompactCommand&, const CompactCommand&) = default;
};
struct NearestCommand {  ///< to the valid place found nearest to the shifted one
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  std::optional<Sheet> to;
  friend bool operator==(const NearestCommand&, const NearestCommand&) = default;
};

struct FitCommand {  ///< a new placement in the first of the places where it fits (fits_where)
  std::uint32_t part = 0;
  Sheet sheet;
  std::optional<bool> mirrored;  ///< absent: as it fits
  friend bool operator==(const FitCommand&, const FitCommand&) = default;
};

/// Defects and quality zones as they really are: admitted in both modes, whatever lies there; what breaks a
/// rule by it shows as violations. A feature that is moved or given another outline is its polygon from then
/// on, curves are left behind.
struct AddFeatureCommand {
  FeatureKind kind = FeatureKind::defect;
  std::uint32_t stock = 0;
  std::string id;  ///< of none of its kind on the stock yet; not empty, plain text
  int grade = 1;   ///< severity or quality
  std::vector<std::vector<geom::GridPoint>> loops;  ///< the outline, then holes
  friend bool operator==(const AddFeatureCommand&, const AddFeatureCommand&) = default;
};
struct MoveFeatureCommand {
  FeatureKind kind = FeatureKind::defect;
  std::uint32_t stock = 0;
  std::string id;
  geom::GridPoint by;
  friend bool operator==(const MoveFeatureCommand&, const MoveFeatureCommand&) = default;
};
struct ReshapeFeatureCommand {
  FeatureKind kind = FeatureKind::defect;
  std::uint32_t stock = 0;
  std::string id;
  std::vector<std::vector<geom::GridPoint>> loops;
  friend bool operator==(const ReshapeFeatureCommand&, const ReshapeFeatureCommand&) = default;
};
struct GradeFeatureCommand {
  FeatureKind kind = FeatureKind::defect;
  std::uint32_t stock = 0;
  std::string id;
  int grade = 1;
  friend bool operator==(const GradeFeatureCommand&, const GradeFeatureCommand&) = default;
};
struct RemoveFeatureCommand {
  FeatureKind kind = FeatureKind::defect;
  std::uint32_t stock = 0;
  std::string id;
  friend bool operator==(const RemoveFeatureCommand&, const RemoveFeatureCommand&) = default;
};

using Command =
    std::variant<PlaceCommand, MoveCommand, RotateCommand, FlipCommand, RemoveCommand, SwapCommand,
                 LockCommand, SlideCommand, SlideAlongCommand, SettleCommand, PushCommand, SnapCommand,
                 CompactCommand, NearestCommand, FitCommand, AddFeatureCommand, MoveFeatureCommand,
                 ReshapeFeatureCommand, GradeFeatureCommand, RemoveFeatureCommand>;

/// One line, without its end: `slide 3 5 : -1 0`. Millimetres, degrees and names of parts and stocks, nothing
/// is lost.
[[nodiscard]] std::string to_text(const Command& command, const Document& document);
/// Fails with bad_input, naming the word. Numbers are read as in layout files.
[[nodiscard]] Result<Command> command_from_text(std::string_view line, const Document& document);

enum class Mode : std::uint8_t {
  strict,  ///< what would break a rule is not admitted: the source's rule
  free     ///< it is, and shown as violations
};

/// Everything that a command changes: placements and features before and after. Undoing it is putting back
/// what was before, the features in reverse order.
struct PlacementChange {
  std::optional<Placement> before, after;  ///< at least one, of one id
  friend bool operator==(const PlacementChange&, const PlacementChange&) = default;
};
struct Change {
  std::vector<PlacementChange> placements;  ///< ascending by id; none when nothing moved
  std::uint64_t next_id_before = 1, next_id_after = 1;
  std::vector<FeatureChange> features;  ///< in the order in which they are carried out
  [[nodiscard]] bool is_nothing() const noexcept {
    return placements.empty() && features.empty() && next_id_before == next_id_after;
  }
  friend bool operator==(const Change&, const Change&) = default;
};

/// Works out what a command would do, or why it may not.
///
/// Strict: fails with ErrorCode::refuted, in one sentence with the first violation, when a placement that it
/// changes would break a rule. (Removing and locking break none.) Free: only commands that slide insist on
/// valid places, since they need one to start from. Fails with ErrorCode::usage for ids, parts or sheets that
/// are not there, locked placements, no direction, and what leaves the grid; with ErrorCode::bad_input for
/// outlines that make_grid_region refuses, ids and grades that features cannot have. Deterministic; the
/// workspace is as before.
///
/// \param run  for commands that take long, CompactCommand and FitCommand: stopped, they give what they have
/// so far, or fail with ErrorCode::usage where that is nothing yet. The work limit does not count.
[[nodiscard]] Result<Change> plan(const Workspace& workspace, const Command& command, Mode mode,
                                  const RunControl& run = {});

void carry_out(Workspace& workspace, const Change& change);
/// Carries a change out on a document alone. \pre stocks and parts are there
void carry_out(Document& document, const Change& change);
void take_back(Workspace& workspace, const Change& change);

/// Places where a part would lie clear on a sheet, at most `most`, lowest and then leftmost first: settled
/// towards the lower left from the lowest clear ones of a grid of starts, at each of its angles (16 of a
/// range) and mirrored where it may be. Found by trying; not all there are. Ids are 0.
/// \param mirrored  so or not so only; absent: either
[[nodiscard]] std::vector<Placement> fits_where(const Workspace& workspace, std::uint32_t part, Sheet sheet,
                                                std::size_t most, std::optional<bool> mirrored = std::nullopt,
                                                const RunControl& run = {});

}  // namespace lekalo::layout
