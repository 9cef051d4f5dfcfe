#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/phi/outline_relation.hpp"

namespace lekalo::phi {

/// The collision engine: many bodies on one piece of stock, which is asked again and again. It gives the
/// answers of phi/outline_relation.hpp, faster. docs/design/scene.md says how.
///
/// A *shape* is an outline that is turned for good and moved freely; a *body* is a shape at a place. Bodies
/// forbid: others may not overlap them, or, for a `container`, may not reach out of it; and they keep a gap.
/// There are no exceptions, threads or library mathematics, so the engine runs in a browser as it is.
/// Questions remember what they find out, so ask one scene from one thread at a time. Copies answer alike and
/// remember for themselves.
using ShapeIndex = std::uint32_t;
using BodyIndex = std::uint32_t;
inline constexpr BodyIndex kNoBody = ~BodyIndex{0};

struct Body {
  ShapeIndex shape = 0;
  geom::GridPoint at = {};
  /// The larger of both bodies' gaps counts between them.
  std::int64_t gap = 0;
  /// Only questions with a layer in common meet the body.
  std::uint32_t layers = 1;
  /// Only questions that tolerate less than this meet the body.
  std::int64_t rank = 1;
  /// The complement of the outline is what is forbidden.
  bool container = false;
};

/// A question asks about a probe: a shape at a place.
struct Probe {
  ShapeIndex shape = 0;
  geom::GridPoint at = {};
  std::int64_t gap = 0;
  std::uint32_t layers = 1;
  std::int64_t tolerates = 0;
  /// A body that does not count, because the probe stands for it.
  BodyIndex except = kNoBody;
};

struct NearestBody {
  BodyIndex body = kNoBody;
  /// True when the two overlap; phi/separation.hpp says how deep.
  bool overlaps = false;
  /// The least distance of the edges, with on_a on the body and on_b on the probe.
  EdgeDistance edges;
};

class Scene {
 public:
  /// \param world  where most bodies will lie; others cost more, and count all the same
  /// \param cells  about how many cells the index has; a few for each body is right
  Scene(const geom::GridBox& world, std::size_t cells);
  ~Scene();
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(Scene other) noexcept;

  /// Adds an outline as it is, around its own origin.
  /// \pre made by make_grid_region or turned()
  ShapeIndex add_shape(geom::GridRegion outline);
  [[nodiscard]] const geom::GridRegion& outline(ShapeIndex shape) const noexcept {
    return shapes_[shape].outline;
  }
  [[nodiscard]] const geom::GridBox& box(ShapeIndex shape) const noexcept { return shapes_[shape].box; }

  /// Cost of put() and take(): O(cells under the body's box). Indices of bodies taken out are used again, the
  /// last one first, so putting a body back undoes taking it.
  BodyIndex put(const Body& body);
  void take(BodyIndex body);
  /// \pre the body was put in and not taken out
  [[nodiscard]] const Body& body(BodyIndex index) const noexcept { return bodies_[index]; }

  /// Returns the largest gap of all bodies that were ever put in, in steps.
  [[nodiscard]] std::int64_t widest_gap() const noexcept { return widest_gap_; }

  /// Says whether anything forbids the probe's place.
  [[nodiscard]] bool forbidden(const Probe& probe) const;
  /// Returns everything that forbids it, ascending.
  [[nodiscard]] std::vector<BodyIndex> forbidding(const Probe& probe) const;
  /// Does the same into `found`, whose room is used again.
  void forbidding(const Probe& probe, std::vector<BodyIndex>& found) const;
  /// Returns the bodies whose boxes come within `reach` of `box`, of these layers, ascending. A container
  /// always counts as near.
  [[nodiscard]] std::vector<BodyIndex> near(const geom::GridBox& box, std::int64_t reach,
                                            std::uint32_t layers) const;
  /// Returns the bodies with material at p, ascending; containers are not asked.
  [[nodiscard]] std::vector<BodyIndex> at(geom::GridPoint p, std::uint32_t layers) const;

