#include "tree_check.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/parallel.hpp"
#include "near.hpp"
#include "tree_value.hpp"
#include "verify/number/surely.hpp"
#include "verify/shape/contour_tree.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// Beyond so many looks at sides nothing more is shown.
constexpr std::size_t kMostTreeWork = 20'000'000;
/// Beside corners nothing is shown of stretches as short as this share of the reach; but of so many in a row
/// something must be.
constexpr double kShort = 0.5;
constexpr int kMostShort = 160;
constexpr int kShortAtCorner = 16;
/// An end that is cut off is about a 16th of the whole, and is to be no shorter than that.
constexpr double kEnd = 16;
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

/// A part of a side that is still to be shown.
struct Part {
  Side piece;
  /// It begins, or ends, where outlines may meet: the shorter it is the less of it is open there.
  bool begins_at_corner = false, ends_at_corner = false;
  /// The half-planes of which the parts that it was cut from did not tell on which side of them it lies: a
  /// range of TreeCheck::undecided_. What was said of the others is so much of TreeCheck::value_.
  std::size_t undecided_begin = 0, undecided_end = 0, said = 0;
};

/// A side of a primitive, and the direction of a line.
struct Member {
  SideOfTree side;
  Vec along;
};

/// Says whether the line or circle that carries a side is surely farther than `room` from a point.
bool is_away(const Member& member, const Side& side, const Vec& p, double room) {
  const Span off = side.arc ? length(p - side.centre) - side.radius : cross(member.along, p - side.from);
  return is_positive(absolute(off) - just(room) - just(side.off));
}

/// A tree and the region that is to be it, arranged for walks along their sides.
struct Ground {
  Ground(const Tree& tree, const Shape& region, double distance)
      : primitives(tree.primitives), used(region), reach(distance), outline(pieces_of(region)) {
    clip_half_planes();
    gather_sides();
  }

  /// A side with a point farther from every primitive is none of the tree's.
  /// \param near  the half-plane that a point was near to last, which is asked first
  [[nodiscard]] bool far_from_primitives(const Vec& p, std::size_t& near) const {
    bool far = true;
    const double limit = kFar * reach;
    sides.visit_near(box_of(p), limit, [&](std::size_t m) {
      const auto [k, i] = members[m].side;
      far = far && surely_above(distance(p, primitives[k].shape.sides[i]), just(limit));
    });
    for (std::size_t k = 0, begin = near; k < half_planes.size() && far; ++k) {
      near = (begin + k) % half_planes.size();
      const SideOfTree& line = half_planes[near].side;
      far = is_away(half_planes[near], primitives[line.primitive].shape.sides[line.side], p, limit);
    }
    return far;
  }

  std::vector<Primitive> primitives;
  const Shape& used;
  double reach;
  /// The sides of all primitives but half-planes, and the lines of those.
  std::vector<Member> members, half_planes;
  /// The primitives that are no half-planes.
  std::vector<std::size_t> with_box;
  /// Over the sides in the order of members, and over the boxes of the primitives in the order of with_box.
  SideTree sides{std::vector<Box>()}, wholes{std::vector<Box>()};
  CurvePieces outline;

 private:
  /// Half-planes become lines that are longer than everything else together. A region that is larger runs
  /// along nothing there.
  void clip_half_planes() {
    double size = 0;
    for (const Primitive& primitive : primitives)
      for (const Side& side : primitive.shape.sides) {
        const Box box = box_of(side);
        size = std::max({size, -box.low_x, -box.low_y, box.high_x, box.high_y});
      }
    const double window = 4 * size;
    for (Primitive& primitive : primitives) {
      if (!primitive.half_plane) continue;
      Side& line = primitive.shape.sides[0];
      const Vec along = unit(line.to - line.from);
      const Vec foot = line.from - along * dot(along, line.from);
      line.from = foot - along * just(window), line.to = foot + along * just(window);
      bound(primitive.shape);
    }
  }

