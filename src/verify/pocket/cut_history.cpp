#include "lekalo/verify/cut_history.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cut_path.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "nc_program.hpp"
#include "rim_cover.hpp"
#include "simulate_job.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

constexpr double kMostPieces = 2e5;
/// Two heights between which less than this is engaged, in mm2 for a mm of path, are one layer.
constexpr double kThinLayer = 1e-4;
/// Widths that differ by less are equal, mm; the rim's rounding is below it.
constexpr double kSameWidth = 1e-7;
/// The floor below a tool is measured on so many rings.
constexpr int kRings = 12;
constexpr std::size_t kPiecesToTell = 1000;

/// Returns the height down to which a cut leaves nothing under the tool. Along a slope that is its upper end.
double cleared_to(const Cut& cut) {
  return length(cut.stroke) > 0 ? std::max(cut.from_z, cut.to_z) : std::min(cut.from_z, cut.to_z);
}

/// Knows what stands about the tool at one place, by the cuts before.
class Surroundings {
 public:
  Surroundings(const CutPath& path, const Air& air, double radius, double top)
      : air_(air), cuts_(path.before), radius_(radius), widest_(radius), top_(top) {
    first_ = cuts_.size();
    cuts_.insert(cuts_.end(), path.cuts.begin(), path.cuts.end());
    for (const Cut& cut : cuts_) widest_ = std::max(widest_, cut.radius);
    index_ = index_over(cuts_, radius);
    repeated_ = repeated(cuts_);
    for (std::size_t i = 0; i < first_; ++i) add(i);
  }

  /// The cuts before this one of the program stand in the stock; the next ones not yet.
  void go_to(std::size_t number) {
    for (; added_ < number; ++added_) add(first_ + added_);
    const Stroke& stroke = cuts_[first_ + number].stroke;
    const Place middle = 0.5 * (stroke.from + stroke.to);
    const double reach = radius_ + 0.5 * length(stroke.to - stroke.from);
    index_.near(middle, reach + widest_, near_);
    std::erase_if(
        near_, [&](std::uint32_t i) { return distance(middle, cuts_[i].stroke) > reach + cuts_[i].radius; });
    // The newest cover most of what the tool meets.
    std::reverse(near_.begin(), near_.end());
  }

  /// Returns the layers at a place where the tool's tip is at z, the lowest first.
  /// \param so_far  the way of the cut at hand to there, of some length
  std::vector<EngagedLayer> rim_at(double z, const Stroke& so_far) {
    const std::vector<double> heights = heights_above(z, top_);
    std::vector<State> states(heights.size() - 1);
    std::vector<EngagedLayer> layers;
    divide(heights, 0, states.size() - 1, so_far, states, layers);
    return layers;
  }

  /// Returns the heights between which the floor is the same everywhere, with both ends, ascending.
  [[nodiscard]] std::vector<double> heights_above(double z, double upto) const {
    std::vector<double> heights{z};
    for (const std::uint32_t i : near_)
      if (const double h = cleared_to(cuts_[i]); h > z + kSameLevel && h < upto - kSameLevel)
        heights.push_back(h);
    std::sort(heights.begin(), heights.end());
    const auto same = [](double a, double b) { return b - a < kSameLevel; };
    heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
    heights.push_back(std::max(upto, z));
    return heights;
  }

  /// Returns the area under the tool that no cut has taken off at z, mm2: rings of it, each by its arcs.
  double floor_at(double z, Place at) {
    double area = 0;
    const double step = radius_ / kRings;
    for (int k = 0; k < kRings; ++k) {
      const double ring = (k + 0.5) * step;
      for (const double way : {1e-6, -1e-6}) {
        rim_.begin(at, ring, {false, true, at - Place{way, 0}, at, {}, 0});
        cover(z);
        area += ring * step * rim_.open_angle();
      }
    }
    return area;
  }

 private:
  struct State {
    bool known = false;
    double width = 0;
    std::vector<RimCover::OpenArc> arcs;
  };

  void add(std::size_t i) {
    if (!repeated_[i]) index_.add(static_cast<std::uint32_t>(i), cuts_[i].stroke);
  }

  /// Takes away what is cut down to z.
  void cover(double z) {
    for (std::size_t k = 0; k < near_.size() && !rim_.nothing_left(); ++k) {
      const Cut& cut = cuts_[near_[k]];
      if (cleared_to(cut) <= z + kSameLevel) rim_.add(cut.stroke, cut.radius);
    }
    if (!air_.empty()) rim_.add_air(air_);
  }

  const State& state_between(double low, double high, const Stroke& so_far, State& state) {
    if (state.known) return state;
    state.known = true;
    rim_.begin(so_far.to, radius_, so_far);
    cover(0.5 * (low + high));
    rim_.add_open_arcs(state.arcs);
    state.width = rim_.open_width();
    return state;
  }

