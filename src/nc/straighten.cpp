#include "straighten.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "arc.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"
#include "modes.hpp"
#include "white_list.hpp"

namespace lekalo::nc {
namespace {

/// The inner ends of chords have this many decimals, in millimetres and inches.
constexpr int kChordDecimals = 6;
/// More chords for one arc mean a mistyped radius.
constexpr double kMostChords = 10'000;

struct Spot {
  Grains x = 0, y = 0, z = 0;
};

/// The decimals that the value needs, at least those of chords.
int decimals_for(Grains value, LengthUnit unit) {
  int decimals = kChordDecimals;
  while (decimals < kMaxDecimals && value % quantum(unit, decimals) != 0) ++decimals;
  return decimals;
}

std::string written(char letter, Grains value, LengthUnit unit) {
  const int decimals = decimals_for(value, unit);
  return letter + format_decimal(value / quantum(unit, decimals), decimals);
}

Grains rounded(double millimetres, LengthUnit unit) {
  const Grains step = quantum(unit, kChordDecimals);
  return steps_nearest(geom::DoubleDouble{millimetres * kGrainsPerMillimetre}, step) * step;
}

/// The chords of one arc.
class Chords {
 public:
  Chords(const Motion& motion, double tolerance_mm) : motion_(motion), arc_(motion_arc(motion)) {
    sweep_ = arc_.sweep + kTurn * static_cast<double>(motion.turns - 1);
    // A curve with second derivative b leaves the chord over a step d by b d^2 / 8 at most.
    const double bend = std::max(arc_.start_radius, arc_.end_radius) +
                        2 * std::abs(arc_.end_radius - arc_.start_radius) / sweep_;
    count_ = std::max(1.0, std::ceil(sweep_ * std::sqrt(bend / (8 * tolerance_mm))));
    const double step = sweep_ / count_;
    // Three coordinates are rounded to the nearest step.
    const double grid = static_cast<double>(quantum(motion.unit, kChordDecimals)) / kGrainsPerMillimetre;
    off_mm_ = bend * step * step / 8 + grid;
  }

  [[nodiscard]] bool too_many() const { return !(count_ <= kMostChords); }
  [[nodiscard]] double off_mm() const { return off_mm_; }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(count_); }

  /// The words of the chords, in their order.
  [[nodiscard]] std::vector<std::string> words() const {
    std::vector<std::string> all;
    Spot here{motion_.start.x, motion_.start.y, motion_.start_z};
    for (std::size_t k = 1; k <= count(); ++k) {
      const Spot next = spot(k);
      all.push_back(words_to(here, next));
      here = next;
    }
    return all;
  }

 private:
  [[nodiscard]] Spot spot(std::size_t k) const {
    if (k == count()) return {motion_.end.x, motion_.end.y, motion_.end_z};
    const double share = static_cast<double>(k) / count_;
    const Vector out = arc_.start - arc_.centre;
    const double begin = geom::direction_angle(out.x.hi, out.y.hi);
    const auto [sine, cosine] = sine_and_cosine(begin + (motion_.clockwise ? -share : share) * sweep_);
    const double radius = arc_.start_radius + share * (arc_.end_radius - arc_.start_radius);
    const double first = arc_.centre.x.hi / kGrainsPerMillimetre + radius * cosine;
    const double second = arc_.centre.y.hi / kGrainsPerMillimetre + radius * sine;
    const auto across = [&](Grains from, Grains to) {
      if (from == to) return from;
      return rounded(
          (static_cast<double>(from) + share * static_cast<double>(to - from)) / kGrainsPerMillimetre,
          motion_.unit);
    };
    if (motion_.plane == 180)
      return {rounded(second, motion_.unit), across(motion_.start.y, motion_.end.y),
              rounded(first, motion_.unit)};
    return {across(motion_.start.x, motion_.end.x), rounded(first, motion_.unit),
            rounded(second, motion_.unit)};
  }

  static std::pair<double, double> sine_and_cosine(double angle) {
    const auto pair = geom::sincos(angle);
    return {pair.sine, pair.cosine};
  }

  [[nodiscard]] std::string words_to(const Spot& here, const Spot& next) const {
    const bool steps = motion_.incremental;
    std::string text;
    const auto add = [&](char letter, Grains from, Grains to, bool in_plane) {
      if (!in_plane && motion_.start == motion_.end) return;
      if (!in_plane && from == to) return;
      text += (text.empty() ? "" : " ") + written(letter, steps ? to - from : to, motion_.unit);
    };
    add('X', here.x, next.x, motion_.plane == 180);
    add('Y', here.y, next.y, motion_.plane == 190);
    add('Z', here.z, next.z, true);
    return text;
  }

