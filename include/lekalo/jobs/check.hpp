#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/layout/check.hpp"

namespace lekalo::jobs {

/// Holds the answers of the two checks of a layout: that of the engine (layout/check.hpp), which also finds
/// the way out of a violation, and that of the independent checker (verify/layout.hpp), which reads the bytes
/// itself.
struct Checked {
  /// Every violation that the engine finds, in the order of the check.
  std::vector<layout::Violation> violations;
  /// A sentence for each finding that only one of the two checks has.
  std::vector<std::string> disagreements;

  [[nodiscard]] bool agree() const noexcept { return disagreements.empty(); }
  /// Both find that no rule is broken.
  [[nodiscard]] bool valid() const noexcept { return agree() && violations.empty(); }
};

/// Runs both checks. The independent checker gets the bytes of the layout's file; where it does not take them
/// (a layout written by hand may leave polygons of curves and pairs of angles to lekalo), it gets those that
/// io::write_layout makes.
///
/// Fails with ErrorCode::refuted where the independent checker takes neither. Cost: that of layout::check and
/// of verify::verify_layout, about a second for 1,000 parts.
[[nodiscard]] Result<Checked> check(const Layout& layout);

/// Gives the findings as "lekalo-check" JSON (docs/formats.md) with an empty member "run", ending in a line
/// end.
[[nodiscard]] std::string check_json(const Layout& layout, const Checked& checked);

/// The last line of defence before a layout that lekalo made is handed out: fails with ErrorCode::refuted and
/// one sentence unless both checks find that no rule is broken.
/// \param bytes  of the document, as they are about to be written; \pre io::write_layout(document)
[[nodiscard]] Result<void> confirm_layout(const layout::Document& document, std::string_view bytes);

}  // namespace lekalo::jobs