  /// A part of the rim that is engaged at a height is engaged at every lower one, so that layers whose rim is
  /// as wide are one, as a single one is.
  void divide(const std::vector<double>& heights, std::size_t first, std::size_t last, const Stroke& so_far,
              std::vector<State>& states, std::vector<EngagedLayer>& layers) {
    ask();
    const State& low = state_between(heights[first], heights[first + 1], so_far, states[first]);
    if (low.arcs.empty()) return;
    const State& high = state_between(heights[last], heights[last + 1], so_far, states[last]);
    const double thick = heights[last + 1] - heights[first], differ = low.width - high.width;
    if (differ * thick <= kThinLayer) {
      add_layers(heights[first], heights[last + 1], low, layers);
      return;
    }
    const std::size_t middle = (first + last) / 2;
    divide(heights, first, middle, so_far, states, layers);
    divide(heights, middle + 1, last, so_far, states, layers);
  }

  /// Layers one above the other with the same arcs become one.
  static void add_layers(double low_z, double high_z, const State& state, std::vector<EngagedLayer>& layers) {
    for (const RimCover::OpenArc& arc : state.arcs) {
      const double begin = angle_between({1, 0}, arc.right);
      const auto below = std::find_if(layers.begin(), layers.end(), [&](const EngagedLayer& l) {
        return l.high_z == low_z && std::abs(l.begin - begin) < kSameWidth &&
               std::abs(l.end - begin - arc.angle) < kSameWidth;
      });
      if (below != layers.end())
        below->high_z = high_z;
      else
        layers.push_back({low_z, high_z, begin, begin + arc.angle, arc.width});
    }
  }

  const Air& air_;
  /// The cuts of earlier programs, and from first_ on those of this one.
  std::vector<Cut> cuts_;
  std::size_t first_ = 0, added_ = 0;
  std::vector<bool> repeated_;
  double radius_, widest_, top_;
  StrokeIndex index_;
  RimCover rim_;
  std::vector<std::uint32_t> near_;
};

/// Makes the pieces of a program, in its order.
class HistoryMaker {
 public:
  HistoryMaker(const SimulateJob& job, const std::vector<NcDwell>& dwells, const SimulateOptions& o,
               double longest)
      : moves_(job.moves),
        cuts_(job.path.cuts),
        dwells_(dwells),
        clock_(job.moves, o),
        around_(job.path, job.reach.air(), o.tool_diameter / 2, o.top),
        longest_(longest) {
    double whole = 0;
    for (const Cut& cut : cuts_) whole += length(cut.stroke) + std::abs(cut.to_z - cut.from_z);
    longest_ = std::max(longest_, whole / kMostPieces);
  }

  CutHistory run(const ProgressListener& progress) {
    std::size_t next = 0;
    for (move_ = 0; move_ < moves_.size(); ++move_) {
      wait(move_);
      double done = 0;
      for (; next < cuts_.size() && cuts_[next].move == move_; ++next) {
        if (progress && next % kPiecesToTell == 0)
          progress({next, static_cast<double>(next) / static_cast<double>(cuts_.size())});
        const Cut& cut = cuts_[next];
        add_air(done, cut.begin, cut.stroke.from);
        around_.go_to(next);
        length(cut.stroke) > 0 ? add_cut(cut) : add_plunge(cut);
        done = cut.end;
      }
      add_air(done, 1, moves_[move_].to);
    }
    wait(moves_.size());
    made_.seconds = clock_.seconds() + waited_;
    return std::move(made_);
  }

 private:
  /// Adds the dwells before a move.
  void wait(std::size_t before_move) {
    for (; dwell_ < dwells_.size() && dwells_[dwell_].before_move <= before_move; ++dwell_) {
      CutPiece piece;
      piece.start =
          (before_move < moves_.size() ? clock_.seconds_at(before_move, 0) : clock_.seconds()) + waited_;
      piece.seconds = dwells_[dwell_].seconds;
      if (!moves_.empty()) {
        const Move& m = moves_[before_move == 0 ? 0 : before_move - 1];
        const Place at = before_move == 0 ? m.from : m.to;
        piece.from_x = piece.to_x = at.x, piece.from_y = piece.to_y = at.y;
        piece.from_z = piece.to_z = before_move == 0 ? m.from_z : m.to_z;
      }
      made_.pieces.push_back(piece);
      waited_ += piece.seconds;
    }
  }

  /// Returns a piece of the move between two shares of its way.
  [[nodiscard]] CutPiece piece_of(double begin, double end, Place from, Place to, double from_z,
                                  double to_z) const {
    const Move& move = moves_[move_];
    CutPiece piece;
    const double start = clock_.seconds_at(move_, begin);
    piece.start = start + waited_, piece.seconds = clock_.seconds_at(move_, end) - start;
    piece.from_x = from.x, piece.from_y = from.y, piece.from_z = from_z;
    piece.to_x = to.x, piece.to_y = to.y, piece.to_z = to_z;
    piece.length = length(to - from);
    piece.feed = move.feed, piece.line = move.line, piece.rapid = move.rapid;
    return piece;
  }

