#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/paper/colour.hpp"
#include "lekalo/draw/solid_picture.hpp"
#include "painting.hpp"

namespace lekalo::draw {

/// The place that decides, in the frame of the blank: the tightest contact, else where most is missing.
struct SolidFocus {
  solid::Vector place;                 ///< of the part
  solid::Vector on_blank;              ///< the nearest point of the blank's surface
  solid::Vector outward;               ///< away from the part's material, of length 1
  double distance = 0;                 ///< mm, negative outside the blank
  std::optional<std::size_t> contact;  ///< its index
};

/// The choices that picture, report and page share.
struct SolidLook {
  explicit SolidLook(const SolidScene& scene);

  solid::Motion motion;
  PaintedPart part;  ///< in the frame of the blank
  PaintedBlank blank;
  ColourRange range;
  double least = 0, greatest = 0;  ///< allowances, mm; without them 0
  double size = 0;                 ///< of part and blank together, mm
  int decimals = 6;                ///< of the placement
  int table_decimals = 4;          ///< of measured lengths
  std::optional<SolidFocus> focus;
  /// The contacts of a part that is inside, and their places on the part.
  std::vector<locate::SolidTouch> touches;
  std::vector<solid::Vector> contacts;

  /// The direction of a contact from the part to the blank, of length 1.
  [[nodiscard]] solid::Vector outward(std::size_t contact) const;
  /// True if the allowance is below the demand anywhere.
  [[nodiscard]] bool missing() const { return missing_; }
  /// True if something of the part is as cast, which has no value.
  [[nodiscard]] bool as_cast() const { return as_cast_; }
  [[nodiscard]] double value_of(double allowance) const {
    return (allowance - range.low) / (range.high - range.low);
  }

 private:
  bool missing_ = false, as_cast_ = false;
};

/// The view in which the focus faces the viewer and nothing of the part is before it, or a usual one.
[[nodiscard]] SpaceView facing(const SolidLook& look);

/// A number that the reader is told of the placement.
struct SolidFigure {
  const char* what;
  std::string value;
  const char* kind;
  bool bad = false;
};
/// Bound, gap, demand, what is missing and unknown, and the pose. Bounds and what is missing are rounded up.
[[nodiscard]] std::vector<SolidFigure> figures_of(const SolidScene& scene, const SolidLook& look);
/// The least allowance as it is printed, rounded down, or that the part is not inside.
[[nodiscard]] std::string clearance_text(const SolidScene& scene, const SolidLook& look);
/// The meaning of the colours of the scale.
[[nodiscard]] const char* scale_words(const SolidScene& scene);
/// A colour and what it stands for.
struct SolidKey {
  Colour colour;
  double alpha = 1;
  std::string words;
  const char* kind;
};
/// Returns the meaning of the colours, but for those of the scale.
[[nodiscard]] std::vector<SolidKey> key_of(const SolidScene& scene, const SolidLook& look);

}  // namespace lekalo::draw
