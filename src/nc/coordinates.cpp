#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "arc.hpp"
#include "lekalo/base/stop.hpp"
#include "modes.hpp"
#include "white_list.hpp"

namespace lekalo::nc {
namespace {

/// An arc that needs finer numbers than this to keep its shape is refused.
constexpr int kMostDecimals = 12;
/// Rounding may move the centre of an arc by radius this far, in units of the fifth decimal. Short arcs and
/// near half circles get more decimals, because their centre hangs on the difference of the ends.
constexpr double kCentreSteps = 2;

int decimals_of(const Word* a, const Word* b) {
  return std::max(
      {kLeastDecimals, a != nullptr ? a->value.decimals : 0, b != nullptr ? b->value.decimals : 0});
}

GridPoint operator+(GridPoint a, GridPoint b) { return {a.x + b.x, a.y + b.y}; }
GridPoint operator-(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y}; }
GridPoint operator*(Wide k, GridPoint a) { return {k * a.x, k * a.y}; }

GridPoint nearest(const Vector& v, Grains step) {
  return {steps_nearest(v.x, step) * step, steps_nearest(v.y, step) * step};
}

bool is_multiple(GridPoint p, Grains step) { return p.x % step == 0 && p.y % step == 0; }

/// A pair of words of one block, X Y or I J, and the values that they get.
struct Pair {
  const Word *first = nullptr, *second = nullptr;
  char first_letter = 'X', second_letter = 'Y';
  bool write_first = false, write_second = false;  ///< false: the bytes of the word stay
  GridPoint value;
  int decimals = kLeastDecimals;
};

/// Step 5a of docs/design/nc-rewrite.md: one pass over the motions, with a given number of decimals for each.
/// The machine's position is followed as the control will know it, from the written words, so that no
/// rounding adds up under G91.
class CoordinatePass {
 public:
  CoordinatePass(const RewriteJob& job, const std::vector<int>& extra_decimals)
      : job_(job), motion_(job.machine_from_part), extra_(extra_decimals) {}

  void run() {
    const auto& motions = job_.interpretation.motions;
    for (std::size_t k = 0; k < motions.size(); ++k) write(motions[k], k);
    deviation_mm += across_mm_;
  }

  std::vector<Edit> edits;
  double deviation_mm = 0;
  int most_decimals = 0;
  std::vector<std::size_t> distorted;  ///< arcs that do not keep their shape with these decimals

 private:
  void write(const Motion& motion, std::size_t k) {
    const GridPoint start = here_;
    if (motion.x != nullptr || motion.y != nullptr) write_end(motion, k);
    bool kept = true;
    if (motion.plane != 170) {
      kept = keep_upright_arc(motion, start);
    } else if (motion.kind == MotionKind::arc_by_centre) {
      const GridPoint centre = write_centre(motion, k, start);
      kept = keep_arc(motion,
                      arc_by_centre(motion_(motion.start), motion_(motion.end), motion_(motion.centre),
                                    motion.clockwise, motion.start == motion.end),
                      arc_by_centre(to_vector(start), to_vector(here_), to_vector(centre), motion.clockwise,
                                    start == here_));
      kept = kept && (motion.start == motion.end) == (start == here_);
    } else if (motion.kind == MotionKind::arc_by_radius) {
      kept = start != here_ && keep_arc_by_radius(motion, start);
    }
    if (!kept) distorted.push_back(k);
    deviation_mm = std::max(deviation_mm, millimetres(to_vector(here_) - motion_(motion.end)));
  }

  void write_end(const Motion& motion, std::size_t k) {
    Pair pair{.first = motion.x, .second = motion.y, .value = {}};
    pair.decimals = std::min(decimals_of(motion.x, motion.y) + extra_[k], kMaxDecimals);
    const GridPoint start = here_;
    if (motion.incremental && !motion_.turns()) {
      here_ = start + (motion.end - motion.start);
      return;
    }
    here_ = rounded_end(motion, start, pair.decimals);
    const Vector& shift = motion_.shift();
    pair.write_first = motion_.turns() || (motion.x != nullptr && shift.x.hi != 0);
    pair.write_second = motion_.turns() || (motion.y != nullptr && shift.y.hi != 0);
    pair.value = motion.incremental ? step_of(here_ - start, motion.repeats) : here_;
    emit(motion, pair);
  }

  static GridPoint step_of(GridPoint way, std::int64_t repeats) { return {way.x / repeats, way.y / repeats}; }

