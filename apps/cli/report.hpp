#pragma once

#include <string>

#include "contours.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// The bytes of --report, --allowances and --drawing; empty where not asked for.
struct ReportFiles {
  std::string report, allowances, drawing;
};

/// Of regions: the document holds them.
[[nodiscard]] Result<ReportFiles> make_reports(const LocateOptions& options,
                                               const io::LocateDocument& document);
/// Of convex contours, with the numbers of the result document.
[[nodiscard]] Result<ReportFiles> make_reports(const LocateOptions& options,
                                               const io::LocateDocument& document, const Contour& part,
                                               const Contour& blank);

}  // namespace lekalo::cli
