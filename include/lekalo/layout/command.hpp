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
#include "lekalo/layout/job.hpp"
#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// The commands of interactive correction: values, applied to a workspace by apply() (below) or, with
/// history, by a Session. What each does, and the text form: docs/design/layout-commands.md. Directions are
/// vectors of any length but 0; distances are grid steps. Ids name placements; a command with several moves
/// them as one.

/// A new placement; its id is the document's next.
struct PlaceCommand {
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
  /// Another sheet, if the placements change to one.
  std::optional<Sheet> to;
  friend bool operator==(const MoveCommand&, const MoveCommand&) = default;
};
/// Turns about the middle of the placements' boxes, counter-clockwise.
struct RotateCommand {
  std::vector<std::uint64_t> ids;
  double degrees = 0;  ///< |degrees| <= 360,000
  friend bool operator==(const RotateCommand&, const RotateCommand&) = default;
};
/// Makes left right, about the middle of the placements' boxes.
struct FlipCommand {
  std::vector<std::uint64_t> ids;
  friend bool operator==(const FlipCommand&, const FlipCommand&) = default;
};
struct RemoveCommand {
  std::vector<std::uint64_t> ids;
  friend bool operator==(const RemoveCommand&, const RemoveCommand&) = default;
};
/// Two placements change places: the middles of their boxes, and their sheets.
struct SwapCommand {
  std::uint64_t a = 0, b = 0;
  friend bool operator==(const SwapCommand&, const SwapCommand&) = default;
};
struct LockCommand {
  std::vector<std::uint64_t> ids;
  bool locked = true;
  friend bool operator==(const LockCommand&, const LockCommand&) = default;
};
/// Slides in a direction until something is in the way; gaps are kept.
struct SlideCommand {
  std::vector<std::uint64_t> ids;
  geom::GridPoint direction;
  friend bool operator==(const SlideCommand&, const SlideCommand&) = default;
};
/// Slides towards a shifted place, along whatever is in the way; gaps are kept.
struct SlideAlongCommand {
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  friend bool operator==(const SlideAlongCommand&, const SlideAlongCommand&) = default;
};
/// Slides and slides along until the placements rest against what lies in the direction; `then` is a second
/// direction, for a corner.
struct SettleCommand {
  std::vector<std::uint64_t> ids;
  geom::GridPoint direction;
  std::optional<geom::GridPoint> then;
  friend bool operator==(const SettleCommand&, const SettleCommand&) = default;
};
/// Moves, and takes along what is in the way. Locked parts and borders stay and stop the motion.
struct PushCommand {
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  friend bool operator==(const PushCommand&, const PushCommand&) = default;
};
/// Takes the nearest edge of a neighbour or border within reach. The part is turned parallel to it where its
/// angles allow it, and moved against it, corner to corner where a corner is within reach.
struct SnapCommand {
  std::uint64_t id = 0;
  std::int64_t reach = 0;
  friend bool operator==(const SnapCommand&, const SnapCommand&) = default;
};
/// Lets everything on a sheet that is not locked settle in a direction, the foremost first.
struct CompactCommand {
  /// Without a value: every sheet that something lies on.
  std::optional<Sheet> sheet;
  geom::GridPoint direction;
  friend bool operator==(const CompactCommand&, const CompactCommand&) = default;
};
/// Moves to the valid place found nearest to the shifted one.
struct NearestCommand {
  std::vector<std::uint64_t> ids;
  geom::GridPoint by;
  std::optional<Sheet> to;
  friend bool operator==(const NearestCommand&, const NearestCommand&) = default;
};

/// A new placement in the first of the places where it fits (fits_where).
struct FitCommand {
  std::uint32_t part = 0;
  Sheet sheet;
  /// Without a value: as it fits.
  std::optional<bool> mirrored;
  friend bool operator==(const FitCommand&, const FitCommand&) = default;
};

