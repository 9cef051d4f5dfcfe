#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "profile_leads.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

/// A lead may end so many kerfs before the line, where beside its end a part is in the way.
constexpr std::array kKerfsBefore{0.0, 0.25, 0.75};

struct LeadTurn {
  double cosine, sine;
};
/// Straight on, then aslant by 45 degrees to either side, then across.
constexpr double kHalfRoot = 0.70710678118654752;
constexpr std::array<LeadTurn, 5> kLeadTurns{
    {{1, 0}, {kHalfRoot, kHalfRoot}, {kHalfRoot, -kHalfRoot}, {0, 1}, {0, -1}}};

class LineStarts {
 public:
  LineStarts(const Cut& line, std::size_t own, const Surroundings& around, const ProfileOptions& options)
      : line_(line), own_(own), around_(around), options_(options), resolution_(resolution_of(options)) {}

  Starts find() const {
    Starts found;
    const std::vector<double> lengths = lead_lengths(options_.lead_in_mm, options_);
    for (const bool from_end : {false, true}) {
      if (from_end && !line_.either_way) continue;
      for (const double length : lengths) {
        std::vector<Start> led = with_lead(from_end, length);
        const bool is_free =
            std::any_of(led.begin(), led.end(), [](const Start& start) { return start.met.empty(); });
        std::move(led.begin(), led.end(), std::back_inserter(found.choices));
        if (is_free) break;
      }
    }
    for (const bool from_end : {false, true})
      if (!from_end || line_.either_way) add_bare(from_end, found);
    return found;
  }

 private:
  [[nodiscard]] WrittenPoint end(bool from_end) const {
    return from_end ? line_.path.back().to : line_.path.front().from;
  }
  /// The unit vector that goes on beyond the end.
  [[nodiscard]] Point outwards(bool from_end) const {
    const WrittenEdge& edge = from_end ? line_.path.back() : line_.path.front();
    const Point along = resolution_.mm(edge.to) - resolution_.mm(edge.from);
    return (from_end ? 1 : -1) / geom::norm(along) * along;
  }
  [[nodiscard]] bool has_room_for_pierce(WrittenPoint at) const {
    return options_.pierce_diameter_mm == 0 ||
           around_.proof.disc_stays_out(at, 0.5 * options_.pierce_diameter_mm);
  }

  [[nodiscard]] std::vector<Start> with_lead(bool from_end, double length) const {
    std::vector<Start> found;
    const WrittenPoint at = end(from_end);
    const Point ahead = outwards(from_end), aside = geom::perpendicular(ahead);
    for (std::size_t short_of = 0; short_of < kKerfsBefore.size(); ++short_of)
      for (std::size_t turned = 0; turned < kLeadTurns.size(); ++turned) {
        const LeadTurn turn = kLeadTurns[turned];
        const WrittenPoint before =
            resolution_.rounded(resolution_.mm(at) + kKerfsBefore[short_of] * options_.kerf_mm * ahead);
        const WrittenPoint pierce =
            resolution_.rounded(resolution_.mm(before) + length * (turn.cosine * ahead + turn.sine * aside));
        if (pierce == before) continue;
        const WrittenEdge lead{geom::EdgeKind::line, pierce, before, {}};
        std::vector<WrittenEdge> all{lead};
        if (before != at) all.push_back({geom::EdgeKind::line, before, at, {}});
        if (!around_.proof.stays_out(all) || !has_room_for_pierce(pierce) ||
            around_.kerfs.goes_along(own_, lead))
          continue;
        Start start{all, 0, pierce, at, around_.kerfs.met(own_, {lead}, pierce), length};
        start.from_end = from_end;
        start.bends = short_of + turned;
        found.push_back(std::move(start));
      }
    return found;
  }

  void add_bare(bool from_end, Starts& found) const {
    const WrittenPoint at = end(from_end);
    Start start{{}, 0, at, at, {}, 0};
    start.from_end = from_end;
    start.in_kerf_of = around_.kerfs.holding(own_, at, options_.tolerance_mm + 2 * resolution_.step_mm());
    if (start.in_kerf_of.empty() && !has_room_for_pierce(at)) return;
    if (start.in_kerf_of.empty()) start.met = around_.kerfs.met(own_, {}, at);
    found.choices.push_back(std::move(start));
  }

  const Cut& line_;
  std::size_t own_;
  const Surroundings& around_;
  const ProfileOptions& options_;
  Resolution resolution_;
};

}  // namespace

Starts pocket_starts_of(std::vector<WrittenEdge>& path, std::size_t own, double lead_in_mm,
                        const Surroundings& around, const ProfileOptions& options) {
  Starts found = starts_of(path, own, lead_in_mm, around, options);
  if (!found.choices.empty()) return found;
  const double near = options.tolerance_mm + 2 * resolution_of(options).step_mm();
  for (std::size_t edge = 0; edge < path.size(); ++edge) {
    const WrittenPoint at = path[edge].from;
    Start start{{}, edge, at, at, {}, 0};
    start.in_kerf_of = around.kerfs.holding(own, at, near);
    if (!start.in_kerf_of.empty()) found.choices.push_back(std::move(start));
  }
  return found;
}

Starts line_starts_of(const Cut& line, std::size_t own, const Surroundings& around,
                      const ProfileOptions& options) {
  return LineStarts(line, own, around, options).find();
}

}  // namespace lekalo::nc
