#include "certificate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "certificate_leaf.hpp"
#include "certificate_tables.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "solid_window.hpp"

namespace lekalo::verify {
namespace {

/// After this many findings the certificate has failed, and the other leaves are only read.
constexpr std::size_t kMostFailures = 3;

class TreeCheck {
 public:
  TreeCheck(Json tree, std::string path, const LeafFrame& frame, const PartBounds* bounds,
            CertificateTables& tables, std::vector<std::string>& findings, std::string& complaint)
      : path_(std::move(path)),
        frame_(frame),
        bounds_(bounds),
        tables_(tables),
        findings_(findings),
        complaint_(complaint),
        fields_(tree, path_, complaint) {}

  /// Returns the box of the whole tree.
  PoseBox root() {
    for (std::size_t k = 0; k < 6; ++k) {
      const auto ends =
          numbers_of<2>(fields_.get(kAxes[k]), complaint_, [&] { return fields_.name(kAxes[k]); });
      if (ends) whole_.low[k] = both((*ends)[0]), whole_.high[k] = both((*ends)[1]);
      if (whole_.high[k].exact < whole_.low[k].exact)
        complain(fmt::format("{} is not in ascending order", fields_.name(kAxes[k])));
    }
    return whole_;
  }

  /// Reads the nodes and checks the leaves. `nodes` counts those of all trees.
  void walk(std::size_t& nodes, std::size_t& leaves) {
    const Json list = fields_.get("nodes");
    if (!list.is_array()) complain(fmt::format("{} is not a list", fields_.name("nodes")));
    if (!complaint_.empty()) return;
    const std::size_t failed = findings_.size() + kMostFailures;
    Cell root{};
    for (std::size_t k = 0; k < 6; ++k) {
      root.low[k] = end_at(whole_.low[k]);
      root.high[k] = end_at(whole_.high[k]);
    }
    std::vector<Cell> open{root};
    JsonItems items(list);
    for (; const auto item = items.next(); ++at_) {
      if (nodes++ == limits::kMostCertificateNodes)
        return complain(
            fmt::format("{} is beyond the most nodes, {}", name(), limits::kMostCertificateNodes));
      if (open.empty()) return complain(name() + " is one more than the subdivision needs");
      const Cell cell = open.back();
      open.pop_back();
      const auto first = item->is_array() ? JsonItems(*item).next() : std::nullopt;
      if (first && first->is_string()) {
        split(*item, cell, open);
      } else {
        ++leaves;
        check_leaf(*item, cell, findings_.size() < failed);
      }
      if (!complaint_.empty()) return;
    }
    if (!open.empty())
      findings_.push_back(
          fmt::format("{}: the subdivision ends early, {} boxes are missing", path_, open.size()));
  }

 private:
  static constexpr std::array<std::string_view, 6> kAxes{"x", "y", "z", "turn_x", "turn_y", "turn_z"};
  /// In the order of LeafTerm::Kind.
  static constexpr std::array<std::string_view, 10> kKinds{
      "ball", "plane", "face", "part_face", "edges", "point", "point_plane", "point_face", "datum", "near"};

  /// The ends of a box, by their places among all ends: a split has one, which many boxes share.
  struct Cell {
    std::array<std::uint32_t, 6> low, high;
  };

  void complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
  }
  [[nodiscard]] std::string name() const { return fmt::format("{}.nodes[{}]", path_, at_); }

  std::uint32_t end_at(Both place) {
    ends_.push_back(std::move(place));
    return static_cast<std::uint32_t>(ends_.size() - 1);
  }

  void split(Json node, const Cell& cell, std::vector<Cell>& open) {
    JsonItems items(node);
    const std::string word = json_text(*items.next());
    const auto axis = static_cast<std::size_t>(std::ranges::find(kAxes, word) - kAxes.begin());
    const auto at = items.next();
    const auto place = at ? parse_decimal(at->text) : std::nullopt;
    if (axis == kAxes.size() || !place || items.next())
      return complain(name() + " is neither a split nor a leaf");
    const std::uint32_t end = end_at(both(*place));
    Cell low = cell, high = cell;
    if (ends_[end].exact < ends_[cell.low[axis]].exact || ends_[cell.high[axis]].exact < ends_[end].exact)
      return complain(fmt::format("{} splits {} outside of its box", name(), kAxes[axis]));
    low.high[axis] = high.low[axis] = end;
    open.push_back(high);
    open.push_back(low);
  }

