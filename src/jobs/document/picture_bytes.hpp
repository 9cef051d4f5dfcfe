#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/draw/layout_picture.hpp"
#include "lekalo/jobs/picture_form.hpp"

namespace lekalo::jobs {

/// A picture in a form. Fails as draw::layout_png and draw::layout_pdf do.
[[nodiscard]] Result<std::string> picture_bytes(const draw::LayoutPicture& picture, PictureForm form);

}  // namespace lekalo::jobs
