#include "tree_check.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "near.hpp"
#include "tree_value.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Beyond so many looks at sides nothing more is shown.
constexpr std::size_t kMostWork = 20'000'000;
/// Beside corners nothing is shown of stretches as short as this share of the reach; but of so many in a row
/// something must be.
constexpr double kShort = 0.5;
constexpr int kMostShort = 160;
/// The tree is asked this many times the reach to the left and to the right of a stretch.
constexpr double kAside = 2;
/// A point this many times the reach away from all outlines of the tree is on none of them.
constexpr double kFar = 8;

/// Our knowledge of the tree's material beside one stretch of a curve.
struct Beside {
  In left = In::open, right = In::open;
  /// The primitives along which the stretch runs.
  std::vector<SideOfTree> along;
};

class TreeCheck {
 public:
  TreeCheck(const Tree& tree, const Shape& used, double reach)
      : primitives_(tree.primitives), used_(used), reach_(reach), outline_(pieces_of(used)), value_(tree) {}

  TreeVerdict run() {
    clip_half_planes();
    gather_sides();
    if (!ends_in_window()) leave_open("the shape may have no end");
    for (const Side& side : used_.sides) {
      if (side.written || verdict_.along.empty()) verdict_.along.emplace_back();
      check_edge(side);
      if (!verdict_.fault.empty()) return verdict_;
    }
    for (const Primitive& primitive : primitives_)
      for (const Side& side : primitive.shape.sides) {
        check_side(side);
        if (!verdict_.fault.empty()) return verdict_;
      }
    return verdict_;
  }

 private:
  void leave_open(std::string sentence) {
    if (verdict_.open.empty()) verdict_.open = std::move(sentence);
  }

  /// Half-planes become lines that are longer than everything else together.
  void clip_half_planes() {
    double size = std::max({-used_.low_x, -used_.low_y, used_.high_x, used_.high_y, 0.0});
    for (const Primitive& primitive : primitives_)
      for (const Side& side : primitive.shape.sides) {
        const Box box = box_of(side);
        size = std::max({size, -box.low_x, -box.low_y, box.high_x, box.high_y});
      }
    window_ = 4 * size;
    for (Primitive& primitive : primitives_) {
      if (!primitive.half_plane) continue;
      Side& line = primitive.shape.sides[0];
      const Vec along = unit(line.to - line.from);
      const Vec foot = line.from - along * dot(along, line.from);
      line.from = foot - along * just(window_), line.to = foot + along * just(window_);
      bound(primitive.shape);
    }
  }

  /// The sides of all primitives stand in one tree, and their boxes in another, so that a piece is asked about
  /// those near to it alone.
  void gather_sides() {
    std::vector<Box> boxes, wholes;
    for (std::size_t k = 0; k < primitives_.size(); ++k) {
      const Primitive& primitive = primitives_[k];
      const Shape& shape = primitive.shape;
      for (std::size_t i = 0; i < shape.sides.size(); ++i) {
        const Side& side = shape.sides[i];
        members_.push_back({{k, i}, side.arc ? Vec{} : unit(side.to - side.from)});
        boxes.push_back(shape.tree->box(i));
      }
      wholes.push_back(primitive.half_plane ? Box{-kInfinity, -kInfinity, kInfinity, kInfinity}
                                            : Box{shape.low_x, shape.low_y, shape.high_x, shape.high_y});
    }
    sides_ = SideTree(std::move(boxes));
    wholes_ = SideTree(std::move(wholes));
  }

  /// Beyond the window there is none of any primitive but half-planes.
  bool ends_in_window() {
    value_.clear();
    for (std::size_t k = 0; k < primitives_.size(); ++k)
      if (primitives_[k].half_plane) value_.set(k, In::open);
    return value_.value() == In::no;
  }

  static In in_half_plane(const Side& line, const Vec& p) {
    const Span turn = cross(line.to - line.from, p - line.from);
    return turn.low > 0 ? In::yes : (turn.high < 0 ? In::no : In::open);
  }
  [[nodiscard]] In in_primitive(const Primitive& primitive, const Vec& p) const {
    if (primitive.half_plane) return in_half_plane(primitive.shape.sides[0], p);
    const auto in = holds(primitive.shape, p);
    return !in ? In::open : (*in ? In::yes : In::no);
  }

  static Vec middle_of(const Side& piece) {
    if (!piece.arc) return (piece.from + piece.to) * just(0.5);
    const Vec sum = piece.first + piece.last;
    return piece.centre + unit(sum) * piece.radius;
  }
  /// Returns the direction that is to the left along the piece; along arcs as they run counter-clockwise.
  static Vec left_of(const Side& piece) {
    if (piece.arc) return -unit(piece.first + piece.last);
    const Vec along = unit(piece.to - piece.from);
    return {-along.y, along.x};
  }

