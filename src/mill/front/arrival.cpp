#include "arrival.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "mill/path/arc_through.hpp"
#include "step_law.hpp"

namespace lekalo::mill {

using geom::Point;
using geom::Region;
using geom::RegionIndex;

namespace {

constexpr double kFit = 0.004;      // mm
constexpr std::size_t kMargin = 4;  // nodes beyond the box

field::GridFrame frame_about(const geom::Box& box, double pitch) {
  const double margin = static_cast<double>(kMargin) * pitch;
  // The grid lies off round numbers, so that walls at round numbers do not run through nodes.
  return {box.low - Point{margin + 0.37 * pitch, margin + 0.41 * pitch}, pitch,
          static_cast<std::size_t>((box.high.x - box.low.x) / pitch) + 2 * kMargin + 2,
          static_cast<std::size_t>((box.high.y - box.low.y) / pitch) + 2 * kMargin + 2};
}

}  // namespace

ArrivalField::ArrivalField(const RegionIndex& allowed, const std::vector<Region>& start, double pitch,
                           const Law& law)
    : law_(law) {
  const field::GridFrame frame = frame_about(allowed.bounds(), pitch);
  std::vector<double> speeds = field::signed_distances(allowed, frame);
  for (double& at : speeds) at = at > 0 ? speed(at) : 0;
  arrival_ = field::arrival_times(frame, speeds, RegionIndex(start));
  field::extend_beyond_walls(arrival_, speeds, kMargin - 1);
  lines_.emplace(frame, arrival_.time);
}

double ArrivalField::speed(double distance) const {
  const double step =
      step_for(law_.bend * (law_.beyond + std::max(0.0, distance)), law_.tool_radius, law_.cosine);
  return std::min(law_.step, std::max(step, law_.least * law_.step));
}

Result<std::vector<Region>> ArrivalField::before(double time) const {
  using Place = field::LevelLines::Place;
  std::vector<geom::Contour> contours;
  for (std::vector<Place>& line : lines_->at(time)) {
    ask(1 + line.size());
    const std::size_t n = line.size();
    // A line begins at a place that is not smooth, if it has one, so that the fit may break there.
    const auto rough = std::find_if(line.begin(), line.end(), [](const Place& p) { return !p.known; });
    std::rotate(line.begin(), rough == line.end() ? line.begin() : rough, line.end());
    for (int round = 0; round < 2; ++round) {
      std::vector<Place> smoother = line;
      for (std::size_t i = 0; i < n; ++i) {
        const Place &a = line[(i + n - 1) % n], &b = line[(i + 1) % n];
        if (a.known && b.known && line[i].known) smoother[i].at = 0.25 * (a.at + 2 * line[i].at + b.at);
      }
      line = std::move(smoother);
    }
    geom::Contour contour;
    for (std::size_t i = 0; i < n;) {
      if (!line[i].known || !line[(i + 1) % n].known) {
        const Point a = line[i].at, b = line[(i + 1) % n].at;
        if (!(a == b)) contour.push_back({geom::EdgeKind::line, a, b, {}});
        ++i;
        continue;
      }
      std::vector<Point> run;
      std::size_t k = i;
      while (k <= n && line[k % n].known && (k < n || i == 0)) run.push_back(line[k++ % n].at);
      fit_arcs(run, kFit, contour);
      i = k - 1;
      if (i == 0) break;
    }
    if (contour.size() > 2) contours.push_back(std::move(contour));
  }
  return geom::nest_contours(std::move(contours));
}

}  // namespace lekalo::mill