/// The commands for features describe defects and quality zones as they really are. So they are admitted in
/// both modes, whatever lies there, and what breaks a rule by them shows as violations. A feature that is
/// moved or given another outline is its polygon from then on; its curves are left behind.
struct AddFeatureCommand {
  FeatureKind kind = FeatureKind::defect;
  std::uint32_t stock = 0;
  /// An id that no feature of its kind on the stock has yet; not empty, plain text.
  std::string id;
  int grade = 1;                                    ///< severity or quality
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

/// The commands for the job say what is wanted. So they, too, are admitted in both modes, and placements that
/// break a rule by them show as violations. What is placed of a part, or on a sheet, that goes is taken off
/// with it.
struct QuantityCommand {
  std::uint32_t part = 0;
  std::int64_t quantity = 0;  ///< Part::demand
  friend bool operator==(const QuantityCommand&, const QuantityCommand&) = default;
};
struct RotationsCommand {
  std::uint32_t part = 0;
  std::vector<AngleRange> rotations;  ///< an empty list allows any
  friend bool operator==(const RotationsCommand&, const RotationsCommand&) = default;
};
struct MirrorCommand {
  std::uint32_t part = 0;
  bool may_mirror = false;
  friend bool operator==(const MirrorCommand&, const MirrorCommand&) = default;
};
/// The part goes from kits too, and a kit that was made of nothing else goes with it.
struct RemovePartCommand {
  std::uint32_t part = 0;
  friend bool operator==(const RemovePartCommand&, const RemovePartCommand&) = default;
};
struct AddSheetCommand {
  std::int64_t width = 0, height = 0;
  std::int64_t count = 0;  ///< 0: as many as may be needed
  friend bool operator==(const AddSheetCommand&, const AddSheetCommand&) = default;
};
struct AddStripCommand {
  std::int64_t width = 0;
  friend bool operator==(const AddStripCommand&, const AddStripCommand&) = default;
};
struct CountCommand {
  std::uint32_t stock = 0;
  std::int64_t count = 1;
  friend bool operator==(const CountCommand&, const CountCommand&) = default;
};
struct RemoveStockCommand {
  std::uint32_t stock = 0;
  friend bool operator==(const RemoveStockCommand&, const RemoveStockCommand&) = default;
};
enum class RuleKind : std::uint8_t {
  gap,  ///< one that is smaller than the kerf is raised to it
  border,
  kerf  ///< the width of the cut: a smaller gap is raised to it
};
struct RuleCommand {
  RuleKind kind = RuleKind::gap;
  std::int64_t length = 0;
  friend bool operator==(const RuleCommand&, const RuleCommand&) = default;
};

using Command =
    std::variant<PlaceCommand, MoveCommand, RotateCommand, FlipCommand, RemoveCommand, SwapCommand,
                 LockCommand, SlideCommand, SlideAlongCommand, SettleCommand, PushCommand, SnapCommand,
                 CompactCommand, NearestCommand, FitCommand, AddFeatureCommand, MoveFeatureCommand,
                 ReshapeFeatureCommand, GradeFeatureCommand, RemoveFeatureCommand, QuantityCommand,
                 RotationsCommand, MirrorCommand, RemovePartCommand, AddSheetCommand, AddStripCommand,
                 CountCommand, RemoveStockCommand, RuleCommand>;

/// Returns the command as one line without its end: `slide 3 5 : -1 0`. Lengths are in millimetres, angles in
/// degrees, parts and stocks have their names, and nothing is lost.
[[nodiscard]] std::string to_text(const Command& command, const Document& document);
/// Returns a name as a line of a command has it: in quotation marks.
[[nodiscard]] std::string quoted_name(std::string_view name);
/// Fails with bad_input, naming the word. Numbers are read as in layout files.
[[nodiscard]] Result<Command> command_from_text(std::string_view line, const Document& document);

enum class Mode : std::uint8_t {
  strict,  ///< what would break a rule is not admitted: the source's rule
  free     ///< it is, and shown as violations
};

/// Everything that a command changes: placements, features and the job before and after. Undoing it means
/// putting back what was before, the features in reverse order. Placements and features name parts and stocks
/// by the numbers that JobChange speaks of.
struct PlacementChange {
  /// At least one of the two, with one id.
  std::optional<Placement> before, after;
  friend bool operator==(const PlacementChange&, const PlacementChange&) = default;
};
struct Change {
  /// The changes ascending by id; none when nothing moved.
  std::vector<PlacementChange> placements;
  std::uint64_t next_id_before = 1, next_id_after = 1;
  /// The changes in the order in which they are carried out.
  std::vector<FeatureChange> features;
  JobChange job;
  [[nodiscard]] bool is_nothing() const noexcept {
    return placements.empty() && features.empty() && job.is_nothing() && next_id_before == next_id_after;
  }
  friend bool operator==(const Change&, const Change&) = default;
};

/// Works out what a command would do, or why it may not.
///
/// In strict mode this fails with ErrorCode::refuted, in one sentence with the first violation, when a
/// placement that it changes would break a rule. (Removing and locking break none.) In free mode only
/// commands that slide insist on valid places, since they need one to start from. It fails with
/// ErrorCode::usage for ids, parts or sheets that are not there, locked placements, a direction of no length,
/// and what leaves the grid; with ErrorCode::bad_input for outlines that make_grid_region refuses, and ids
/// and grades that features cannot have. It is deterministic, and the workspace is as before.
///
/// \param run  for commands that take long, CompactCommand and FitCommand. When they are stopped they give
/// what they have so far, or fail with ErrorCode::usage where that is nothing yet. The work limit does not
/// count.
[[nodiscard]] Result<Change> plan(const Workspace& workspace, const Command& command, Mode mode,
                                  const RunControl& run = {});

/// Cost: that of the placements and features; where the job changes, that of the document and of its scenes.
void carry_out(Workspace& workspace, const Change& change);
/// Carries a change out on a document alone.
/// \pre stocks and parts are there
void carry_out(Document& document, const Change& change);
void take_back(Workspace& workspace, const Change& change);

/// Returns the change that takes one back. Numbers of placements are never given again while others may speak
/// of them, so the next one stays `next_id`.
[[nodiscard]] Change reversed(const Change& change, std::uint64_t next_id);
/// Returns the change that leads from one document to another.
[[nodiscard]] Change difference(const Document& from, const Document& to);
/// Returns a change that fits the document `then` with the numbers that parts and stocks have in `now`, where
/// others may have come and gone since. Fails with ErrorCode::refuted where it names one that is not there
/// any more, or is another shape.
[[nodiscard]] Result<Change> renumbered(Change change, const Document& then, const Document& now);

/// Returns places where a part would lie clear on a sheet, at most `most`, lowest and then leftmost first.
/// Each is settled towards the lower left from one of the lowest clear places of a grid of starts, at each of
/// the part's angles (16 of a range) and mirrored where it may be. They are found by trying and are not all
/// there are. Ids are 0.
/// \param mirrored  so or not so only; without a value either
[[nodiscard]] std::vector<Placement> fits_where(const Workspace& workspace, std::uint32_t part, Sheet sheet,
                                                std::size_t most, std::optional<bool> mirrored = std::nullopt,
                                                const RunControl& run = {});

}  // namespace lekalo::layout