  /// The sides of all primitives stand in one tree, and their boxes in another, so that a piece is asked
  /// about those near to it alone. Half-planes, which are near to all, are kept apart.
  void gather_sides() {
    std::vector<Box> boxes, of_primitives;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const Primitive& primitive = primitives[k];
      const Shape& shape = primitive.shape;
      if (primitive.half_plane) {
        half_planes.push_back({{k, 0}, unit(shape.sides[0].to - shape.sides[0].from)});
        continue;
      }
      for (std::size_t i = 0; i < shape.sides.size(); ++i) {
        const Side& side = shape.sides[i];
        members.push_back({{k, i}, side.arc ? Vec{} : unit(side.to - side.from)});
        boxes.push_back(shape.tree->box(i));
      }
      of_primitives.push_back({shape.low_x, shape.low_y, shape.high_x, shape.high_y});
      with_box.push_back(k);
    }
    sides = SideTree(std::move(boxes));
    wholes = SideTree(std::move(of_primitives));
  }
};

/// The result of a walk along one side.
struct Finding {
  std::string fault, open;
  /// Says that an edge runs along no side. What joins an arc to its end may.
  std::string alone;
  /// The sides of primitives along which an edge of the region runs.
  std::set<SideOfTree> along;
};

/// Walks along sides, one after the other.
class Walk {
 public:
  Walk(const Tree& tree, const Ground& ground)
      : ground_(ground), primitives_(ground.primitives), reach_(ground.reach), value_(tree) {}

  /// Returns the looks at sides that were needed so far.
  [[nodiscard]] std::size_t work() const { return work_; }

  /// Beyond the window there is none of any primitive but half-planes.
  /// \pre nothing was looked at
  [[nodiscard]] bool ends_in_window() const { return value_.value() == In::no; }

  /// Looks at an edge of the region.
  /// \param most_work  nothing more is shown when this walk has needed more
  Finding along_edge(const Side& side, std::size_t most_work) {
    begin(side, most_work);
    for (const Vec& p : points_of(side))
      if (ground_.far_from_primitives(p, near_last_)) {
        found_.fault = fmt::format("its outline at {} is none of the tree's", text_of(p));
        return std::move(found_);
      }
    bool wrong = false;
    const bool whole = halve(side, {}, [&](const Side& piece, const Corners& corners) {
      const Beside known = beside(piece, corners, true);
      if (known.along.empty() || known.left == In::open || known.right == In::open) return false;
      const Vec aside = left_of(piece) * just(kAside * reach_);
      const auto in = holds(ground_.used, middle_of(piece) + aside),
                 out = holds(ground_.used, middle_of(piece) - aside);
      if (!in || !out) return false;
      found_.along.insert(known.along.begin(), known.along.end());
      wrong = wrong || (known.left == In::yes) != *in || (known.right == In::yes) != *out;
      return true;
    });
    if (wrong) found_.fault = fmt::format("its material about {} is not that of the tree", text_of(at_));
    const std::string sentence =
        fmt::format("its outline about {} is not shown to be the tree's", text_of(at_));
    if (!whole) leave_open(sentence);
    if (found_.along.empty()) found_.alone = sentence;
    return std::move(found_);
  }

  /// Looks at a side of a primitive, which edges of the region meet, or leave, at `meetings`.
  Finding along_side(const Side& side, const std::vector<Vec>& meetings, std::size_t most_work) {
    begin(side, most_work);
    bool missing = false;
    const bool whole = halve(side, meetings, [&](const Side& piece, const Corners& corners) {
      if (!ground_.outline.first_not_within({{piece, 0}}, 2 * kAside * reach_, work_, 0)) return true;
      const Beside known = beside(piece, corners, false);
      if (known.left == In::open || known.right == In::open) return false;
      missing = missing || (known.left != known.right &&
                            surely_above(distance(middle_of(piece), ground_.used), just(kFar * reach_)));
      return known.left == known.right || missing;
    });
    if (missing) found_.fault = fmt::format("it lacks the outline of the tree about {}", text_of(at_));
    if (!whole) leave_open(fmt::format("the tree's outline about {} is not shown to be its", text_of(at_)));
    return std::move(found_);
  }

 private:
  void begin(const Side& side, std::size_t most_work) {
    found_ = {};
    at_ = side.from;
    most_work_ = most_work;
  }
  void leave_open(std::string sentence) {
    if (found_.open.empty()) found_.open = std::move(sentence);
  }

