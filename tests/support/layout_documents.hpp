#pragma once

// Random layout documents that use everything the format has: arcs, holes, zones, kits, open strips, odd ids,
// coordinates on any step. A function of seed and index alone.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::cases {

inline layout::Outline checked(Result<geom::GridRegion> region) {
  if (!region) throw std::logic_error("test input: " + region.error().message);
  layout::Outline outline;
  outline.polygon = *std::move(region);
  return outline;
}

/// Points about `centre` between the two radii, counter-clockwise or not: star-shaped, so simple.
inline std::vector<geom::GridPoint> star(Random& random, geom::GridPoint centre, double least, double most) {
  const std::size_t n = 3 + random.below(12);
  std::vector<geom::GridPoint> points;
  const double phase = random.uniform(0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double turn = (static_cast<double>(i) + 0.8 * random.uniform()) / static_cast<double>(n) + phase;
    const auto [sine, cosine] = geom::sincos(6.283185307179586 * turn);
    const double radius = random.uniform(least, most);
    points.push_back(centre +
                     geom::GridPoint{geom::grid_from_mm(radius * cosine), geom::grid_from_mm(radius * sine)});
  }
  if (random.below(2) == 0) return {points.rbegin(), points.rend()};
  return points;
}

inline layout::Outline random_outline(Random& random, geom::ChordSide side) {
  const auto step = [&] {
    return static_cast<std::int64_t>(random.below(std::uint64_t{1} << 31)) - (std::int64_t{1} << 30);
  };
  const geom::GridPoint centre{step(), step()};
  if (random.below(3) == 0) {  // a washer or a disc, drawn with arcs
    const geom::Point c = geom::mm_from_grid(centre);
    const double radius = random.uniform(2, 60);
    const auto circle = [&](double r, geom::EdgeKind kind) {
      return geom::Contour{{kind, {c.x + r, c.y}, {c.x + r, c.y}, c}};
    };
    std::vector<geom::Contour> holes;
    if (random.below(2) == 0) holes.push_back(circle(radius * 0.4, geom::EdgeKind::arc_cw));
    const auto region = geom::make_region(circle(radius, geom::EdgeKind::arc_ccw), std::move(holes));
    if (!region) throw std::logic_error("test input: " + region.error().message);
    const double tolerance = random.uniform(0.01, 0.2);
    layout::Outline outline = checked(geom::grid_region_of_curves(*region, side, tolerance));
    outline.curves.push_back(*region);
    outline.chord_tolerance_mm = tolerance;
    return outline;
  }
  while (true) {  // wide gaps between directions may bring the hole outside
    std::vector<std::vector<geom::GridPoint>> loops{star(random, centre, 20, 60)};
    if (random.below(2) == 0) loops.push_back(star(random, centre, 0.5, 3));
    if (auto region = geom::make_grid_region(std::move(loops))) return checked(std::move(region));
  }
}

inline std::string random_text(Random& random) {
  static const char* const kPieces[] = {"vamp", "\"", "\\", "носок",  " ",
                                        "/",    "7",  "底", "a.b[0]", "\xf0\x9f\x91\x9e"};
  std::string text;
  for (std::uint64_t i = random.below(4); i > 0; --i) text += kPieces[random.below(10)];
  return text;
}

