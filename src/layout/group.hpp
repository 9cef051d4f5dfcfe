#pragma once

#include <optional>
#include <vector>

#include "lekalo/layout/workspace.hpp"
#include "lekalo/phi/slide.hpp"

namespace lekalo::layout {

/// Placements that move as one among all others of their sheet. While the group lives they are taken out of
/// the workspace's scenes. The motions keep every rule, and all but jump() need a valid start.
class Group {
 public:
  /// \pre all on one sheet
  Group(const Workspace& workspace, std::vector<Placement> placements);

  [[nodiscard]] const std::vector<Placement>& placements() const noexcept { return placements_; }
  [[nodiscard]] bool is_clear(geom::GridPoint shift = {}) const;
  /// Returns the box around all outlines as they lie.
  [[nodiscard]] geom::GridBox box() const;
  [[nodiscard]] Sheet sheet() const noexcept { return {placements_[0].stock, placements_[0].copy}; }

  void jump(geom::GridPoint shift) noexcept;

  /// Moves along a unit vector by at most `length` steps, until something is in the way.
  /// \return whether something was in the way
  bool slide(geom::Point direction, double length);
  /// Moves towards a shifted place, along what is in the way as long as that comes nearer to it.
  void slide_along(geom::GridPoint by);
  /// Slides and slides along until it rests against what lies in the direction.
  void settle(geom::Point direction);

  /// Returns the bodies that stop the group from moving on in a direction.
  [[nodiscard]] std::vector<phi::BodyIndex> blockers(geom::Point direction) const;

 private:
  struct Way {
    phi::SlidePath path;
    std::vector<double> events;
  };
  [[nodiscard]] Way way(geom::Point direction, double length) const;
  /// Returns the directions along the edges that the group touches, ordered by how far they lead towards
  /// `goal`. Directions that lead away are left out.
  [[nodiscard]] std::vector<geom::Point> along_contacts(geom::Point goal) const;
  /// Slides along a contact until it ends or the way towards `goal` opens.
  /// \return whether the group got anywhere
  bool follow(geom::Point along, double length, geom::Point goal);

  const Workspace& workspace_;
  std::vector<Placement> placements_;
  std::vector<std::uint64_t> ids_;
  Workspace::Lifted lifted_;
  /// True when the placements keep the rules that no motion changes.
  bool allowed_;
};

/// A vector in steps as doubles, the nearest vector of whole steps (ties to even), and the direction of one.
[[nodiscard]] geom::Point in_doubles(geom::GridPoint p) noexcept;
[[nodiscard]] geom::GridPoint nearest_step(geom::Point p) noexcept;
[[nodiscard]] geom::Point unit_vector(geom::GridPoint direction) noexcept;

}  // namespace lekalo::layout
