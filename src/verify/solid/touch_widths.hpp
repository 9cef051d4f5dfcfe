#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scan_widths.hpp"

namespace lekalo::verify {

/// Holds the blank's mesh against the nominal mesh and the touches it was moved to, and gives its triangles
/// the widths that the touches leave (docs/formats.md). Adds a finding for all that is not so; nothing is
/// returned where there are no widths. Some findings may be followed by others that come of them.
///
/// Suppose that a motion M of the nominal mesh is as stated, and take a touch c and a ball (a, r) without
/// surface of that mesh inside. With d = form + guard the surface is farther than ball / 2 - d from c, and
/// nearer than ball / 2 + d. So |M a - c| is above r - ball / 2 - d. If a is in the material, it is above
/// r - d: c does not lie deeper than that. And above r + ball / 2 - d where ball / 2 is above 2 d, because c
/// is then outside. Where the touches have directions, the place half a ball from each, against its
/// direction, stands for c, and there is no ball. \param nominal  closed; its triangles are those of the
/// blank, in their order \pre the scan has touches
[[nodiscard]] std::optional<ScanWidths> touch_widths(const SolidMesh& nominal, const SolidMesh& blank,
                                                     const SolidReading& touches,
                                                     const WrittenSolidScan& scan,
                                                     std::vector<std::string>& findings);

}  // namespace lekalo::verify