  /// The written end point. `decimals` grows where the end must be the same as the start, to the last digit.
  GridPoint rounded_end(const Motion& motion, GridPoint start, int& decimals) const {
    if (motion.start_known && motion.end == motion.start) {
      if (motion.incremental) return start;
      for (int enough = decimals; enough <= kMaxDecimals; ++enough)
        if (is_multiple(start, quantum(motion.unit, enough))) {
          decimals = enough;
          return start;
        }
    }
    const Vector exact = motion_(motion.end);
    if (motion.incremental) {
      // All repeats make one step, so the rounding of that step counts as often.
      for (std::int64_t power = 1; power < motion.repeats && decimals < kMaxDecimals; power *= 10) ++decimals;
      const geom::DoubleDouble repeats{static_cast<double>(motion.repeats)};
      const Vector way = exact - to_vector(start);
      const Vector step{way.x / repeats, way.y / repeats};
      return start + motion.repeats * nearest(step, quantum(motion.unit, decimals));
    }
    GridPoint end = nearest(exact, quantum(motion.unit, decimals));
    if (!motion_.turns()) keep_missing_axes(motion, start, end);
    if (motion.kind == MotionKind::arc_by_radius)
      end = kept_half_circle(motion, start, end, quantum(motion.unit, decimals));
    return end;
  }

  /// An axis without a word does not move under a pure shift, and one that is not shifted keeps its bytes.
  void keep_missing_axes(const Motion& motion, GridPoint start, GridPoint& end) const {
    if (motion.x == nullptr) end.x = start.x;
    if (motion.y == nullptr) end.y = start.y;
    if (motion.x != nullptr && motion_.shift().x.hi == 0) end.x = motion.end.x;
    if (motion.y != nullptr && motion_.shift().y.hi == 0) end.y = motion.end.y;
  }

  /// With ends a hair nearer than the diameter, the centre of a half circle by radius would leave the chord
  /// by the root of that hair. So the end is taken from the neighbours at which the chord still spans the
  /// diameter.
  GridPoint kept_half_circle(const Motion& motion, GridPoint start, GridPoint end, Grains step) const {
    const geom::DoubleDouble radius = to_double_double(motion.radius);
    if (!spans_diameter(to_vector(motion.start), to_vector(motion.end), radius)) return end;
    const Vector exact = motion_(motion.end);
    GridPoint best = end;
    double least = -1;
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy) {
        const GridPoint candidate{end.x + dx * step, end.y + dy * step};
        if (!spans_diameter(to_vector(start), to_vector(candidate), radius)) continue;
        const double off = millimetres(to_vector(candidate) - exact);
        if (least < 0 || off < least) {
          least = off;
          best = candidate;
        }
      }
    return best;
  }

  GridPoint write_centre(const Motion& motion, std::size_t k, GridPoint start) {
    if (!motion.absolute_centre && !motion_.turns()) return start + (motion.centre - motion.start);
    Pair pair{.first = motion.i, .second = motion.j, .first_letter = 'I', .second_letter = 'J', .value = {}};
    pair.decimals = std::min(decimals_of(motion.i, motion.j) + extra_[k], kMaxDecimals);
    const Grains step = quantum(motion.unit, pair.decimals);
    const Vector exact = motion_(motion.centre);
    const Vector& shift = motion_.shift();
    pair.write_first = motion_.turns() || shift.x.hi != 0;
    pair.write_second = motion_.turns() || shift.y.hi != 0;
    if (motion.absolute_centre) {
      pair.value = nearest(exact, step);
      if (!pair.write_first) pair.value.x = motion.centre.x;
      if (!pair.write_second) pair.value.y = motion.centre.y;
      emit(motion, pair);
      return pair.value;
    }
    // The centre counts from the written start, so that the start's rounding does not move the centre.
    pair.value = nearest(exact - to_vector(start), step);
    emit(motion, pair);
    return start + pair.value;
  }

  bool keep_arc(const Motion& motion, const Arc& exact, const Arc& written) {
    const std::optional<double> deviation = arc_deviation(exact, written);
    const bool round = radii_agree(written, motion.unit) ||
                       (job_.control != words::Control::linuxcnc && radii_nearly_agree(written));
    if (!deviation || !round || !(written.sweep >= 0.75 * kSmallestSweep)) return false;
    deviation_mm = std::max(deviation_mm, *deviation);
    return true;
  }

