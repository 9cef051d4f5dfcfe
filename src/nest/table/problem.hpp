#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/nest/nest.hpp"
#include "made_once.hpp"
#include "nest/tuning/tuning.hpp"
#include "nofit.hpp"

namespace lekalo::nest {

/// A layout document as the search sees it, in doubles and mm.

/// A part, mirrored or not, or something of the stock where parts may not lie.
struct SearchShape {
  enum class Kind : std::uint8_t { part, border, defect, zone };
  Kind kind = Kind::part;
  SearchOutline whole;
  std::uint32_t part = 0;  ///< index, for shapes of parts
  int level = 0;           ///< severity of a defect, quality of a zone
  /// For shapes of parts, by quality: the areas that need more than a zone of that quality has.
  std::vector<std::pair<int, SearchOutline>> demanding;
  Box window;  ///< for shapes of the stock: the box within which parts can be at all
};

/// A shape at an angle.
struct Form {
  std::uint32_t shape = 0, angle = 0;
  double c = 1, s = 0;
  geom::GridRotation rotation;
  bool mirrored = false;
  Box box;  ///< of the form with its origin at (0, 0)
};

/// Forms that one part may have: the indices [first, last). Upright ones come before mirrored ones.
struct Forms {
  std::uint32_t first = 0, last = 0;
  friend bool operator==(const Forms&, const Forms&) = default;
};

/// Something that does not move: a locked part, a border that is no rectangle, holes, defects or zones.
struct Obstacle {
  std::uint32_t form = 0;
  double x = 0, y = 0;
};

/// One strip, sheet or hide: a rectangle that parts lie in, and obstacles there. A hide has the rectangle
/// around it, and its border is an obstacle.
struct Bin {
  std::uint32_t stock = 0;
  std::int64_t copy = 0;
  Box box;
  bool open = false;  ///< a strip, whose used length is what is sought
  double area = 0;    ///< of its material, mm^2
  bool holds_locked = false;
  /// x and y up to which locked parts reach.
  double locked_reach = -std::numeric_limits<double>::infinity();
  double locked_top = -std::numeric_limits<double>::infinity();
  std::vector<Obstacle> obstacles;
};

struct SearchOptions {
  std::size_t angles_of_any = 24;  ///< of a part that may be turned by any angle
  /// Gives parts the angles at which unlocked placements lie too, if they may have them.
  bool given_angles = false;
  std::size_t cells = tuning::kRasterCells;  ///< about so many in the raster of a table
  Remnant remnant = Remnant::corner;
};

/// The only bin of a problem that is one strip.
inline constexpr std::uint32_t kStrip = 0;

class Problem {
 public:
  /// \param document  outlives the problem; placements that are not locked do not count
  Problem(const layout::Document& document, const SearchOptions& options)
      : Problem(document, document, options) {}
  /// \param searched  outlives the problem: the document with outlines that hold those of `document`
  Problem(const layout::Document& document, const layout::Document& searched, const SearchOptions& options);

