#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/heat/cutting.hpp"
#include "lekalo/heat/stock.hpp"
#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/phases.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// The stock of a workpiece: a block, or an outline and a thickness.
struct StockGiven {
  std::optional<heat::StockWords> block;
  std::optional<File> outline;  ///< in any form of io::OutlineFile; where there is no block
  double thickness = 0;         ///< mm, of an outline
};

/// A program, the pocket that it clears, and what is needed to say how much work it is.
struct HeatSourceJob {
  File program;
  File pocket;  ///< region JSON (docs/formats.md)
  std::vector<EarlierProgram> after;
  verify::SimulateOptions machining;  ///< the stock's upper face is at machining.top
  heat::CuttingConditions cutting;    ///< its tool is that of `machining`
  StockGiven stock;
};

/// A stock with its upper face at some Z; its sides are upright.
struct HeatStock {
  heat::StockBox box;                   ///< the block, or the box about the outline
  std::optional<io::ReadOutline> read;  ///< with regions; none for a block
};

/// The work of a program, and the way of its tool.
struct HeatSource {
  HeatStock stock;
  std::vector<heat::ToolPiece> pieces;  ///< in the order of time, without a gap
  heat::CuttingWork work;
  /// Sentences about what the programs leave to the control, verify::unsaid_modes().
  std::vector<std::string> unsaid;
};

/// Follows the program with the independent checker (verify/cut_history.hpp) and computes the work of its
/// cuts (heat/cutting.hpp), by pieces of an eighth of the tool's diameter. Contacts that lie outside of the
/// stock meet nothing. bad_input with one sentence where a contact crosses the stock's border by more than
/// 0.01 mm, where the program lies outside of the stock, and for all that these two refuse. The only phase is
/// "following the program". Cost: that of verify::cut_history.
[[nodiscard]] Result<HeatSource> heat_source(const HeatSourceJob& job, const PhaseListener& phases = {});

}  // namespace lekalo::jobs
