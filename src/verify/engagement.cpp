#include <algorithm>

#include "cut_path.hpp"
#include "rim_cover.hpp"

namespace lekalo::verify {
namespace {

constexpr double kAirDegrees = 3, kLasting = 0.2;
constexpr double kDegrees = 180 / kPi;
constexpr double kSameLevel = 1e-6;  // mm of Z that no machine tells

class Engagement {
 public:
  Engagement(const CutPath& path, double radius, double spacing, SimulateReport& report)
      : path_(path), radius_(radius), spacing_(spacing), report_(report) {
    Place low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Stroke& s : path.strokes) {
      Place a, b;
      box_of(s, a, b);
      low = {std::min(low.x, a.x), std::min(low.y, a.y)},
      high = {std::max(high.x, b.x), std::max(high.y, b.y)};
    }
    if (!path.strokes.empty()) index_ = StrokeIndex(low, high, radius);
  }

  void run() {
    for (std::size_t i = 0; i < path_.cuts.size(); ++i) {
      measure(i);
      index_.add(static_cast<std::uint32_t>(i), path_.strokes[i]);
    }
    sum_up();
  }

 private:
  void measure(std::size_t number) {
    const Cut& cut = path_.cuts[number];
    const double whole = length(cut.stroke);
    if (!(whole > 0)) return;
    gather(number, at_share(cut.stroke, 0.5), whole);
    const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(whole / spacing_)));
    double done = 0;
    for (std::size_t k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      const Place at = at_share(cut.stroke, share);
      EngagementSample sample;
      sample.x = at.x, sample.y = at.y;
      sample.z = cut.from_z + share * (cut.to_z - cut.from_z);
      const Stroke so_far = until(cut.stroke, at);
      const double upto = length(so_far);
      sample.length = upto - done;
      done = upto;
      sample.line = cut.line;
      if (sample.length > 0) {
        rim_.begin(at, radius_, so_far);
        engage(cut, sample);
      }
      if (cut.rapid && sample.engagement >= kAirDegrees) report_.rapid_cut_mm += sample.length;
      report_.samples.push_back(sample);
    }
  }

  /// Earlier strokes that may reach the tool's rim from anywhere on this one. What was found for a place
  /// nearby serves, with what came since.
  void gather(std::size_t number, Place middle, double whole) {
    const double slack = radius_;
    if (gathered_ && length(middle - gathered_at_) + whole / 2 <= slack) {
      for (; gathered_upto_ < number; ++gathered_upto_)
        near_.push_back(static_cast<std::uint32_t>(gathered_upto_));
      return;
    }
    gathered_ = true;
    gathered_at_ = middle, gathered_upto_ = number;
    const double reach = 2 * radius_ + slack;
    index_.near(middle, reach, near_);
    std::erase_if(near_, [&](std::uint32_t i) { return distance(middle, path_.strokes[i]) > reach; });
    useful_.clear();
  }

  /// Material is there at the tip's depth until the tip was as deep; what a ramp of the same entry left as
  /// its floor is entry, too.
  void engage(const Cut& cut, EngagementSample& sample) {
    const double z = sample.z;
    const auto as_deep = [&](const Cut& earlier) {
      return std::max(earlier.from_z, earlier.to_z) <= z + kSameLevel;
    };
    // What covered much a moment ago comes first, then what is newest.
    found_.clear();
    for (const std::uint32_t i : useful_)
      if (as_deep(path_.cuts[i]) && rim_.add(path_.strokes[i])) found_.push_back(i);
    for (std::size_t k = near_.size(); k-- > 0 && !rim_.nothing_left();)
      if (as_deep(path_.cuts[near_[k]]) && rim_.add(path_.strokes[near_[k]])) found_.push_back(near_[k]);
    useful_.swap(found_);
    sample.engagement = rim_.open_angle() * kDegrees;
    if (sample.engagement < kAirDegrees) return;
    if (cut.to_z < cut.from_z) {
      sample.entry = true;
      return;
    }
    for (const std::uint32_t i : near_) {
      const Cut& earlier = path_.cuts[i];
      if (!earlier.level() && earlier.entry == cut.entry &&
          std::min(earlier.from_z, earlier.to_z) >= z - kSameLevel)
        rim_.add(earlier.stroke);
    }
    sample.entry = rim_.open_angle() * kDegrees < sample.engagement - 1e-6;
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

  /// Largest value that no sample undercuts over a stretch of at least kLasting. From each sample on, the
  /// least so far goes down as the stretch grows, so the first stretch long enough is the best from there.
  void find_lasting() {
    const auto& samples = report_.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      double least = 360, mm = 0;
      for (std::size_t k = i; k < samples.size() && mm < kLasting - 1e-9; ++k) {
        if (samples[k].entry) break;
        least = std::min(least, samples[k].engagement);
        if (least <= report_.engagement_max_deg) break;
        mm += samples[k].length;
      }
      if (mm >= kLasting - 1e-9) report_.engagement_max_deg = std::max(report_.engagement_max_deg, least);
    }
  }

  const CutPath& path_;
  double radius_, spacing_;
  SimulateReport& report_;
  StrokeIndex index_;
  RimCover rim_;
  std::vector<std::uint32_t> near_;            ///< earlier strokes about gathered_at_
  std::vector<std::uint32_t> useful_, found_;  ///< of them, what covered some of the rim
  bool gathered_ = false;
  Place gathered_at_;
  std::size_t gathered_upto_ = 0;
};

}  // namespace

void measure_engagement(const CutPath& path, double radius, double spacing, SimulateReport& report) {
  Engagement(path, radius, spacing, report).run();
}

}  // namespace lekalo::verify