  /// Adds what a move goes above the stock. An arc is said by its ends: nothing is cut there.
  void add_air(double begin, double end, Place to) {
    if (!(end > begin)) return;
    const Move& move = moves_[move_];
    const Place from =
        made_.pieces.empty() ? move.from : Place{made_.pieces.back().to_x, made_.pieces.back().to_y};
    const auto z = [&](double share) { return move.from_z + share * (move.to_z - move.from_z); };
    made_.pieces.push_back(piece_of(begin, end, from, to, z(begin), z(end)));
  }

  void add_cut(const Cut& cut) {
    const double whole = length(cut.stroke), drop = cut.to_z - cut.from_z;
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(whole / longest_ - 1e-9)));
    const auto share_of = [&](double k) { return k / static_cast<double>(count); };
    double begin = cut.begin, done = 0;
    Place from = cut.stroke.from;
    for (std::size_t k = 0; k < count; ++k) {
      ask();
      const double middle = share_of(static_cast<double>(k) + 0.5),
                   last = share_of(static_cast<double>(k + 1));
      const Place to = k + 1 == count ? cut.stroke.to : at_share(cut.stroke, last);
      // Shares of arcs are not exactly by length.
      const double upto = k + 1 == count ? whole : length(until(cut.stroke, to));
      const double end = cut.begin + upto / whole * (cut.end - cut.begin);
      const auto z = [&](double way) { return cut.from_z + way / whole * drop; };
      CutPiece piece = piece_of(begin, end, from, to, z(done), z(upto));
      piece.length = upto - done;
      if (cut.stroke.arc) piece.centre = {cut.stroke.centre.x, cut.stroke.centre.y};
      const Place at = at_share(cut.stroke, middle);
      piece.rim = around_.rim_at(0.5 * (piece.from_z + piece.to_z), until(cut.stroke, at));
      if (drop < 0) piece.floor_area = around_.floor_at(0.5 * (piece.from_z + piece.to_z), at);
      made_.pieces.push_back(std::move(piece));
      begin = end, done = upto, from = to;
    }
  }

  /// Straight down, the floor is the same between the heights of the cuts before. Straight up cuts nothing.
  void add_plunge(const Cut& cut) {
    const Place at = cut.stroke.from;
    const double drop = cut.to_z - cut.from_z;
    std::vector<double> stations{cut.to_z, cut.from_z};
    if (drop < 0) {
      stations.clear();
      const std::vector<double> heights = around_.heights_above(cut.to_z, cut.from_z);
      for (std::size_t i = heights.size(); i-- > 1;) {
        const double high = heights[i], low = heights[i - 1];
        const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil((high - low) / longest_ - 1e-9)));
        for (std::size_t k = 0; k < count; ++k)
          stations.push_back(high - (high - low) * static_cast<double>(k) / static_cast<double>(count));
      }
      stations.push_back(cut.to_z);
    } else {
      std::swap(stations.front(), stations.back());
    }
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      ask();
      const auto share = [&](double z) {
        return drop != 0 ? cut.begin + (z - cut.from_z) / drop * (cut.end - cut.begin) : cut.begin;
      };
      const double high = stations[i], low = stations[i + 1];
      CutPiece piece = piece_of(share(high), share(low), at, at, high, low);
      if (drop < 0) piece.floor_area = around_.floor_at(0.5 * (high + low), at);
      made_.pieces.push_back(std::move(piece));
    }
  }

  const std::vector<Move>& moves_;
  const std::vector<Cut>& cuts_;
  const std::vector<NcDwell>& dwells_;
  MachineClock clock_;
  Surroundings around_;
  double longest_;
  CutHistory made_;
  std::size_t move_ = 0, dwell_ = 0;
  double waited_ = 0;
};

}  // namespace

double CutPiece::volume() const {
  double volume = floor_area * std::max(0.0, from_z - to_z);
  for (const EngagedLayer& layer : rim) volume += layer.width * (layer.high_z - layer.low_z) * length;
  return volume;
}

Result<CutHistory> cut_history(const Document& program, const Document& pocket, const SimulateOptions& o,
                               const std::vector<EarlierProgram>& earlier, double longest,
                               const ProgressListener& progress) {
  if (!(longest >= 1e-3 && longest <= 100))
    return failure(ErrorCode::usage,
                   fmt::format("pieces of {:g} mm: they are to be 0.001 to 100 mm long", longest));
  LEKALO_TRY(const SimulateJob job, read_simulate_job(program, pocket, o, earlier));
  LEKALO_TRY(const NcProgram read, read_program(program, {.control = o.control, .top = o.top}));
  return HistoryMaker(job, read.dwells, o, longest).run(progress);
}

}  // namespace lekalo::verify