  /// Returns the body whose edges are nearest to the probe's, of those that the question is about. Containers
  /// do not count, nor does what is further away than `within` steps. A body that overlaps counts as nearest
  /// of all, and of equals the one with the lower index does. The result is kNoBody where there is none. Gaps
  /// do not matter. Cost: edge_distance with those whose boxes are nearer than the answer.
  [[nodiscard]] NearestBody nearest(const Probe& probe, std::int64_t within) const;

  /// Returns all memory in use. Cost: O(shapes + remembered pairs).
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Memory;  ///< the findings of questions
  struct Shape {
    geom::GridRegion outline;
    geom::GridBox box;
    /// Outlines that differ by no more than a shift have one form.
    std::uint32_t form;
    /// True for an axis-parallel rectangle.
    bool is_box;
  };
  /// A body as questions read it.
  struct Placed {
    geom::GridBox box;
    std::int64_t gap, rank;
    std::uint32_t form;
    /// 0 for containers and where no body is.
    std::uint32_t layers;
    /// The last question that looked at it.
    mutable std::uint32_t question;
    /// True for an axis-parallel rectangle.
    bool is_box;
  };
  /// The first and last columns and rows of a box of cells.
  struct Cells {
    std::int32_t left, right, bottom, top;
  };
  /// The bodies of a cell, in a chain of these.
  struct Cell {
    std::uint32_t count = 0, next = 0;
    std::array<BodyIndex, 6> bodies;
  };
  struct Question;
  using Blockers = std::array<BodyIndex, 16>;

  [[nodiscard]] Question question(const Probe& probe) const;
  /// Says whether a question is about a body that is no further from the probe's box than all gaps.
  [[nodiscard]] static bool is_in_reach(const Placed& body, const Question& question) noexcept;
  [[nodiscard]] bool forbids(const Placed& body, const Question& question) const;
  [[nodiscard]] bool container_forbids(BodyIndex index, const Question& question) const;
  [[nodiscard]] bool pair_forbids(std::uint32_t fixed, std::uint32_t moving, geom::GridPoint shift,
                                  std::int64_t gap, bool container) const;
  /// Calls visit(index) for every body in the cells that the box meets with accept(placed), once each. Stops
  /// when visit returns true.
  template <class Accept, class Visit>
  bool visit_near(const geom::GridBox& box, std::uint32_t question, Accept&& accept, Visit&& visit) const;
  template <class Accept, class Visit>
  bool visit_cell(std::size_t cell, std::uint32_t question, Accept&& accept, Visit&& visit) const;
  [[nodiscard]] std::uint32_t next_question() const;
  /// Says whether a point inside the probe lies in a cell that a body covers, and that body forbids.
  [[nodiscard]] bool lies_on_covered(const Question& question) const;
  void cover(BodyIndex index, BodyIndex from, BodyIndex to);
  /// Returns the cells that a box meets. A place outside the world counts to the cells at its edge.
  [[nodiscard]] Cells cells_of(const geom::GridBox& box) const noexcept;
  void add_to_cell(std::size_t cell, BodyIndex index);
  void remove_from_cell(std::size_t cell, BodyIndex index);

  geom::GridBox world_;
  /// The cells in a step.
  double per_step_ = 0;
  std::int32_t columns_ = 1, rows_ = 1;
  /// The cells row by row, then those that hold what did not fit.
  std::vector<Cell> cells_;
  std::uint32_t free_cell_ = 0;
  std::vector<Shape> shapes_;
  std::vector<Body> bodies_;
  std::vector<Placed> placed_;
  /// By body and by the direction it is asked to go: the body that forbade it lately.
  mutable std::vector<Blockers> blockers_;
  /// The small cells in a step.
  double small_per_step_ = 0;
  std::int32_t small_columns_ = 0, small_rows_ = 0;
  /// By small cell: a body that has material all over it, or none.
  std::vector<BodyIndex> covered_by_;
  std::vector<char> is_in_;
  std::vector<BodyIndex> free_;
  std::vector<BodyIndex> containers_;
  /// The widest gap of all bodies that were ever put in.
  std::int64_t widest_gap_ = 0;
  mutable std::uint32_t question_ = 0;
  std::unique_ptr<Memory> memory_;
};

}  // namespace lekalo::phi
