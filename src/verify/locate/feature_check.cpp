#include "feature_check.hpp"

#include <algorithm>
#include <set>

#include "feature_file.hpp"
#include "lekalo/base/joined_text.hpp"

namespace lekalo::verify {
namespace {

std::string text_of(const std::optional<double>& number) {
  return number ? fmt::format("{}", *number) : "none";
}

/// Returns the number of the first edge of every contour, and the number of edges at the end. Lines that join
/// an arc to its ends are no edges.
std::vector<std::size_t> first_edges(const Shape& part) {
  std::vector<std::size_t> firsts;
  std::size_t edges = 0, side = 0;
  for (const std::size_t start : part.contour_starts) {
    for (; side < start; ++side) edges += part.sides[side].written ? 1 : 0;
    firsts.push_back(edges);
  }
  return firsts;
}

class FeatureCheck {
 public:
  FeatureCheck(const std::string& file, const StatedDemands& stated, const DemandClaims& claims)
      : file_(file), stated_(stated), claims_(claims) {}

  void run() {
    check_minimum();
    if (!stated_.ignored.empty() && !claims_.part_cut)
      find("{} ignores some of the part, but part_cut is false", file_);
    if (stated_.ignored.empty() && claims_.part_cut) find("part_cut is true, but {} ignores nothing", file_);
    static const std::vector<WrittenFeature> none;
    const std::vector<WrittenFeature>& written = claims_.demands ? claims_.demands->features : none;
    for (std::size_t k = 0; k < std::max(written.size(), stated_.features.size()); ++k) {
      if (k >= written.size())
        return find("feature \"{}\" of {} is missing from the demands", stated_.features[k].name, file_);
      if (k >= stated_.features.size())
        return find("feature \"{}\" of the demands is not in {}", written[k].name, file_);
      if (written[k].name != stated_.features[k].name)
        return find("feature {} of the demands is \"{}\", but \"{}\" in {}", k, written[k].name,
                    stated_.features[k].name, file_);
      check_numbers(written[k], stated_.features[k]);
      check_edges(written[k], stated_.features[k]);
    }
  }

  [[nodiscard]] const std::vector<std::string>& findings() const { return findings_; }
  /// Returns a sentence for everything that was left open.
  [[nodiscard]] const std::vector<std::string>& open() const { return open_; }

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  /// The larger of the two minima holds for all edges of no feature, with demands and without.
  void check_minimum() {
    const double asked = approximate(claims_.min_allowance), least = std::max(asked, stated_.minimum);
    if (claims_.demands == nullptr) {
      if (asked < stated_.minimum)
        find("the minimum of {} is {} mm, but the result has no demands and a min_allowance of {} mm", file_,
             stated_.minimum, asked);
      return;
    }
    if (approximate(claims_.demands->minimum_as_written) != least)
      find("demands.minimum is {} mm, but min_allowance and {} demand {} mm",
           approximate(claims_.demands->minimum_as_written), file_, least);
  }

  void check_numbers(const WrittenFeature& written, const StatedFeature& stated) {
    const FeatureNumbers &is = written.numbers, &should = stated.numbers;
    const auto compare = [&](const char* what, const std::optional<double>& one,
                             const std::optional<double>& other) {
      if (one != other)
        find("feature \"{}\": {} is {}, but {} in {}", stated.name, what, text_of(one), text_of(other),
             file_);
    };
    compare("minimum", is.minimum, should.minimum);
    compare("target", is.target, should.target);
    compare("maximum", is.maximum, should.maximum);
    compare("scale", is.scale, should.scale);
    compare("finished", is.finished, should.finished);
  }

  void check_edges(const WrittenFeature& written, const StatedFeature& stated) {
    if (written.edges.empty()) find("feature \"{}\" has no edges", stated.name);
    if (stated.label) return check_label(written, stated);
    if (claims_.part_cut && claims_.origin.edges.empty()) {
      open_.push_back(fmt::format("which edges feature \"{}\" has without what {} ignores was not rechecked",
                                  stated.name, file_));
      return;
    }
    std::vector<std::size_t> edges;
    if (stated.edges) {
      edges = *stated.edges;
    } else {
      const std::vector<std::size_t> firsts =
          first_edges(claims_.part_cut ? *claims_.origin.in_file : claims_.part);
      const std::size_t contour = stated.contour.value_or(0);
      if (contour + 1 >= firsts.size())
        return find("feature \"{}\" has contour {} in {}, which the part has not", stated.name, contour,
                    file_);
      for (std::size_t k = firsts[contour]; k < firsts[contour + 1]; ++k) edges.push_back(k);
    }
    if (claims_.part_cut)
      return check_marked(written, claims_.origin.edges, std::set(edges.begin(), edges.end()));
    if (written.edges != edges)
      find("feature \"{}\" has other edges than {} says: {}, not {}", stated.name, file_,
           excerpt(joined_text(written.edges, ", ")), excerpt(joined_text(edges, ", ")));
  }

