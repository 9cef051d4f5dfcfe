#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/fit/assembly.hpp"
#include "lekalo/fit/closed_form.hpp"
#include "lekalo/fit/corrected.hpp"
#include "lekalo/fit/iso286.hpp"
#include "lekalo/fit/pressing.hpp"
#include "lekalo/fit/turning.hpp"
#include "lekalo/jobs/phases.hpp"
#include "lekalo/jobs/picture_form.hpp"

namespace lekalo::jobs {

/// A metal by its name, or by numbers, which go before those of the name.
struct MaterialWords {
  std::string name;  ///< of fit::known_materials(); empty: numbers alone
  std::optional<double> youngs_mpa, poisson, yield_mpa, hardening_mpa, expansion_per_k;
};

/// A ring that is pressed on what is there already.
struct OuterRing {
  double outer_diameter = 0, interference = 0;  ///< mm; the interference in diameter
};

/// A hub that is pressed on a shaft. Lengths in mm.
struct FitJob {
  std::string fit;  ///< "18H8/z8"; empty: diameter and interference
  double diameter = 0, interference = 0;
  double most_interference = 0;  ///< the interference is from that to this; 0: it is one
  double hub_outer = 0, length = 0;
  double shaft_length = 0;         ///< 0: three times the hub's
  std::optional<double> from_end;  ///< from the shaft's right end to the hub's; none: in the middle
  double bore = 0;                 ///< of the shaft; 0: solid
  std::vector<OuterRing> more;     ///< as long as the hub
  MaterialWords material;
  std::optional<MaterialWords> shaft_material;  ///< where it is another
  /// Rz of shaft and hub, um: what of the interference is smoothed away.
  std::optional<std::array<double, 2>> roughness_um;
  std::optional<std::array<double, 2>> friction;  ///< least and greatest, for the force of pressing
  std::optional<double> clearance_um;             ///< in diameter, for the temperature of shrinking
  /// The surface that is to be a cylinder after pressing, at the mean interference; and the names of the
  /// files of its profile, as they stand in the result; empty: not asked for.
  std::optional<fit::Surface> cylindrical;
  std::string table_as, drawing_as, program_as;
  fit::TurningWords turning;
  std::optional<PictureForm> picture;  ///< SVG or PNG
};

/// One interference, and what it does.
struct FitCase {
  double interference = 0;  ///< of the first seat, mm, in diameter
  fit::Pressed pressed, released;
  std::optional<fit::DinFit> din;
};

struct Fitted {
  std::optional<fit::NamedFit> named;
  fit::Assembly assembly;
  std::vector<FitCase> cases;  ///< the least, the mean and the greatest; one where one is given
  std::optional<fit::Corrected> corrected;
  std::string table, drawing, program;  ///< of the profile: CSV, DXF, NC; empty where not asked for
  std::string picture;                  ///< SVG or PNG; empty where not asked for
  std::string json;                     ///< format lekalo-fit (docs/formats.md); confirmed by the checker
};

/// Presses the rings and says what it does to them. bad_input with one sentence for a fit, an assembly or a
/// metal that is not one; for an interference that is not above 0, also after smoothing; for a hub that
/// yields through and does not harden. refuted where the checker finds a figure that is not true. Phases:
/// "pressing the least interference" and so on. Cost: that of fit::Pressing, some seconds at most.
[[nodiscard]] Result<Fitted> fit(const FitJob& job, const PhaseListener& phases = {});

}  // namespace lekalo::jobs