  static In in_half_plane(const Side& line, const Vec& p) {
    const Span turn = cross(line.to - line.from, p - line.from);
    return is_positive(turn) ? In::yes : (is_positive(-turn) ? In::no : In::open);
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
  /// A piece with what is asked of it again and again.
  struct Stretch {
    explicit Stretch(const Side& side) : piece(side), corners(corners_of(side)), middle(middle_of(side)) {}
    Side piece;
    Corners corners;
    Vec middle;
  };
  /// Says whether a piece surely does not meet a side. Its ends tell more than the line through it, which is
  /// hardly known far from a short piece.
  static bool stays_apart(const Stretch& stretch, const Side& side) {
    const Side& piece = stretch.piece;
    const Corners& corners = stretch.corners;
    bool before = true, behind = true;
    for (std::size_t i = 0; i < corners.count; ++i) {
      const Vec& at = corners.at[i];
      const Span height =
          side.arc ? length(at - side.centre) - side.radius : cross(side.to - side.from, at - side.from);
      before = before && is_positive(-height), behind = behind && is_positive(height);
    }
    // The corners are on one side of a line, or within a circle, with all between them.
    if (before || (behind && !side.arc)) return true;
    if (side.arc) {
      // The chord is nowhere nearer to the centre than this, and the arc nowhere farther from its chord.
      const Span half = length(corners.at[1] - corners.at[0]) * just(0.5);
      const double nearest =
          std::min(length(corners.at[0] - side.centre).low, length(corners.at[1] - side.centre).low);
      Span least = square_root(just(nearest) * just(nearest) - half * half);
      if (piece.arc) least = least - half * half / piece.radius;
      if (surely_above(least, side.radius)) return true;
    }
    return is_positive(distance(piece, side));
  }

  /// Says whether a half-plane holds all of a piece of this length and of the stretches beside it, or nothing
  /// of them. From most of them its first corner is farther away than that it needs a second look.
  In in_half_plane(const Member& half_plane, const Corners& corners, double length_of_piece) {
    const Side& line = primitives_[half_plane.side.primitive].shape.sides[0];
    const auto height_of = [&](const Vec& corner) { return cross(half_plane.along, corner - line.from); };
    const Span room = just(2 * kAside * reach_), far = room + just(length_of_piece);
    bool within = true, without = true;
    ++work_;
    const Span first = height_of(corners.at[0]);
    if (surely_above(first, far)) return In::yes;
    if (surely_above(-first, far)) return In::no;
    for (std::size_t i = 0; i < corners.count; ++i) {
      const Span height = height_of(corners.at[i]);
      within = within && surely_above(height, room), without = without && surely_above(-height, room);
    }
    return within ? In::yes : (without ? In::no : In::open);
  }

  /// Decides which of the half-planes of which the parts before did not tell hold all of a piece and of the
  /// stretches beside it, or nothing of them. The others are undecided for its parts, too. Where they tell
  /// the material there whatever else is near, and no outline is looked for, that is returned instead, and
  /// the rest is not asked. They are asked from the one that told last to both hands: what cuts off one piece
  /// mostly stands next to what cuts off another.
  In decide_half_planes(const Side& piece, const Corners& corners, bool apart) {
    const std::size_t begin = part_.undecided_begin, count = part_.undecided_end - begin;
    if (count == 0) return In::open;
    const auto say_of_others = [&](In in) {
      if (!apart)
        ground_.wholes.visit_near(box_of(piece), 2 * kAside * reach_,
                                  [&](std::size_t w) { value_.set(ground_.with_box[w], in); });
    };
    const auto told = [&] { return !apart && value_.value() != In::open; };
    const auto undecided = undecided_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto first =
        static_cast<std::size_t>(std::lower_bound(undecided, undecided_.end(), told_last_) - undecided);
    double length_of_piece = 0;
    for (std::size_t i = 1; i < corners.count; ++i)
      length_of_piece = std::max(length_of_piece, length(corners.at[i] - corners.at[0]).high);
    say_of_others(In::open);
    decided_.resize(count);
    for (std::size_t k = 0; k < count && !told(); ++k) {
      const std::size_t u = (first + (k % 2 == 0 ? k / 2 : count - (k + 1) / 2)) % count;
      const std::size_t asked = undecided_[begin + u];
      const Member& half_plane = ground_.half_planes[asked];
      decided_[u] = in_half_plane(half_plane, corners, length_of_piece);
      value_.set(half_plane.side.primitive, decided_[u]);
      if (told()) told_last_ = asked;
    }
    if (told()) {
      const In in = value_.value();
      value_.take_back(part_.said);
      return in;
    }
    say_of_others(In::no);
    part_.undecided_begin = undecided_.size();
    for (std::size_t u = 0; u < count; ++u)
      if (decided_[u] == In::open) undecided_.push_back(undecided_[begin + u]);
    part_.undecided_end = undecided_.size();
    part_.said = value_.said();
    return In::open;
  }

  /// Asks on which side of a piece there is material of the tree. Where the outline of a primitive meets a
  /// stretch beside the piece, that primitive is open there, and what the others say may be enough: another
  /// shape of a union holds all of the stretch, or a half-plane of an intersection nothing of it. For the
  /// rest one point of each stretch tells for all of it. `apart` wants no outline to meet the two.
  /// \pre piece is a line or turns by less than a half
  Beside beside(const Side& piece, const Corners& corners, bool apart) {
    const double aside = kAside * reach_;
    Beside known;
    known.left = known.right = decide_half_planes(piece, corners, apart);
    if (known.left != In::open) return known;
    if (piece.arc && !surely_above(piece.radius, just(2 * aside))) return known;
    const Stretch left(aside_of(piece, aside)), right(aside_of(piece, -aside));
    const Vec &at_left = left.middle, &at_right = right.middle;
    const Vec middle = middle_of(piece);
    const double room = (just(farthest(piece, middle)) + just(2 * aside)).high;
    near_.clear();
    bool given_up = false;
    const auto look_at = [&](const Member& member) {
      ++work_;
      const auto [k, i] = member.side;
      const Side& side = primitives_[k].shape.sides[i];
      if (is_away(member, side, middle, room)) return;
      work_ += 3;
      const bool meets_left = !stays_apart(left, side);
      given_up = apart && meets_left;
      if (given_up) return;
      near_.push_back({k, meets_left, !stays_apart(right, side)});
      given_up = apart && near_.back().meets_right;
      if (!is_away(member, side, middle, reach_) && farthest(piece, corners, side) <= reach_)
        known.along.push_back({k, i});
    };
    double limit = 2 * aside;
    ground_.sides.visit_near(box_of(piece), limit, [&](std::size_t m) {
      if (given_up) return void(limit = -1);  // no box is so near, which ends the walk
      look_at(ground_.members[m]);
    });
    for (std::size_t u = part_.undecided_begin; u < part_.undecided_end && !given_up; ++u)
      look_at(ground_.half_planes[undecided_[u]]);
    if (given_up) return known;
    const auto may_hold = [place = box_of(at_left)](const Box& box) { return !surely_apart(box, place); };
    const auto look_within = [&](std::size_t k) {
      ++work_;
      value_.set(k, in_primitive(primitives_[k], at_left));
    };
    ground_.wholes.visit(may_hold, [&](std::size_t w) { look_within(ground_.with_box[w]); });
    for (std::size_t u = part_.undecided_begin; u < part_.undecided_end; ++u)
      look_within(ground_.half_planes[undecided_[u]].side.primitive);
    for (const Near& one : near_)
      if (one.meets_left) value_.set(one.primitive, In::open);
    known.left = value_.value();
    // A primitive that is not near is the same on both hands.
    for (const Near& one : near_)
      value_.set(one.primitive, in_primitive(primitives_[one.primitive], at_right));
    for (const Near& one : near_)
      if (one.meets_right) value_.set(one.primitive, In::open);
    known.right = value_.value();
    value_.take_back(part_.said);
    return known;
  }

  /// Returns a side in parts that turn by less than a half, cut at those of its places that are nearest to
  /// the corners.
  static std::vector<Part> cut_at_corners(const Side& whole, const std::vector<Vec>& corners) {
    const bool has_ends = whole.sweep != Sweep::full;  // those of a circle are where it happens to begin
    std::vector<Part> open{{whole, has_ends, has_ends}}, parts;
    while (!open.empty()) {
      Part part = open.back();
      open.pop_back();
      if (part.piece.sweep != Sweep::less) {
        const std::array<Side, 2> two = halves(part.piece);
        open.push_back({two[1], false, part.ends_at_corner});
        open.push_back({two[0], part.begins_at_corner, false});
        continue;
      }
      // In the order of their distance from its beginning. Each is looked for in what the one before it left.
      std::vector<std::pair<double, Vec>> in_order;
      const Vec begin =
          part.piece.arc ? part.piece.centre + part.piece.first * part.piece.radius : part.piece.from;
      for (const Vec& corner : corners)
        if (cut_beside(part.piece, corner)) in_order.emplace_back(length(corner - begin).high, corner);
      std::ranges::sort(in_order, {}, [](const auto& one) { return one.first; });
      for (const auto& [away, corner] : in_order) {
        const auto two = cut_beside(part.piece, corner);
        if (!two) continue;
        parts.push_back({(*two)[0], part.begins_at_corner, true});
        part = {(*two)[1], true, part.ends_at_corner};
      }
      parts.push_back(part);
    }
    return parts;
  }

  /// Returns two parts that make up the whole. What is open lies mostly where outlines meet; if that is at
  /// one end, most of the rest can be told at once. No part is made that is far shorter than the shortest
  /// that are looked at: within the reach outlines may run on the wrong side of each other.
  [[nodiscard]] std::array<Part, 2> cut(const Part& part) const {
    std::array<Part, 2> two{part, part};
    const bool long_enough =
        surely_above(length(part.piece.to - part.piece.from), just(kEnd * kShortAtCorner * kShort * reach_));
    const std::array<Side, 2> pieces = part.begins_at_corner != part.ends_at_corner && long_enough
                                           ? with_end_cut_off(part.piece, part.begins_at_corner)
                                           : halves(part.piece);
    two[0].piece = pieces[0], two[1].piece = pieces[1];
    two[0].ends_at_corner = two[1].begins_at_corner = false;
    return two;
  }

  /// Calls `settled(piece, corners)` for parts of a side until it is true for all but the shortest. Outlines
  /// may meet at its ends and at `meetings`.
  template <class Settled>
  bool halve(const Side& whole, const std::vector<Vec>& meetings, Settled settled) {
    undecided_.resize(ground_.half_planes.size());
    std::iota(undecided_.begin(), undecided_.end(), std::size_t{0});
    std::vector<Part> open = cut_at_corners(whole, meetings);
    for (Part& part : open) part.undecided_end = undecided_.size();
    int short_ones = 0;
    while (!open.empty()) {
      part_ = open.back();
      open.pop_back();
      undecided_.resize(part_.undecided_end);
      value_.take_back(part_.said);
      const Side piece = part_.piece;
      const Corners corners = corners_of(piece);
      const Vec middle = piece.arc ? piece.from : (piece.from + piece.to) * just(0.5);
      const bool at_corner = part_.begins_at_corner || part_.ends_at_corner;
      const bool is_short = farthest(piece, middle) <= (at_corner ? kShortAtCorner : 1) * kShort * reach_;
      // An end at a corner is open as long as it is not short: to ask would be for nothing.
      const bool is_end = part_.begins_at_corner != part_.ends_at_corner;
      if ((!is_end || is_short) && settled(piece, corners)) {
        short_ones = 0;
        continue;
      }
      // Beside a corner nothing is shown of a stretch that stands for as many of the shortest.
      if (is_short) {
        short_ones += at_corner ? kShortAtCorner : 1;
        if (short_ones > kMostShort) return false;
        continue;
      }
      if (work_ > most_work_) {
        leave_open("more work than is spent on it would be needed");
        return false;
      }
      at_ = piece.from;
      for (const Part& half : cut(part_)) {
        // A part that cannot be halved is as long as the whole.
        if (piece.arc && ends_of(half.piece) == ends_of(piece)) return false;
        open.push_back(half);
      }
    }
    return true;
  }

  /// Returns the directions of an arc's ends, by which two of one circle are told apart.
  static std::array<double, 4> ends_of(const Side& arc) {
    return {arc.first.x.low, arc.first.y.low, arc.last.x.low, arc.last.y.low};
  }
  static std::string text_of(const Vec& p) { return fmt::format("({}, {})", p.x.low, p.y.low); }

  const Ground& ground_;
  const std::vector<Primitive>& primitives_;
  const double reach_;
  TreeValue value_;
  /// The part that is looked at, and the half-planes that it and those it was cut from leave undecided, one
  /// range after the other.
  Part part_;
  std::vector<std::size_t> undecided_;
  /// The half-plane that told last of a piece, and what each of the undecided ones is at the one looked at.
  std::size_t told_last_ = 0;
  std::vector<In> decided_;
  /// The half-plane that a point was near to last.
  std::size_t near_last_ = 0;
  /// The primitives near the stretch that is looked at.
  struct Near {
    std::size_t primitive;
    bool meets_left, meets_right;
  };
  std::vector<Near> near_;
  std::size_t work_ = 0, most_work_ = 0;
  /// A place near the last piece that was cut.
  Vec at_;
  Finding found_;
};

/// Walks along all sides, on two threads. Each of two walks takes every other side, whoever runs it, and they
/// wait for each other now and then, so that the threads change neither what is found nor what it costs.
class TreeCheck {
 public:
  TreeCheck(const Tree& tree, const Shape& used, double reach)
      : ground_(tree, used, reach), walks_{Walk(tree, ground_), Walk(tree, ground_)} {}

