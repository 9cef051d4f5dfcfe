#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificate.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/exact.hpp"
#include "verify/pocket/program_check.hpp"
#include "verify/read/contour.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

/// Derived fields are computed in doubles by whoever writes them. This relative tolerance covers a few
/// roundings of the numbers they come from. Nothing that is proved rests on it.
inline constexpr double kDerivedTolerance = 1e-15;

/// The fields of a result of `lekalo locate` that a checker can hold against the files.

struct WrittenInput {
  LengthUnit unit = LengthUnit::millimetre;
  std::size_t points = 0;
  std::vector<std::size_t> dropped;
};

struct WrittenPlacement {
  Decimal x, y, theta, theta_deg, clearance;
};

struct WrittenTrim {
  Decimal tolerance, loss;
  Contour contour;
};

/// How the placement differs from that of an earlier result.
struct WrittenComparison {
  bool same_part = false;
  Decimal dx, dy, dtheta, dtheta_deg, largest_shift, last_clearance, last_pose_clearance;
};

/// The distances of the blank's points from the placed part.
struct WrittenDeviations {
  std::size_t points = 0;
  Decimal least, greatest;
};

struct ResultDocument {
  std::string status;
  WrittenInput part, blank;
  WrittenPlacement best;
  std::optional<Decimal> upper_bound, gap;
  Decimal min_allowance, shortfall;
  Window window;
  std::vector<WrittenContact> contacts;
  /// The list of intervals, where the result itself holds it.
  std::optional<Json> certificate;
  /// The number of intervals that the result states, where a file of its own holds the list.
  std::optional<std::size_t> certificate_file_intervals;
  std::vector<WrittenPlacement> alternatives;
  std::optional<WrittenTrim> trim;
  std::optional<WrittenNc> nc;
  std::optional<WrittenComparison> comparison;
  std::optional<WrittenDeviations> deviations;
  /// The digest of the part's file, for the comparison.
  std::string part_sha256;
};

/// Reads a result. bad_input names the document, when a field is missing or is not what docs/formats.md says.
/// The result keeps pieces of the text behind `written`.
[[nodiscard]] Result<ResultDocument> read_result_document(Json written, const std::string& name);

/// Returns the list of intervals of a certificate file.
[[nodiscard]] Result<Json> read_certificate_document(const Document& document);

/// Reads one item of a certificate; bad_input names `index`.
[[nodiscard]] Result<WrittenInterval> read_interval(Json item, std::size_t index, const std::string& name);

}  // namespace lekalo::verify
