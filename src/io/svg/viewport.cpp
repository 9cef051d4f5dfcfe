#include "viewport.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lekalo::io::detail {
namespace {

Affine scaled_and_moved(const Bounded& sx, const Bounded& sy, const Bounded& tx, const Bounded& ty) {
  return {sx.value,
          0,
          0,
          sy.value,
          {tx.value, ty.value},
          std::max(sx.error, sy.error),
          std::max(tx.error, ty.error)};
}

/// A side of the page as the file says it.
struct Side {
  Bounded number;
  std::string unit;  ///< "px" for none
};
Read<std::optional<Side>> read_side(const SvgElement& root, const char* key) {
  const std::string* text = root.attribute(key);
  if (text == nullptr || *text == "auto") return std::optional<Side>{};
  const auto length = split_svg_length(*text);
  if (!length) return tl::unexpected(fmt::format("{}: {}", key, length.error()));
  // The percentage is that of a window, which we do not have.
  if (length->unit == "%") return std::optional<Side>{};
  if (!millimetres_per_unit(length->unit))
    return tl::unexpected(
        fmt::format("{} is {}; known units: px, mm, cm, in, pt, pc, Q, %", key, excerpt(*text)));
  if (!(length->number.value > 0))
    return tl::unexpected(fmt::format("{} is {}; it must be above 0", key, excerpt(*text)));
  return std::optional<Side>{Side{length->number, length->unit.empty() ? "px" : std::string(length->unit)}};
}

Bounded millimetres(const Side& side) {
  const Bounded per = *millimetres_per_unit(side.unit);
  if (side.unit == "px") return over(times(side.number, {254, 0}), {960, 0});
  if (side.unit == "pt") return over(times(side.number, {254, 0}), {720, 0});
  if (side.unit == "pc") return over(times(side.number, {254, 0}), {60, 0});
  if (side.unit == "in") return over(times(side.number, {254, 0}), {10, 0});
  return times(side.number, per);
}

/// Turns y upwards: (x, height - y).
Affine turned_up(const Affine& down, const Bounded& height) {
  const Affine up{1, 0, 0, -1, {0, height.value}, 0, height.error};
  return composed(up, down);
}

}  // namespace

Read<std::optional<ViewBox>> read_view_box(const SvgElement& element) {
  const std::string* text = element.attribute("viewBox");
  if (text == nullptr) return std::optional<ViewBox>{};
  SvgScanner scanner(*text);
  ViewBox box;
  for (Bounded* number : {&box.x, &box.y, &box.width, &box.height}) {
    const auto read = scanner.number();
    if (!read) return tl::unexpected("viewBox: " + read.error());
    *number = *read;
    scanner.skip_comma();
  }
  if (!scanner.at_end()) return tl::unexpected("viewBox has four numbers; more are " + scanner.here());
  if (!(box.width.value > 0 && box.height.value > 0))
    return tl::unexpected(fmt::format("viewBox is {}; its width and height must be above 0", excerpt(*text)));
  return std::optional<ViewBox>{box};
}

