#include "stated_arcs.hpp"

#include <algorithm>

#include "scanner.hpp"

namespace lekalo::io::detail {

std::string exact_arcs_text(const std::vector<ExactArc>& arcs) {
  std::string text;
  for (const ExactArc& arc : arcs) text += (text.empty() ? "" : "; ") + text_of(arc);
  return text;
}

std::size_t restore_exact_arcs(std::vector<BoundedShape>& curves, std::string_view text) {
  std::vector<ExactArc> arcs;
  std::size_t unreadable = 0;
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(one.size() + 1, text.size()));
    if (const auto arc = read_exact_arc(one))
      arcs.push_back(*arc);
    else
      ++unreadable;
  }
  return unreadable + io::restore_exact_arcs(curves, arcs);
}

bool restore_page_corner(Affine& map, std::string_view text) {
  SvgScanner scanner(text);
  const auto x = scanner.number();
  scanner.skip_comma();
  const auto y = x ? scanner.number() : x;
  if (!x || !y || !scanner.at_end()) return false;
  const Affine moved = composed({1, 0, 0, 1, {x->value, y->value}, 0, std::max(x->error, y->error)}, map);
  const bool plain = moved.xx == 1 && moved.xy == 0 && moved.yx == 0 && moved.yy == -1 &&
                     moved.shift == geom::Point{} && moved.linear_error == 0 && moved.shift_error == 0;
  if (plain) map = moved;
  return plain;
}

}  // namespace lekalo::io::detail
