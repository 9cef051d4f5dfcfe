#include "entities.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "io/text/refusal.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "text.hpp"

namespace lekalo::io {

namespace {

/// A plane that leans by no more than this counts as that of the drawing, because programs write directions
/// with rounding.
constexpr double kLeaning = 1e-9;

/// Says whether the text of a number is nothing but zeros, without reading the number.
bool is_zero(std::string_view number) {
  return std::all_of(number.begin(),
                     std::find_if(number.begin(), number.end(), [](char c) { return c == 'e' || c == 'E'; }),
                     [](char c) { return c == '0' || c == '.' || c == '-' || c == '+'; });
}

}  // namespace

Error DxfCursor::broken_off(std::size_t begin, std::string_view what) const {
  if (fault()) return *fault();
  return refuse_line(name_, begin, fmt::format("{} does not end; the file is not complete", what)).value();
}

BoundedPoint DxfEntities::Numbers::point(int x, int y) const {
  const Millimetres px = get(x), py = get(y);
  return {{px.value, py.value}, std::max(px.error, py.error)};
}

void DxfEntities::Numbers::set(int code, Millimetres value) {
  known_.set(static_cast<std::size_t>(code));
  values_[static_cast<std::size_t>(code)] = value;
}

Result<void> DxfEntities::read(DxfBlock& into) {
  const std::size_t curves = into.curves.size(), insertions = into.insertions.size(), cost = into.cost,
                    texts = into.texts.size();
  begin_entity();
  const Common entity = common_;
  const Result<void> done = read_kind(into);
  if (done || at_.fault() || cost_ > kMostCurves) return done;
  // Nothing of a damaged entity counts.
  into.curves.resize(curves);
  into.insertions.resize(insertions);
  into.texts.resize(texts);
  cost_ -= into.cost - cost;
  into.cost = cost;
  if (has_entity_) entities_.pop_back();
  common_ = entity;
  set_aside(into, done.error());
  return {};
}

void DxfEntities::set_aside(DxfBlock& into, const Error& why) {
  const auto to_next = [this] {
    while (at_.ok() && at_.code() != 0) at_.next();
  };
  to_next();
  while (common_.type == "POLYLINE" && at_.ok() && (at_.at(0, "VERTEX") || at_.at(0, "SEQEND"))) {
    const bool ends = at_.at(0, "SEQEND");
    at_.next();
    to_next();
    if (ends) break;
  }
  count_unread(into, "damaged");
  if (damaged_.size() < kMostDamagedTold) damaged_.push_back(why.message);
}

Result<void> DxfEntities::read_kind(DxfBlock& into) {
  struct Kind {
    std::string_view type;
    Result<void> (DxfEntities::*read)(DxfBlock&);
  };
  static constexpr Kind kKinds[] = {
      {"LINE", &DxfEntities::read_line},         {"LWPOLYLINE", &DxfEntities::read_lwpolyline},
      {"ARC", &DxfEntities::read_arc},           {"CIRCLE", &DxfEntities::read_circle},
      {"POLYLINE", &DxfEntities::read_polyline}, {"SPLINE", &DxfEntities::read_spline},
      {"ELLIPSE", &DxfEntities::read_ellipse},   {"INSERT", &DxfEntities::read_insert},
      {"MLINE", &DxfEntities::read_mline},       {"HATCH", &DxfEntities::read_hatch},
      {"TEXT", &DxfEntities::read_text},         {"ATTRIB", &DxfEntities::read_text},
      {"MTEXT", &DxfEntities::read_mtext},
  };
  for (const Kind& kind : kKinds) {
    if (common_.type == kind.type) return (this->*kind.read)(into);
  }
  return read_other(into);
}

void DxfEntities::begin_entity() {
  common_ = {};
  common_.type = at_.value();
  common_.line = at_.line();
  has_entity_ = false;
}

Result<bool> DxfEntities::take_common() {
  // An application's groups, {ACAD_REACTORS and the like, last up to the closing brace.
  if (common_.in_application) {
    common_.in_application = !at_.at(102, "}");
    return true;
  }
  switch (at_.code()) {
    case 5:
      common_.handle = at_.value();
      return true;
    case 8:
      common_.layer = at_.value();
      return true;
    case 6:
      common_.line_type = at_.value();
      return true;
    case 62:
      if (common_.colour.is_by_layer()) common_.colour = DxfColour::of_index(at_.value());
      return true;
    case 420:
      common_.colour = DxfColour::of_rgb(at_.value());
      return true;
    case 60:
      common_.invisible = at_.value() == "1";
      return true;
    case 67:
      common_.paper_space = at_.value() == "1";
      return true;
    case 102:
      common_.in_application = at_.value().substr(0, 1) == "{";
      return true;
    case 210:
    case 220:
    case 230: {
      LEKALO_TRY(const auto value, number(false));
      common_.normal[(at_.code() - 210) / 10] = value.value;
      return true;
    }
    default:
      // No entity that is read wants a group from 80 on but LWPOLYLINE, whose number of vertices is group 90.
      return at_.code() >= 80 && at_.code() != 90;
  }
}

Result<void> DxfEntities::read_numbers(const Wanted* first, const Wanted* last, Numbers& numbers) {
  while (at_.next() && at_.code() != 0) {
    ask();
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    const Wanted* wanted =
        std::find_if(first, last, [this](const Wanted& w) { return w.code == at_.code(); });
    if (wanted == last) continue;
    if (numbers.has(wanted->code)) {
      return refuse_line(at_.name(), at_.line(),
                         fmt::format("the {} of line {} has the group {} twice; the file is damaged",
                                     shown(common_.type), common_.line, wanted->code));
    }
    LEKALO_TRY(const auto value, number(wanted->is_length));
    numbers.set(wanted->code, value);
    if (wanted->code >= 30 && wanted->code < 40) note_height();
  }
  for (const Wanted* wanted = first; at_.ok() && wanted != last; ++wanted) {
    if (wanted->is_needed && !numbers.has(wanted->code)) {
      return refuse_entity(fmt::format("has no group {}; the file is damaged", wanted->code));
    }
  }
  return {};
}

Result<Millimetres> DxfEntities::number(bool is_length) const {
  const auto value = read_millimetres(at_.value(), is_length ? unit_ : DecimalFactor{});
  if (!value) return refuse_line(at_.name(), at_.line(), number_sentence(value.error(), at_.value()));
  return *value;
}

Result<unsigned> DxfEntities::whole_number() const {
  LEKALO_TRY(const auto value, number(false));
  if (value.error != 0 || !(value.value >= 0) || value.value != std::floor(value.value)) {
    return refuse_line(at_.name(), at_.line(),
                       fmt::format("a whole number is wanted here, not {}", excerpt(at_.value())));
  }
  return static_cast<unsigned>(value.value);
}

void DxfEntities::note_height() {
  if (!has_heights_) has_heights_ = !is_zero(at_.value());
}

tl::unexpected<Error> DxfEntities::refuse_entity(const std::string& sentence) const {
  return refuse_line(
      at_.name(), common_.line,
      fmt::format("the {} on layer {} {}", shown(common_.type), excerpt(common_.layer), sentence));
}

bool DxfEntities::is_out_of_sight(DxfBlock& into) {
  if (common_.paper_space) {
    count_unread(into, "paper space");
  } else if (common_.invisible) {
    count_unread(into, "invisible");
  }
  return common_.paper_space || common_.invisible;
}

void DxfEntities::count_unread(DxfBlock& into, const char* why) const {
  into.count_unread(fmt::format("{} ({})", shown(common_.type), why), common_.line);
}

std::optional<Affine> DxfEntities::plane(double height) const {
  const auto [nx, ny, nz] = common_.normal;
  const double lean = std::max(std::abs(nx), std::abs(ny));
  if (!(lean <= kLeaning * std::abs(nz)) || nz == 0) return std::nullopt;
  Affine world;
  // The axes of a plane seen from above are those of the drawing (arbitrary axis algorithm); seen from below,
  // x runs the other way. Leaning by t shortens them by less than t^2 and moves what lies at height z by z t.
  if (nz < 0) world.xx = -1;
  const double t = lean / std::abs(nz) * (1 + 0x1p-40);
  world.linear_error = 2 * t * t;
  world.shift_error = 2 * t * std::abs(height);
  return world;
}

Result<void> DxfEntities::add(DxfBlock& into, const Affine& plane, BoundedShape shape) {
  if (!plane.is_identity()) {
    auto seen = image(plane, shape);
    if (!seen) return refuse_entity(fmt::format("reaches beyond {:g} mm", kLargestMillimetres));
    shape = std::move(*seen);
  }
  if (is_point(shape.shape)) {
    count_unread(into, "of no length");
    return {};
  }
  if (!has_entity_) {
    entities_.push_back({std::string(common_.type), shown(common_.handle), common_.line});
    if (common_.handle.empty()) entities_.back().handle.clear();
    has_entity_ = true;
  }
  const std::size_t cost = curve_cost(shape.shape);
  cost_ += cost;
  if (cost_ > kMostCurves) {
    return refuse_entity(
        fmt::format("is one too many: drawings have at most {} curves; keep what is to be cut", kMostCurves));
  }
  into.cost += cost;
  into.curves.push_back(
      {std::move(shape.shape), static_cast<std::uint32_t>(entities_.size() - 1), pen(), shape.error});
  return {};
}

std::uint32_t DxfEntities::pen() {
  return pens_.index(
      {layers_.index(common_.layer.empty() ? "0" : common_.layer), common_.colour, common_.line_type});
}

Result<void> DxfEntities::read_line(DxfBlock& into) {
  static constexpr Wanted kWanted[] = {{10, true, true}, {20, true, true}, {30, true, false},
                                       {11, true, true}, {21, true, true}, {31, true, false}};
  Numbers numbers;
  LEKALO_CHECK(read_numbers(kWanted, numbers));
  if (!at_.ok() || is_out_of_sight(into)) return {};
  // The ends of a line are points of the drawing, whatever its extrusion direction.
  return add(into, {}, line_between(numbers.point(10, 20), numbers.point(11, 21)));
}

Result<void> DxfEntities::read_insert(DxfBlock& into) {
  static constexpr Wanted kWanted[] = {{10, true, true},   {20, true, true},   {30, true, false},
                                       {41, false, false}, {42, false, false}, {50, false, false},
                                       {44, true, false},  {45, true, false}};
  Insertion insertion;
  Numbers numbers;
  // The name and the counts of an insertion are not among the numbers, so they are taken on the way.
  std::string_view name;
  while (at_.next() && at_.code() != 0) {
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    if (at_.code() == 2) name = at_.value();
    if (at_.code() == 70 || at_.code() == 71) {
      LEKALO_TRY(const auto count, whole_number());
      (at_.code() == 70 ? insertion.columns : insertion.rows) = std::max(count, 1U);
    }
    const auto* wanted = std::find_if(std::begin(kWanted), std::end(kWanted),
                                      [this](const Wanted& w) { return w.code == at_.code(); });
    if (wanted == std::end(kWanted)) continue;
    LEKALO_TRY(const auto value, number(wanted->is_length));
    numbers.set(wanted->code, value);
    if (wanted->code == 30) note_height();
  }
  if (!at_.ok()) return {};
  if (name.empty() || !numbers.has(10) || !numbers.has(20)) {
    return refuse_entity("has no block name or no place; the file is damaged");
  }
  if (is_out_of_sight(into)) return {};
  const auto world = plane(numbers.get(30).value);
  insertion.scale_x = numbers.get(41, {1, 0});
  insertion.scale_y = numbers.get(42, {1, 0});
  if (!world || insertion.scale_x.value == 0 || insertion.scale_y.value == 0) {
    count_unread(into, !world ? "tilted" : "scale 0");
    return {};
  }
  insertion.before = into.curves.size();
  insertion.name = name;
  insertion.line = common_.line;
  insertion.pen = pen();
  insertion.world = *world;
  insertion.at = numbers.point(10, 20);
  const Millimetres degrees = numbers.get(50);
  insertion.rotation = direction_of_degrees(degrees.value);
  insertion.rotation_error = degrees.error * kDegree * (1 + 0x1p-40);
  insertion.column_step = numbers.get(44);
  insertion.row_step = numbers.get(45);
  into.insertions.push_back(insertion);
  return {};
}

Result<void> DxfEntities::read_other(DxfBlock& into) {
  while (at_.next() && at_.code() != 0) LEKALO_CHECK(take_common());
  // SEQEND ends vertices and attributes, and draws nothing itself.
  if (!at_.ok() || common_.type == "SEQEND" || is_out_of_sight(into)) return {};
  into.count_unread(shown(common_.type), common_.line);
  return {};
}

}  // namespace lekalo::io
