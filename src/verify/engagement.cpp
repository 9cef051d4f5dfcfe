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
    index_.near(at_share(cut.stroke, 0.5), 2 * radius_ + whole, near_);
    const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(whole / spacing_)));
    double done = 0;
    for (std::size_t k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      const Place at = at_share(cut.stroke, share);
      EngagementSample sample;
      sample.x = at.x, sample.y = at.y;
      sample.z = cut.from_z + share * (cut.to_z - cut.from_z);
      const double upto = length(until(cut.stroke, at));
      sample.length = upto - done;
      done = upto;
      sample.line = cut.line;
      // Material is there at the tip's depth until the tip was as deep; what a ramp of the same entry left as
      // its floor is entry, too.
      const double strict = open_degrees(cut, at, sample.z, false);
      sample.engagement = strict;
      if (strict >= kAirDegrees) {
        if (cut.to_z < cut.from_z) {
          sample.entry = true;
        } else {
          const double beside = open_degrees(cut, at, sample.z, true);
          sample.entry = beside < strict - 1e-6;
        }
      }
      if (cut.rapid && strict >= kAirDegrees) report_.rapid_cut_mm += sample.length;
      report_.samples.push_back(sample);
    }
  }

  double open_degrees(const Cut& cut, Place at, double z, bool ramps_count) {
    rim_.begin(at, radius_);
    rim_.add_own(until(cut.stroke, at));
    for (const std::uint32_t i : near_) {
      const Cut& earlier = path_.cuts[i];
      const bool as_deep = std::max(earlier.from_z, earlier.to_z) <= z + kSameLevel;
      const bool ramp = ramps_count && !earlier.level() && earlier.entry == cut.entry &&
                        std::min(earlier.from_z, earlier.to_z) >= z - kSameLevel;
      if (as_deep || ramp) rim_.add(earlier.stroke);
    }
    return rim_.open_angle() * kDegrees;
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
  std::vector<std::uint32_t> near_;
};

}  // namespace

void measure_engagement(const CutPath& path, double radius, double spacing, SimulateReport& report) {
  Engagement(path, radius, spacing, report).run();
}

}  // namespace lekalo::verify