  TreeVerdict run() {
    if (!walks_[0].ends_in_window()) verdict_.open = "the shape may have no end";
    const std::vector<Side>& edges = ground_.used.sides;
    const bool goes_on = walk(
        edges.size(),
        [&](Walk& walk, std::size_t e, std::size_t most) { return walk.along_edge(edges[e], most); },
        [&](std::size_t e, const Finding& found) {
          // A line that joins an arc to its end may be too short to run along anything.
          if (edges[e].written) {
            if (verdict_.open.empty()) verdict_.open = found.open.empty() ? found.alone : found.open;
            verdict_.along.push_back(found.along);
          }
          for (const SideOfTree& one : found.along) {
            std::vector<Vec>& ends = ends_along_[one];
            ends.push_back(edges[e].from), ends.push_back(edges[e].to);
          }
        });
    if (!goes_on) return std::move(verdict_);
    std::vector<SideOfTree> sides;
    for (std::size_t k = 0; k < ground_.primitives.size(); ++k)
      for (std::size_t i = 0; i < ground_.primitives[k].shape.sides.size(); ++i) sides.push_back({k, i});
    walk(
        sides.size(),
        [&](Walk& walk, std::size_t s, std::size_t most) {
          const auto ends = ends_along_.find(sides[s]);
          return walk.along_side(ground_.primitives[sides[s].primitive].shape.sides[sides[s].side],
                                 ends == ends_along_.end() ? std::vector<Vec>() : ends->second, most);
        },
        [](std::size_t, const Finding&) {});
    return std::move(verdict_);
  }

