#include "labels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/io/text/words.hpp"
#include "printed_number.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr double kStandOff[] = {2.0, 4.0, 7.0, 11.0};             ///< mm of paper
constexpr double kAside[] = {0, 4, -4, 8, -8, 13, -13, 19, -19};  ///< mm of paper, along the edge
constexpr double kClear = 0.5;                                    ///< mm around a label

class Places {
 public:
  Places(const Obstacles& obstacles, const Rect& page) : obstacles_(obstacles), page_(page) {}

  struct Place {
    Rect box;
    Segment leader;
  };

  std::optional<Place> find(const Label& label, double width, double height) {
    const Point out = (1 / geom::norm(label.outward)) * label.outward;
    const Point sides[] = {out, -out, perpendicular(out), -perpendicular(out)};
    for (const Point side : sides) {
      if (const auto place = find(label, side, width, height)) return place;
      if (!label.any_side) break;
    }
    return std::nullopt;
  }

 private:
  std::optional<Place> find(const Label& label, Point out, double width, double height) {
    const Point aside = perpendicular(out);
    const double reach = (std::abs(out.x) * width + std::abs(out.y) * height) / 2;
    for (const double off : kStandOff) {
      for (const double step : kAside) {
        const Point centre = label.at + (off + reach) * out + step * aside;
        const Place place{{centre.x - width / 2, centre.y - height / 2, width, height},
                          leader(label.at, centre, width, height)};
        if (!is_free(place)) continue;
        taken_.push_back(place);
        return place;
      }
    }
    return std::nullopt;
  }

  static Segment leader(Point from, Point centre, double width, double height) {
    const Rect box{centre.x - width / 2, centre.y - height / 2, width, height};
    const Point to{std::clamp(from.x, box.x, box.right()), std::clamp(from.y, box.y, box.bottom())};
    return {from, to};
  }

  [[nodiscard]] bool is_free(const Place& place) const {
    const Rect box = place.box.grown(kClear);
    if (!page_.contains(box)) return false;
    for (const Place& other : taken_) {
      if (box.overlaps(other.box) || clipped(other.leader, box) ||
          clipped(place.leader, other.box.grown(kClear))) {
        return false;
      }
    }
    const auto inside = [&box](const Ring& ring) {
      return geom::locate_point(ring, box.centre()) != geom::PointLocation::outside;
    };
    return std::none_of(obstacles_.filled.begin(), obstacles_.filled.end(),
                        [&](const Ring& ring) { return inside(ring) || crosses(ring, box); }) &&
           std::none_of(obstacles_.lines.begin(), obstacles_.lines.end(),
                        [&](const Ring& ring) { return crosses(ring, box); });
  }
  static bool crosses(const Ring& ring, const Rect& box) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      ask();
      if (clipped({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]}, box)) return true;
    }
    return false;
  }

  const Obstacles& obstacles_;
  Rect page_;
  std::vector<Place> taken_;
};

}  // namespace

void place_labels(const std::vector<Label>& labels, double size, const Obstacles& obstacles, const Rect& page,
                  std::vector<Item>& items) {
  Places places(obstacles, page);
  for (const Label& label : labels) {
    const double width = size * io::text_width(label.text), height = 0.8 * size;
    const auto place = places.find(label, width, height);
    if (!place) continue;
    items.push_back(
        PathItem{{{place->leader.a, place->leader.b}}, false, stroked(kFaint, 0.2), {"leader", ""}});
    items.push_back(TextItem{{place->box.x + width / 2, place->box.bottom()},
                             label.text,
                             size,
                             Anchor::middle,
                             label.colour,
                             false,
                             {label.kind, ""}});
  }
}

}  // namespace lekalo::draw
