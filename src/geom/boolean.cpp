#include "lekalo/geom/boolean.hpp"

#include "overlay.hpp"

namespace lekalo::geom {
namespace {

using detail::Winding;

detail::KeepRule rule_of(BooleanOperation operation) {
  switch (operation) {
    case BooleanOperation::intersect:
      return [](const Winding& w) { return w[0] > 0 && w[1] > 0; };
    case BooleanOperation::subtract:
      return [](const Winding& w) { return w[0] > 0 && w[1] <= 0; };
    case BooleanOperation::exclude:
      return [](const Winding& w) { return (w[0] > 0) != (w[1] > 0); };
    case BooleanOperation::unite:
      break;
  }
  return [](const Winding& w) { return w[0] > 0 || w[1] > 0; };
}

}  // namespace

Result<BooleanResult> combine(const std::vector<Region>& a, const std::vector<Region>& b,
                              BooleanOperation operation, double operand_error) {
  detail::Outlines outlines;
  outlines.add(a, 0);
  outlines.add(b, 1);
  return detail::overlay(outlines, rule_of(operation), operand_error);
}

Result<BooleanResult> united(const std::vector<Region>& pieces, double operand_error) {
  return combine(pieces, {}, BooleanOperation::unite, operand_error);
}

}  // namespace lekalo::geom
