#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/decimal.hpp"
#include "lekalo/base/error.hpp"

namespace lekalo::io {

enum class PlyScalar : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::float32;
  std::optional<PlyScalar> count;  ///< of a list
};
struct PlyElement {
  std::string name;
  std::uint64_t rows = 0;
  std::vector<PlyProperty> properties;
};

/// A vertex of a PLY, scaled to millimetres.
struct PlyPoint {
  double xyz[3] = {0, 0, 0};
  double error = 0;  ///< of each coordinate, mm
};

/// A PLY file from front to back (Turk 1994: ascii, binary_little_endian, binary_big_endian, version 1.0).
/// The rows of an element can be read or skipped once, after those of the elements before it. Rows are
/// counted from 0. A count in the header is believed as far as there are bytes for it.
///
/// Everything fails with bad_input and a sentence that names the file, and the line or the row.
class PlyFile {
 public:
  /// \pre both outlive this
  PlyFile(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  [[nodiscard]] Result<void> read_header();
  [[nodiscard]] const std::vector<PlyElement>& elements() const noexcept { return elements_; }
  /// The comments of the header, without the word and the blanks around them.
  [[nodiscard]] const std::vector<std::string_view>& comments() const noexcept { return comments_; }
  /// The element called so; none: nullptr.
  [[nodiscard]] const PlyElement* element(std::string_view name) const noexcept;
  /// No more rows than this can follow, whatever the header says.
  [[nodiscard]] std::size_t most_rows(const PlyElement& element) const noexcept;

  [[nodiscard]] Result<void> skip(const PlyElement& element);

  /// The properties x and y of vertices, and z where it is wanted. Fails for one that is a list, there twice
  /// or not at all.
  using Axes = std::array<std::optional<std::size_t>, 3>;
  [[nodiscard]] Result<Axes> axes_of(const PlyElement& vertices, bool wants_z) const;
  /// take(point, row) until it fails; a coordinate without a property is 0.
  using TakePoint = std::function<Result<void>(const PlyPoint&, std::size_t)>;
  [[nodiscard]] Result<void> read_points(const PlyElement& element, const Axes& axes, DecimalFactor unit,
                                         const TakePoint& take);
  /// take(items, row) until it fails, with the items of a list, which have to be whole numbers.
  using TakeList = std::function<Result<void>(const std::vector<std::int64_t>&, std::size_t)>;
  [[nodiscard]] Result<void> read_lists(const PlyElement& element, std::size_t property,
                                        const TakeList& take);

  /// The number of a property, no list, in the row that is handed out; nothing if it is not from 0 to 2^32
  /// - 1.
  [[nodiscard]] std::optional<std::uint32_t> index_in_row(const PlyElement& element,
                                                          std::size_t property) const;

  /// Refuses what stands in a row that was handed out.
  [[nodiscard]] tl::unexpected<Error> refuse_row(const PlyElement& element, std::size_t row,
                                                 const std::string& sentence) const;

 private:
  enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

  std::optional<std::string_view> next_line();
  [[nodiscard]] tl::unexpected<Error> refuse_here(const std::string& sentence) const;
  [[nodiscard]] tl::unexpected<Error> ends_early(const PlyElement& element, std::uint64_t row) const;
  Result<void> read_format(bool& has_format);
  Result<void> read_element();
  Result<void> read_property();
  [[nodiscard]] bool is_big() const noexcept { return encoding_ == Encoding::big_endian; }
  /// Cuts the next row off what is left, and finds where its properties begin: words of a line, or bytes.
  Result<std::string_view> next_row(const PlyElement& element, std::uint64_t row);
  Result<std::string_view> next_words(const PlyElement& element, std::uint64_t row);

  std::string_view rest_, row_;
  const std::string& name_;
  std::size_t line_ = 0;
  Encoding encoding_ = Encoding::ascii;
  std::vector<PlyElement> elements_;
  std::vector<std::string_view> comments_, words_;
  std::vector<std::size_t> begins_;
};

}  // namespace lekalo::io
