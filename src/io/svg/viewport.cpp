#include "viewport.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lekalo::io::detail {
namespace {

constexpr double kMillimetresPerInch = 25.4;
/// The digits that programs write of a page's size lose less than this, mm.
constexpr double kWholeWithin = 0.002;

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

/// The largest of some lengths, in mm or whole inches, of which both sides are multiples; 0 for none.
double roundness(double wide, double high) {
  const auto divides = [](double step, double mm) {
    return mm >= 0.5 * step && std::abs(mm - step * std::round(mm / step)) <= kWholeWithin;
  };
  for (const double step : {100.0, 50.0, kMillimetresPerInch, 10.0, 5.0, 1.0})
    if (divides(step, wide) && divides(step, high)) return step;
  return 0;
}

/// A sentence where the page is of whole millimetres or inches at the 72 or 90 px to an inch of other
/// programs and not at 96, or was made by an Inkscape that counted 90; else "".
std::string other_resolution(const SvgElement& root, const std::optional<Side>& width,
                             const std::optional<Side>& height) {
  if (!width || !height || width->unit != "px" || height->unit != "px") return "";
  const auto at = [](const Side& side, double dpi) { return side.number.value * kMillimetresPerInch / dpi; };
  const auto roundness_at = [&](double dpi) { return roundness(at(*width, dpi), at(*height, dpi)); };
  const std::string* version = root.attribute("inkscape:version");
  const bool old_inkscape = version != nullptr && version->starts_with("0.") && *version < "0.92";
  for (const double dpi : {72.0, 90.0}) {
    if (!(dpi == 90 && old_inkscape) && !(roundness_at(dpi) > roundness_at(96))) continue;
    return fmt::format(
        "; at {:g} px to the inch it would be {:.6g} x {:.6g} mm, not {:.6g} x {:.6g} mm: if so, "
        "give width and height in mm",
        dpi, at(*width, dpi), at(*height, dpi), at(*width, 96), at(*height, 96));
  }
  return "";
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
    page.notice = side ? "the page is given in px, taken as 1/96 inch; --units says otherwise" +
                             other_resolution(root, width, height)
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