inline layout::Document random_document(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index + 1);
  const auto some = [&](std::uint64_t most) { return static_cast<std::int64_t>(random.below(most + 1)); };
  const auto half = [&] { return random.below(2) == 0; };
  const auto gap = [&] { return some(random.below(2) == 0 ? 20 : 40'000'000); };
  const auto angle = [&] {
    return half() ? 15.0 * static_cast<double>(some(48)) - 360 : random.uniform(-400, 400);
  };
  const auto quality = [&] {
    return random.below(4) == 0 ? layout::kBestQuality : static_cast<int>(some(5));
  };

  layout::Document d;
  d.name = random_text(random);
  d.rules = {gap(), gap(), gap()};
  for (std::int64_t i = some(3); i > 0; --i) {
    layout::Stock s;
    s.id = random_text(random) + std::to_string(i);
    s.name = random_text(random);
    s.kind = static_cast<layout::StockKind>(random.below(3));
    s.cost = half() ? 1 : random.uniform(0, 1000);
    if (half()) s.grain_degrees = angle();
    if (s.kind == layout::StockKind::strip) {
      s.open_length = half();
      const std::int64_t along = s.open_length ? layout::kLongestStrip : 2'000'000'000 + some(1'000'000'000);
      const std::int64_t across = 1'000'000'000 + some(1'000'000'000);
      s.outline.polygon = {{{0, 0}, {along, 0}, {along, across}, {0, across}}, {0, 4}};
    } else {
      s.count = 1 + some(5);
      s.outline = random_outline(random, geom::ChordSide::shrink);
    }
    for (std::int64_t k = some(2); k > 0; --k)
      s.defects.push_back({"d" + std::to_string(k), 1 + static_cast<int>(some(4)),
                           random_outline(random, geom::ChordSide::grow)});
    for (std::int64_t k = some(2); k > 0; --k)
      s.zones.push_back({"z" + std::to_string(k), static_cast<int>(some(4)),
                         random_outline(random, geom::ChordSide::grow)});
    d.stocks.push_back(std::move(s));
  }
  for (std::int64_t i = some(5); i > 0; --i) {
    layout::Part p;
    p.id = random_text(random) + std::to_string(i);
    p.name = random_text(random);
    p.outline = random_outline(random, geom::ChordSide::grow);
    p.quality = quality();
    for (std::int64_t k = some(2); k > 0; --k)
      p.areas.push_back({quality(), random_outline(random, geom::ChordSide::grow)});
    for (std::int64_t k = some(3); k > 0; --k) {
      const double from = angle();
      p.rotations.push_back({from, half() ? from : from + random.uniform(0, 500)});
    }
    p.may_mirror = half();
    if (half()) p.grain = layout::Grain{angle(), random.uniform(0, 90)};
    p.tolerated_severity = static_cast<int>(some(3));
    p.priority = static_cast<int>(some(4)) - 2;
    p.demand = some(20);
    if (half()) p.gap = gap();
    if (half()) p.border_gap = gap();
    if (half()) p.defect_gap = gap();
    for (std::int64_t k = some(2); k > 0; --k) {
      const geom::Point from{random.uniform(-50, 50), random.uniform(-50, 50)},
          to{random.uniform(-50, 50), 51};
      const geom::Point centre = to - geom::Point{8, 0};
      p.marks.push_back({half() ? random_text(random) : "",
                         {{geom::EdgeKind::line, from, to, {}},
                          {geom::EdgeKind::arc_ccw, to, centre + geom::Point{0, 8}, centre}},
                         half() ? "#00ff7f" : "",
                         static_cast<layout::MarkRole>(random.below(4))});
      layout::PartText text;
      text.text = "N" + random_text(random);
      text.at = {random.uniform(-50, 50), random.uniform(-50, 50)};
      text.height = random.uniform(0.5, 30);
      text.degrees = half() ? angle() : 0;
      text.width_factor = half() ? random.uniform(0.1, 3) : 1;
      text.mirrored = half();
      text.anchor = static_cast<layout::TextAnchor>(random.below(3));
      text.layer = half() ? random_text(random) : "";
      text.colour = half() ? "#a0b0c0" : "";
      text.role = static_cast<layout::MarkRole>(random.below(4));
      p.texts.push_back(std::move(text));
    }
    d.parts.push_back(std::move(p));
  }
  for (std::int64_t i = d.parts.empty() ? 0 : some(2); i > 0; --i) {
    layout::Kit k;
    k.id = random_text(random) + std::to_string(i);
    k.name = random_text(random);
    k.demand = some(30);
    k.value = random.uniform(0, 10);
    for (std::int64_t n = 1 + some(3); n > 0; --n) {
      layout::KitPiece piece;
      piece.part = static_cast<std::uint32_t>(random.below(d.parts.size()));
      piece.count = 1 + some(3);
      if (half()) piece.mirrored = d.parts[piece.part].may_mirror && half();
      k.pieces.push_back(piece);
    }
    d.kits.push_back(std::move(k));
  }
  for (std::int64_t i = d.parts.empty() || d.stocks.empty() ? 0 : some(12); i > 0; --i) {
    layout::Placement p;
    p.id = d.next_id + random.below(3);
    d.next_id = p.id + 1 + random.below(2);
    p.part = static_cast<std::uint32_t>(random.below(d.parts.size()));
    p.stock = static_cast<std::uint32_t>(random.below(d.stocks.size()));
    p.copy = some(3);
    p.rotation = geom::rotation_from_degrees(random.below(3) == 0 ? random.uniform(-1e-6, 1e-6) : angle());
    const auto far = [&] {
      return static_cast<std::int64_t>(random.below((std::uint64_t{1} << 40) + 1)) - geom::kGridLimit / 2;
    };
    p.at = {far(), far()};
    p.mirrored = half();
    p.locked = half();
    d.placements.push_back(p);
  }
  if (half()) d.rules.kerf = gap();
  const auto material = [&] {
    return layout::Material{random_text(random), half() ? 0 : 2'000 + some(100'000'000)};
  };
  for (layout::Stock& s : d.stocks) s.material = material();
  for (layout::Part& p : d.parts) {
    p.material = material();
    if (half()) p.purpose = {random_text(random), "2028-02-29", random_text(random)};
  }
  return d;
}

}  // namespace lekalo::cases
