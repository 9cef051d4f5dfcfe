#include "same_layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace lekalo::verify {
namespace {

bool same_outline(const WrittenOutline& a, const WrittenOutline& given) {
  if ((a.drawn == nullptr) != (given.drawn == nullptr)) return false;
  if (a.drawn != nullptr &&
      (a.chord_tolerance != given.chord_tolerance || !same_edges(*a.drawn, *given.drawn, kStep)))
    return false;
  // A polygon that was made is proved to be that of its curves by the reader.
  return !given.unmade.empty() || loops_of(a) == loops_of(given);
}

bool same_part(const WrittenPart& a, const WrittenPart& b) {
  const bool areas = std::equal(a.areas.begin(), a.areas.end(), b.areas.begin(), b.areas.end(),
                                [](const WrittenArea& p, const WrittenArea& q) {
                                  return p.quality == q.quality && same_outline(p.outline, q.outline);
                                });
  return a.id == b.id && areas && a.marks == b.marks && a.texts == b.texts && a.rotations == b.rotations &&
         same_outline(a.outline, b.outline) && a.quality == b.quality && a.may_mirror == b.may_mirror &&
         a.grain == b.grain && a.tolerated_severity == b.tolerated_severity && a.priority == b.priority &&
         a.demand == b.demand && a.gap == b.gap && a.border_gap == b.border_gap &&
         a.defect_gap == b.defect_gap && a.material == b.material && a.customer == b.customer &&
         a.due == b.due && a.label == b.label;
}

bool same_features(const std::vector<WrittenStockFeature>& a, const std::vector<WrittenStockFeature>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const WrittenStockFeature& p, const WrittenStockFeature& q) {
                      return p.id == q.id && p.grade == q.grade && same_outline(p.outline, q.outline);
                    });
}

bool same_stock(const WrittenStock& a, const WrittenStock& b) {
  return a.id == b.id && a.kind == b.kind && a.count == b.count && a.cost == b.cost && a.open == b.open &&
         a.grain == b.grain && a.material == b.material && same_outline(a.outline, b.outline) &&
         same_features(a.defects, b.defects) && same_features(a.zones, b.zones);
}

bool same_place(const WrittenPiece& a, const WrittenPiece& b) {
  return a.part == b.part && a.stock == b.stock && a.copy == b.copy && a.turn == b.turn && a.at == b.at &&
         a.mirrored == b.mirrored && a.locked == b.locked;
}

template <class T, class Same>
void compare(const char* what, const std::vector<T>& a, const std::vector<T>& given, const Same& are_same,
             std::vector<std::string>& to) {
  if (a.size() != given.size()) {
    to.push_back(
        fmt::format("there are {} {}s, and {} in the layout it was made from", a.size(), what, given.size()));
    return;
  }
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!are_same(a[i], given[i]))
      to.push_back(fmt::format("{} \"{}\" is not that of the layout it was made from", what, a[i].id));
}

}  // namespace

std::vector<GridLoop> loops_of(const GridOutline& outline) {
  std::vector<GridLoop> loops;
  bool open = false;
  for (const GridEdge& edge : outline.edges) {
    if (!open) loops.emplace_back();
    loops.back().push_back(edge.from);
    open = !(edge.to == loops.back().front());
  }
  for (GridLoop& loop : loops)
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loops;
}

std::vector<std::string> differences(const WrittenLayout& layout, const WrittenLayout& given) {
  std::vector<std::string> found;
  compare("stock", layout.stocks, given.stocks, same_stock, found);
  compare("part", layout.parts, given.parts, same_part, found);
  compare(
      "kit", layout.kits, given.kits, [](const auto& a, const auto& b) { return a == b; }, found);
  if (layout.kerf != given.kerf) found.emplace_back("the kerf is not that of the layout it was made from");
  std::map<std::uint64_t, const WrittenPiece*> pieces;
  for (const WrittenPiece& piece : layout.placements) pieces[piece.id] = &piece;
  for (const WrittenPiece& piece : given.placements) {
    if (!piece.locked) continue;
    const auto there = pieces.find(piece.id);
    if (there == pieces.end() || !same_place(*there->second, piece))
      found.push_back(fmt::format("placement {} is locked and does not lie where it lay", piece.id));
  }
  return found;
}

}  // namespace lekalo::verify
