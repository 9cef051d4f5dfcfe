#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/text/refusal.hpp"
#include "lekalo/base/counted.hpp"
#include "ply.hpp"
#include "solid_builder.hpp"

namespace lekalo::io {
namespace {

constexpr std::string_view kVertices = "vertex", kFaces = "face", kStrips = "tristrips",
                           kBodyFaces = "body_face";  // of lekalo-step

class PlySolid {
 public:
  PlySolid(std::string_view bytes, SolidBuilder& made) : ply_(bytes, made.name()), made_(made) {}

  Result<void> read() {
    LEKALO_CHECK(ply_.read_header());
    LEKALO_TRY(axes_, read_heads());
    LEKALO_CHECK(read_deviation());
    for (const PlyElement& element : ply_.elements()) {
      if (element.name == kVertices) {
        LEKALO_CHECK(read_vertices(element));
      } else if (element.name == kFaces) {
        LEKALO_CHECK(read_faces(element));
      } else if (element.name == kBodyFaces && by_lekalo_step_) {
        LEKALO_CHECK(read_names(element));
      } else {
        LEKALO_CHECK(ply_.skip(element));
      }
    }
    if (made_.vertices() == 0) return refuse(made_.name(), "there are no vertices in this PLY");
    return cut_faces();
  }

 private:
  [[nodiscard]] bool has(std::string_view element) const {
    const PlyElement* const found = ply_.element(element);
    return found != nullptr && found->rows > 0;
  }

  /// Looks whether all that is needed is there, before the rows are read.
  Result<PlyFile::Axes> read_heads() {
    const PlyElement* const vertices = ply_.element(kVertices);
    if (vertices == nullptr) return refuse(made_.name(), "there is no element vertex in this PLY");
    if (vertices->rows > kMostSolidVertices) return refuse(made_.name(), too_many_vertices());
    if (has(kStrips) && !has(kFaces))
      return refuse(made_.name(), "this PLY has strips of triangles, which are not read; save it with faces");
    if (has(kFaces) && ply_.element(kFaces)->rows > kMostSolidTriangles)
      return refuse(made_.name(), too_many_triangles());
    for (const PlyElement& element : ply_.elements())
      if (element.name != kVertices && element.name != kFaces && element.name != kBodyFaces &&
          element.rows > 0)
        made_.tell(fmt::format("{} of the element {} are ignored", element.rows, excerpt(element.name)));
    return ply_.axes_of(*vertices, true);
  }

  /// Takes what lekalo-step says of the body that it made the triangles of.
  Result<void> read_deviation() {
    constexpr std::string_view kMaker = "lekalo-step 1", kDeviation = "deviation ";
    const std::vector<std::string_view>& comments = ply_.comments();
    if (comments.empty() || comments.front() != kMaker) return {};
    by_lekalo_step_ = true;
    for (const std::string_view comment : comments)
      if (comment.starts_with(kDeviation)) {
        const std::string_view word = comment.substr(kDeviation.size());
        const auto read = read_millimetres(word, {});
        if (!read) return refuse(made_.name(), "deviation: " + number_sentence(read.error(), word));
        if (!(read->value >= 0))
          return refuse(made_.name(), fmt::format("the deviation {} is below 0", word));
        return made_.set_deviation(read->value);
      }
    return refuse(made_.name(), "lekalo-step made it, but its header has no deviation; make it again");
  }

  Result<void> read_vertices(const PlyElement& element) {
    made_.reserve(ply_.most_rows(element), 0);
    return ply_.read_points(element, axes_, made_.unit(),
                            [&](const PlyPoint& p, std::size_t) -> Result<void> {
                              made_.add_vertex({p.xyz[0], p.xyz[1], p.xyz[2]}, p.error);
                              return {};
                            });
  }

