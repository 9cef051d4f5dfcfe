#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/jobs/picture_form.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"

namespace lekalo::jobs {

/// Says what a layout amounts to, and what the engine's check finds in it.
struct Shown {
  layout::Completeness completeness;
  std::vector<layout::Violation> violations;
};

/// Cost: that of layout::completeness and layout::check.
[[nodiscard]] Shown show(const layout::Document& document);

/// The figures as "lekalo-show" JSON (docs/cli.md) with an empty member "run", ending in a line end.
[[nodiscard]] std::string show_json(const Layout& layout, const Shown& shown);

/// The layout on one page (draw/layout_picture.hpp) with these violations marked; PDF has pages of tables
/// behind it. `title` may be any bytes, what is not UTF-8 becomes U+FFFD.
/// Fails with ErrorCode::environment where the drawing library does.
[[nodiscard]] Result<std::string> layout_picture(const layout::Document& document, std::string_view title,
                                                 const std::vector<layout::Violation>& violations,
                                                 PictureForm form);

}  // namespace lekalo::jobs