Read<Affine> fit(const SvgElement& element, const ViewBox& box, const Bounded& width, const Bounded& height) {
  const std::string* said = element.attribute("preserveAspectRatio");
  std::string_view align = said == nullptr ? std::string_view("xMidYMid") : std::string_view(*said);
  while (!align.empty() && align[0] == ' ') align.remove_prefix(1);
  if (align.substr(0, 6) == "defer ") align.remove_prefix(6);
  std::string_view word = align.substr(0, align.find(' '));
  Bounded sx = over(width, box.width), sy = over(height, box.height);
  Bounded left{}, above{};
  if (word != "none") {
    const bool known = word.size() == 8 && word[0] == 'x' && word[4] == 'Y';
    const auto share = [&](std::string_view part) -> std::optional<double> {
      if (part == "Min") return 0.0;
      if (part == "Mid") return 0.5;
      if (part == "Max") return 1.0;
      return std::nullopt;
    };
    const auto x = known ? share(word.substr(1, 3)) : std::nullopt,
               y = known ? share(word.substr(5, 3)) : std::nullopt;
    if (!x || !y)
      return tl::unexpected(fmt::format("preserveAspectRatio is {}, which is no alignment", excerpt(*said)));
    const bool slice = align.find("slice") != std::string_view::npos;
    // Two scales that are equal, as exact numbers may be, leave no room to be shared out by an alignment.
    (sx.value < sy.value) != slice ? sy = sx : sx = sy;
    left = times({*x, 0}, minus(width, times(sx, box.width)));
    above = times({*y, 0}, minus(height, times(sy, box.height)));
  }
  return scaled_and_moved(sx, sy, minus(left, times(sx, box.x)), minus(above, times(sy, box.y)));
}

Read<Page> page_of(const SvgElement& root, std::optional<LengthUnit> said) {
  LEKALO_TRY(const auto width, read_side(root, "width"));
  LEKALO_TRY(const auto height, read_side(root, "height"));
  LEKALO_TRY(const auto box, read_view_box(root));
  Page page;
  const std::optional<Side>& side = width ? width : height;
  page.unit = side ? side->unit : "px";
  if (page.unit != "px" && said) {
    const bool inch = page.unit == "in", metric = page.unit == "mm" || page.unit == "cm" || page.unit == "Q";
    if (*said == LengthUnit::inch ? !inch : !metric) {
      return tl::unexpected(fmt::format(
          "the page is given in {}, which contradicts the unit asked for; leave the unit out", page.unit));
    }
  }
  const bool by_user = page.unit == "px" && said;
  if (by_user) page.unit = *said == LengthUnit::inch ? "inch" : "mm";
  const Bounded px = *millimetres_per_unit("px");
  page.millimetres_per_unit = by_user ? millimetres_per(*said) : millimetres_per_unit(page.unit)->value;
  if (page.unit == "px") {
    page.notice = side ? "the page is given in px, taken as 1/96 inch; --units says otherwise"
                       : "the page has no size; its units are taken as px, 1/96 inch; --units says otherwise";
  }
  if (by_user || (!side && box)) {
    // One unit of the drawing is one of the user's (or a px), whatever the size of the window.
    const Bounded scale =
        by_user ? (*said == LengthUnit::inch ? *millimetres_per_unit("in") : Bounded{1, 0}) : px;
    const Bounded x = box ? box->x : Bounded{}, y = box ? box->y : Bounded{};
    const Bounded tall = box ? box->height : (height ? height->number : Bounded{});
    const Affine down = scaled_and_moved(scale, scale, negative(times(scale, x)), negative(times(scale, y)));
    page.millimetres_from_user = turned_up(down, times(scale, tall));
    page.viewport = {box ? box->width : (width ? width->number : Bounded{}), tall};
    return page;
  }
  if (!box) {
    const auto in_px = [&](const std::optional<Side>& s) {
      return s ? over(times(millimetres(*s), {960, 0}), {254, 0}) : Bounded{};
    };
    page.viewport = {in_px(width), in_px(height)};
    page.millimetres_from_user =
        turned_up(scaled_and_moved(px, px, {}, {}), height ? millimetres(*height) : Bounded{});
    return page;
  }
  // A missing side follows from the other and the view box.
  const ViewBox& view = *box;
  Bounded wide = width ? millimetres(*width) : Bounded{}, tall = height ? millimetres(*height) : Bounded{};
  if (!width) wide = over(times(tall, view.width), view.height);
  if (!height) tall = over(times(wide, view.height), view.width);
  LEKALO_TRY(const auto down, fit(root, view, wide, tall));
  page.millimetres_from_user = turned_up(down, tall);
  page.viewport = {view.width, view.height};
  return page;
}

}  // namespace lekalo::io::detail