  /// Gathers the corners of the faces, which may stand before the vertices.
  Result<void> read_faces(const PlyElement& element) {
    if (element.rows == 0) return {};
    const std::size_t list =
        std::min(place_of(element, "vertex_indices", true), place_of(element, "vertex_index", true));
    if (list == element.properties.size())
      return refuse(made_.name(), "the faces of this PLY have no list vertex_indices");
    const auto vertices = static_cast<std::int64_t>(ply_.element(kVertices)->rows);
    const std::size_t of_body =
        by_lekalo_step_ ? place_of(element, "face", false) : element.properties.size();
    return ply_.read_lists(
        element, list, [&](const std::vector<std::int64_t>& items, std::size_t row) -> Result<void> {
          if (of_body < element.properties.size()) {
            const auto number = ply_.index_in_row(element, of_body);
            if (!number) return ply_.refuse_row(element, row, "its face is not a whole number from 0");
            body_faces_.push_back(*number);
          }
          if (items.size() < 3)
            return ply_.refuse_row(element, row,
                                   fmt::format("a face has three corners or more, not {}", items.size()));
          for (const std::int64_t item : items) {
            if (item < 0 || item >= vertices)
              return ply_.refuse_row(
                  element, row,
                  fmt::format("vertex {} is not there: the file has {}, numbered from 0", item,
                              counted(static_cast<std::size_t>(vertices), "vertex", "vertices")));
            corners_.push_back(static_cast<std::uint32_t>(item));
          }
          if (corners_.size() > std::numeric_limits<std::uint32_t>::max() ||
              corners_.size() - 2 * (ends_.size() + 1) > kMostSolidTriangles)
            return ply_.refuse_row(element, row, too_many_triangles());
          ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
          return {};
        });
  }

  /// The place of a property, a list or none; as many as there are where it is not there.
  static std::size_t place_of(const PlyElement& element, std::string_view name, bool is_list) {
    std::size_t at = 0;
    while (at < element.properties.size() &&
           (element.properties[at].name != name || element.properties[at].count.has_value() != is_list))
      ++at;
    return at;
  }

  /// Reads the names of the faces of the STEP file, and their colours.
  Result<void> read_names(const PlyElement& element) {
    const std::size_t list = place_of(element, "name", true);
    if (list == element.properties.size()) return ply_.skip(element);
    const std::size_t colour = place_of(element, "colour", false);
    return ply_.read_lists(
        element, list, [&](const std::vector<std::int64_t>& items, std::size_t row) -> Result<void> {
          std::string& name = names_.emplace_back();
          for (const std::int64_t byte : items) name += static_cast<char>(byte);
          if (colour == element.properties.size()) return {};
          const auto number = ply_.index_in_row(element, colour);
          if (!number || *number > SolidFile::kNoColour)
            return ply_.refuse_row(
                element, row,
                fmt::format("its colour is not a whole number from 0 to {}", SolidFile::kNoColour));
          colours_.push_back(*number);
          return {};
        });
  }

  Result<void> cut_faces() {
    made_.reserve(made_.vertices(), corners_.size() - 2 * ends_.size());
    const std::span<const std::uint32_t> all(corners_);
    for (std::size_t face = 0, begin = 0; face < ends_.size(); begin = ends_[face++]) {
      const std::size_t first = made_.triangles();
      if (!body_faces_.empty())
        made_.begin_group(body_faces_[face] < names_.size() ? names_[body_faces_[face]] : "");
      const std::string wrong = made_.add_face(all.subspan(begin, ends_[face] - begin));
      if (!body_faces_.empty()) made_.set_face(first, body_faces_[face]);
      if (!wrong.empty()) return refuse(made_.name(), fmt::format("face {}: {}", face, wrong));
    }
    made_.set_colours(std::move(colours_));
    return {};
  }

  PlyFile ply_;
  SolidBuilder& made_;
  PlyFile::Axes axes_;
  std::vector<std::uint32_t> corners_, ends_;
  /// The words of lekalo-step: the face of each, and the names and colours of those faces.
  bool by_lekalo_step_ = false;
  std::vector<std::uint32_t> body_faces_, colours_;
  std::vector<std::string> names_;
};

}  // namespace

bool is_ply(std::string_view bytes) {
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r") || bytes.starts_with("ply ");
}

Result<void> read_ply(std::string_view bytes, SolidBuilder& made) { return PlySolid(bytes, made).read(); }

}  // namespace lekalo::io