  void check_leaf(Json leaf, const Cell& cell, bool look) {
    if (!leaf.is_array()) return complain(name() + " is neither a split nor a leaf");
    terms_.clear();
    const std::size_t before = findings_.size();
    std::size_t count = 0;
    JsonItems items(leaf);
    while (const auto item = items.next()) {
      if (count++ == limits::kMostCertificateTerms)
        return complain(fmt::format("{} has more than {} terms", name(), limits::kMostCertificateTerms));
      if (!read_term(*item, look)) return complain(name() + " has a term that is none");
    }
    if (!any_) return complain(name() + " has no multiplier above 0");
    any_ = false;
    if (!look) return;
    if (findings_.size() > before) return;
    PoseBox box;
    for (std::size_t k = 0; k < 6; ++k) box.low[k] = ends_[cell.low[k]], box.high[k] = ends_[cell.high[k]];
    if (proves(terms_, box, frame_)) return;
    std::string where;
    for (std::size_t k = 0; k < 6; ++k)
      where += fmt::format("{}{} {} to {}", k == 0 ? "" : ", ", kAxes[k], nearest(box.low[k].exact),
                           nearest(box.high[k].exact));
    findings_.push_back(
        fmt::format("{}: its terms do not prove that no placement with {} has more {} than {} mm", name(),
                    where, bounds_ == nullptr ? "clearance" : "margin", nearest(frame_.bound.exact)));
  }

  /// Reads one term; where `look` says so, it goes to the terms, unless it is not what it has to be.
  bool read_term(Json item, bool look) {
    if (!item.is_array()) return false;
    JsonItems items(item);
    std::array<Json, 4> value;
    for (Json& one : value) {
      const auto next = items.next();
      if (!next) return false;
      one = *next;
    }
    const auto multiplier = value[3].is_number() ? parse_decimal(value[3].text) : std::nullopt;
    if (items.next() || !value[0].is_string() || !multiplier || sgn(multiplier->digits) < 0 ||
        is_beyond_all_sizes(*multiplier))
      return false;
    const std::string word = json_text(value[0]);
    const auto place = static_cast<std::size_t>(std::ranges::find(kKinds, word) - kKinds.begin());
    if (place == kKinds.size()) return false;
    const auto kind = static_cast<LeafTerm::Kind>(place);
    const auto of_part = number_of_part(kind, value[1]), of_blank = number_of_blank(kind, value[2]);
    if (!of_part || !of_blank) return false;
    if (sgn(multiplier->digits) == 0) return true;
    any_ = true;
    if (look) add_term(kind, *of_part, *of_blank, *multiplier);
    return true;
  }

  /// \pre it is not of a datum
  static bool is_of_point(LeafTerm::Kind kind) { return kind >= LeafTerm::Kind::point; }
  static bool is_of_part_ball(LeafTerm::Kind kind) { return kind <= LeafTerm::Kind::face; }

  [[nodiscard]] std::optional<std::size_t> number_of_part(LeafTerm::Kind kind, Json value) const {
    if (kind == LeafTerm::Kind::part_face) return triangle_of(value, frame_.part);
    if (kind == LeafTerm::Kind::edges) return edge_of(value, frame_.part);
    if (kind == LeafTerm::Kind::datum) return index(value, tables_.datum_points());
    return index(value, is_of_point(kind) ? tables_.part_points() : tables_.part_balls());
  }
  [[nodiscard]] std::optional<std::size_t> number_of_blank(LeafTerm::Kind kind, Json value) const {
    switch (kind) {
      case LeafTerm::Kind::face:
      case LeafTerm::Kind::point_face:
        return triangle_of(value, frame_.blank);
      case LeafTerm::Kind::edges:
        return edge_of(value, frame_.blank);
      case LeafTerm::Kind::plane:
      case LeafTerm::Kind::point_plane:
        return index(value, tables_.planes());
      case LeafTerm::Kind::datum:
        return index(value, tables_.directions());
      case LeafTerm::Kind::near:
        return index(value, 6 * tables_.bodies());
      default:
        return index(value, tables_.blank_balls());
    }
  }