  /// An arc outside the XY plane, which a pure shift carries without turning it. Its centre counts from its
  /// written start.
  bool keep_upright_arc(const Motion& motion, GridPoint start) {
    const geom::DoubleDouble low = to_double_double(motion.start_z), high = to_double_double(motion.end_z);
    const auto at = [&](const Vector& p, const geom::DoubleDouble& z) {
      return in_plane(p, z, motion.plane);
    };
    const auto arc = [&](const Vector& from, const Vector& to, const Vector& centre) {
      const Vector a = at(from, low), b = at(to, high);
      return motion.kind == MotionKind::arc_by_radius
                 ? arc_by_radius(a, b, to_double_double(motion.radius), motion.clockwise)
                 : arc_by_centre(a, b, at(centre, to_double_double(motion.centre_z)), motion.clockwise,
                                 same_point(a, b));
    };
    const Vector from = to_vector(start), to = to_vector(here_);
    const Vector exact_from = motion_(motion.start), exact_to = motion_(motion.end);
    const Vector way = to_vector(motion.centre - motion.start);
    if (!keep_arc(motion, arc(exact_from, exact_to, exact_from + way), arc(from, to, from + way)))
      return false;
    // A place across the plane is off by no more than the ends are.
    across_mm_ = std::max({across_mm_, millimetres(from - exact_from), millimetres(to - exact_to)});
    return true;
  }

  bool keep_arc_by_radius(const Motion& motion, GridPoint start) {
    const geom::DoubleDouble radius = to_double_double(motion.radius);
    const Vector from = to_vector(start), to = to_vector(here_);
    const Arc exact = arc_by_radius(motion_(motion.start), motion_(motion.end), radius, motion.clockwise);
    const Arc written = arc_by_radius(from, to, radius, motion.clockwise);
    const double limit = kCentreSteps * 1e-5 * millimetres_per(motion.unit);
    return radius_reaches(from, to, radius) && millimetres(written.centre - exact.centre) <= limit &&
           keep_arc(motion, exact, written);
  }

  void emit(const Motion& motion, const Pair& pair) {
    const Grains step = quantum(motion.unit, pair.decimals);
    const std::string first = format_decimal(pair.value.x / step, pair.decimals);
    const std::string second = format_decimal(pair.value.y / step, pair.decimals);
    if (pair.write_first || pair.write_second) most_decimals = std::max(most_decimals, pair.decimals);
    if (pair.write_first && pair.first == nullptr)
      supply(motion, *pair.second, pair.first_letter, first, true);
    if (pair.write_first && pair.first != nullptr) replace(*pair.first, first);
    if (pair.write_second && pair.second != nullptr) replace(*pair.second, second);
    if (pair.write_second && pair.second == nullptr)
      supply(motion, *pair.first, pair.second_letter, second, false);
  }

  void replace(const Word& word, const std::string& number) {
    edits.push_back({word.number_begin, word.number_end - word.number_begin, number});
  }

  /// Adds a word beside its sister, in her case and spacing.
  void supply(const Motion& motion, const Word& sister, char letter, const std::string& number, bool before) {
    const Block& block = job_.program.blocks[motion.block];
    const char written = job_.text[sister.letter_at];
    const char cased = written >= 'a' ? static_cast<char>(letter - 'A' + 'a') : letter;
    const auto blank_at = [&](std::size_t at) {
      return at >= block.end || job_.text[at] == ' ' || job_.text[at] == '\t';
    };
    const bool spaced =
        sister.letter_at == block.begin ? blank_at(sister.number_end) : blank_at(sister.letter_at - 1);
    const char* gap = spaced ? " " : "";
    // The edit covers the sister's letter, so that it comes after what was supplied behind the word before.
    if (before)
      edits.push_back({sister.letter_at, 1, fmt::format("{}{}{}{}", cased, number, gap, written)});
    else
      edits.push_back({sister.number_end, 0, fmt::format("{}{}{}", gap, cased, number)});
  }

  const RewriteJob& job_;
  const RigidMotion& motion_;
  const std::vector<int>& extra_;
  GridPoint here_;
  double across_mm_ = 0;
};

/// True when the words of a motion decide where it ends; otherwise it carries on from its start.
bool sets_end(const Motion& motion, bool turns) {
  const bool stays = motion.start_known && motion.end == motion.start;
  return (motion.x != nullptr || motion.y != nullptr) && !stays && (turns || !motion.incremental);
}