  const Motion& motion_;
  Arc arc_;
  double sweep_ = 0, count_ = 1, off_mm_ = 0;
};

const Word* motion_word(const Block& block) {
  for (const Word& word : block.words)
    if (const auto tenths = word.letter == 'G' ? tenths_of(word.value) : std::nullopt; tenths)
      if (*tenths <= words::kCounterClockwise) return &word;
  return nullptr;
}

bool ends_or_stops(const Block& block) {
  return std::ranges::any_of(block.words, [](const Word& word) {
    const auto number = word.letter == 'M' ? word.value.whole() : std::nullopt;
    return number && (*number <= 2 || *number == 30);
  });
}

class Straightener {
 public:
  Straightener(std::string_view text, const Program& program, double tolerance_mm)
      : text_(text), program_(program), tolerance_(tolerance_mm), extra_lines_(program.blocks.size(), 0) {}

  std::optional<std::string> fault;
  std::size_t fault_line = 0;

  bool run(const Interpretation& interpretation) {
    bool after_chords = false;
    for (const Motion& motion : interpretation.motions) {
      const Block& block = program_.blocks[motion.block];
      if (motion.plane != 170) {
        if (!replace(motion, block)) return false;
        after_chords = true;
      } else if (after_chords) {
        // An arc that goes on by the motion in force needs its word again, because chords are G1.
        const bool arc = motion.kind == MotionKind::arc_by_centre || motion.kind == MotionKind::arc_by_radius;
        if (arc && motion_word(block) == nullptr) insert(block, motion.clockwise ? "G2 " : "G3 ");
        after_chords = false;
      }
    }
    for (const Block& block : program_.blocks)
      for (const Word& word : block.words)
        if (const auto tenths = word.letter == 'G' ? tenths_of(word.value) : std::nullopt;
            tenths == 180 || tenths == 190)
          edits_.push_back({word.number_begin, word.number_end - word.number_begin, "17"});
    return true;
  }

  Straightened take() {
    Straightened result{apply_edits(text_, std::move(edits_)), {}, chord_mm_, arcs_};
    for (std::size_t k = 0; k < program_.blocks.size(); ++k)
      result.lines.insert(result.lines.end(), 1 + extra_lines_[k], program_.blocks[k].line);
    return result;
  }

 private:
  void insert(const Block& block, const std::string& word) {
    const auto first = std::ranges::find_if(block.words, [](const Word& each) { return each.letter != 'N'; });
    edits_.push_back({first->letter_at, 0, word});
  }

  bool refuse(const Block& block, std::string why) {
    fault = std::move(why), fault_line = block.line;
    return false;
  }

  bool replace(const Motion& motion, const Block& block) {
    const Chords chords(motion, tolerance_);
    if (chords.too_many()) return refuse(block, "the arc needs more than 10000 chords; is its radius right?");
    if (ends_or_stops(block))
      return refuse(block, "an arc of G18 or G19 beside M0, M1, M2 or M30; give them a block of their own");
    std::string time;
    if (motion.inverse_time && !share_time(block, chords.count(), time))
      return refuse(block, "an arc of G18 or G19 under G93 without F in its block");
    const std::vector<std::string> lines = chords.words();
    if (const Word* word = motion_word(block))
      edits_.push_back({word->number_begin, word->number_end - word->number_begin, "1"});
    else
      insert(block, "G1 ");
    bool written = false;
    for (const Word& word : block.words) {
      if (std::string_view("XYZIJKRP").find(word.letter) == std::string_view::npos) continue;
      edits_.push_back({word.letter_at, word.number_end - word.letter_at, written ? "" : lines.front()});
      written = true;
    }
    std::string more;
    for (std::size_t k = 1; k < lines.size(); ++k) more += program_.line_end + lines[k] + time;
    edits_.push_back({block.end, 0, more});
    extra_lines_[motion.block] = lines.size() - 1;
    chord_mm_ = std::max(chord_mm_, chords.off_mm());
    ++arcs_;
    return true;
  }

  /// Under G93 every block says its own time: the chords share that of the arc.
  bool share_time(const Block& block, std::size_t count, std::string& time) {
    for (const Word& word : block.words) {
      if (word.letter != 'F') continue;
      time = format_decimal(static_cast<Wide>(word.value.digits) * static_cast<Wide>(count),
                            word.value.decimals);
      edits_.push_back({word.number_begin, word.number_end - word.number_begin, time});
      time = " F" + time;
      return true;
    }
    return false;
  }

  std::string_view text_;
  const Program& program_;
  double tolerance_;
  std::vector<std::size_t> extra_lines_;
  std::vector<Edit> edits_;
  double chord_mm_ = 0;
  std::size_t arcs_ = 0;
};

}  // namespace

Result<Straightened> straighten(std::string_view text, const std::string& name, const Program& program,
                                const Interpretation& interpretation, double tolerance_mm) {
  Straightener straightener(text, program, tolerance_mm);
  if (!straightener.run(interpretation)) return refusal(name, straightener.fault_line, *straightener.fault);
  return straightener.take();
}

}  // namespace lekalo::nc
