#include "picture_bytes.hpp"

namespace lekalo::jobs {

Result<std::string> picture_bytes(const draw::LayoutPicture& picture, PictureForm form) {
  switch (form) {
    case PictureForm::svg:
      break;
    case PictureForm::png:
      return draw::layout_png(picture);
    case PictureForm::pdf:
      return draw::layout_pdf(picture);
  }
  return draw::layout_svg(picture);
}

}  // namespace lekalo::jobs
