#pragma once

// Sheets on which edges of parts face each other at exactly one kerf: a rectangle that is divided over and
// over, so that all kinds of crossings come about. Some places stay empty, some parts are smaller than their
// place, some places hold two right triangles.

#include <cmath>
#include <cstdint>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::cases {

struct CommonSheet {
  std::vector<std::vector<geom::Point>> parts;  ///< corners, counter-clockwise
  double side = 0;                              ///< all parts lie in a square from (0, 0), with room around
};

class CommonSheetMaker {
 public:
  /// \param least  sides of places, mm
  CommonSheetMaker(Random& random, double kerf, double least) : random_(random), kerf_(kerf), least_(least) {}

  CommonSheet make() {
    const double margin = 8 + 2 * kerf_, width = random_.uniform(2, 5) * least_,
                 height = random_.uniform(2, 5) * least_;
    divide(margin, margin, width, height);
    if (sheet_.parts.empty()) add(margin, margin, least_, least_);
    sheet_.side = 2 * margin + std::max(width, height);
    return sheet_;
  }

 private:
  [[nodiscard]] static double rounded(double mm) { return std::round(mm * 1000) / 1000; }

  void divide(double x, double y, double width, double height) {
    const bool may_x = width > 2 * least_ + kerf_, may_y = height > 2 * least_ + kerf_;
    if ((!may_x && !may_y) || random_.below(7) == 0) return leaf(x, y, width, height);
    const bool along_x = may_x && (!may_y || random_.below(2) == 0);
    const double whole = along_x ? width : height,
                 first = rounded(random_.below(3) == 0 ? (whole - kerf_) / 2
                                                       : random_.uniform(least_, whole - least_ - kerf_)),
                 second = whole - first - kerf_;
    if (along_x)
      divide(x, y, first, height), divide(x + first + kerf_, y, second, height);
    else
      divide(x, y, width, first), divide(x, y + first + kerf_, width, second);
  }

  void leaf(double x, double y, double width, double height) {
    switch (random_.below(8)) {
      case 0:
        return;
      case 1: {
        // The hypotenuses keep half a kerf from the diagonal.
        const double along = std::hypot(width, height), off_x = kerf_ / 2 * along / height,
                     off_y = kerf_ / 2 * along / width;
        if (off_x > width / 2 || off_y > height / 2) return add(x, y, width, height);
        sheet_.parts.push_back({{x + off_x, y}, {x + width, y}, {x + width, y + height - off_y}});
        sheet_.parts.push_back({{x, y + off_y}, {x + width - off_x, y + height}, {x, y + height}});
        return;
      }
      case 2: {
        const double less_x = random_.uniform(kerf_, width / 2), less_y = random_.uniform(kerf_, height / 2);
        const double left = random_.below(2) == 0 ? 0 : less_x, low = random_.below(2) == 0 ? 0 : less_y;
        return add(x + rounded(left), y + rounded(low), rounded(width - less_x), rounded(height - less_y));
      }
      default:
        add(x, y, width, height);
    }
  }

  void add(double x, double y, double width, double height) {
    sheet_.parts.push_back({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
  }

  Random& random_;
  double kerf_, least_;
  CommonSheet sheet_;
};

}  // namespace lekalo::cases
