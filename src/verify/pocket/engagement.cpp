#include <algorithm>
#include <map>

#include "cut_path.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "rim_cover.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

constexpr double kLasting = 0.2;  // mm
/// A stroke of a ramp that is shorter than this changes no written digit of Z.
constexpr double kTooShortToSink = 0.01;  // mm
constexpr double kLayerError = 1e-3;      // mm
constexpr std::size_t kCutsToTell = 1000;
/// Under a plunging tool, material smaller than this is not looked for.
constexpr double kSpeck = 0.02;  // mm

/// Returns the depth that all of the cut reaches at least.
double highest(const Cut& cut) { return std::max(cut.from_z, cut.to_z); }

class Engagement {
 public:
  Engagement(const CutPath& path, const Air& air, double radius, double spacing, SimulateReport& report)
      : air_(air), cuts_(path.before), radius_(radius), widest_(radius), spacing_(spacing), report_(report) {
    first_ = cuts_.size();
    cuts_.insert(cuts_.end(), path.cuts.begin(), path.cuts.end());
    for (const Cut& cut : cuts_) {
      widest_ = std::max(widest_, cut.radius);
      top_ = std::max(top_, highest(cut));
    }
    index_ = index_over(cuts_, radius);
    spacing_ = std::max(spacing, least_spacing());
    repeated_ = repeated(cuts_);
    for (const Cut& cut : cuts_) {
      const Place middle = 0.5 * (cut.stroke.from + cut.stroke.to);
      // An arc of at most a quarter turn lies in the disc that has its chord as diameter.
      discs_.push_back({middle, 0.5 * length(cut.stroke.to - cut.stroke.from) + cut.radius + kSpeck});
    }
    bottoms_.resize(cuts_.size());
    const auto slopes = [&](const Cut& cut) { return !cut.level() || length(cut.stroke) < kTooShortToSink; };
    for (std::size_t i = cuts_.size(); i-- > 0;) {
      bottoms_[i] = std::min(cuts_[i].from_z, cuts_[i].to_z);
      if (i + 1 < cuts_.size() && slopes(cuts_[i]) && slopes(cuts_[i + 1]) &&
          cuts_[i + 1].entry == cuts_[i].entry)
        bottoms_[i] = std::min(bottoms_[i], bottoms_[i + 1]);
    }
  }

