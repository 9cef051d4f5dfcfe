#include "stated_arcs.hpp"

#include <utility>

namespace lekalo::io {

void DxfExactArcs::add(std::string_view text) {
  const std::size_t blank = text.find(' ');
  const auto arc = blank == std::string_view::npos ? std::nullopt : read_exact_arc(text.substr(blank + 1));
  if (arc)
    arcs_[std::string(text.substr(0, blank))].push_back(*arc);
  else
    ++unfit_;
}

std::size_t DxfExactArcs::restore(std::vector<DrawnCurve>& curves, const std::vector<DrawnEntity>& entities) {
  if (arcs_.empty()) return unfit_;
  std::vector<DrawnCurve> made;
  made.reserve(curves.size());
  for (std::size_t begin = 0, end = 0; begin < curves.size(); begin = end) {
    while (end < curves.size() && curves[end].entity == curves[begin].entity) ++end;
    const auto found = arcs_.find(entities[curves[begin].entity].handle);
    if (found == arcs_.end()) {
      for (std::size_t i = begin; i < end; ++i) made.push_back(std::move(curves[i]));
      continue;
    }
    const std::uint32_t entity = curves[begin].entity, layer = curves[begin].layer;
    std::vector<BoundedShape> shapes;
    for (std::size_t i = begin; i < end; ++i) shapes.push_back({std::move(curves[i].shape), curves[i].error});
    unfit_ += restore_exact_arcs(shapes, found->second);
    arcs_.erase(found);  // copies by blocks come at other places
    for (BoundedShape& one : shapes) made.push_back({std::move(one.shape), entity, layer, one.error});
  }
  curves = std::move(made);
  for (const auto& [handle, arcs] : arcs_) unfit_ += arcs.size();
  return unfit_;
}

}  // namespace lekalo::io
