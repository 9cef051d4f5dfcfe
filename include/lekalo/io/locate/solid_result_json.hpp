#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/locate/solid_feature_file.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "lekalo/locate/guaranteed_solid.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/touched_solid.hpp"
#include "lekalo/solid/symmetry.hpp"

namespace lekalo::io {

/// The result document of `lekalo locate` for solids (docs/formats.md, "Results for solids"). Triangles of
/// contacts have the numbers of their file.

/// One file that the result was made from.
struct SolidInputRecord {
  std::string role;  ///< "part", "blank", "points", "nominal", "start", "features", "nc" or "allow"
  FileRecord file;
  std::optional<SolidUnit> unit;                   ///< of a solid, or of points
  std::size_t triangles = 0;                       ///< of a solid
  std::size_t points = 0;                          ///< of the points that the blank was made from
  std::optional<double> deviation = std::nullopt;  ///< of a mesh by lekalo-step, mm
};

/// The poses that were looked at: see locate::SolidProblem.
struct SolidWindow {
  locate::SolidPose start;
  solid::Vector pivot;  ///< the point of the part whose place may differ by `shift`; part coordinates, mm
  double shift = 0;     ///< mm
  double turn_deg = 0;
  /// A box of rotations that holds all turns up to turn_deg about any axis has others at its corners. None is
  /// farther from the start than this, rounded up to hundredths.
  [[nodiscard]] double farthest_turn_deg(locate::SolidFreedom freedom) const noexcept;
};

/// The statements about a blank that is its nominal mesh, moved to touches, and why they hold it there.
struct SolidTouchRecord {
  double ball = 0, form = 0;  ///< mm
  bool directions = false;    ///< each touch has one
  locate::TouchProof proof;
};

/// The statements about a blank from a scanner, and what they leave open (locate/guaranteed_solid.hpp).
struct SolidScanRecord {
  double guard = 0;                           ///< mm
  std::optional<double> min_radius, max_dip;  ///< mm
  std::optional<locate::SolidUnderside> underside;
  double widest = 0;  ///< mm
  std::size_t unknown_triangles = 0;
  double unknown_area = 0;  ///< mm2
  /// Points that count as none of the surface, by their numbers in the file of points.
  std::vector<std::uint32_t> left_out;
  std::vector<std::string> assumptions;
  /// A blank that was touched has them, and no radius, dip or underside.
  std::optional<SolidTouchRecord> touches = std::nullopt;
  [[nodiscard]] bool proved() const noexcept { return unknown_triangles == 0; }
};

/// A datum, and how far the part is off it at the pose, at most, mm.
struct SolidDatumRecord {
  std::string name;
  double within = 0, off = 0;
  [[nodiscard]] bool kept() const noexcept { return off <= within; }
  /// It is missed by so much, mm, rounded up; 0 where it is kept.
  [[nodiscard]] double missed() const noexcept;
};

/// The demands of triangles, and how well they are met.
struct SolidDemandRecord {
  /// That of triangles of no feature, mm; none where they are as cast.
  std::optional<double> minimum = 0;
  std::vector<SolidFeature> features;
  /// No point of each feature is farther from the blank's surface, mm; counts for those with a maximum, or
  /// that are finished.
  std::vector<double> largest = {};
  std::vector<SolidDatumRecord> datums;
  [[nodiscard]] bool keeps_maxima() const noexcept;
  /// The least of (allowance - minimum) / scale, mm; none where the part is not inside.
  std::optional<double> margin;
  /// No pose of the window has more, mm; none of a method that proves nothing.
  std::optional<double> margin_bound;
};

/// How the placement was chosen of those with nearly the best margin.
struct SolidChoiceRecord {
  std::string criterion;  ///< largest, even
  double give_up = 0;     ///< mm
  /// The largest margin found before anything was given up, or clearance where there are no demands; and no
  /// point of what has a demand is farther from the blank's surface at the pose, mm. None where the part is
  /// not inside.
  std::optional<double> margin_found = std::nullopt, largest = std::nullopt;
  /// The smallest largest allowance found before any of it was given up, and how far allowances deviate from
  /// what they should be at the pose (locate::allowance_deviation), mm. `even` alone has them, likewise.
  std::optional<double> largest_found = std::nullopt, deviation = std::nullopt;
};

/// The lines that set work offset and rotation for the placement.
struct OffsetRecord {
  std::string control;
  int axes = 3, work_offset = 1;
  FileRecord output;
};

/// The rotations that bring the part onto itself, as far as was seen.
struct SolidSymmetryRecord {
  double tolerance = 0;  ///< mm
  solid::Symmetry found;
};

struct SolidDocument {
  std::string status;  ///< optimal, stopped, infeasible, unproved
  std::string method;  ///< certified, climb, icp, axes
  std::vector<SolidInputRecord> inputs;
  std::vector<std::string> warnings;
  std::uint64_t work = 0;
  locate::SolidFreedom freedom = locate::SolidFreedom::six;
  std::string start;  ///< how the start of the window was come by: drawn, file, found
  SolidWindow window;
  std::optional<SolidSymmetryRecord> symmetry;  ///< none of a part without
  locate::SolidPose pose;
  /// The least allowance, of what has a demand, mm. There is none where the part is not inside the blank.
  std::optional<double> clearance;
  /// There is none of a method that proves nothing, and none with demands, mm.
  std::optional<double> upper_bound;
  double min_allowance = 0;
  /// None without a file of features.
  std::optional<SolidDemandRecord> demands;
  /// None where the largest margin is all that counts.
  std::optional<SolidChoiceRecord> choice;
  std::vector<locate::SolidTouch> contacts;
  /// Without one the blank is taken as drawn.
  std::optional<SolidScanRecord> scan;
  /// Without trees when there is none, or when it is in certificate_file; its triangles are those of the
  /// meshes that were placed.
  locate::SolidProof proof;
  /// The numbers of these triangles in their files.
  std::vector<std::uint32_t> part_numbers, blank_numbers;
  /// Says which of them are turned round.
  std::vector<bool> part_turned, blank_turned;
  std::optional<FileRecord> certificate_file;
  /// The boxes of the certificate, wherever it is.
  std::size_t certificate_boxes = 0;
  std::optional<NcRecord> nc;
  std::optional<OffsetRecord> offset;
  /// The time of this run; the only field that is not a function of the input.
  double seconds = 0;
  unsigned threads = 1;

  [[nodiscard]] bool inside() const noexcept { return clearance.has_value(); }
  /// The margin, or the clearance where there are no demands, mm; none where the part is not inside.
  [[nodiscard]] std::optional<double> margin() const noexcept {
    return demands ? demands->margin : clearance;
  }
  /// The rest that is missing of the demanded allowance, or of the demands, mm; none where the part is not
  /// inside.
  [[nodiscard]] std::optional<double> shortfall() const noexcept;
};

/// The document as JSON text, in the form of that of outlines. \pre every number is finite
[[nodiscard]] std::string result_json(const SolidDocument& document);

/// The document of a certificate file. \pre there is a proof
[[nodiscard]] std::string certificate_text(const SolidDocument& document);

/// Names as they stand in results.
[[nodiscard]] const char* name_of(locate::SolidFreedom freedom) noexcept;

}  // namespace lekalo::io