  /// Returns the stretch that runs beside a piece, to the left of it for a distance above 0.
  static Side aside_of(Side piece, double by) {
    const Vec shift = left_of(piece) * just(by);
    if (piece.arc) {
      piece.radius = piece.radius - just(by);
      piece.from = piece.centre + piece.first * piece.radius,
      piece.to = piece.centre + piece.last * piece.radius;
      return piece;
    }
    piece.from = piece.from + shift, piece.to = piece.to + shift;
    return piece;
  }
  /// Says whether a piece surely does not meet a side. Its ends tell more than the line through it, which is
  /// hardly known far from a short piece.
  static bool surely_apart(const Side& piece, const Side& side) {
    const Corners corners = corners_of(piece);
    bool before = true, behind = true;
    Span nearest = just(kInfinity);
    for (std::size_t i = 0; i < corners.count; ++i) {
      const Vec& at = corners.at[i];
      const Span height =
          side.arc ? length(at - side.centre) - side.radius : cross(side.to - side.from, at - side.from);
      before = before && height.high < 0, behind = behind && height.low > 0;
      if (i < 2 && side.arc) nearest = {std::min(nearest.low, length(at - side.centre).low), kInfinity};
    }
    // The corners are on one side of a line, or within a circle, with all between them.
    if (before || (behind && !side.arc)) return true;
    if (side.arc && behind) {
      // The chord is nowhere nearer to the centre than this, and the arc nowhere farther from its chord.
      const Span half = length(corners.at[1] - corners.at[0]) * just(0.5);
      Span least = square_root(just(nearest.low) * just(nearest.low) - half * half);
      if (piece.arc) least = least - half * half / piece.radius;
      if (least.low > side.radius.high) return true;
    }
    const Vec middle = middle_of(piece);
    return (distance(middle, side) - just(farthest(piece, middle))).low > 0 || distance(piece, side).low > 0;
  }

  /// A side of a primitive, and the direction of a line.
  struct Member {
    SideOfTree side;
    Vec along;
  };
  /// Says whether the line or circle that carries a side is surely farther than `room` from a point.
  static bool is_away(const Member& member, const Side& side, const Vec& p, double room) {
    const Span off = side.arc ? length(p - side.centre) - side.radius : cross(member.along, p - side.from);
    return (absolute(off) - just(room) - just(side.off)).low > 0;
  }

  /// Asks on which side of a piece there is material of the tree. Where the outline of a primitive meets a
  /// stretch beside the piece, that primitive is open there, and what the others say may be enough: another
  /// shape of a union holds all of the stretch, or a half-plane of an intersection nothing of it. For the
  /// rest one point of each stretch tells for all of it. `apart` wants no outline to meet the two.
  /// \pre piece is a line or turns by less than a half
  Beside beside(const Side& piece, const Corners& corners, bool apart) {
    const double aside = kAside * reach_;
    Beside known;
    if (piece.arc && !(piece.radius.low > 2 * aside)) return known;
    const Side left = aside_of(piece, aside), right = aside_of(piece, -aside);
    const Vec at_left = middle_of(left), at_right = middle_of(right);
    const Vec middle = middle_of(piece);
    const double room = (just(farthest(piece, middle)) + just(2 * aside)).high;
    struct Near {
      std::size_t primitive;
      bool meets_left, meets_right;
    };
    std::vector<Near> near;
    bool given_up = false;
    double limit = 2 * aside;
    sides_.visit_near(box_of(piece), limit, [&](std::size_t m) {
      if (given_up) return void(limit = -1);  // no box is so near, which ends the walk
      ++work_;
      const auto [k, i] = members_[m].side;
      const Side& side = primitives_[k].shape.sides[i];
      if (is_away(members_[m], side, middle, room)) return;
      work_ += 3;
      near.push_back({k, !surely_apart(left, side), !surely_apart(right, side)});
      const bool meets = near.back().meets_left || near.back().meets_right;
      given_up = apart && meets;
      if (!meets && farthest(piece, corners, side) <= reach_) known.along.push_back({k, i});
    });
    if (given_up) return known;
    value_.clear();
    const auto may_hold = [&](const Box& box) {
      return !(at_left.x.high < box.low_x || at_left.x.low > box.high_x || at_left.y.high < box.low_y ||
               at_left.y.low > box.high_y);
    };
    wholes_.visit(may_hold, [&](std::size_t k) {
      ++work_;
      value_.set(k, in_primitive(primitives_[k], at_left));
    });
    for (const Near& one : near)
      if (one.meets_left) value_.set(one.primitive, In::open);
    known.left = value_.value();
    // A primitive that is not near is the same on both hands.
    for (const Near& one : near) value_.set(one.primitive, in_primitive(primitives_[one.primitive], at_right));
    for (const Near& one : near)
      if (one.meets_right) value_.set(one.primitive, In::open);
    known.right = value_.value();
    return known;
  }