  /// Fills the samples on these lines.
  void measure_on(const std::vector<LineRange>& lines) {
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      // A subprogram's lines come again, and earlier programs have lines of the same numbers.
      const auto range = std::ranges::lower_bound(lines, cuts_[i].line, {}, &LineRange::last);
      if (i >= first_ && range != lines.end() && cuts_[i].line >= range->first) measure(i);
      if (!repeated_[i]) index_.add(static_cast<std::uint32_t>(i), cuts_[i].stroke);
    }
  }

  std::vector<Removed> run(const ProgressListener& progress) {
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      if (i >= first_) measure(i);
      if (!repeated_[i]) index_.add(static_cast<std::uint32_t>(i), cuts_[i].stroke);
      if (progress && i % kCutsToTell == 0)
        progress({i, static_cast<double>(i) / static_cast<double>(cuts_.size())});
    }
    sum_up();
    std::vector<Removed> removed;
    for (const auto& [z, mm2] : removed_) removed.push_back({z, mm2});
    return removed;
  }

 private:
  /// Returns the spacing at which the path has as many samples as it may have: so many, and some more for
  /// each line that cuts. A line of a few bytes can be kilometres long.
  [[nodiscard]] double least_spacing() const {
    constexpr double kMostSamples = 5e5, kMostSamplesALine = 64;
    double whole = 0, lines = 0;
    for (std::size_t i = first_; i < cuts_.size(); ++i) {
      whole += length(cuts_[i].stroke);
      if (i == first_ || cuts_[i].line != cuts_[i - 1].line) ++lines;
    }
    return whole / (kMostSamples + kMostSamplesALine * lines);
  }

  struct Disc {
    Place middle;
    double radius;
  };

  void measure(std::size_t number) {
    const Cut& cut = cuts_[number];
    const double whole = length(cut.stroke);
    if (!(whole > 0)) return plunge(number);
    gather(number, at_share(cut.stroke, 0.5), whole);
    const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(whole / spacing_)));
    double done = 0;
    for (std::size_t k = 1; k <= pieces; ++k) {
      ask();
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      const Place at = at_share(cut.stroke, share);
      EngagementSample sample;
      sample.x = at.x, sample.y = at.y;
      sample.z = cut.from_z + share * (cut.to_z - cut.from_z);
      const Stroke so_far = until(cut.stroke, at);
      const double upto = length(so_far);
      sample.length = upto - done;
      done = upto;
      sample.line = cut.line, sample.feed = cut.feed;
      rim_.begin(at, radius_, so_far);
      engage(cut, sample);
      if (sample.entry) measure_layer(sample.z, so_far);
      if (cut.level() && sample.engagement >= kAirDegrees)
        removed_[std::round(sample.z / kSameLevel) * kSameLevel] += width_ * sample.length;
      if (cut.rapid && sample.engagement >= kAirDegrees) report_.rapid_cut_mm += sample.length;
      report_.samples.push_back(sample);
    }
  }

  /// Finds the earlier strokes that may reach the tool's rim from anywhere on this stroke. Those found for a
  /// place nearby serve again, together with the strokes that came since.
  void gather(std::size_t number, Place middle, double whole) {
    const double slack = radius_;
    if (length(middle - gathered_at_) + whole / 2 <= slack) {
      for (; gathered_upto_ < number; ++gathered_upto_)
        if (!repeated_[gathered_upto_]) near_.push_back(static_cast<std::uint32_t>(gathered_upto_));
      return;
    }
    gathered_at_ = middle, gathered_upto_ = number;
    const double reach = radius_ + slack;
    index_.near(middle, reach + widest_, near_);
    std::erase_if(
        near_, [&](std::uint32_t i) { return distance(middle, cuts_[i].stroke) > reach + cuts_[i].radius; });
    useful_.clear();
  }

  /// Step 5: measures a plunge straight down. It counts from the lowest depth on to which all of the tool's
  /// disc is already cut.
  void plunge(std::size_t number) {
    const Cut& cut = cuts_[number];
    if (!(cut.to_z < cut.from_z)) return;
    const Place at = cut.stroke.from;
    std::vector<std::uint32_t> near;
    index_.near(at, radius_ + widest_, near);
    std::vector<double> depths{cut.to_z, cut.from_z};
    for (const std::uint32_t i : near) depths.push_back(std::clamp(highest(cuts_[i]), cut.to_z, cut.from_z));
    std::sort(depths.begin(), depths.end());
    // The halving works because what is cut down to one depth is cut at every depth above it.
    std::size_t low = 0, high = depths.size() - 1;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (is_cut({at, radius_ - kSpeck}, at, 2 * radius_, near, depths[middle]))
        high = middle;
      else
        low = middle + 1;
    }
    const double drop = depths[low] - cut.to_z;
    report_.entry_mm += drop;
    if (cut.rapid) report_.rapid_cut_mm += drop;
  }

  /// Says whether a square is cut. It is divided into squares of kSpeck mm, and of those whose middle lies in
  /// the disc none may have its middle in material at depth z.
  bool is_cut(const Disc& disc, Place middle, double side, const std::vector<std::uint32_t>& near,
              double z) const {
    const double half = side * 0.7071067811865476, off = length(middle - disc.middle) - disc.radius;
    if (off > half || (side <= kSpeck && off > 0)) return true;
    double least = kInfinity;
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t i : near) {
      ask();
      if (highest(cuts_[i]) > z + kSameLevel) continue;
      const double beyond = distance(middle, cuts_[i].stroke) - cuts_[i].radius;
      least = std::min(least, beyond);
      if (beyond <= half) kept.push_back(i);
    }
    if (least + half <= 0) return true;
    if (side <= kSpeck) return least <= 0 || air_.holds(middle);
    for (const Place corner : {Place{-1, -1}, Place{1, -1}, Place{-1, 1}, Place{1, 1}})
      if (!is_cut(disc, middle + side / 4 * corner, side / 2, kept, z)) return false;
    return true;
  }

  /// Steps 2 and 7: a place counts as material at the tip's depth until all of a stroke over it was as deep.
  /// Where the rim meets only the floor that a ramp of the same entry left, the sample is entry too.
  void engage(const Cut& cut, EngagementSample& sample) {
    const double z = sample.z;
    const auto as_deep = [&](std::uint32_t i) { return highest(cuts_[i]) <= z + kSameLevel; };
    const auto add = [&](std::uint32_t i) {
      return rim_.may_meet(discs_[i].middle, discs_[i].radius) && as_deep(i) &&
             rim_.add(cuts_[i].stroke, cuts_[i].radius);
    };
    // Strokes that covered much at the last sample come first, then the newest ones.
    found_.clear();
    for (const std::uint32_t i : useful_)
      if (add(i)) found_.push_back(i);
    for (std::size_t k = near_.size(); k-- > 0 && !rim_.nothing_left();)
      if (add(near_[k])) found_.push_back(near_[k]);
    useful_.swap(found_);
    if (!air_.empty()) rim_.add_air(air_);
    sample.engagement = rim_.open_angle() * kDegreesPerRadian;
    sample.left = rim_.open_left() * kDegreesPerRadian;
    width_ = rim_.open_width();
    if (sample.engagement < kAirDegrees) return;
    if (cut.to_z < cut.from_z) {
      sample.entry = true;
      return;
    }
    for (const std::uint32_t i : near_) {
      const Cut& earlier = cuts_[i];
      if (!earlier.level() && earlier.entry == cut.entry && bottoms_[i] <= z + kSameLevel &&
          std::min(earlier.from_z, earlier.to_z) >= z - kSameLevel)
        rim_.add(earlier.stroke, earlier.radius);
    }
    sample.entry = rim_.open_angle() * kDegreesPerRadian < sample.engagement - 1e-6;
  }

  /// Says whether the rim meets material at depth z.
  bool meets(double z, const Stroke& so_far) {
    rim_.begin(so_far.to, radius_, so_far);
    for (std::size_t k = near_.size(); k-- > 0 && !rim_.nothing_left();) {
      const Cut& earlier = cuts_[near_[k]];
      if (highest(earlier) <= z + kSameLevel) rim_.add(earlier.stroke, earlier.radius);
    }
    if (!air_.empty()) rim_.add_air(air_);
    return rim_.open_angle() * kDegreesPerRadian >= kAirDegrees;
  }

  /// Raises report_.entry_layer_mm where an entry's rim meets a thicker layer. Halving finds its thickness,
  /// because what is cut down to one depth is cut at every depth above it.
  void measure_layer(double z, const Stroke& so_far) {
    double low = z + report_.entry_layer_mm + kLayerError;
    if (!(low < top_) || !meets(low, so_far)) return;
    double high = top_;
    while (high - low > kLayerError) {
      ask();
      const double middle = 0.5 * (low + high);
      (meets(middle, so_far) ? low : high) = middle;
    }
    report_.entry_layer_mm = high - z;
  }

  void sum_up() {
    double air = 0;
    std::vector<std::pair<double, double>> cutting;  // engagement, length
    for (const EngagementSample& s : report_.samples) {
      report_.length_mm += s.length;
      if (s.entry) {
        report_.entry_mm += s.length;
        continue;
      }
      report_.engagement_peak_deg = std::max(report_.engagement_peak_deg, s.engagement);
      if (s.engagement < kAirDegrees)
        air += s.length;
      else
        cutting.emplace_back(s.engagement, s.length);
    }
    report_.air_percent = report_.length_mm > 0 ? 100 * air / report_.length_mm : 0;
    std::sort(cutting.begin(), cutting.end());
    double cut_length = 0, so_far = 0;
    for (const auto& [engagement, mm] : cutting) cut_length += mm;
    for (const auto& [engagement, mm] : cutting) {
      so_far += mm;
      report_.engagement_p95_deg = engagement;
      if (so_far >= 0.95 * cut_length) break;
    }
    find_lasting();
  }

  /// Finds the largest value that samples do not fall below over a stretch of at least kLasting. Going on
  /// from a sample, the least value can only fall as the stretch grows, so the first stretch that is long
  /// enough is the best one from there.
  void find_lasting() {
    const auto& samples = report_.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      double least = kInfinity, mm = 0;
      for (std::size_t k = i; k < samples.size() && mm < kLasting - 1e-9; ++k) {
        if (samples[k].entry) break;
        least = std::min(least, samples[k].engagement);
        if (least <= report_.engagement_max_deg) break;
        mm += samples[k].length;
      }
      if (mm >= kLasting - 1e-9) report_.engagement_max_deg = std::max(report_.engagement_max_deg, least);
    }
  }

  const Air& air_;
  /// The cuts of earlier programs, and from first_ on those of this one.
  std::vector<Cut> cuts_;
  std::size_t first_ = 0;
  /// By cut: it changes nothing for those after it.
  std::vector<bool> repeated_;
  /// By cut: a disc around all that the tool sweeps along it.
  std::vector<Disc> discs_;
  /// By cut: the depth that its ramp reaches. Material that the ramp left below that is no entry's.
  std::vector<double> bottoms_;
  /// The radius of this tool, the radius of the widest tool of all, and the spacing of samples.
  double radius_, widest_, spacing_;
  SimulateReport& report_;
  /// The top of the stock, from which the tool comes down.
  double top_ = -kInfinity;
  StrokeIndex index_;
  RimCover rim_;
  /// The width, across the heading, of the rim that was in material at the last sample.
  double width_ = 0;
  /// The area taken off on the level, mm2, by depth.
  std::map<double, double> removed_;
  /// The earlier strokes about gathered_at_.
  std::vector<std::uint32_t> near_;
  /// Those of near_ that covered some of the rim at the last sample.
  std::vector<std::uint32_t> useful_, found_;
  Place gathered_at_{kInfinity, kInfinity};
  std::size_t gathered_upto_ = 0;
};

}  // namespace

std::vector<Removed> measure_engagement(const CutPath& path, const Air& air, double radius, double spacing,
                                        SimulateReport& report, const ProgressListener& progress) {
  return Engagement(path, air, radius, spacing, report).run(progress);
}

void measure_engagement_on(const CutPath& path, const Air& air, const SimulateOptions& options,
                           const std::vector<LineRange>& lines, SimulateReport& report) {
  Engagement(path, air, options.tool_diameter / 2, options.spacing, report).measure_on(lines);
}

}  // namespace lekalo::verify
