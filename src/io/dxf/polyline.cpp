#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "entities.hpp"
#include "io/text/refusal.hpp"
#include "text.hpp"

// Reads LWPOLYLINE, and POLYLINE with its VERTEX entities.

namespace lekalo::io {
namespace {

constexpr unsigned kClosed = 1, kSpace = 8, kMeshes = 16 | 64;  // flags of POLYLINE
constexpr unsigned kFramePoint = 16;  // flag of VERTEX: controls a spline, is not on it

}  // namespace

Result<void> DxfEntities::add_polyline(DxfBlock& into, const Affine& plane, bool closed) {
  const std::size_t before = into.curves.size(), n = vertices_.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Vertex& a = vertices_[i];
    const Vertex& b = vertices_[i + 1 == n ? 0 : i + 1];
    // Programs repeat points; between equal ones nothing is drawn.
    auto shape = bulge_arc(a.at, b.at, a.bulge.value, a.bulge.error);
    if (!shape) continue;
    const double reach = std::abs(a.bulge.value) * geom::norm(b.at.at - a.at.at);
    if (!(reach <= 2 * kLargestMillimetres)) {
      return refuse_entity(fmt::format("has a bulge that reaches beyond {:g} mm", kLargestMillimetres));
    }
    LEKALO_CHECK(add(into, plane, std::move(*shape)));
  }
  if (into.curves.size() == before) count_unread(into, "of no length");
  return {};
}

Result<void> DxfEntities::read_lwpolyline(DxfBlock& into) {
  vertices_.clear();
  unsigned flags = 0;
  double height = 0;
  std::optional<unsigned> count;
  bool wants_y = false;
  while (at_.next() && at_.code() != 0) {
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    switch (at_.code()) {
      case 70:
      case 90: {
        LEKALO_TRY(const auto value, whole_number());
        if (at_.code() == 70) flags = value;
        if (at_.code() == 90) count = value;
        break;
      }
      case 10:
      case 20:
      case 38:
      case 42: {
        LEKALO_TRY(const auto value, number(at_.code() != 42));
        if (at_.code() == 38) {
          height = value.value;
          note_height();
        } else if (at_.code() == 42) {
          if (vertices_.empty())
            return refuse_line(at_.name(), at_.line(), "a bulge before the first vertex");
          vertices_.back().bulge = value;
        } else if (wants_y != (at_.code() == 20)) {
          return refuse_line(at_.name(), at_.line(),
                             wants_y ? "an x, but the one before has no y" : "a y without its x");
        } else if (at_.code() == 10) {
          vertices_.push_back({{{value.value, 0}, value.error}, {}});
          wants_y = true;
        } else {
          vertices_.back().at.at.y = value.value;
          vertices_.back().at.error = std::max(vertices_.back().at.error, value.error);
          wants_y = false;
        }
        break;
      }
      default:
        break;
    }
  }
  if (!at_.ok()) return {};
  if (wants_y) return refuse_entity("has an x without its y");
  if (count && *count != vertices_.size()) {
    return refuse_entity(
        fmt::format("says it has {} vertices, but has {}; the file is damaged", *count, vertices_.size()));
  }
  if (is_out_of_sight(into)) return {};
  const auto world = plane(height);
  if (!world) {
    count_unread(into, "tilted");
    return {};
  }
  return add_polyline(into, *world, (flags & kClosed) != 0);
}

Result<void> DxfEntities::read_polyline(DxfBlock& into) {
  unsigned flags = 0;
  Millimetres height;
  while (at_.next() && at_.code() != 0) {
    LEKALO_TRY(const auto taken, take_common());
    if (taken) continue;
    if (at_.code() == 70) {
      LEKALO_TRY(const auto value, whole_number());
      flags = value;
    } else if (at_.code() == 30) {
      LEKALO_TRY(const auto value, number(true));
      height = value;
      note_height();
    }
  }
  const Common polyline = common_;
  LEKALO_CHECK(read_vertices(flags));
  common_ = polyline;
  if (!at_.ok() || is_out_of_sight(into)) return {};
  if ((flags & kMeshes) != 0) {
    count_unread(into, "mesh");
    return {};
  }
  if ((flags & kSpace) != 0) {
    // Straight lines between points of the drawing.
    for (Vertex& vertex : vertices_) vertex.bulge = {};
    return add_polyline(into, {}, (flags & kClosed) != 0);
  }
  const auto world = plane(height.value);
  if (!world) {
    count_unread(into, "tilted");
    return {};
  }
  return add_polyline(into, *world, (flags & kClosed) != 0);
}

Result<void> DxfEntities::read_vertices(unsigned flags) {
  static constexpr Wanted kWanted[] = {
      {10, true, false}, {20, true, false}, {30, true, false}, {42, false, false}, {70, false, false}};
  vertices_.clear();
  while (at_.ok() && at_.at(0, "VERTEX")) {
    common_ = {};
    common_.type = at_.value();
    common_.line = at_.line();
    Numbers numbers;
    LEKALO_CHECK(read_numbers(kWanted, numbers));
    if (!at_.ok() || (flags & kMeshes) != 0) continue;
    if (!numbers.has(10) || !numbers.has(20)) return refuse_entity("has no place; the file is damaged");
    const double vertex_flags = numbers.get(70).value;
    const bool is_frame_point = vertex_flags >= 0 && (static_cast<unsigned>(vertex_flags) & kFramePoint) != 0;
    if (!is_frame_point) vertices_.push_back({numbers.point(10, 20), numbers.get(42)});
  }
  if (at_.ok() && at_.at(0, "SEQEND")) {
    while (at_.next() && at_.code() != 0) {
    }
  }
  return {};
}

}  // namespace lekalo::io