  /// Calls `settled(piece, corners)` for parts of a side until it is true for all but the shortest.
  template <class Settled>
  bool halve(const Side& whole, Settled settled) {
    std::vector<Side> open{whole};
    int short_ones = 0;
    while (!open.empty()) {
      const Side piece = open.back();
      open.pop_back();
      const bool wide = piece.arc && piece.sweep != Sweep::less;
      if (!wide) {
        const Corners corners = corners_of(piece);
        const Vec middle = piece.arc ? piece.from : (piece.from + piece.to) * just(0.5);
        if (settled(piece, corners)) {
          short_ones = 0;
          continue;
        }
        if (farthest(piece, middle) <= kShort * reach_) {
          if (++short_ones > kMostShort) return false;
          continue;
        }
        if (work_ > kMostWork) {
          leave_open("more work than is spent on it would be needed");
          return false;
        }
      }
      at_ = piece.from;
      for (const Side& half : halves(piece)) {
        // A part that cannot be halved is as long as the whole.
        if (!wide && half.arc && half.first.x.low == piece.first.x.low &&
            half.last.x.low == piece.last.x.low && half.first.y.low == piece.first.y.low &&
            half.last.y.low == piece.last.y.low)
          return false;
        open.push_back(half);
      }
    }
    return true;
  }

  /// A side with a point farther from every primitive is none of the tree's.
  [[nodiscard]] bool far_from_primitives(const Vec& p) const {
    bool far = true;
    const double limit = kFar * reach_;
    sides_.visit_near(box_of(p), limit, [&](std::size_t m) {
      const auto [k, i] = members_[m].side;
      far = far && distance(p, primitives_[k].shape.sides[i]).low > limit;
    });
    return far;
  }

  void check_edge(const Side& side) {
    std::set<SideOfTree>& along = verdict_.along.back();
    for (const Vec& p : points_of(side))
      if (far_from_primitives(p)) {
        verdict_.fault = fmt::format("its outline at {} is none of the tree's", text_of(p));
        return;
      }
    bool wrong = false;
    const bool whole = halve(side, [&](const Side& piece, const Corners& corners) {
      const Beside known = beside(piece, corners, true);
      if (known.along.empty() || known.left == In::open || known.right == In::open) return false;
      const Vec aside = left_of(piece) * just(kAside * reach_);
      const auto in = holds(used_, middle_of(piece) + aside), out = holds(used_, middle_of(piece) - aside);
      if (!in || !out) return false;
      along.insert(known.along.begin(), known.along.end());
      wrong = wrong || (known.left == In::yes) != *in || (known.right == In::yes) != *out;
      return true;
    });
    if (wrong) verdict_.fault = fmt::format("its material about {} is not that of the tree", text_of(at_));
    if (!whole || along.empty())
      leave_open(fmt::format("its outline about {} is not shown to be the tree's", text_of(at_)));
  }

  void check_side(const Side& side) {
    bool missing = false;
    const bool whole = halve(side, [&](const Side& piece, const Corners& corners) {
      if (!outline_.first_not_within({{piece, 0}}, 2 * kAside * reach_, work_, 0)) return true;
      const Beside known = beside(piece, corners, false);
      if (known.left == In::open || known.right == In::open) return false;
      missing =
          missing || (known.left != known.right && distance(middle_of(piece), used_).low > kFar * reach_);
      return known.left == known.right || missing;
    });
    if (missing) verdict_.fault = fmt::format("it lacks the outline of the tree about {}", text_of(at_));
    if (!whole) leave_open(fmt::format("the tree's outline about {} is not shown to be its", text_of(at_)));
  }

  static std::string text_of(const Vec& p) { return fmt::format("({}, {})", p.x.low, p.y.low); }

  std::vector<Primitive> primitives_;
  const Shape& used_;
  double reach_;
  double window_ = 0;
  std::vector<Member> members_;
  /// Over the sides of all primitives, in the order of members_, and over the boxes of the primitives.
  SideTree sides_{std::vector<Box>()}, wholes_{std::vector<Box>()};
  CurvePieces outline_;
  TreeValue value_;
  std::size_t work_ = 0;
  /// A place near the last piece that was cut.
  Vec at_;
  TreeVerdict verdict_;
};

}  // namespace

TreeVerdict check_tree(const Tree& tree, const Shape& used, double reach) {
  return TreeCheck(tree, used, reach).run();
}

}  // namespace lekalo::verify
