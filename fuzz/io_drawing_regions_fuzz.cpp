#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"

// Curves of any kind from bytes: mostly on a coarse grid, where ends, copies and overlaps meet, sometimes
// with any doubles. Whatever they are, what comes out is in order.

namespace {

using namespace lekalo;

void must(bool condition) {
  if (!condition) std::abort();
}

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] bool empty() const { return at_ >= size_; }
  unsigned next() { return empty() ? 0 : data_[at_++]; }
  double number() {
    const unsigned kind = next();
    if (kind == 255) {
      double any = 0;
      unsigned char raw[sizeof any];
      for (unsigned char& byte : raw) byte = static_cast<unsigned char>(next());
      std::memcpy(&any, raw, sizeof any);
      return any;
    }
    // Whole millimetres, some of them off by less than the tolerance or not much more.
    const double off[] = {0, 0, 0, 1e-15, 0.001, 0.004, 0.011, 1e6};
    return static_cast<double>(kind % 16) + off[kind / 16 % 8];
  }
  geom::Point point() {
    const double x = number(), y = number();
    return {x, y};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

geom::Edge edge_of(Bytes& bytes, unsigned kind) {
  const geom::Point from = bytes.point(), to = bytes.point();
  if (kind == 0) return {geom::EdgeKind::line, from, to, {}};
  const auto way = kind % 2 == 0 ? geom::EdgeKind::arc_ccw : geom::EdgeKind::arc_cw;
  if (kind < 3) return {way, from, to, bytes.point()};
  if (kind < 5) return {way, from, from, to};
  return {way, from, to, 0.5 * (from + to)};
}

io::Shape shape_of(Bytes& bytes) {
  const unsigned kind = bytes.next() % 9;
  if (kind < 7) return edge_of(bytes, kind);
  if (kind == 7) {
    io::EllipseArc arc;
    arc.centre = bytes.point(), arc.u = bytes.point(), arc.v = bytes.point();
    arc.begin = bytes.number() / 4;
    arc.end = arc.begin + std::min(bytes.number() / 4 + 0.01, 6.283185307179586);
    const auto at = [&](double t) { return arc.centre + std::cos(t) * arc.u + std::sin(t) * arc.v; };
    arc.from = at(arc.begin), arc.to = arc.end - arc.begin > 6.28 ? arc.from : at(arc.end);
    return arc;
  }
  io::Spline spline;
  spline.degree = bytes.next() % 17;
  const std::size_t poles = bytes.next() % 24;
  double knot = 0;
  for (std::size_t i = 0; i < poles; ++i) spline.poles.push_back(bytes.point());
  for (std::size_t i = 0; i < poles + spline.degree + 1; ++i) {
    if (i > spline.degree && i <= poles) knot += bytes.next() % 3;
    spline.knots.push_back(knot);
  }
  if (bytes.next() % 2 == 0)
    for (std::size_t i = 0; i < poles; ++i) spline.weights.push_back(bytes.number());
  return spline;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, std::min<std::size_t>(size, 2000));
  io::DrawingOptions options;
  const unsigned first = bytes.next();
  options.strict = first % 2 == 0;
  const double tolerances[] = {0, 1e-6, 0.01, 2};
  options.join_tolerance = tolerances[first / 2 % 4];
  options.curve_tolerance = first / 8 % 2 == 0 ? 0.01 : 1;
  io::Drawing drawing;
  drawing.name = "fuzz.dxf";
  drawing.layers = {{"A", false}, {"B", true}};
  if (first / 16 % 4 == 0) options.take = {"b", "a"};
  while (!bytes.empty()) {
    const auto entity = static_cast<std::uint32_t>(drawing.entities.size());
    drawing.entities.push_back({"X", "", entity + std::size_t{1}});
    const std::uint32_t layer = bytes.next() % 16 == 0 ? 1 : 0;
    drawing.curves.push_back({shape_of(bytes), entity, layer, 0});
  }
  const auto found = io::make_regions(drawing, options);
  if (!found) {
    must(found.error().code == ErrorCode::bad_input);
    must(found.error().message.rfind("fuzz.dxf: ", 0) == 0);
    return 0;
  }
  must(!found->regions.empty());
  for (const geom::Region& region : found->regions) must(!geom::fault_of({region}));
  if (options.strict) must(!geom::fault_of(found->regions));
  must(found->curve_of_edge.size() == geom::edges_in(found->regions));
  for (const std::uint32_t curve : found->curve_of_edge) must(curve < drawing.curves.size());
  must(found->curve_tolerance <= options.curve_tolerance);
  must(found->tolerance >= 0 &&
       found->tolerance <=
           (found->curve_tolerance + found->moved + found->repaired + found->coordinate_error) * (1 + 1e-12));
  must(found->repaired <= options.repair);
  for (const geom::Region& region : found->regions) {
    auto again = geom::make_region(region.outer, region.holes);
    must(again && *again == region);
  }
  return 0;
}
