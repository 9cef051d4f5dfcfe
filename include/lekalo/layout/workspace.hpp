#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "lekalo/layout/check.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/layout/feature.hpp"
#include "lekalo/phi/scene.hpp"

namespace lekalo::layout {

/// One copy of one stock.
struct Sheet {
  std::uint32_t stock = 0;
  std::int64_t copy = 0;
  friend auto operator<=>(const Sheet&, const Sheet&) = default;
};

/// The layers of the scenes below.
inline constexpr std::uint32_t kPartLayer = 1, kBorderLayer = 2, kDefectLayer = 4, kZoneLayer = 8;

/// A document and what answers questions about it at once: every sheet's scene, kept in step with the
/// placements and features. It says the same as check() of the same document. One thread may use it at a
/// time, questions too, because they fill caches. The cost of a change is that of putting one body; a feature
/// costs one body on every copy of its stock.
class Workspace {
 public:
  /// \pre read or made as documents must be (io/layout_json.hpp refuses others)
  explicit Workspace(Document document);

  [[nodiscard]] const Document& document() const noexcept { return document_; }
  /// Returns the placement with this id, or none. Cost: O(log n).
  [[nodiscard]] const Placement* find(std::uint64_t id) const noexcept;
  /// Returns the ids of the parts at a point of a sheet, edges included, ascending.
  [[nodiscard]] std::vector<std::uint64_t> at(Sheet sheet, geom::GridPoint p) const;

  /// Adds or replaces the placement with this id.
  void set(const Placement& placement);
  void erase(std::uint64_t id);
  void set_next_id(std::uint64_t id) noexcept { document_.next_id = id; }

  /// Adds or replaces a feature, as put_feature() does.
  void set_feature(std::uint32_t stock, std::uint32_t index, const Feature& feature);
  /// \pre the feature is there
  void erase_feature(std::uint32_t stock, FeatureKind kind, std::string_view id);
  /// Returns the violations of all parts with one feature, on all copies of its stock, in the order of
  /// check(). Cost: O(placements), and the check of those near it.
  /// \pre the feature is there
  [[nodiscard]] std::vector<Violation> violations_with(std::uint32_t stock, FeatureKind kind,
                                                       std::uint32_t index,
                                                       Depths depths = Depths::measured) const;

  /// Says whether these placements, in place of those with their ids, break no rule, neither against all
  /// others nor among themselves. Their ids need not exist.
  [[nodiscard]] bool is_clear(std::span<const Placement> placements) const;
  /// Returns every violation that one of the placements would have a part in, each in place of the placement
  /// with its id, in the order of check().
  [[nodiscard]] std::vector<Violation> violations_of(std::span<const Placement> placements,
                                                     Depths depths = Depths::measured) const;

  /// Returns the scene that a sheet's bodies lie in; shape() returns a part turned. Both are made when they
  /// are first asked for.
  [[nodiscard]] const phi::Scene& scene(Sheet sheet) const;
  [[nodiscard]] phi::ShapeIndex shape(Sheet sheet, const Placement& placement) const;
  /// Returns the id of a body's placement; 0 for stock, defects and zones.
  [[nodiscard]] std::uint64_t placement_of(Sheet sheet, phi::BodyIndex body) const;
  /// Returns the index of the defect or zone that a body is.
  /// \pre it is one
  [[nodiscard]] std::uint32_t feature_of(Sheet sheet, phi::BodyIndex body) const;
  /// Returns the gap between a part and a body of the scene that it would lie in, in steps.
  [[nodiscard]] std::int64_t gap_to(const Part& part, Sheet sheet, phi::BodyIndex body) const;

  /// Does what Scene::near does, in an order that follows from the document alone: what belongs to the stock,
  /// then parts by id. Indices of bodies depend on what came and went before, and a command must not.
  [[nodiscard]] std::vector<phi::BodyIndex> near(Sheet sheet, const geom::GridBox& box, std::int64_t reach,
                                                 std::uint32_t layers) const;
  /// Puts bodies of a scene into that order.
  void sort_bodies(Sheet sheet, std::vector<phi::BodyIndex>& bodies) const;

  /// Says whether a body counts for a part: a defect that it does not tolerate, or a zone too bad for some of
  /// it.
  [[nodiscard]] bool concerns(const Part& part, Sheet sheet, phi::BodyIndex body) const;

  /// Takes placements out of their scenes while it lives, so that only the others forbid. They are put back
  /// also when there is no memory left, for that takes none.
  class Lifted;
  /// Says whether one placement breaks no rule against what lies in its scene now: whether both of the
  /// following hold.
  [[nodiscard]] bool is_clear_of_scene(const Placement& placement) const {
    return may_be_so(placement) && has_room(placement);
  }
  /// Says whether the placement keeps the rules that do not ask where it lies: sheet, angle, mirror, grain.
  [[nodiscard]] bool may_be_so(const Placement& placement) const;
  /// Says whether it keeps those that do.
  [[nodiscard]] bool has_room(const Placement& placement) const;

 private:
  using BodyOfPlacement = std::map<std::uint64_t, phi::BodyIndex>;
  struct SheetScene {
    explicit SheetScene(const geom::GridBox& world, std::size_t cells) : scene(world, cells) {}
    phi::Scene scene;
    std::map<std::tuple<std::uint32_t, std::int64_t, std::int64_t, bool>, phi::ShapeIndex> shapes;
    BodyOfPlacement bodies;
    /// By body; 0 for what belongs to the stock.
    std::vector<std::uint64_t> placements;
    /// By body: the index of the defect or zone.
    std::vector<std::uint32_t> features;
    std::array<std::vector<phi::BodyIndex>, 2> drawn;  ///< by kind of feature and index
    /// The number of shapes of features that were changed or taken.
    std::size_t old_shapes = 0;
  };
  [[nodiscard]] SheetScene& sheet_scene(Sheet sheet) const;
  phi::ShapeIndex shape_in(SheetScene& in, const Placement& placement) const;
  void put(SheetScene& in, const Placement& placement) const;
  /// Returns the entry of the body that was taken out, which still says where it was.
  static BodyOfPlacement::node_type take(SheetScene& in, std::uint64_t id);
  void put_feature_body(SheetScene& in, const Feature& feature, std::uint32_t index) const;
  void number_features(SheetScene& in, FeatureKind kind, std::size_t from) const;
  void forget_old_shapes(Sheet sheet);

  Document document_;
  /// The caches: what they hold follows from the document.
  mutable std::map<Sheet, SheetScene> scenes_;
};

class Workspace::Lifted {
 public:
  Lifted(const Workspace& workspace, std::span<const std::uint64_t> ids);
  ~Lifted();
  Lifted(const Lifted&) = delete;
  Lifted& operator=(const Lifted&) = delete;

 private:
  struct Taken {
    SheetScene* in;
    phi::Body body;
    BodyOfPlacement::node_type entry;
  };
  std::vector<Taken> taken_;
};

}  // namespace lekalo::layout