  void add_term(LeafTerm::Kind kind, std::size_t of_part, std::size_t of_blank, const Decimal& multiplier) {
    LeafTerm term;
    term.kind = kind;
    term.multiplier = both(multiplier);
    term.part = static_cast<std::uint32_t>(of_part);
    term.blank = static_cast<std::uint32_t>(of_blank);
    if (kind == LeafTerm::Kind::datum) {
      if (hold(term)) terms_.push_back(std::move(term));
      return;
    }
    if (kind == LeafTerm::Kind::near) {
      if (keep_off(term)) terms_.push_back(std::move(term));
      return;
    }
    bool holds = true;
    std::uint32_t triangle = kind == LeafTerm::Kind::edges ? term.part / 3 : term.part;
    if (is_of_part_ball(kind)) {
      holds = (term.part_ball = tables_.part_ball(of_part)) != nullptr;
    } else if (is_of_point(kind)) {
      const PartPoint* const point = tables_.part_point(of_part);
      holds = point != nullptr;
      if (holds) term.part_ball = &point->ball, triangle = point->triangle;
    }
    if (kind == LeafTerm::Kind::ball || kind == LeafTerm::Kind::part_face || kind == LeafTerm::Kind::point)
      holds = (term.blank_ball = tables_.blank_ball(of_blank)) != nullptr && holds;
    if (kind == LeafTerm::Kind::plane || kind == LeafTerm::Kind::point_plane)
      holds = (term.plane = tables_.plane(of_blank)) != nullptr && holds;
    if (!holds) return;
    set_bound(term, triangle);
    terms_.push_back(std::move(term));
  }

  /// Gives the term of a datum its point, and of its direction what leads straight off the datum.
  bool hold(LeafTerm& term) {
    const DatumPoint* const point = tables_.datum_point(term.part);
    if (point == nullptr) return false;
    const SolidDatum& datum = *point->datum;
    const Exact3 u = straight_off(datum, as<Fraction>(*tables_.direction(term.blank)));
    if (sgn(dot(u, u)) == 0) {
      findings_.push_back(
          fmt::format("{} has a direction that does not lead off the datum \"{}\"", name(), datum.name));
      return false;
    }
    HeldPoint& held = term.held.emplace();
    held = {*point->place, datum.through, {}, {Fraction(datum.within), just(datum.within)}};
    for (std::size_t axis = 0; axis < 3; ++axis) held.direction[axis] = {u[axis], enclosed(u[axis])};
    return true;
  }

  /// Gives the term of a point that is to be near the blank's surface the body in which it is not.
  bool keep_off(LeafTerm& term) {
    const PartPoint* const point = tables_.part_point(term.part);
    const FarBody* const body = tables_.body(term.blank / 6);
    if (point == nullptr || body == nullptr) return false;
    const double within = bounds_ == nullptr ? kInfinity : bounds_->within[point->triangle];
    if (!(within < kInfinity) || body->apart < Fraction(within)) {
      findings_.push_back(fmt::format(
          "{} has a body {} mm off the blank's surface, and the part's triangle {} may be {} from it", name(),
          verify::nearest(body->apart), frame_.part.numbers[point->triangle],
          within < kInfinity ? fmt::format("{} mm", within) : "anyhow far"));
      return false;
    }
    term.part_ball = &point->ball;
    term.body = body;
    return true;
  }

  /// Says whether it may be of a point that demands nothing. A ball of the part has no bound where there are
  /// rims.
  [[nodiscard]] bool in_rim(const LeafTerm& term, std::uint32_t triangle) const {
    if (bounds_->rims == nullptr) return false;
    return is_of_point(term.kind) ? !bounds_->rims->spare(as<Fraction>(term.part_ball->centre))
                                  : !bounds_->rims->spare(triangle);
  }