/// Gives one more decimal to the words that shape the distorted arcs: their own, and those of the motions
/// before, back to the one that decided where the arc starts. Returns the first arc all of whose words have
/// as many as they may have; it cannot be kept.
std::optional<std::size_t> refine(const std::vector<Motion>& motions, bool turns,
                                  const std::vector<std::size_t>& distorted, std::vector<int>& extra) {
  const auto may_grow = [&](std::size_t k) {
    const Motion& m = motions[k];
    return std::max(decimals_of(m.x, m.y), decimals_of(m.i, m.j)) + extra[k] < kMostDecimals;
  };
  std::vector<bool> growing(motions.size(), false);
  std::vector<bool> start_may_grow(motions.size() + 1, false);
  for (std::size_t k = 0; k < motions.size(); ++k)
    start_may_grow[k + 1] = may_grow(k) || (!sets_end(motions[k], turns) && start_may_grow[k]);

  for (const std::size_t k : distorted) {
    if (!may_grow(k) && !start_may_grow[k]) return k;
    growing[k] = true;
    for (std::size_t j = k; j-- > 0;) {
      ask();
      const bool known = growing[j];  // what stands before it is then growing too
      growing[j] = true;
      if (sets_end(motions[j], turns) || known) break;
    }
  }
  for (std::size_t k = 0; k < motions.size(); ++k)
    if (growing[k] && may_grow(k)) ++extra[k];
  return std::nullopt;
}

/// The first line that became too long for a control.
std::optional<std::size_t> overlong_line(std::string_view text) {
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::size_t returns = end > begin && text[end - 1] == '\r' ? 1 : 0;
    if (end - begin - returns > kMaxBlockLength) return line;
    begin = end + 1;
  }
  return std::nullopt;
}

/// Shifts the heights. All by one number that their decimals can say, so that steps and arcs need no change
/// and no error adds up. Returns what rounding the shift loses, mm.
double shift_heights(const RewriteJob& job, std::vector<Edit>& edits, int& most_decimals) {
  const std::vector<Height>& heights = job.interpretation.heights;
  const bool inches =
      std::ranges::any_of(heights, [](const Height& each) { return each.unit == LengthUnit::inch; });
  const RoundedHeight height = rounded_height(
      *job.options.z, quantum(inches ? LengthUnit::inch : LengthUnit::millimetre, kLeastDecimals));
  if (height.shift == 0) return height.lost_mm;
  for (const auto& [block, word, unit] : heights) {
    const Grains value = to_grains(word->value, unit) + height.shift;
    int decimals = std::max(kLeastDecimals, word->value.decimals);
    while (value % quantum(unit, decimals) != 0 && decimals < kMaxDecimals) ++decimals;
    most_decimals = std::max(most_decimals, decimals);
    edits.push_back({word->number_begin, word->number_end - word->number_begin,
                     format_decimal(value / quantum(unit, decimals), decimals)});
  }
  return height.lost_mm;
}

std::string frame_note(const RewriteJob& job) {
  const RewriteOptions& options = job.options;
  const std::string offset = work_offset_name(options.work_offset);
  std::string offsets;
  for (const int number : job.interpretation.offsets)
    offsets += (offsets.empty() ? "" : ", ") + work_offset_name(number);
  if (offsets.empty()) offsets = offset;
  return options.scan_frame == ScanFrame::machine
             ? fmt::format(
                   "the scan was taken in machine coordinates: {} must be zero in {} and without rotation "
                   "when the program runs, and no G52 or G92 shift may be active",
                   offsets, shifted_axes(options))
             : fmt::format(
                   "the scan was taken in {}: the program must run in the same {}, unchanged since the scan",
                   offset, offset);
}

}  // namespace

Result<Rewritten> rewrite_coordinates(const RewriteJob& job) {
  const std::vector<Motion>& motions = job.interpretation.motions;
  std::vector<int> extra(motions.size(), 0);
  for (;;) {
    CoordinatePass pass(job, extra);
    pass.run();
    if (!pass.distorted.empty()) {
      const std::optional<std::size_t> lost =
          refine(motions, job.machine_from_part.turns(), pass.distorted, extra);
      if (!lost) continue;
      return refusal(
          job.name, job.program.blocks[motions[*lost].block].line,
          fmt::format("the arc does not keep its shape with {} decimals; give it a centre (I J) or split it",
                      kMostDecimals));
    }
    const double height_lost = job.options.z ? shift_heights(job, pass.edits, pass.most_decimals) : 0;
    Rewritten result;
    result.program = apply_edits(job.text, std::move(pass.edits));
    if (const auto line = overlong_line(result.program))
      return refusal(
          job.name, *line,
          fmt::format("the rewritten line would have more than {} bytes; split the block", kMaxBlockLength));
    result.rounding_mm = with_height(rounded_up(pass.deviation_mm), height_lost);
    result.motions = motions.size();
    result.notes.push_back(frame_note(job));
    if (pass.most_decimals > 0)
      result.notes.push_back(fmt::format(
          "rewritten numbers have {} decimals; a control that reads fewer adds its own rounding",
          pass.most_decimals > kLeastDecimals ? fmt::format("{} to {}", kLeastDecimals, pass.most_decimals)
                                              : fmt::format("{}", kLeastDecimals)));
    return result;
  }
}

}  // namespace lekalo::nc
