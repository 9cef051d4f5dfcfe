#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/locate/edge_allowance.hpp"

namespace lekalo::draw {

/// The report of a localisation: one page that a technologist decides by and files away, and the table of the
/// allowance along the outline. Of convex contours (as regions of lines) and of regions alike.
/// docs/design/picture.md.

/// A named group of edges of the part, and what is demanded of it, mm.
struct ReportFeature {
  std::string name;
  std::vector<std::uint32_t> edges;  ///< their numbers (geom::Region)
  std::optional<double> minimum, target, maximum;
};

/// A feature and the allowance over it, mm.
struct FeatureRow {
  ReportFeature feature;
  double length = 0;
  /// Never above the exact minimum of any outline within ReportShapes::outline_error.
  double minimum = 0;
  /// The mean over the length, by trapezoids between the samples: within a quarter of their step.
  double mean = 0;
  /// Never below the exact maximum.
  double maximum = 0;
  /// True when every demand that is known is met.
  bool met = true;
  std::string verdict;
};

/// Holds what the page needs beside the document.
struct ReportShapes {
  std::vector<geom::Region> part, blank;  ///< mm, as used
  /// The outlines may be this far from the true ones, together, mm.
  double outline_error = 0;
  /// The document's numbers of part edges and blank edges, where these regions count otherwise (a contour
  /// that the file gives clockwise); empty: the same.
  std::vector<std::uint32_t> part_edge_numbers, blank_edge_numbers;
};

struct Report {
  io::LocateDocument document;  ///< without shapes and proof
  ReportShapes shapes;
  std::optional<double> margin, margin_bound;  ///< of demands by feature
  /// True for the contacts of convex outlines.
  bool contacts_at_vertices = false;
  std::vector<locate::Touch> contacts;
  std::vector<std::string> proof, assumptions;  ///< sentences
  /// The largest step along the outline between samples, mm.
  double step = 0;
  /// The tolerance of the extremes, mm.
  double tolerance = 0;
  /// The edges of the part.
  std::vector<locate::EdgeAllowance> edges;
  std::vector<FeatureRow> features;
  /// Less than this is missing material, for each edge: the greatest minimum of its features, else that of
  /// the whole part where it is not met; below 0 for a finished one.
  std::vector<double> demanded;
  /// Places and how much is missing there, the worst first.
  std::vector<locate::MissingPlace> missing;
};

/// At most this many places of missing material.
inline constexpr std::size_t kMostMissingPlaces = 5;

/// Without features every contour is one: "outline", "hole 0"; of several pieces "piece 1, hole 2".
///
/// \pre the document's numbers are finite (upper_bound may be infinite), shapes have edges and were made by
///      make_region, and every edge of a feature exists
/// Errors: usage when the outline is too long to sample.
/// Cost: that of locate::edge_allowances for a few thousand samples: a few milliseconds for 100 edges.
[[nodiscard]] Result<Report> make_report(const io::LocateDocument& document, ReportShapes shapes,
                                         std::vector<ReportFeature> features = {});

/// The page (A4, portrait): placement with the allowance in colour, numbers and what is proved, histogram,
/// contacts, features, input files with their digests, assumptions and warnings. Minima and clearances are
/// rounded down, maxima, bounds and what is missing up. What finds no room is counted on the page.
///
/// Same input, same bytes; PNG and PDF on a machine with the same libraries and fonts. PDF has text as text
/// and no date. ErrorCode::environment when the drawing library fails.
[[nodiscard]] std::string report_svg(const Report& report);
[[nodiscard]] Result<std::string> report_png(const Report& report, int width_px = 1654);
[[nodiscard]] Result<std::string> report_pdf(const Report& report);

/// The allowance along the outline as CSV (docs/formats.md): the report's samples, each edge with both ends
/// and its least and greatest allowance. Numbers in the shortest form that reads back.
[[nodiscard]] std::string allowances_csv(const Report& report);

}  // namespace lekalo::draw