  /// Gives the term the bound of what its side of the part demands; a finding where that is nothing.
  void set_bound(LeafTerm& term, std::uint32_t triangle) {
    if (bounds_ == nullptr) return;
    std::uint32_t place = bounds_->least.value_or(PartBounds::kAsCast);
    if (!is_of_part_ball(term.kind)) place = bounds_->of[triangle];
    if (place != PartBounds::kAsCast && in_rim(term, triangle))
      findings_.push_back(fmt::format("{} has a term of the part's triangle {} in the rim of a finished face",
                                      name(), frame_.part.numbers[triangle]));
    else if (place != PartBounds::kAsCast)
      term.bound = &bounds_->bounds[place];
    else if (is_of_part_ball(term.kind))
      findings_.push_back(
          fmt::format("{} has a part ball, but something of the part is as cast or finished", name()));
    else
      findings_.push_back(fmt::format("{} has a term of the part's triangle {}, which is as cast or finished",
                                      name(), frame_.part.numbers[triangle]));
  }

  /// Reads a whole number below a count.
  static std::optional<std::size_t> index(Json value, std::size_t count) {
    const auto number = value.is_number() ? parse_decimal(value.text) : std::nullopt;
    return number ? index_below(*number, count) : std::nullopt;
  }
  static std::optional<std::size_t> triangle_of(Json value, const SolidMesh& mesh) {
    const auto number = index(value, limits::kMostSolidItems);
    return number ? mesh.triangle_of_file(*number) : std::nullopt;
  }
  static std::optional<std::size_t> edge_of(Json value, const SolidMesh& mesh) {
    const auto number = index(value, 3 * limits::kMostSolidItems);
    const auto triangle = number ? mesh.triangle_of_file(*number / 3) : std::nullopt;
    return triangle ? std::optional(3 * std::size_t{*triangle} + *number % 3) : std::nullopt;
  }

  std::string path_;
  const LeafFrame& frame_;
  const PartBounds* bounds_;
  CertificateTables& tables_;
  std::vector<std::string>& findings_;
  std::string& complaint_;
  Fields fields_;
  PoseBox whole_;
  std::vector<Both> ends_;
  std::vector<LeafTerm> terms_;
  bool any_ = false;
  std::size_t at_ = 0;
};

}  // namespace

Result<void> SolidCertificate::check(Json certificate, const std::string& name) {
  std::string complaint;
  const auto bad = [&] { return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, complaint)); };
  Fields fields(certificate, "certificate", complaint);
  const auto pivot =
      numbers_of<3>(fields.get("pivot"), complaint, [] { return std::string("certificate.pivot"); });
  CertificateTables tables(certificate, part_, blank_, datums_, findings_, complaint);
  if (!complaint.empty()) return bad();
  Both3 at;
  bool same_pivot = true;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = both((*pivot)[k]);
    same_pivot = same_pivot && compare((*pivot)[k], window_.pivot[k]) == 0;
  }
  if (!same_pivot) findings_.emplace_back("the pivot of the certificate is not that of the window");

  std::size_t nodes = 0;
  const std::vector<std::size_t> charts = charts_of(window_);
  std::vector<std::string> beyond;
  std::size_t trees = 0;
  fields.each("trees", [&](Json item, const std::string& path) {
    if (!complaint.empty()) return;
    const auto start = numbers_of<4>(Fields(item, path, complaint).get("quaternion"), complaint,
                                     [&] { return path + ".quaternion"; });
    if (start && std::ranges::all_of(*start, [](const Decimal& q) { return sgn(q.digits) == 0; }))
      complaint = path + ".quaternion is 0, which is no rotation";
    if (!complaint.empty()) return;
    const LeafFrame frame{part_, blank_, SolidMotion({*start, {}}), at, both(bound_)};
    TreeCheck tree(item, path, frame, bounds_, tables, findings_, complaint);
    const PoseBox root = tree.root();
    if (!complaint.empty()) return;
    if (trees < charts.size())
      if (const auto part = beyond_box(window_, charts[trees], root, *start))
        beyond.push_back(fmt::format("{}: {}", path, *part));
    ++trees;
    tree.walk(nodes, leaves_);
  });
  if (!complaint.empty()) return bad();
  if (trees != charts.size())
    findings_.push_back(
        fmt::format("certificate.trees has {} trees, and the window takes {}", trees, charts.size()));
  findings_.insert(findings_.end(), beyond.begin(), beyond.end());
  return {};
}

}  // namespace lekalo::verify
