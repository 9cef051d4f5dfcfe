#include "certificate_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "solid_document.hpp"
#include "triangle_distance.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

/// Calls visit(triangle, its exact squared distance) for the triangles that enclosures do not show to be
/// `radius(triangle)` away from a point, and none of which is above `most`, until it returns true.
template <class Radius, class Visit>
bool any_within(const PlacedSolid& body, const Ball& ball, double most, const Radius& radius,
                const Visit& visit) {
  const Vec3 p = as<Span>(ball.centre);
  const Box3 place = box_of(p);
  bool found = false;
  body.tree().visit([&](const Box3& box) { return !found && !(gap(place, box) > most); },
                    [&](std::uint32_t triangle) {
                      const double within = radius(triangle);
                      if (distance({p, p, p}, body.triangle(triangle), within).low > within) return;
                      found = visit(triangle, exact_squared_distance(as<Fraction>(ball.centre),
                                                                     body.exact_triangle(triangle)));
                    });
  return found;
}

bool lies_on_surface(const PlacedSolid& body, const Ball& ball) {
  return any_within(
      body, ball, 0, [](std::uint32_t) { return 0.0; },
      [](std::uint32_t, const Fraction& distance) { return sgn(distance) == 0; });
}

/// Says whether all of the ball is within the width of one triangle.
bool lies_in_width(const PlacedSolid& body, const Ball& ball) {
  if (body.mesh().widths.empty()) return false;
  const auto width = [&](std::uint32_t triangle) { return body.mesh().width(triangle).low; };
  return any_within(
      body, ball, step_up(body.widest() - ball.radius.near.low),
      [&](std::uint32_t triangle) { return step_up(width(triangle) - ball.radius.near.low); },
      [&](std::uint32_t triangle, const Fraction& distance) {
        const Fraction rest = Fraction(width(triangle)) - ball.radius.exact;
        return sgn(rest) >= 0 && distance <= rest * rest;
      });
}

/// \pre the centre is not on the surface
bool holds(const PlacedSolid& body, const Ball& ball) {
  return body.holds(as<Span>(ball.centre), as<Fraction>(ball.centre));
}

std::optional<std::string> fault_of_part_ball(const PlacedSolid& part, const Ball& ball) {
  if (auto fault = nearer(part, ball)) return fault;
  if (lies_on_surface(part, ball)) return std::nullopt;
  if (!holds(part, ball)) return "its centre is not in the part";
  return std::nullopt;
}

std::optional<std::string> fault_of_blank_ball(const PlacedSolid& blank, const Ball& ball) {
  if (lies_in_width(blank, ball)) return std::nullopt;
  if (auto fault = nearer(blank, ball)) return fault;
  if (lies_on_surface(blank, ball)) return std::nullopt;
  if (holds(blank, ball)) return "its centre is in the blank";
  return std::nullopt;
}

std::optional<std::string> fault_of_plane(const PlacedSolid& blank, const HalfSpace& plane) {
  const Vec3 n = as<Span>(plane.normal);
  const Exact3 exact_n = as<Fraction>(plane.normal);
  if (sgn(dot(exact_n, exact_n)) == 0) return "its normal is 0";
  const SolidMesh& mesh = blank.mesh();
  std::optional<std::string> fault;
  // Below a triangle the material begins beyond its width.
  const double stretch = std::max(0.0, length(n).low);
  const auto lifted = [&](Span along, double width) { return (along + just(stretch) * just(width)).low; };
  const auto reaches_below = [&](const Box3& box) {
    const Span along = dot(
        n, Vec3{Span{box.low[0], box.high[0]}, Span{box.low[1], box.high[1]}, Span{box.low[2], box.high[2]}});
    return !fault && !(lifted(along, blank.narrowest()) >= plane.level.near.high);
  };
  blank.tree().visit(reaches_below, [&](std::uint32_t triangle) {
    const double width = mesh.width(triangle).low;
    for (const std::uint32_t v : mesh.triangles[triangle])
      if (dot(exact_n, blank.exactly_at(v)) + Fraction(stretch) * Fraction(width) < plane.level.exact)
        fault = fmt::format("a corner of the blank's triangle {} is not in it", mesh.numbers[triangle]);
  });
  return fault;
}

