#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificate.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/exact.hpp"
#include "verify/read/contour.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

/// The fields of a result of `lekalo locate` that say something a checker can hold against the files.

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

struct WrittenNc {
  Decimal clearance, rounding_mm;
};

struct ResultDocument {
  std::string status;
  WrittenInput part, blank;
  WrittenPlacement best;
  std::optional<Decimal> upper_bound, gap;
  Decimal min_allowance, shortfall;
  Window window;
  std::vector<WrittenContact> contacts;
  std::optional<Json> certificate;                        ///< list of intervals
  std::optional<std::size_t> certificate_file_intervals;  ///< the list is in a file, and has so many
  std::vector<WrittenPlacement> alternatives;
  std::optional<WrittenTrim> trim;
  std::optional<WrittenNc> nc;
};

/// bad_input, naming the document, when a field is missing or is not what docs/formats.md says. Pieces of the
/// text behind `written` stay in use.
[[nodiscard]] Result<ResultDocument> read_result_document(Json written, const std::string& name);

/// The list of intervals of a certificate file.
[[nodiscard]] Result<Json> read_certificate_document(const Document& document);

/// One item of a certificate; bad_input names `index`.
[[nodiscard]] Result<WrittenInterval> read_interval(Json item, std::size_t index, const std::string& name);

}  // namespace lekalo::verify