 private:
  /// Calls `look(walk, side, most work)` for each of so many sides, and `take(side, finding)` in their order.
  /// False when a fault was found.
  template <class Look, class Take>
  bool walk(std::size_t count, Look look, Take take) {
    for (std::size_t begin = 0; begin < count; begin += kRound) {
      const std::size_t end = std::min(begin + kRound, count);
      std::vector<Finding> found(end - begin);
      const std::size_t done = walks_[0].work() + walks_[1].work();
      share_out(walks_.size(), kUsualThreads, [&](std::size_t w) {
        // The looks of the other walk until they wait for each other are left out.
        const std::size_t most = kMostTreeWork - std::min(kMostTreeWork, done - walks_[w].work());
        for (std::size_t i = begin + w; i < end; i += walks_.size())
          found[i - begin] = look(walks_[w], i, most);
      });
      for (std::size_t i = begin; i < end; ++i) {
        Finding& one = found[i - begin];
        take(i, one);
        if (verdict_.open.empty()) verdict_.open = std::move(one.open);
        verdict_.fault = std::move(one.fault);
        if (!verdict_.fault.empty()) return false;
      }
    }
    return true;
  }

  /// So many sides are walked along before the walks wait for each other.
  static constexpr std::size_t kRound = 128;

  Ground ground_;
  std::array<Walk, 2> walks_;
  /// The ends of the edges that run along a side.
  std::map<SideOfTree, std::vector<Vec>> ends_along_;
  TreeVerdict verdict_;
};

}  // namespace

TreeVerdict check_tree(const Tree& tree, const Shape& used, double reach) {
  return TreeCheck(tree, used, reach).run();
}

}  // namespace lekalo::verify
