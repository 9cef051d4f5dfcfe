#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/scan/scan_file.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/locate/demand.hpp"
#include "lekalo/locate/placement.hpp"
#include "lekalo/locate/proof.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/nc/rewrite.hpp"

namespace lekalo::io {

/// The result document of `lekalo locate` (docs/formats.md): what is in it, the writer, and a reader for the
/// parts that other commands need. All indices here are file order already.

/// A file by the name the user gave, and the digest of its bytes.
struct FileRecord {
  std::string path, sha256;
};

/// One file that the result was made from. `unit`, `points` and `dropped` are for contours only.
struct InputRecord {
  std::string role;  ///< "part", "blank", "nc" or "last-result"
  FileRecord file;
  std::optional<LengthUnit> unit;
  std::size_t points = 0;
  std::vector<std::size_t> dropped;
};

struct NcRecord {
  std::string mode, scan_frame, control;
  int work_offset = 1;
  double rounding_mm = 0;
  /// The clearance that the written program keeps, mm: never above clearance - rounding_mm.
  double clearance = 0;
  std::size_t motions = 0;
  std::vector<std::string> notes;
  FileRecord output;
};

/// Probing again: how far the new placement lies from that of an earlier result (input "last-result").
struct ComparisonRecord {
  /// True when the earlier result was made from a part file with the same bytes.
  bool same_part = true;
  double dx = 0, dy = 0;  ///< new minus last, mm
  double dtheta = 0;      ///< new minus last, radians in (-pi, pi]
  /// The largest shift of all part vertices, mm.
  double largest_shift = 0;
  /// The clearance as written in the earlier result, mm.
  double last_clearance = 0;
  /// The clearance of the last placement in the new blank, mm, never above the exact one.
  double last_pose_clearance = 0;
};

struct DeviationsRecord {
  FileRecord file;
  std::size_t points = 0;
  double least = 0, greatest = 0;  ///< mm, positive outside the placed part
};

/// Demands and what became of them. A trade-off curve and `contacts` as in DemandResult.
struct DemandRecord {
  double minimum = 0;
  std::vector<locate::Feature> features;
  locate::Criterion criterion = locate::criteria().front();
  double give_up = 0;
  double margin = 0, margin_bound = 0, margin_found = 0, margin_gap = 0, largest = 0, deviation = 0;
  /// Its proof without `grown`; without certificate: there is none, or it is in certificate_file.
  std::optional<locate::SmallestLargest> second;
  std::vector<locate::TradeOff> curve;
  double grown_for = 0, shift = 0, bound = 0;  ///< as in DemandProof
};

/// A localisation of convex outlines or of regions: `proof` says which.
struct LocateDocument {
  std::string status;  ///< optimal, stopped, infeasible, unproved
  std::string method;  ///< certified, ipopt, icp
  std::vector<InputRecord> inputs;
  std::vector<std::string> warnings;
  std::uint64_t seed = 0, work = 0;
  locate::Placement placement;
  /// True when the part is mirrored in the placement.
  bool mirrored = false;
  /// There is none with demands, whose margin has the bound.
  std::optional<double> upper_bound;
  double min_allowance = 0, shortfall = 0;
  double window_from_deg = 0, window_to_deg = 360;
  /// With an AngleProof only numbers and multipliers are written.
  std::vector<locate::Touch> contacts;
  /// Empty when there is none, or when it is in certificate_file.
  locate::Proof proof;
  std::optional<FileRecord> certificate_file;
  /// The size of the proof, wherever it is.
  std::size_t certificate_intervals = 0;
  std::optional<NcRecord> nc;
  /// The time of this run; the only field that is not a function of the input.
  double seconds = 0;
  int threads = 1;

  // A PoseProof comes with what follows.
  std::vector<geom::Region> part, blank;
  double part_tolerance = 0, blank_tolerance = 0;
  /// True when `part` is without what a file of features says to ignore.
  bool part_cut = false;
  /// The mirroring that was allowed.
  locate::Mirror mirror = locate::Mirror::no;
  locate::LockedShift locked;
  std::optional<DemandRecord> demands;
  /// How drawings became the regions.
  std::optional<DrawingRecord> part_drawing, blank_drawing;
  /// The scan that `blank` was made from.
  std::optional<ScanRecord> scan;

  // An AngleProof comes with what follows.
  std::vector<locate::Placement> alternatives;
  bool alternatives_complete = true;
  std::optional<TrimRecord> trim;
  std::optional<ComparisonRecord> comparison;
  std::optional<DeviationsRecord> deviations;

  /// True if convex outlines were placed, by the fast path or a method of reference.
  [[nodiscard]] bool convex() const noexcept { return std::holds_alternative<locate::AngleProof>(proof); }
};

/// The document as JSON text, one top-level field or list item a line, numbers in the shortest form that
/// reads back to the same double. Bytes of a path that are not UTF-8 become U+FFFD. \pre every number is
/// finite.
[[nodiscard]] std::string result_json(const LocateDocument& document);

/// Writes how a drawing or a scan became regions as results have it, or null, where a value is due.
void write_record(JsonWriter& json, const std::optional<DrawingRecord>& drawing);
void write_record(JsonWriter& json, const std::optional<ScanRecord>& scan);

/// How many intervals of the angle or boxes of poses prove what the document says, that of largest allowances
/// included.
[[nodiscard]] std::size_t proof_size(const LocateDocument& document);
/// True if the document holds a proof of its bound.
[[nodiscard]] bool has_proof(const LocateDocument& document) noexcept;

/// The document of a certificate file: all proofs that the document holds.
[[nodiscard]] std::string certificate_text(const LocateDocument& document);

/// Names as they stand in results.
[[nodiscard]] const char* name_of(locate::Status status) noexcept;
[[nodiscard]] const char* name_of(nc::RewriteMode mode) noexcept;
[[nodiscard]] const char* name_of(nc::ScanFrame frame) noexcept;

/// Holds what `verify` and `--compare` need of a written result; what is proved about the rest is verify's
/// matter.
struct WrittenResult {
  std::string status, method;
  std::vector<InputRecord> inputs;  ///< role and file only
  locate::Placement placement;
  bool mirrored = false;
  /// The pose in a result for solids, which has neither `placement` nor `mirrored`.
  std::optional<locate::SolidPose> solid_pose;
  std::optional<FileRecord> certificate_file, nc_output, deviations;

  /// The first input with this role, or nullptr.
  [[nodiscard]] const InputRecord* input(std::string_view role) const noexcept;
};

/// bad_input, naming the file and the field, when this is not a result of `lekalo locate` of this version.
[[nodiscard]] Result<WrittenResult> read_result(std::string_view bytes, const std::string& name);

}  // namespace lekalo::io
