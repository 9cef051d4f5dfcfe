#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/limits.hpp"
#include "solid_clearance.hpp"
#include "verify/pocket/program_check.hpp"
#include "verify/read/fields.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

/// The fields of a result for solids (docs/formats.md).

struct WrittenSolid {
  SolidUnit unit = SolidUnit::millimetre;
  std::size_t triangles = 0;
  std::optional<Decimal> deviation = std::nullopt;
};

/// Points that the blank's mesh was made from.
struct WrittenPoints {
  SolidUnit unit = SolidUnit::millimetre;
  std::size_t count = 0;
};

enum class SolidFreedom : std::uint8_t { xyz, c_xyz, six };

/// The poses that were looked at.
struct SolidWindow {
  SolidFreedom freedom = SolidFreedom::six;
  SolidPose start;
  std::array<Decimal, 3> pivot;
  Decimal shift, turn_deg;
};

struct WrittenSolidContact {
  SolidContact points;
  /// Their numbers in the files, from 0.
  std::size_t part_triangle{}, blank_triangle{};
};

/// The statements of the result about a blank that was touched, and why they hold it (docs/formats.md).
struct WrittenTouches {
  struct Term {
    std::size_t touch{}, ball{};
    Decimal multiplier;
  };
  struct Cut {
    std::size_t axis{};  ///< x, y, z, turn_x, turn_y, turn_z
    bool above = false;
    Decimal at;
    std::vector<Term> terms;
  };
  struct Way {
    std::size_t corner = 0;
    Decimal multiplier;
    Cut cut;
  };
  Decimal ball, form;
  bool directions = false;
  std::array<Decimal, 3> pivot;
  std::array<Decimal, 4> quaternion;
  std::array<std::array<Decimal, 2>, 6> box;
  std::vector<std::array<Decimal, 4>> balls;
  std::vector<Cut> cuts;
  SolidPose moved;
  std::array<std::array<Decimal, 3>, 2> around;
  std::vector<Way> ways;
};

/// The statements of the result about a blank from a scanner.
struct WrittenSolidScan {
  struct Underside {
    Decimal z, flat;
  };
  Decimal guard;
  std::optional<Decimal> min_radius, max_dip;  ///< at least one is there, or touches
  std::optional<Underside> underside;
  std::optional<WrittenTouches> touches;
  Decimal widest;
  std::size_t unknown_triangles = 0;
  bool proved = false;
  /// The numbers of points that count as none of the surface.
  std::vector<std::size_t> left_out;
};

/// The statements of the result about a file of features.
struct WrittenSolidDemands {
  struct Feature {
    std::string name;
    std::size_t triangles = 0;
    std::optional<Decimal> minimum, scale;  ///< of what is neither as cast nor finished
    bool as_cast = false;
    /// The first of one with a maximum, the second of one that is finished, and the last of both.
    std::optional<Decimal> maximum = std::nullopt, finished = std::nullopt, largest = std::nullopt;
    /// One that is finished may have it.
    std::optional<Decimal> rim = std::nullopt;
    /// One with a demand may have it.
    std::optional<Decimal> target = std::nullopt;
  };
  struct Datum {
    std::string name;
    Decimal within, off;
    /// One that is not kept has it.
    std::optional<Decimal> missed = std::nullopt;
  };
  std::optional<Decimal> minimum;
  std::vector<Feature> features;
  std::vector<Datum> datums;
  std::optional<Decimal> margin, bound, gap;
};

/// The statements of the result about how its placement was chosen.
struct WrittenSolidChoice {
  bool even = false;
  Decimal give_up;
  std::optional<Decimal> margin_found, largest;  ///< both, or neither
  /// With `even` likewise, and else neither.
  std::optional<Decimal> largest_found = std::nullopt, deviation = std::nullopt;
};

struct SolidDocument {
  std::string status;
  WrittenSolid part, blank;
  std::optional<WrittenPoints> points;
  std::optional<WrittenSolid> nominal;
  SolidWindow window;
  SolidPose pose;
  bool inside = false;
  std::optional<Decimal> clearance, upper_bound, gap, shortfall;
  Decimal min_allowance, unknown_area;
  std::vector<WrittenSolidContact> contacts;
  std::optional<WrittenSolidScan> scan;
  std::optional<WrittenSolidDemands> demands;
  std::optional<WrittenSolidChoice> choice;
  /// The certificate where the result itself holds it, else null.
  Json certificate;
  /// The number of boxes that the result states of the certificate's file.
  std::optional<std::size_t> boxes_in_file;
  std::optional<WrittenNc> nc;
};

/// Reads a result. bad_input names the document, where a field is missing or is not what docs/formats.md
/// says.
[[nodiscard]] Result<SolidDocument> read_solid_document(Json written, const std::string& name);

/// Returns the certificate of a certificate file.
[[nodiscard]] Result<Json> read_solid_certificate_document(const Document& document);

/// Says what is false of how the placement is said to be chosen, but for its allowances.
[[nodiscard]] std::vector<std::string> faults_of_choice(const SolidDocument& document);

/// Says whether a number is larger than any that a result may have.
[[nodiscard]] bool is_beyond_all_sizes(const Decimal& value);

/// Reads a list of so many numbers, none beyond limits::kLargestDerived; complains, and returns nothing,
/// where it is another one. `name` makes the list's name for that.
template <std::size_t Count, class Name>
[[nodiscard]] std::optional<std::array<Decimal, Count>> numbers_of(Json list, std::string& complaint,
                                                                   const Name& name) {
  std::array<Decimal, Count> numbers;
  std::size_t count = 0;
  if (list.is_array()) {
    JsonItems items(list);
    while (const auto item = items.next()) {
      auto number = item->is_number() ? parse_decimal(item->text) : std::nullopt;
      if (!number || count == Count || is_beyond_all_sizes(*number)) {
        count = Count + 1;
        break;
      }
      numbers[count++] = *std::move(number);
    }
  }
  if (count == Count) return numbers;
  if (complaint.empty())
    complaint =
        fmt::format("{} is not a list of {} numbers within {:g}", name(), Count, limits::kLargestDerived);
  return std::nullopt;
}

}  // namespace lekalo::verify