  /// The document as it is searched (with_outer_outlines).
  const layout::Document& document() const noexcept { return *document_; }
  /// The document as it was given: what counts in the end.
  const layout::Document& given() const noexcept { return *given_; }
  const std::vector<Form>& forms() const noexcept { return forms_; }
  /// The form of a part at this rotation; the number of forms where it has none.
  std::uint32_t form_of(std::uint32_t part, geom::GridRotation rotation, bool mirrored) const noexcept;
  /// The forms of a part: of one hand, or all.
  Forms forms_of(std::uint32_t part, std::optional<bool> mirrored = std::nullopt) const noexcept;
  std::uint32_t part_of(const Form& form) const noexcept { return shapes_[form.shape].part; }
  SearchShape::Kind kind_of(const Form& form) const noexcept { return shapes_[form.shape].kind; }
  const std::vector<Bin>& bins() const noexcept { return bins_; }
  Remnant remnant() const noexcept { return options_.remnant; }
  /// One strip is all the stock, and its length is what is sought.
  bool is_strip() const noexcept { return bins_.size() == 1 && bins_[kStrip].open; }
  double area_of(std::uint32_t part) const noexcept { return areas_[part]; }
  double hull_area_of(std::uint32_t part) const noexcept { return hull_areas_[part]; }
  double border_gap_of(std::uint32_t part) const noexcept { return border_gaps_[part]; }
  /// A length, mm, of which all corners of the stock, and of all parts at every angle they may have, are
  /// multiples; 0 where there is none above a micrometre.
  double unit() const noexcept { return unit_; }
  /// True if the grain of a part's form follows that of a bin's stock.
  bool follows_grain(std::uint32_t form, std::uint32_t bin) const noexcept {
    return follows_grain_.empty() || follows_grain_[form * document_->stocks.size() + bins_[bin].stock] != 0;
  }
  /// True if the part's box fits on some stock in one of these forms.
  bool fits_somewhere(std::uint32_t part, const Forms& forms) const noexcept;
  /// How many pieces are locked, by part.
  const std::vector<layout::PieceCount>& locked_pieces() const noexcept { return locked_pieces_; }
  /// The widest gap that may count between any two shapes, mm.
  double widest_gap() const noexcept { return widest_gap_; }

  /// How deep form b at a shift of (dx, dy) from form a lies in it.
  double depth(const Form& a, const Form& b, double dx, double dy) const {
    if (a.shape <= b.shape) return table(a, b).depth(a.c * dx + a.s * dy, a.c * dy - a.s * dx);
    return table(b, a).depth(-(b.c * dx + b.s * dy), b.s * dx - b.c * dy);
  }
  /// Roughly the area that both have in common, mm^2; 0 unless both are parts.
  double common_area(const Form& a, const Form& b, double dx, double dy) const {
    if (a.shape <= b.shape) return table(a, b).common_area(a.c * dx + a.s * dy, a.c * dy - a.s * dx);
    return table(b, a).common_area(-(b.c * dx + b.s * dy), b.s * dx - b.c * dy);
  }
  /// The depth as of depth(), and the direction in which b gets free.
  NoFit::Way way_out(const Form& a, const Form& b, double dx, double dy) const;

 private:
  /// The tables of a pair of shapes, by difference of angles. Each is made when it is first asked for.
  using Row = std::vector<MadeOnce<const NoFit>>;
  const NoFit& table(const Form& a, const Form& b) const {
    const std::size_t pair = std::size_t{a.shape} * shapes_.size() + b.shape;
    const std::size_t relative = relative_[a.angle * angles_.size() + b.angle];
    if (const Row* row = rows_[pair].find())
      if (const NoFit* found = (*row)[relative].find()) return *found;
    return make_table(pair, relative, a, b);
  }
  const NoFit& make_table(std::size_t pair, std::size_t relative, const Form& a, const Form& b) const;
  void add_parts();
  void add_bins();
  void add_locked();
  void find_unit();
  void find_grain();
  void add_stock_obstacles(std::uint32_t stock, Bin& bin);
  void add_relative_angles();
  std::uint32_t obstacle_form(SearchShape::Kind kind, int level, SearchOutline shape);
  std::uint32_t angle_index(geom::GridRotation rotation);
  void add_form(std::uint32_t shape, geom::GridRotation rotation, bool mirrored);

  const layout::Document *document_, *given_;
  SearchOptions options_;
  std::vector<SearchShape> shapes_;
  std::vector<Form> forms_;
  std::vector<Forms> by_part_;
  std::vector<Bin> bins_;
  std::vector<double> areas_, hull_areas_, border_gaps_;
  std::vector<layout::PieceCount> locked_pieces_;
  double widest_gap_ = 0, unit_ = 0;
  std::vector<char> follows_grain_;  ///< by form and stock; empty where every form does on every stock
  std::vector<geom::GridRotation> angles_;
  std::vector<std::uint32_t> relative_;
  std::vector<std::pair<double, double>> relative_pairs_;
  std::size_t relative_count_ = 1, cells_ = 0;
  mutable std::vector<MadeOnce<Row>> rows_;  ///< by pair of shapes
};

}  // namespace lekalo::nest
