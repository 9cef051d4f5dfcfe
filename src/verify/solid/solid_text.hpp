#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solid_mesh.hpp"

namespace lekalo::verify {

/// Collects what a reader finds in a file.
class SolidMaker {
 public:
  SolidMaker(const Document& document, SolidUnit unit) : document_(document) { reading_.unit = unit; }

  [[nodiscard]] const Document& document() const { return document_; }
  [[nodiscard]] std::size_t vertices() const { return reading_.mesh.near.size(); }
  [[nodiscard]] std::size_t triangles() const { return reading_.mesh.triangles.size(); }

  /// Returns the sentence of refusal for the three numbers of a text, or none.
  [[nodiscard]] std::optional<std::string> add_vertex(const std::string_view* words);
  [[nodiscard]] std::optional<std::string> add_vertex(const std::array<double, 3>& xyz);
  [[nodiscard]] std::optional<std::string> add_vertex(std::array<Decimal, 3> numbers) {
    return add(std::move(numbers));
  }
  [[nodiscard]] std::optional<std::string> add_triangle(const std::array<std::uint32_t, 3>& corners);
  /// The triangles that follow have this name.
  void begin_group(std::string_view name);
  /// The last triangle is of a face of a STEP file.
  void set_face(std::uint32_t face) { reading_.face_of.push_back(face); }
  void add_colour(std::uint32_t colour) { reading_.colours.push_back(colour); }
  void set_deviation(Decimal millimetres) { reading_.deviation = std::move(millimetres); }
  [[nodiscard]] SolidUnit unit() const { return reading_.unit; }
  /// The file says it.
  void set_unit(SolidUnit unit) { reading_.unit = unit; }
  /// Gives the file up: it is not read any further.
  void leave_open(std::string sentence) { reading_.open = std::move(sentence); }
  [[nodiscard]] bool is_open() const { return reading_.open.has_value(); }

  [[nodiscard]] SolidReading take() { return std::move(reading_); }

 private:
  [[nodiscard]] std::optional<std::string> add(std::array<Decimal, 3> numbers);
  [[nodiscard]] std::optional<std::string> add_near(const std::array<double, 3>& millimetres);

  const Document& document_;
  SolidReading reading_;
  std::map<std::string, std::size_t> numbers_;  ///< of groups
  std::uint32_t group_ = 0;
};

/// Cuts a line at blanks.
void split(std::string_view line, std::vector<std::string_view>& words);

[[nodiscard]] Result<void> read_ply(SolidMaker& made);
[[nodiscard]] Result<void> read_three_mf(SolidMaker& made);

}  // namespace lekalo::verify