/// A row of four numbers that was read before.
template <class Thing>
Thing row_of(Json written) {
  std::string none;
  const auto [x, y, z, last] = *numbers_of<4>(written, none, [] { return std::string(); });
  return {{both(x), both(y), both(z)}, both(last)};
}

std::optional<std::string> fault_of_datum_point(const std::vector<SolidDatum>& datums, Json written,
                                                DatumPoint& point) {
  std::string none;
  const auto numbers = *numbers_of<2>(written, none, [] { return std::string(); });
  const auto d = index_below(numbers[0], datums.size()),
             k = index_below(numbers[1], 3 * limits::kMostSolidItems);
  if (!d) return "its datum is none";
  const SolidDatum& datum = datums[*d];
  if (!k) return "its point is none of the datum";
  std::size_t place = *k;
  if (!datum.triangles.empty()) {
    if (!std::ranges::binary_search(datum.triangles, *k / 3)) return "its point is none of the datum";
    const auto found = std::ranges::lower_bound(datum.triangles, *k / 3);
    place = 3 * static_cast<std::size_t>(found - datum.triangles.begin()) + *k % 3;
  }
  if (place >= datum.points.size()) return "its point is none of the datum";
  point = {&datum, &datum.points[place]};
  return std::nullopt;
}

std::optional<std::string> fault_of_point(const SolidMesh& part, Json written, PartPoint& point) {
  std::string none;
  const auto [f, u, v] = *numbers_of<3>(written, none, [] { return std::string(); });
  const auto number = index_below(f, limits::kMostSolidItems);
  const auto triangle = number ? part.triangle_of_file(*number) : std::nullopt;
  if (!triangle) return "its triangle is none of the part";
  const Fraction along = to_fraction(u), across = to_fraction(v);
  if (sgn(along) < 0 || sgn(across) < 0 || along + across > 1) return "it is not in its triangle";
  point.triangle = *triangle;
  const auto& corners = part.triangles[*triangle];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Fraction from = part.exact(corners[0], axis);
    Both& at = point.ball.centre[axis];
    at.exact =
        from + along * (part.exact(corners[1], axis) - from) + across * (part.exact(corners[2], axis) - from);
    at.near = enclosed(at.exact);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> index_below(const Decimal& number, std::size_t count) {
  if (number.exponent < 0 || sgn(number.digits) < 0 ||
      compare(number, Decimal{Integer(static_cast<unsigned long>(count)), 0}) >= 0)
    return std::nullopt;
  return static_cast<std::size_t>(to_long(in_units(number, 0)));
}

std::optional<std::string> nearer(const PlacedSolid& body, const Ball& ball) {
  const auto width = [&](std::uint32_t triangle) { return body.mesh().width(triangle).low; };
  std::optional<std::string> fault;
  any_within(
      body, ball, step_up(ball.radius.near.high - body.narrowest()),
      [&](std::uint32_t triangle) { return step_up(ball.radius.near.high - width(triangle)); },
      [&](std::uint32_t triangle, const Fraction& distance) {
        const Fraction rest = ball.radius.exact - Fraction(width(triangle));
        if (distance >= rest * rest) return false;
        fault =
            fmt::format("triangle {} comes nearer to its centre than its radius{}",
                        body.mesh().numbers[triangle], body.mesh().widths.empty() ? "" : " less its width");
        return true;
      });
  return fault;
}

CertificateTables::CertificateTables(Json certificate, const SolidMesh& part, const SolidMesh& blank,
                                     const std::vector<SolidDatum>& datums,
                                     std::vector<std::string>& findings, std::string& complaint)
    : part_(part), blank_(blank), datums_(datums), findings_(findings) {
  const Fields fields(certificate, "certificate", complaint);
  read<4>(fields.get("part_balls"), "part_balls", true, part_balls_, complaint);
  read<4>(fields.get("blank_balls"), "blank_balls", true, blank_balls_, complaint);
  read<4>(fields.get("planes"), "planes", false, planes_, complaint);
  // A certificate without them may leave the word out.
  if (const Json points = fields.get("part_points"); !points.text.empty())
    read<3>(points, "part_points", false, part_points_, complaint);
  if (const Json points = fields.get("datum_points"); !points.text.empty())
    read<2>(points, "datum_points", false, datum_points_, complaint);
  if (const Json directions = fields.get("directions"); !directions.text.empty())
    read<3>(directions, "directions", false, directions_, complaint);
  if (const Json bodies = fields.get("bodies"); !bodies.text.empty())
    read<13>(bodies, "bodies", false, bodies_, complaint);
}

template <std::size_t Count, class Thing>
void CertificateTables::read(Json list, const char* key, bool has_radius, std::vector<Row<Thing>>& rows,
                             std::string& complaint) {
  const auto complain = [&](std::string_view sentence) {
    if (complaint.empty()) complaint = fmt::format("certificate.{} {}", key, sentence);
  };
  if (!list.is_array()) return complain("is not a list");
  JsonItems items(list);
  while (const auto item = items.next()) {
    const auto name = [&] { return fmt::format("certificate.{}[{}]", key, rows.size()); };
    if (rows.size() == limits::kMostCertificateRows)
      return complain(fmt::format("has more than {} rows", limits::kMostCertificateRows));
    const auto numbers = numbers_of<Count>(*item, complaint, name);
    if (!numbers) return;
    if (has_radius && sgn(numbers->back().digits) < 0) return complain("has a radius below 0");
    rows.push_back({*item});
  }
}

template <class Thing, class Make>
const Thing* CertificateTables::look(Row<Thing>& row, const char* key, std::size_t number, const Make& make) {
  if (!row.seen) {
    row.seen = true;
    auto thing = std::make_unique<Thing>();
    if (const auto wrong = make(row.written, *thing))
      findings_.push_back(
          fmt::format("certificate.{}[{}] is not what it has to be: {}", key, number, *wrong));
    else
      row.thing = std::move(thing);
  }
  return row.thing.get();
}

const Ball* CertificateTables::part_ball(std::size_t number) {
  return look(part_balls_[number], "part_balls", number, [&](Json written, Ball& ball) {
    ball = row_of<Ball>(written);
    return fault_of_part_ball(part_, ball);
  });
}
const Ball* CertificateTables::blank_ball(std::size_t number) {
  return look(blank_balls_[number], "blank_balls", number, [&](Json written, Ball& ball) {
    ball = row_of<Ball>(written);
    return fault_of_blank_ball(blank_, ball);
  });
}
const HalfSpace* CertificateTables::plane(std::size_t number) {
  return look(planes_[number], "planes", number, [&](Json written, HalfSpace& plane) {
    plane = row_of<HalfSpace>(written);
    return fault_of_plane(blank_, plane);
  });
}
const PartPoint* CertificateTables::part_point(std::size_t number) {
  return look(part_points_[number], "part_points", number,
              [&](Json written, PartPoint& point) { return fault_of_point(part_.mesh(), written, point); });
}

const FarBody* CertificateTables::body(std::size_t number) {
  return look(bodies_[number], "bodies", number, [&](Json written, FarBody& body) {
    std::string none;
    return fault_of_body(blank_, *numbers_of<13>(written, none, [] { return std::string(); }), body);
  });
}

const DatumPoint* CertificateTables::datum_point(std::size_t number) {
  return look(datum_points_[number], "datum_points", number,
              [&](Json written, DatumPoint& point) { return fault_of_datum_point(datums_, written, point); });
}
const Both3* CertificateTables::direction(std::size_t number) {
  return look(directions_[number], "directions", number,
              [](Json written, Both3& direction) -> std::optional<std::string> {
                std::string none;
                const auto [x, y, z] = *numbers_of<3>(written, none, [] { return std::string(); });
                direction = {both(x), both(y), both(z)};
                return std::nullopt;
              });
}

}  // namespace lekalo::verify
