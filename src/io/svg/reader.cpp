#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "document.hpp"
#include "io/drawing/copies.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "shapes.hpp"
#include "stated_arcs.hpp"
#include "style.hpp"
#include "viewport.hpp"

namespace lekalo::io {
namespace {

using namespace detail;

/// The most damaged elements that are told one by one; the rest is counted.
constexpr std::size_t kMostDamagedTold = 1000;
/// Copies are drawn from their text, which counts as one more copy for every so many bytes.
constexpr std::size_t kBytesOfACopy = 64;

/// Returns how many copies drawing an element again counts as.
std::size_t cost_of(const SvgElement& element) {
  std::size_t bytes = 0;
  for (const char* key : {"d", "points", "style", "class"})
    if (const std::string* text = element.attribute(key)) bytes += text->size();
  return 1 + bytes / kBytesOfACopy;
}

/// Elements that draw nothing where they stand, and have no outline to lose.
constexpr std::string_view kSilent[] = {"title",  "desc",   "metadata", "style",
                                        "script", "symbol", "view",     "color-profile"};
/// Elements that may stand in defs besides shapes to be used.
constexpr std::string_view kResources[] = {"clipPath", "mask",        "pattern",        "marker",
                                           "filter",   "font",        "linearGradient", "radialGradient",
                                           "hatch",    "meshgradient"};

template <std::size_t N>
bool is_in(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// The values that an element takes from those around it.
struct Context {
  Affine map;  ///< user units to millimetres
  Viewport viewport;
  std::string layer;
  /// True when the layer comes from a group that says it is one.
  bool layer_said = false;
  /// The property display, which no child can undo.
  bool shown = true;
  /// The property visibility, which a child can undo.
  bool visible = true;
  /// The words of stroke and fill, and whether the stroke is dashed.
  std::string stroke, fill;
  bool dashed = false;
  /// Filled by winding numbers, as CSS has it where nothing is said.
  bool is_filled = true;
  geom::FillRule fill_rule = geom::FillRule::nonzero;
  std::size_t depth = 0;
  bool copied = false;  ///< by a use
};

/// Step 6 of docs/design/svg.md: walks through the elements and collects their curves.
class SvgReader {
 public:
  SvgReader(const SvgDocument& document, const std::string& name) : document_(document), styles_(document) {
    drawing_.name = name;
  }

  Result<Drawing> run(std::optional<LengthUnit> unit) {
    const SvgElement& root = document_.elements.front();
    const auto page = page_of(root, unit);
    if (!page) return fault(root, page.error());
    drawing_.unit = page->unit;
    drawing_.millimetres_per_unit = page->millimetres_per_unit;
    if (!page->notice.empty()) drawing_.notices.push_back(page->notice);
    for (const std::string& notice : styles_.notices()) drawing_.notices.push_back(notice);
    Context context;
    context.map = page->millimetres_from_user;
    if (const std::string* corner = root.attribute(kPageCorner);
        corner != nullptr && !restore_page_corner(context.map, *corner))
      drawing_.notices.push_back(
          fmt::format("{}: its page was changed since it was written, and no longer says where its corner "
                      "lies; the origin is that corner",
                      drawing_.name));
    context.viewport = page->viewport;
    LEKALO_CHECK(moved(root, context));
    see(root, context);
    LEKALO_CHECK(children(root, context));
    if (unfit_arcs_ > 0) drawing_.notices.push_back(unfit_arcs_sentence(unfit_arcs_, drawing_.name));
    for (auto& [what, unread] : unread_) drawing_.unread.push_back(std::move(unread));
    return std::move(drawing_);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> fault(const SvgElement& element, const std::string& why) const {
    const std::string* id = element.attribute("id");
    return failure(ErrorCode::bad_input,
                   fmt::format("{}, line {}, {}{}: {}", drawing_.name, element.line, element.name,
                               id == nullptr ? "" : " " + excerpt(*id), why));
  }

  [[nodiscard]] tl::unexpected<Error> beyond(const SvgElement& element, const std::string& why) {
    beyond_limits_ = true;
    return fault(element, why);
  }

  void count_unread(const std::string& what, const SvgElement& element) {
    Unread& unread = unread_[what];
    if (unread.count++ == 0) unread = {what, 1, element.line};
    unread.line = std::min(unread.line, element.line);
  }

  /// Applies the attribute "transform", within the map so far.
  Result<void> moved(const SvgElement& element, Context& context) {
    if (const auto property = geometry_in_style(element)) {
      return fault(element,
                   fmt::format("its style attribute says {}, which is not read; save the drawing with "
                               "presentation attributes",
                               *property));
    }
    const std::string* text = element.attribute("transform");
    if (text == nullptr) return {};
    const auto map = read_svg_transform(*text);
    if (!map) return fault(element, "transform: " + map.error());
    return placed(element, *map, context);
  }

  Result<void> placed(const SvgElement& element, const Affine& inner, Context& context) {
    context.map = composed(context.map, inner);
    const double largest =
        std::max({context.map.size(), std::abs(context.map.shift.x), std::abs(context.map.shift.y)});
    if (largest <= kLargestMillimetres) return {};
    return fault(element, fmt::format("it is moved or enlarged beyond {:g}", kLargestMillimetres));
  }

  void see(const SvgElement& element, Context& context) const {
    const Look says = styles_.of(element);
    const std::string& visibility = says[Property::visibility];
    if (says[Property::display] == "none") context.shown = false;
    if (visibility == "hidden" || visibility == "collapse") context.visible = false;
    if (visibility == "visible") context.visible = true;
    const auto is_said = [&](Property property) {
      return !says[property].empty() && says[property] != "inherit";
    };
    if (is_said(Property::stroke)) context.stroke = colour_word(says[Property::stroke]);
    if (is_said(Property::fill)) {
      context.fill = colour_word(says[Property::fill]);
      context.is_filled = says[Property::fill] != "none" && says[Property::fill] != "transparent";
    }
    if (is_said(Property::fill_rule))
      context.fill_rule =
          says[Property::fill_rule] == "evenodd" ? geom::FillRule::even_odd : geom::FillRule::nonzero;
    if (is_said(Property::stroke_dasharray)) context.dashed = says[Property::stroke_dasharray] != "none";
  }

  static std::string name_of(const SvgElement& group) {
    for (const char* key : {"inkscape:label", "id"})
      if (const std::string* said = group.attribute(key)) return *said;
    return "";
  }

  Result<void> children(const SvgElement& element, const Context& context) {
    for (const std::uint32_t child : element.children)
      LEKALO_CHECK(whole(document_.elements[child], context));
    return {};
  }

  /// Draws an element, or sets it aside with its sentence where it is damaged. Fails where the drawing is
  /// beyond the limits.
  Result<void> whole(const SvgElement& element, const Context& context) {
    const std::size_t curves = drawing_.curves.size();
    const Result<void> done = draw(element, context);
    if (done || beyond_limits_) return done;
    drawing_.curves.resize(curves);
    count_unread(element.name + " (damaged)", element);
    if (drawing_.damaged.size() < kMostDamagedTold) drawing_.damaged.push_back(done.error().message);
    return {};
  }

  Result<void> draw(const SvgElement& element, Context context) {
    if (context.copied && (copies_ += cost_of(element)) > kMostCopies)
      return beyond(element, fmt::format("uses make more than {} copies of elements", kMostCopies));
    const std::string& name = element.name;
    if (name == "defs") {
      for (const std::uint32_t child : element.children)
        if (is_in(kResources, document_.elements[child].name))
          count_unread(document_.elements[child].name, document_.elements[child]);
      return {};
    }
    if (is_in(kSilent, name)) return {};
    see(element, context);
    if (is_svg_shape(name)) {
      LEKALO_CHECK(moved(element, context));
      return shape(element, context);
    }
    const bool group = name == "g" || name == "a" || name == "switch";
    if (!group && name != "svg" && name != "use") {
      count_unread(name, element);
      return {};
    }
    if (++context.depth > kDeepestNesting)
      return beyond(element, fmt::format("groups and uses are nested more than {} deep", kDeepestNesting));
    LEKALO_CHECK(moved(element, context));
    if (name == "use") return use(element, context);
    if (name == "svg") return viewport(element, element, context);
    if (name == "g") enter_layer(element, context);
    return name == "switch" ? choose(element, context) : children(element, context);
  }

  static void enter_layer(const SvgElement& group, Context& context) {
    const std::string* mode = group.attribute("inkscape:groupmode");
    const bool says_layer = mode != nullptr && *mode == "layer";
    if (!says_layer && (context.layer_said || !context.layer.empty())) return;
    context.layer = name_of(group);
    context.layer_said = says_layer;
  }

  /// Draws the first child of a switch that asks for nothing special.
  Result<void> choose(const SvgElement& element, const Context& context) {
    for (const std::uint32_t index : element.children) {
      const SvgElement& child = document_.elements[index];
      const std::string* extensions = child.attribute("requiredExtensions");
      if (child.attribute("systemLanguage") != nullptr || (extensions != nullptr && !extensions->empty()))
        continue;
      return draw(child, context);
    }
    count_unread("switch", element);
    return {};
  }

  /// Draws the content of an svg or symbol element; `place` has its corner and size (a use, or the element
  /// itself).
  Result<void> viewport(const SvgElement& element, const SvgElement& place, Context context) {
    const bool by_use = &element != &place;
    const auto side = [&](const char* key, Along along, const Bounded& otherwise) -> Read<Bounded> {
      const std::string* text = place.attribute(key);
      if (text == nullptr && by_use) text = element.attribute(key);
      if (text == nullptr || *text == "auto") return otherwise;
      return read_svg_length(*text, context.viewport, along);
    };
    const auto width = side("width", Along::x, context.viewport.width),
               height = side("height", Along::y, context.viewport.height);
    const auto box = read_view_box(element);
    if (!width || !height || !box)
      return fault(place, !width    ? "width: " + width.error()
                          : !height ? "height: " + height.error()
                                    : box.error());
    if (!by_use) LEKALO_CHECK(shifted(element, context));
    if (*box) {
      // The standard says that nothing is drawn then.
      if (!(width->value > 0 && height->value > 0)) return {};
      const auto map = fit(element, **box, *width, *height);
      if (!map) return fault(element, map.error());
      LEKALO_CHECK(placed(element, *map, context));
      context.viewport = {(*box)->width, (*box)->height};
    } else {
      context.viewport = {*width, *height};
    }
    return children(element, context);
  }

  /// Moves the map by the attributes x and y.
  Result<void> shifted(const SvgElement& element, Context& context) {
    Affine shift;
    for (const char* key : {"x", "y"}) {
      const std::string* text = element.attribute(key);
      if (text == nullptr) continue;
      const bool is_x = *key == 'x';
      const auto read = read_svg_length(*text, context.viewport, is_x ? Along::x : Along::y);
      if (!read) return fault(element, fmt::format("{}: {}", key, read.error()));
      (is_x ? shift.shift.x : shift.shift.y) = read->value;
      shift.shift_error = std::max(shift.shift_error, read->error);
    }
    return placed(element, shift, context);
  }

  Result<void> use(const SvgElement& element, Context context) {
    const std::string* target = element.attribute("href");
    if (target == nullptr) target = element.attribute("xlink:href");
    if (target == nullptr || target->empty() || target->front() != '#') {
      count_unread("use (of another file)", element);
      return {};
    }
    const SvgElement* used = document_.by_id(target->substr(1));
    if (used == nullptr)
      return fault(element, fmt::format("there is no element {} to use", excerpt(*target)));
    LEKALO_CHECK(shifted(element, context));
    context.copied = true;
    if (used->name != "symbol" && used->name != "svg") return draw(*used, context);
    see(*used, context);
    LEKALO_CHECK(moved(*used, context));
    return viewport(*used, element, context);
  }

  Result<void> shape(const SvgElement& element, const Context& context) {
    auto shapes = read_svg_shape(element, context.viewport);
    if (!shapes) return fault(element, shapes.error());
    if (const std::string* exact = element.attribute(kExactArcs))
      unfit_arcs_ += restore_exact_arcs(*shapes, *exact);
    if (drawing_.curves.size() + shapes->size() > kMostCurves)
      return beyond(element, fmt::format("more than {} curves, copies counted", kMostCurves));
    std::vector<BoundedShape> placed_shapes;
    for (const BoundedShape& one : *shapes) {
      ask();
      auto placed_shape = image(context.map, one);
      if (!placed_shape) {
        return fault(element, fmt::format("its transforms make it flat, or bring it beyond {:g} mm",
                                          kLargestMillimetres));
      }
      if (!std::isfinite(placed_shape->error)) return fault(element, "its numbers are too large to be drawn");
      if (!is_point(placed_shape->shape)) placed_shapes.push_back(*std::move(placed_shape));
    }
    if (placed_shapes.empty()) {
      count_unread(element.name + " (without length)", element);
      return {};
    }
    const std::string* id = element.attribute("id");
    const auto entity = static_cast<std::uint32_t>(drawing_.entities.size());
    const std::string* label = element.attribute("inkscape:label");
    drawing_.entities.push_back({element.name, id == nullptr ? "" : *id, element.line,
                                 context.is_filled ? context.fill_rule : geom::FillRule::even_odd,
                                 label == nullptr ? "" : *label,
                                 context.stroke.empty() && context.is_filled});
    const std::uint32_t layer =
        layer_index({context.layer, !context.shown || !context.visible,
                     context.stroke.empty() ? context.fill : context.stroke, context.dashed ? "dashed" : ""});
    for (BoundedShape& one : placed_shapes)
      drawing_.curves.push_back({std::move(one.shape), entity, layer, one.error});
    return {};
  }

  /// Says whether rounding has left nothing of a line or an arc.
  static bool is_point(const Shape& shape) {
    const auto* edge = std::get_if<geom::Edge>(&shape);
    if (edge == nullptr) return false;
    if (edge->kind == geom::EdgeKind::line) return edge->from == edge->to;
    return edge->from == edge->centre || edge->to == edge->centre;
  }

  std::uint32_t layer_index(Layer layer) {
    const auto [found, is_new] =
        layers_.try_emplace({layer.name, layer.hidden, layer.colour, layer.line_type},
                            static_cast<std::uint32_t>(drawing_.layers.size()));
    if (is_new) drawing_.layers.push_back(std::move(layer));
    return found->second;
  }

  const SvgDocument& document_;
  StyleSheet styles_;
  Drawing drawing_;
  std::map<std::string, Unread> unread_;
  std::map<std::tuple<std::string, bool, std::string, std::string>, std::uint32_t> layers_;
  std::size_t copies_ = 0, unfit_arcs_ = 0;
  bool beyond_limits_ = false;
};

}  // namespace

Result<Drawing> parse_svg(std::string_view bytes, const std::string& name, std::optional<LengthUnit> unit) {
  LEKALO_TRY(const auto document, read_svg_document(bytes, name));
  return SvgReader(document, name).run(unit);
}

DrawingFormat drawing_svg() {
  return {.file = {.name = "SVG", .endings = {".svg"}, .first_bytes = "<"},
          .parse = parse_svg,
          .handles_are_names = true};
}

}  // namespace lekalo::io
