#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/phi/outline_relation.hpp"

namespace lekalo::phi {

/// The collision engine: many bodies on one piece of stock, asked again and again. Same answers as
/// phi/outline_relation.hpp, found faster. docs/design/scene.md.
///
/// A *shape* is an outline turned for good and moved freely; a *body* is a shape at a place. Bodies forbid:
/// others may not overlap them, or, for a `container`, may not reach out of it; and they keep a gap. No
/// exceptions, threads or library mathematics, so that it runs in a browser as it is. Questions remember what
/// they find out: ask one scene from one thread at a time. Copies answer alike and remember for themselves.
using ShapeIndex = std::uint32_t;
using BodyIndex = std::uint32_t;
inline constexpr BodyIndex kNoBody = ~BodyIndex{0};

struct Body {
  ShapeIndex shape = 0;
  geom::GridPoint at = {};
  std::int64_t gap = 0;      ///< the larger of both bodies' gaps counts between them
  std::uint32_t layers = 1;  ///< met only by questions with a layer in common
  std::int64_t rank = 1;     ///< and only by questions that tolerate less
  bool container = false;    ///< the complement of the outline is what is forbidden
};

/// A question asks about a probe: a shape at a place.
struct Probe {
  ShapeIndex shape = 0;
  geom::GridPoint at = {};
  std::int64_t gap = 0;
  std::uint32_t layers = 1;
  std::int64_t tolerates = 0;
  BodyIndex except = kNoBody;  ///< a body that does not count: itself
};

struct NearestBody {
  BodyIndex body = kNoBody;
  bool overlaps = false;  ///< then how deep: phi/separation.hpp
  EdgeDistance edges;     ///< on_a on the body, on_b on the probe
};

class Scene {
 public:
  /// \param world  where most bodies will lie; others cost more, and count all the same
  /// \param cells  about how many cells its index has; a few for each body is right
  Scene(const geom::GridBox& world, std::size_t cells);
  ~Scene();
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(Scene other) noexcept;

  /// The outline counts as it is, around its own origin. \pre made by make_grid_region or turned()
  ShapeIndex add_shape(geom::GridRegion outline);
  [[nodiscard]] const geom::GridRegion& outline(ShapeIndex shape) const noexcept {
    return shapes_[shape].outline;
  }
  [[nodiscard]] const geom::GridBox& box(ShapeIndex shape) const noexcept { return shapes_[shape].box; }

  /// Cost of both: O(cells under the body's box). Indices of bodies taken out are used again, the last one
  /// first: putting a body back undoes taking it.
  BodyIndex put(const Body& body);
  void take(BodyIndex body);
  /// \pre put and not taken
  [[nodiscard]] const Body& body(BodyIndex index) const noexcept { return bodies_[index]; }

  /// The largest gap of all bodies ever put, in steps.
  [[nodiscard]] std::int64_t widest_gap() const noexcept { return widest_gap_; }

  /// The answer says whether anything forbids the probe's place.
  [[nodiscard]] bool forbidden(const Probe& probe) const;
  /// Everything that does, ascending.
  [[nodiscard]] std::vector<BodyIndex> forbidding(const Probe& probe) const;
  /// Likewise, into `found`, whose room is used again.
  void forbidding(const Probe& probe, std::vector<BodyIndex>& found) const;
  /// Bodies whose boxes come within `reach` of `box`, of these layers, ascending; a container always does.
  [[nodiscard]] std::vector<BodyIndex> near(const geom::GridBox& box, std::int64_t reach,
                                            std::uint32_t layers) const;
  /// Bodies with material at p, ascending; containers are not asked.
  [[nodiscard]] std::vector<BodyIndex> at(geom::GridPoint p, std::uint32_t layers) const;

  /// The body whose edges are nearest to the probe's, of those the question is about, containers aside, not
  /// further than `within` steps; one that overlaps counts as nearest of all, of equals the one with the
  /// lower index. kNoBody where there is none. Gaps do not matter. Cost: edge_distance with those whose boxes
  /// are nearer than the answer.
  [[nodiscard]] NearestBody nearest(const Probe& probe, std::int64_t within) const;

  /// Memory in use, all of it. Cost: O(shapes + remembered pairs).
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Memory;  ///< what questions found out
  struct Shape {
    geom::GridRegion outline;
    geom::GridBox box;
    std::uint32_t form;  ///< equal for outlines that differ by a shift
    bool is_box;         ///< an axis-parallel rectangle
  };
  /// A body as questions read it.
  struct Placed {
    geom::GridBox box;
    std::int64_t gap, rank;
    std::uint32_t form;
    std::uint32_t layers;            ///< 0 for containers and where no body is
    mutable std::uint32_t question;  ///< the last one that looked at it
    bool is_box;                     ///< an axis-parallel rectangle
  };
  /// Columns and rows of cells, ends included.
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
  /// A body is in reach when the question is about it and it is not further from the probe's box than all
  /// gaps.
  [[nodiscard]] static bool is_in_reach(const Placed& body, const Question& question) noexcept;
  [[nodiscard]] bool forbids(const Placed& body, const Question& question) const;
  [[nodiscard]] bool container_forbids(BodyIndex index, const Question& question) const;
  [[nodiscard]] bool pair_forbids(std::uint32_t fixed, std::uint32_t moving, geom::GridPoint shift,
                                  std::int64_t gap, bool container) const;
  /// visit(index) of every body in the cells that the box meets and with accept(placed), once each; stops
  /// when it returns true.
  template <class Accept, class Visit>
  bool visit_near(const geom::GridBox& box, std::uint32_t question, Accept&& accept, Visit&& visit) const;
  template <class Accept, class Visit>
  bool visit_cell(std::size_t cell, std::uint32_t question, Accept&& accept, Visit&& visit) const;
  [[nodiscard]] std::uint32_t next_question() const;
  /// The answer says whether a point inside the probe lies in a cell that a body covers, and that body
  /// forbids.
  [[nodiscard]] bool lies_on_covered(const Question& question) const;
  void cover(BodyIndex index, BodyIndex from, BodyIndex to);
  /// The cells a box meets; what lies outside the world counts to the cells at its edge.
  [[nodiscard]] Cells cells_of(const geom::GridBox& box) const noexcept;
  void add_to_cell(std::size_t cell, BodyIndex index);
  void remove_from_cell(std::size_t cell, BodyIndex index);

  geom::GridBox world_;
  double per_step_ = 0;  ///< cells in a step
  std::int32_t columns_ = 1, rows_ = 1;
  std::vector<Cell> cells_;  ///< row by row, then what did not fit
  std::uint32_t free_cell_ = 0;
  std::vector<Shape> shapes_;
  std::vector<Body> bodies_;
  std::vector<Placed> placed_;
  /// By body and the direction it is asked to go: the one that forbade it lately.
  mutable std::vector<Blockers> blockers_;
  double small_per_step_ = 0;  ///< small cells in a step
  std::int32_t small_columns_ = 0, small_rows_ = 0;
  std::vector<BodyIndex> covered_by_;  ///< by small cell: one that has material all over it, or none
  std::vector<char> is_in_;
  std::vector<BodyIndex> free_;
  std::vector<BodyIndex> containers_;
  std::int64_t widest_gap_ = 0;  ///< of all bodies ever put
  mutable std::uint32_t question_ = 0;
  std::unique_ptr<Memory> memory_;
};

}  // namespace lekalo::phi