  void check_label(const WrittenFeature& written, const StatedFeature& stated) {
    if (!claims_.origin.labels.empty())
      return check_marked(written, claims_.origin.labels, std::set<std::string>{*stated.label});
    if (claims_.origin.in_file)
      return find("feature \"{}\" has the label \"{}\" in {}, but edges of a region file have none",
                  stated.name, *stated.label, file_);
    open_.push_back(fmt::format("which edges have the label \"{}\" was not rechecked for feature \"{}\"",
                                *stated.label, stated.name));
  }

  /// Every edge of the feature has one of the marks, and no other edge has nothing but these. An edge along
  /// which two sides coincide may have the mark of either.
  template <class Mark>
  void check_marked(const WrittenFeature& written, const std::vector<std::set<Mark>>& marks_of_edge,
                    const std::set<Mark>& wanted) {
    for (std::size_t edge = 0; edge < marks_of_edge.size(); ++edge) {
      const std::set<Mark>& marks = marks_of_edge[edge];
      const auto is_wanted = [&](const Mark& mark) { return wanted.count(mark) > 0; };
      const bool listed = std::count(written.edges.begin(), written.edges.end(), edge) > 0;
      if (listed && std::none_of(marks.begin(), marks.end(), is_wanted))
        return find("feature \"{}\" has edge {}, which {} does not give it", written.name, edge, file_);
      if (!listed && !marks.empty() && std::all_of(marks.begin(), marks.end(), is_wanted))
        return find("feature \"{}\" lacks edge {}, which {} gives it", written.name, edge, file_);
    }
  }

  const std::string& file_;
  const StatedDemands& stated_;
  const DemandClaims& claims_;
  std::vector<std::string> findings_, open_;
};

/// Adds what one reading of the file says to the report. Returns false where something was left open.
bool hand_over(const FeatureCheck& check, LocateReport& report) {
  report.findings.insert(report.findings.end(), check.findings().begin(), check.findings().end());
  report.notes.insert(report.notes.end(), check.open().begin(), check.open().end());
  return check.open().empty();
}

bool check_without_file(const DemandClaims& claims, LocateReport& report) {
  const WrittenDemands* const d = claims.demands;
  if (claims.part_cut || (d != nullptr && !d->features.empty()))
    report.findings.emplace_back(
        "the result has demands of features or a part that is cut, but names no file of features");
  if (d != nullptr && approximate(d->minimum_as_written) != approximate(claims.min_allowance))
    report.findings.push_back(fmt::format("demands.minimum is {} mm, but min_allowance is {} mm",
                                          approximate(d->minimum_as_written),
                                          approximate(claims.min_allowance)));
  return true;
}

}  // namespace

IgnoredRegions read_ignored(const std::optional<Document>& file) {
  const Result<Json> root = file ? parse_json(file->bytes, file->name) : Json{};
  std::string complaint;
  if (!root) return {};
  const StatedDemands stated = read_features(*root, LengthUnit::millimetre, complaint);
  return {stated.ignored, stated.unit};
}

bool check_features(const std::optional<Document>& file, const DemandClaims& claims, LocateReport& report) {
  if (!file) return check_without_file(claims, report);
  const Result<Json> root = parse_json(file->bytes, file->name);
  if (!root) return report.findings.push_back(root.error().message), true;
  std::string complaint;
  const StatedDemands in_mm = read_features(*root, LengthUnit::millimetre, complaint);
  if (!complaint.empty())
    return report.findings.push_back(fmt::format("{}: {}", file->name, complaint)), true;
  FeatureCheck as_mm(file->name, in_mm, claims);
  as_mm.run();
  if (in_mm.unit) return hand_over(as_mm, report);
  // A file that does not say its unit may have been given one on the command line.
  const StatedDemands in_inches = read_features(*root, LengthUnit::inch, complaint);
  FeatureCheck as_inches(file->name, in_inches, claims);
  as_inches.run();
  return hand_over(as_inches.findings().empty() ? as_inches : as_mm, report);
}

}  // namespace lekalo::verify
