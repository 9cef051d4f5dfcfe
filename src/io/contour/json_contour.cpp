#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "contour_points.hpp"
#include "lekalo/io/text/json_events.hpp"

namespace lekalo::io {
namespace {

/// An edge of the region form may begin this far from the end of the one before it, per coordinate, in the
/// file's unit.
constexpr double kEdgeGap = 1e-6;

/// Listens to the parser and keeps the points. It takes events and no tree, because only these carry a
/// number's own text, which decides whether it is a double exactly, and because five million points stay
/// small so.
class ContourListener final : public JsonEvents {
 public:
  ContourListener(const std::string& name, LengthUnit unit) {
    file_.name = name;
    file_.unit = unit;
    file_.places_are_lines = false;
  }

  bool null() override { return scalar("null"); }
  bool boolean(bool) override { return scalar("a truth value"); }
  bool integer(std::int64_t value) override { return decimal(fmt::format("{}", value)); }
  bool number(double, std::string_view text) override { return decimal(std::string(text)); }

  bool text(std::string_view text) override {
    if (inside() != Place::root_object || key() != "units") return scalar(excerpt(text));
    if (text != "mm" && text != "inch") {
      return stop(fmt::format("\"units\" is {}; \"mm\" and \"inch\" are known", excerpt(text)));
    }
    file_unit_ = text == "mm" ? LengthUnit::millimetre : LengthUnit::inch;
    return true;
  }

  bool begin_object() override {
    switch (inside()) {
      case Place::nothing:
        return enter(Place::root_object);
      case Place::edge_list:
        return enter(Place::edge);
      case Place::edge:
        return key() == "line" ? enter(Place::line) : stop(fmt::format("{}: {}", item(), unknown_edge()));
      default:
        return wrong("an object");
    }
  }

  bool begin_list() override {
    switch (inside()) {
      case Place::nothing:
        return start_points("the list");
      case Place::root_object:
        return start_member_list();
      case Place::point_list:
        return enter(Place::point);
      case Place::line:
        return enter(key() == "from" ? Place::from : Place::to);
      default:
        return wrong("a list");
    }
  }

  bool key(std::string_view text) override {
    Frame& top = stack_.back();
    if (std::find(top.keys.begin(), top.keys.end(), text) != top.keys.end()) {
      return stop(fmt::format("the key {} stands twice in one object", excerpt(text)));
    }
    top.keys.emplace_back(text);
    if (top.place == Place::line && text != "from" && text != "to") {
      return stop(fmt::format("{}: a line has \"from\" and \"to\", not {}", item(), excerpt(text)));
    }
    return true;
  }

  bool end_object() override {
    const Frame top = std::move(stack_.back());
    stack_.pop_back();
    if (top.place == Place::line && top.keys.size() != 2) {
      return stop(fmt::format("{}: a line needs \"from\" and \"to\"", item()));
    }
    if (top.place == Place::edge && top.keys.empty())
      return stop(fmt::format("{}: {}", item(), unknown_edge()));
    return count_item();
  }

  bool end_list() override {
    const Place place = inside();
    const std::size_t count = stack_.back().count;
    if (is_point(place) && count != 2) {
      return stop(
          fmt::format("{} has {} number{} where x and y are wanted", item(), count, count == 1 ? "" : "s"));
    }
    stack_.pop_back();
    if (place == Place::to) {
      ends_.push_back({numbers_[0].value, numbers_[1].value});
      // "to" is checked against the next "from", but no coordinate of the contour.
    } else if (is_point(place) && !append_point(file_, numbers_[0], numbers_[1], items_)) {
      return stop(too_many_points());
    }
    return count_item();
  }

  void broken(const JsonBreak& at) override {
    const std::string number = at.token.substr(0, at.token.find_last_not_of(" \t\r\n,]}") + 1);
    fault_ = fmt::format("line {}: {}", at.line,
                         at.number_too_large
                             ? number_sentence(NumberFault::too_large, number)
                             : fmt::format("this is not JSON from here on, near {}", excerpt(at.token)));
  }

  /// The contour, after a parse that went through.
  Result<ContourFile> take() {
    if (!has_contour_) return refuse(file_.name, "there is neither \"points\" nor \"outer\" in this file");
    const double gap = kEdgeGap * millimetres_per(file_.unit);
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const std::size_t next = (k + 1) % ends_.size();
      const geom::Point apart = file_.points[next] - ends_[k];
      if (std::max(std::abs(apart.x), std::abs(apart.y)) <= gap) continue;
      return refuse(file_.name,
                    fmt::format("edge {} begins at ({}, {}) mm, but edge {} ends at ({}, {}) mm", next,
                                file_.points[next].x, file_.points[next].y, k, ends_[k].x, ends_[k].y));
    }
    return std::move(file_);
  }

