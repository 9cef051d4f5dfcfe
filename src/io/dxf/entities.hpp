#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blocks.hpp"
#include "groups.hpp"
#include "io/drawing/drawn_shapes.hpp"
#include "io/text/decimal.hpp"
#include "layers.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "pens.hpp"

namespace lekalo::io {

/// The groups of a file with the one that is looked at.
class DxfCursor {
 public:
  DxfCursor(std::string_view bytes, const std::string& name) : name_(name), groups_(bytes, name) {}

  /// False at the end of the file and at a fault.
  bool next() { return ok_ = groups_.next(group_); }
  [[nodiscard]] bool ok() const { return ok_; }
  /// The error of a text that ends or breaks inside of something that began at this line. \pre not ok()
  [[nodiscard]] Error broken_off(std::size_t begin, std::string_view what) const;
  /// The fault of the text; nothing when it simply ended.
  [[nodiscard]] const std::optional<Error>& fault() const { return groups_.fault(); }

  [[nodiscard]] int code() const { return group_.code; }
  [[nodiscard]] std::string_view value() const { return group_.value; }
  [[nodiscard]] std::size_t line() const { return group_.line; }
  [[nodiscard]] bool at(int code, std::string_view value) const {
    return group_.code == code && group_.value == value;
  }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  const std::string& name_;
  DxfGroups groups_;
  DxfGroup group_;
  bool ok_ = true;
};

/// Reads entities into blocks; its functions stand in entities.cpp, conics.cpp, polyline.cpp, spline.cpp,
/// mline.cpp, hatch.cpp and texts.cpp.
class DxfEntities {
 public:
  DxfEntities(DxfCursor& cursor, DxfLayers& layers, DxfPens& pens, DecimalFactor unit)
      : at_(cursor), layers_(layers), pens_(pens), unit_(unit) {}

  /// Reads an entity, or sets it aside with its sentence where it is damaged; fails where the drawing has too
  /// many curves.
  /// \pre the cursor is at the name of an entity (group code 0); afterwards it is at the next group with code
  /// 0, or not ok(), and then what was read does not count
  [[nodiscard]] Result<void> read(DxfBlock& into);

  /// Notes which entities of a block its solid hatches fill.
  void note_fills(const DxfBlock& block);

  /// The sentences about entities that were set aside.
  [[nodiscard]] std::vector<std::string>& damaged() { return damaged_; }

  /// The number that the cursor is at, in millimetres if it is a length.
  [[nodiscard]] Result<Millimetres> number(bool is_length) const;

  [[nodiscard]] std::vector<DrawnEntity>& entities() { return entities_; }
  /// True when something that was read does not lie at z = 0.
  [[nodiscard]] bool has_heights() const { return has_heights_; }

 private:
  /// The groups that every entity may have.
  struct Common {
    std::string_view type, handle, layer, line_type;
    DxfColour colour;
    std::size_t line = 0;
    bool paper_space = false, invisible = false, in_application = false;
    double normal[3] = {0, 0, 1};
  };

  /// A number that a kind of entity has.
  struct Wanted {
    int code = 0;
    bool is_length = false;
    bool is_needed = false;
  };
  /// Numbers of an entity by group code.
  class Numbers {
   public:
    [[nodiscard]] bool has(int code) const { return known_[static_cast<std::size_t>(code)]; }
    [[nodiscard]] Millimetres get(int code, Millimetres otherwise = {}) const {
      return has(code) ? values_[static_cast<std::size_t>(code)] : otherwise;
    }
    [[nodiscard]] BoundedPoint point(int x, int y) const;
    void set(int code, Millimetres value);

   private:
    static constexpr std::size_t kCodes = 80;
    std::bitset<kCodes> known_;
    Millimetres values_[kCodes];
  };

  struct Vertex {
    BoundedPoint at;
    Millimetres bulge;
  };

  Result<void> read_kind(DxfBlock& into);
  void set_aside(DxfBlock& into, const Error& why);
  Result<void> read_line(DxfBlock& into);
  Result<void> read_circle(DxfBlock& into);
  Result<void> read_arc(DxfBlock& into);
  Result<void> read_ellipse(DxfBlock& into);
  Result<void> read_lwpolyline(DxfBlock& into);
  Result<void> read_polyline(DxfBlock& into);
  Result<void> read_vertices(unsigned flags);
  Result<void> read_spline(DxfBlock& into);
  Result<void> read_fit(std::vector<geom::Point>& points, double& error, geom::Point (&tangents)[2]);
  Result<void> read_mline(DxfBlock& into);
  Result<void> read_insert(DxfBlock& into);
  Result<void> read_hatch(DxfBlock& into);
  Result<void> read_text(DxfBlock& into);
  Result<void> read_mtext(DxfBlock& into);
  Result<void> add_text(DxfBlock& into, DxfText text, double degrees, geom::Point direction, double height);
  Result<void> read_other(DxfBlock& into);

  void begin_entity();
  /// Takes a group that every entity may have, and those that do not concern it; false where it is the
  /// kind's.
  Result<bool> take_common();
  Result<void> read_numbers(const Wanted* first, const Wanted* last, Numbers& numbers);
  template <std::size_t N>
  Result<void> read_numbers(const Wanted (&wanted)[N], Numbers& numbers) {
    return read_numbers(wanted, wanted + N, numbers);
  }
  [[nodiscard]] Result<unsigned> whole_number() const;
  void note_height();

  [[nodiscard]] tl::unexpected<Error> refuse_entity(const std::string& sentence) const;
  /// True when the entity draws nothing in the model space; it is counted then.
  bool is_out_of_sight(DxfBlock& into);
  void count_unread(DxfBlock& into, const char* why) const;
  [[nodiscard]] std::uint32_t pen();
  /// The map from the plane of the entity, at this height above its origin, to that of the drawing; nothing
  /// where the plane is seen from the side.
  [[nodiscard]] std::optional<Affine> plane(double height) const;
  Result<void> add(DxfBlock& into, const Affine& plane, BoundedShape shape);
  Result<void> add_polyline(DxfBlock& into, const Affine& plane, bool closed);

  DxfCursor& at_;
  DxfLayers& layers_;
  DxfPens& pens_;
  DecimalFactor unit_;
  std::vector<DrawnEntity> entities_;
  Common common_;
  bool has_entity_ = false;  ///< entities_.back() is the one that is read
  std::vector<Vertex> vertices_;
  std::size_t cost_ = 0;  ///< of all curves so far
  std::vector<std::string> damaged_;
  bool has_heights_ = false;
};

}  // namespace lekalo::io
