#pragma once

// Random commands of correction.

#include <optional>
#include <string>
#include <vector>

#include "lekalo/layout/command.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::cases {

inline std::uint64_t some_id(const layout::Document& document, Random& random) {
  return document.placements[random.below(document.placements.size())].id;
}

inline geom::GridPoint some_vector(Random& random, double most_mm) {
  switch (random.below(3)) {
    case 0: {  // along an axis or a diagonal
      const auto step = [&] { return static_cast<std::int64_t>(random.below(3)) - 1; };
      const geom::GridPoint d{step(), step()};
      const std::int64_t size = geom::grid_from_mm(random.uniform(0.1, most_mm));
      return d == geom::GridPoint{} ? geom::GridPoint{size, 0} : geom::GridPoint{d.x * size, d.y * size};
    }
    default:
      return random_point(random, {-most_mm, -most_mm}, {most_mm, most_mm}) + geom::GridPoint{0, 1};
  }
}

/// A gesture on a defect or a zone of a stock; some are to be refused.
inline layout::Command some_feature_command(const layout::Document& document, Random& random) {
  using layout::FeatureKind;
  const auto stock = static_cast<std::uint32_t>(random.below(document.stocks.size()));
  const FeatureKind kind = random.below(3) == 0 ? FeatureKind::zone : FeatureKind::defect;
  const std::size_t count = feature_count(document.stocks[stock], kind);
  std::string id = "n" + std::to_string(random.below(40));
  if (count > 0 && random.below(8) != 0)
    id = feature_at(document.stocks[stock], kind, static_cast<std::uint32_t>(random.below(count))).id;
  const auto loops = [&] {
    const geom::Point at{random.uniform(0, 300), random.uniform(0, 200)};
    const double size = random.uniform(1, 20);
    std::vector<std::vector<geom::GridPoint>> all{star(random, at, size / 2, size, 3 + random.below(6))};
    if (random.below(5) == 0) all.push_back(star(random, at, size / 20, size / 10, 4));
    return all;
  };
  const int grade = static_cast<int>(random.below(5));
  switch (random.below(count < 4 ? 6 : 5)) {
    case 0:
      return layout::MoveFeatureCommand{kind, stock, id, some_vector(random, 30)};
    case 1:
      return layout::ReshapeFeatureCommand{kind, stock, id, loops()};
    case 2:
      return layout::GradeFeatureCommand{kind, stock, id, grade};
    case 3:
      return layout::RemoveFeatureCommand{kind, stock, id};
    default:
      return layout::AddFeatureCommand{kind, stock, "n" + std::to_string(random.below(40)), grade, loops()};
  }
}

/// The layout with kits of its parts.
inline layout::Document with_kits(layout::Document document, Random& random) {
  for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
    layout::Kit kit;
    kit.id = "kit" + std::to_string(k);
    for (std::uint64_t i = 1 + random.below(3); i > 0; --i) {
      layout::KitPiece piece;
      piece.part = static_cast<std::uint32_t>(random.below(document.parts.size()));
      if (document.parts[piece.part].may_mirror && random.below(2) == 0) piece.mirrored = true;
      kit.pieces.push_back(piece);
    }
    document.kits.push_back(std::move(kit));
  }
  return document;
}

/// A change of the job; some are to be refused.
inline layout::Command some_job_command(const layout::Document& document, Random& random) {
  const auto part = static_cast<std::uint32_t>(random.below(document.parts.size()));
  const auto stock = static_cast<std::uint32_t>(random.below(document.stocks.size()));
  switch (random.below(9)) {
    case 0:
      return layout::QuantityCommand{part, static_cast<std::int64_t>(random.below(12)) - 1};
    case 1: {
      layout::RotationsCommand rotations{part, {}};
      for (std::uint64_t i = random.below(3); i > 0; --i) {
        const double from = random.uniform(-200, 200);
        rotations.rotations.push_back({from, random.below(2) == 0 ? from : from + random.uniform(0, 90)});
      }
      return rotations;
    }
    case 2:
      return layout::MirrorCommand{part, random.below(2) == 0};
    case 3:
      if (document.parts.size() > 2) return layout::RemovePartCommand{part};
      return layout::MirrorCommand{part, true};
    case 4: {
      const std::int64_t width = geom::grid_from_mm(random.uniform(50, 300));
      return layout::AddSheetCommand{width, width / 2, static_cast<std::int64_t>(random.below(4))};
    }
    case 5:
      return layout::AddStripCommand{geom::grid_from_mm(random.uniform(50, 200))};
    case 6:
      return layout::CountCommand{stock, static_cast<std::int64_t>(random.below(5))};
    case 7:
      if (document.stocks.size() > 1) return layout::RemoveStockCommand{stock};
      return layout::CountCommand{stock, 2};
    default: {
      const auto kind = static_cast<layout::RuleKind>(random.below(3));
      return layout::RuleCommand{kind, geom::grid_from_mm(random.uniform(0, 3))};
    }
  }
}

inline layout::Command some_command(const layout::Document& document, Random& random) {
  const std::uint64_t id = some_id(document, random);
  std::vector<std::uint64_t> ids{id};
  if (random.below(6) == 0)
    if (const std::uint64_t other = some_id(document, random); other != id) ids.push_back(other);
  switch (random.below(15)) {
    case 0: {
      layout::PlaceCommand place;
      place.part = static_cast<std::uint32_t>(random.below(document.parts.size()));
      place.rotation = geom::rotation_from_degrees(random.uniform(-180, 180));
      place.mirrored = random.below(3) == 0;
      place.at = random_point(random, {0, 0}, {300, 200});
      return place;
    }
    case 1:
      return layout::MoveCommand{ids, some_vector(random, 20), std::nullopt};
    case 2:
      return layout::RotateCommand{
          ids, random.below(2) == 0 ? 90.0 * static_cast<double>(random.below(4)) : random.uniform(-20, 20)};
    case 3:
      return layout::FlipCommand{ids};
    case 4:
      return document.placements.size() > 3 ? layout::Command{layout::RemoveCommand{{id}}}
                                            : layout::Command{layout::FlipCommand{ids}};
    case 5:
      return layout::SwapCommand{id, some_id(document, random)};
    case 6:
      return layout::LockCommand{ids, random.below(3) == 0};
    case 7:
    case 8:
      return layout::SlideCommand{ids, some_vector(random, 10)};
    case 9:
      return layout::SlideAlongCommand{ids, some_vector(random, 60)};
    case 10:
      return layout::SettleCommand{
          ids, some_vector(random, 10),
          random.below(2) == 0 ? std::optional(some_vector(random, 10)) : std::nullopt};
    case 11:
      return layout::PushCommand{ids, some_vector(random, 40)};
    case 12:
      return layout::SnapCommand{id, geom::grid_from_mm(random.uniform(1, 20))};
    case 13:
      if (random.below(8) == 0) return layout::CompactCommand{layout::Sheet{0, 0}, {-1, 0}};
      return layout::SlideCommand{ids, {-1, 0}};
    default:
      return layout::NearestCommand{ids, some_vector(random, 40), std::nullopt};
  }
}

}  // namespace lekalo::cases