  [[nodiscard]] std::optional<LengthUnit> file_unit() const { return file_unit_; }
  [[nodiscard]] tl::unexpected<Error> fault() const { return refuse(file_.name, fault_); }

 private:
  enum class Place { nothing, root_object, point_list, point, edge_list, edge, line, from, to, hole_list };
  struct Frame {
    Place place;
    std::size_t count = 0;
    std::vector<std::string> keys;
  };

  static bool is_point(Place place) {
    return place == Place::point || place == Place::from || place == Place::to;
  }
  static std::string unknown_edge() {
    return "only {\"line\": {\"from\", \"to\"}} is read until any-shape locate";
  }

  [[nodiscard]] Place inside() const { return stack_.empty() ? Place::nothing : stack_.back().place; }
  [[nodiscard]] const std::string& key() const { return stack_.back().keys.back(); }
  [[nodiscard]] std::string item() const {
    return fmt::format("{} {}", region_form_ ? "edge" : "point", items_);
  }

  bool stop(std::string sentence) {
    fault_ = std::move(sentence);
    return false;
  }

  bool enter(Place place) {
    stack_.push_back({place, 0, {}});
    return true;
  }

  bool start_points(const char* what) {
    if (std::exchange(has_contour_, true))
      return stop(fmt::format("{} is a second contour in this file", what));
    return enter(Place::point_list);
  }

  bool start_member_list() {
    if (key() == "points") return start_points("\"points\"");
    if (key() == "outer") {
      if (std::exchange(has_contour_, true)) return stop("\"outer\" is a second contour in this file");
      region_form_ = true;
      return enter(Place::edge_list);
    }
    if (key() == "holes" || key() == "islands") return enter(Place::hole_list);
    return wrong("a list");
  }

  /// Counts one more complete item of the list around it.
  bool count_item() {
    if (stack_.empty()) return true;
    ++stack_.back().count;
    if (stack_.back().place == Place::point_list || stack_.back().place == Place::edge_list) ++items_;
    return true;
  }

  bool decimal(const std::string& text) {
    if (!is_point(inside())) return scalar(text);
    const auto value = read_millimetres(text, file_.unit);
    if (!value) return stop(fmt::format("{}: {}", item(), number_sentence(value.error(), text)));
    std::size_t& count = stack_.back().count;
    if (count < 2) numbers_[count] = *value;
    ++count;
    return true;
  }

  /// A single value: in the outermost object it may say who measured and when, elsewhere it is a mistake.
  bool scalar(const std::string& what) {
    static const std::set<std::string> kStructured{"points", "outer", "holes", "islands", "units"};
    if (inside() == Place::root_object && kStructured.count(key()) == 0) return true;
    return wrong(what);
  }

  bool wrong(const std::string& what) {
    switch (inside()) {
      case Place::nothing:
        return stop(fmt::format("a list of points or an object is wanted, not {}", what));
      case Place::root_object:
        return stop(fmt::format("the value of {} cannot be {}", excerpt(key()), what));
      case Place::hole_list:
        return stop("the contour has holes or islands, which are not read until any-shape locate");
      case Place::point_list:
      case Place::edge_list:
        return stop(fmt::format("{} is {}", item(), what));
      case Place::edge:
        return stop(fmt::format("{}: {}", item(), unknown_edge()));
      default:
        return stop(fmt::format("{}: two numbers are wanted, not {}", item(), what));
    }
  }

  ContourFile file_;
  std::optional<LengthUnit> file_unit_;
  std::vector<Frame> stack_;
  Millimetres numbers_[2];
  geom::Ring ends_;
  std::size_t items_ = 0;
  bool has_contour_ = false, region_form_ = false;
  std::string fault_;
};

}  // namespace

Result<ContourFile> read_json_contour(std::string_view bytes, const std::string& name,
                                      std::optional<LengthUnit> user_says) {
  const auto listen = [&](LengthUnit unit) {
    ContourListener listener(name, unit);
    const bool complete = parse_json(bytes, listener);
    return std::pair(complete, std::move(listener));
  };
  const LengthUnit assumed = user_says.value_or(LengthUnit::millimetre);
  auto [complete, listener] = listen(assumed);
  if (!complete) return listener.fault();
  LEKALO_TRY(const auto unit, agree_on_unit(name, listener.file_unit(), "\"units\"", user_says));
  if (unit == assumed) return listener.take();
  // "units" may stand behind the points it is for.
  auto [again, in_unit] = listen(unit);
  return again ? in_unit.take() : in_unit.fault();
}

}  // namespace lekalo::io
