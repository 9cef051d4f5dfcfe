#include "lekalo/jobs/heat_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "heat_border.hpp"
#include "jobs/document/earlier_documents.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/verify/cut_history.hpp"

namespace lekalo::jobs {
namespace {

/// A contact may cross the stock's border by the rounding of decimals, mm.
constexpr double kOverBorder = 0.01;
/// Places along a contact's arc at which the border is looked for.
constexpr int kLooks = 9;
/// Pieces of the path are this part of the tool's diameter.
constexpr double kPiece = 0.125;

Result<HeatStock> stock_of(const HeatSourceJob& job) {
  HeatStock stock;
  if (job.stock.block) {
    std::vector<geom::Edge> open;
    LEKALO_TRY(const io::RegionFile pocket, io::parse_regions(job.pocket.bytes, job.pocket.name, {}, &open));
    const geom::Box box = geom::RegionIndex(pocket.regions).bounds();
    stock.box =
        heat::stock_box(*job.stock.block, {(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2});
    return stock;
  }
  if (!job.stock.outline)
    return failure(
        ErrorCode::bad_input,
        "no stock is stated; say its sides and, if the pocket is not in its middle, its lower left "
        "corner, as in 120x100x20@-10,5");
  if (!(job.stock.thickness > 0 && std::isfinite(job.stock.thickness)))
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: the stock is {:g} mm thick; state a thickness above 0",
                               job.stock.outline->name, job.stock.thickness));
  LEKALO_TRY(stock.read, io::read_outline(job.stock.outline->bytes, job.stock.outline->name, {}));
  const geom::Box box = geom::RegionIndex(stock.read->outline.regions).bounds();
  stock.box = {box.low.x, box.low.y, box.high.x, box.high.y, job.stock.thickness};
  return stock;
}

/// Leaves out contacts that lie outside of the stock, and refuses those that cross its border.
class Clip {
 public:
  Clip(const HeatSourceJob& job, const HeatStock& stock)
      : job_(job), stock_(stock), border_(stock), radius_(job.machining.tool_diameter / 2) {}

  Result<void> run(std::vector<heat::ToolPiece>& pieces) {
    bool cuts = false, outside = false;
    for (heat::ToolPiece& piece : pieces) {
      const double x = (piece.from[0] + piece.to[0]) / 2, y = (piece.from[1] + piece.to[1]) / 2;
      if (piece.rim.empty() && !(piece.floor_area > 0)) continue;
      // Most of a path is far from the border.
      if (border_.inside(x, y) >= radius_) {
        cuts = true;
        continue;
      }
      const std::size_t before = piece.rim.size();
      std::vector<heat::RimContact> kept;
      for (const heat::RimContact& contact : piece.rim) {
        const auto [least, greatest] = across(contact, x, y);
        if (greatest <= kOverBorder) continue;
        if (least < -kOverBorder)
          return failure(
              ErrorCode::bad_input,
              fmt::format("{}:{}: the tool cuts {:.3f} mm beyond the stock's border, at X {:.3f} Y "
                          "{:.3f}; state the whole stock, or the pocket's open edge",
                          job_.program.name, piece.line, -least, x, y));
        kept.push_back(contact);
      }
      piece.rim = std::move(kept);
      if (border_.inside(x, y) <= -radius_) piece.floor_area = 0;
      outside = outside || piece.rim.size() < before;
      cuts = cuts || !piece.rim.empty() || piece.floor_area > 0;
    }
    if (!cuts && outside)
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: the program lies outside of the stock, which goes from X {:g} Y {:g} to "
                      "X {:g} Y {:g}; {}",
                      job_.program.name, stock_.box.low_x, stock_.box.low_y, stock_.box.high_x,
                      stock_.box.high_y,
                      border_.is_block() ? "say where its lower left corner is, as in 120x100x20@-10,5"
                                         : "its outline has to be in the program's coordinates"));
    return {};
  }

 private:
  /// The least and the greatest distance from the border along a contact.
  [[nodiscard]] std::array<double, 2> across(const heat::RimContact& contact, double x, double y) const {
    std::array<double, 2> found{INFINITY, -INFINITY};
    for (int k = 0; k < kLooks; ++k) {
      const double angle = contact.begin + (contact.end - contact.begin) * k / (kLooks - 1);
      const auto [sine, cosine] = geom::sincos(angle);
      const double inside = border_.inside(x + radius_ * cosine, y + radius_ * sine);
      found = {std::min(found[0], inside), std::max(found[1], inside)};
    }
    return found;
  }

  const HeatSourceJob& job_;
  const HeatStock& stock_;
  StockBorder border_;
  double radius_;
};

std::vector<heat::ToolPiece> pieces_of(const verify::CutHistory& history) {
  std::vector<heat::ToolPiece> pieces;
  for (const verify::CutPiece& cut : history.pieces) {
    heat::ToolPiece piece;
    piece.start = cut.start, piece.seconds = cut.seconds;
    piece.from = {cut.from_x, cut.from_y, cut.from_z}, piece.to = {cut.to_x, cut.to_y, cut.to_z};
    piece.length = cut.length, piece.line = cut.line, piece.rapid = cut.rapid;
    piece.centre = cut.centre;
    for (const verify::EngagedLayer& layer : cut.rim)
      piece.rim.push_back({layer.low_z, layer.high_z, layer.begin, layer.end, layer.width});
    piece.floor_area = cut.floor_area;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace

Result<HeatSource> heat_source(const HeatSourceJob& job, const PhaseListener& phases) {
  HeatSource made;
  LEKALO_TRY(made.stock, stock_of(job));
  const verify::Document program{job.program.name, job.program.bytes};
  const std::vector<verify::EarlierProgram> earlier = earlier_documents(job.after);
  LEKALO_TRY(const verify::CutHistory history,
             verify::cut_history(program, {job.pocket.name, job.pocket.bytes}, job.machining, earlier,
                                 kPiece * job.machining.tool_diameter,
                                 begin_phase(phases, "following the program")));
  LEKALO_TRY(made.unsaid, verify::unsaid_modes(program, job.machining, earlier));
  made.pieces = pieces_of(history);
  LEKALO_CHECK(Clip(job, made.stock).run(made.pieces));
  heat::CuttingConditions cutting = job.cutting;
  cutting.tool_diameter = job.machining.tool_diameter;
  LEKALO_CHECK(heat::check_conditions(cutting));
  Result<heat::CuttingWork> work =
      heat::cutting_work(made.pieces, cutting, job.machining.top - made.stock.box.thickness);
  if (!work) return failure(work.error().code, fmt::format("{}: {}", job.program.name, work.error().message));
  made.work = *std::move(work);
  return made;
}

}  // namespace lekalo::jobs
