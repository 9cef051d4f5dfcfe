#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "profile_path.hpp"

namespace lekalo::nc {

/// Outlines whose kerfs run into each other can free what they surround together. This says what has to be
/// cut before what, so that it does not come loose uncut.
struct Ring {
  /// Cuts of one heap wait for each other; those of different heaps do not.
  std::size_t heap = 0;
  /// Deeper ones come first. 0 lies at the rim of its heap.
  std::size_t depth = 0;
};

/// By cut. The outlines that nothing or the same hole encloses are taken together: the union of these, each
/// grown by the kerf, is what is no longer sheet when all are cut. An outline on the rim of this union, with
/// a way to it that no other kerf crosses, has depth 0; those that are on the rim once these are left away
/// have depth 1, and so on. At every moment of an order from the depth outwards each outline that is still to
/// be cut borders on the sheet, because it does when everything is cut but what comes later.
///
/// Kerfs count as met where they come nearer than a tolerance. Fails as geom::united does. Cost: that of the
/// union, for each depth; nothing where no kerfs meet.
[[nodiscard]] Result<std::vector<Ring>> loose_rings(const std::vector<ProfilePart>& parts,
                                                    const std::vector<Cut>& cuts,
                                                    const std::vector<std::size_t>& enclosing,
                                                    const ProfileOptions& options);

}  // namespace lekalo::nc
