#include <algorithm>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "profile_order.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {
namespace {

/// The cuts so far, and their leads.
class LeadsBefore {
 public:
  LeadsBefore(std::size_t cuts, const ProfileOptions& options)
      : options_(options), resolution_(resolution_of(options)), is_there_(cuts, false) {}

  void add(std::size_t cut, const Start& start) {
    for (const WrittenEdge& edge : start.lead) {
      leads_.push_back(geom::make_curve(edge_mm(edge, resolution_)));
      boxes_.push_back(geom::curve_box(leads_.back()));
      cut_of_lead_.push_back(cut);
    }
  }
  void finish(std::size_t cut) { is_there_[cut] = true; }

  /// The earlier cut whose kerf the lead or the pierce meets.
  [[nodiscard]] std::optional<std::size_t> met_by(std::size_t cut, const Start& start) const {
    const auto is_there = [&](std::size_t other) { return bool(is_there_[other]); };
    if (!start.in_kerf_of.empty()) {
      const bool is_cut = std::any_of(start.in_kerf_of.begin(), start.in_kerf_of.end(), is_there);
      if (is_cut || options_.pierce_diameter_mm == 0) return std::nullopt;
      return start.in_kerf_of.front();
    }
    const auto there = std::find_if(start.met.begin(), start.met.end(), is_there);
    if (there != start.met.end()) return *there;
    const geom::Point pierce = resolution_.mm(start.pierce);
    const double kerf = options_.kerf_mm;
    const double disc = options_.pierce_diameter_mm > 0 ? 0.5 * (options_.pierce_diameter_mm + kerf) : 0;
    geom::Box around = geom::grown({pierce, pierce}, disc);
    std::vector<geom::Curve> own;
    for (const WrittenEdge& edge : start.lead) {
      own.push_back(geom::make_curve(edge_mm(edge, resolution_)));
      const geom::Box box = geom::grown(geom::curve_box(own.back()), kerf);
      around.low = {std::min(around.low.x, box.low.x), std::min(around.low.y, box.low.y)};
      around.high = {std::max(around.high.x, box.high.x), std::max(around.high.y, box.high.y)};
    }
    for (std::size_t i = 0; i < leads_.size(); ++i) {
      if (cut_of_lead_[i] == cut || !geom::boxes_meet(around, boxes_[i])) continue;
      if (disc > 0 && !(distance_at_least(leads_[i], pierce) >= disc)) return cut_of_lead_[i];
      for (const geom::Curve& lead : own)
        if (!(distance_at_least(lead, leads_[i]) >= kerf)) return cut_of_lead_[i];
    }
    return std::nullopt;
  }

 private:
  const ProfileOptions& options_;
  Resolution resolution_;
  std::vector<bool> is_there_;
  std::vector<geom::Curve> leads_;
  std::vector<geom::Box> boxes_;
  std::vector<std::size_t> cut_of_lead_;
};

}  // namespace

std::vector<std::optional<std::size_t>> settle_starts(const std::vector<Starts>& starts,
                                                      const ProfileOptions& options,
                                                      std::vector<OrderedCut>& order) {
  LeadsBefore before(starts.size(), options);
  std::vector<std::optional<std::size_t>> met;
  for (OrderedCut& ordered : order) {
    ask();
    const std::vector<Start>& choices = starts[ordered.cut].choices;
    std::optional<std::size_t> meets = before.met_by(ordered.cut, choices[ordered.start]);
    // Behind joints all starts are taken, whichever is first.
    const bool takes_all =
        std::any_of(choices.begin(), choices.end(), [](const Start& start) { return start.behind_joint; });
    for (std::size_t k = 0; k < choices.size() && meets; ++k) {
      const auto instead = before.met_by(ordered.cut, choices[k]);
      if (!instead) ordered.start = k, meets.reset();
    }
    for (std::size_t k = 0; k < choices.size(); ++k) {
      if (!takes_all && k != ordered.start) continue;
      if (!meets) meets = before.met_by(ordered.cut, choices[k]);
      before.add(ordered.cut, choices[k]);
    }
    before.finish(ordered.cut);
    met.push_back(meets);
  }
  return met;
}

}  // namespace lekalo::nc
