#pragma once

#include <string>

#include "cairo.hpp"
#include "lekalo/base/error.hpp"
#include "scene.hpp"

namespace lekalo::draw {

/// A PDF that is written page by page, so that a long one needs the memory of one scene and of its own bytes.
/// Text stays text, and there is no date.
class PdfPages {
 public:
  /// \param width, height  of all pages, mm
  PdfPages(double width, double height, const std::string& title, const std::string& description);
  PdfPages(const PdfPages&) = delete;
  PdfPages& operator=(const PdfPages&) = delete;

  /// \param page  has the size of all pages
  void add(const Scene& page);
  /// The bytes; ErrorCode::environment when the drawing library failed.
  [[nodiscard]] Result<std::string> finish() &&;

 private:
  CairoBytes bytes_;
  Surface surface_;
  Canvas canvas_;
};

}  // namespace lekalo::draw
