#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "fronts.hpp"

namespace lekalo::mill {

/// The rounds of step 7 of docs/design/pocket.md: places of the tool's middle with corners rounded less and
/// less, the last with corners as they are. What other tools have cut belongs to each round. Where loops went
/// a corner is rounded by the largest fillet it has room for. A round is made when it is asked for, and so is
/// what lies between two.
class Peels {
 public:
  struct Round {
    std::vector<geom::Region> regions;
    geom::RegionIndex index;
  };

  /// \param allowed  where the tool's middle may be; kept by reference, as the loops
  /// \param loops  their centres, and places of slots
  /// \param cleared  where other tools have been
  /// \param thinness  at most 1: how deep a peel may be, of one beside passes of a step-over of 0.4
  Peels(const std::vector<geom::Region>& allowed, const std::vector<geom::Point>& loops,
        std::vector<geom::Region> cleared, double radius, double thinness);

  [[nodiscard]] std::size_t last() const { return fillets_.size() - 1; }
  /// The roundest round that has room anywhere.
  [[nodiscard]] Result<std::size_t> first();
  /// Errors: as geom::offset and geom::combine. What is returned stays as long as this.
  [[nodiscard]] Result<const Round*> at(std::size_t k);
  [[nodiscard]] Result<const std::vector<Front>*> between(std::size_t outer, std::size_t inner);

 private:
  Result<void> add_corridors(std::size_t k, std::vector<geom::Region>& opened);

  const std::vector<geom::Region>& allowed_;
  const std::vector<geom::Point>& loops_;
  std::vector<geom::Region> cleared_;
  std::vector<double> fillets_;
  std::map<std::size_t, Round> rounds_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Front>> made_;
};

}  // namespace lekalo::mill
