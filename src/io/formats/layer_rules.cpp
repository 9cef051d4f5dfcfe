#include "lekalo/io/formats/layer_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "io/drawing/layers.hpp"
#include "io/layout/mark_words.hpp"
#include "io/text/file_faults.hpp"
#include "io/text/json_reader.hpp"
#include "io/text/json_tree.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::io {
namespace {

using detail::JsonKind;
using detail::JsonTree;
using detail::JsonValue;

constexpr std::string_view kLayersFormat = "lekalo-layers/1";
constexpr std::size_t kMostLayerRows = 10'000;

constexpr std::array<std::pair<LayerRole, std::string_view>, 5> kLayerRoles{{{LayerRole::cut, "cut"},
                                                                             {LayerRole::mark, "mark"},
                                                                             {LayerRole::engrave, "engrave"},
                                                                             {LayerRole::bend, "bend"},
                                                                             {LayerRole::ignore, "ignore"}}};

/// A to Z in lower case.
std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

class LayerRulesReader {
 public:
  explicit LayerRulesReader(const std::string& name) : name_(name) {}

  Result<LayerRules> read(JsonValue root) {
    LEKALO_CHECK(expect_format(root, name_, "table of layers", kLayersFormat));
    for (const JsonValue item : root)
      if (item.key() != "format" && item.key() != "layers")
        complain(fmt::format("there is no key {} beside \"format\" and \"layers\"", excerpt(item.key())));
    const auto list = root.find("layers");
    if (!list || list->kind() != JsonKind::list || list->size() == 0 || list->size() > kMostLayerRows)
      complain(fmt::format("\"layers\" has to be a list of 1 to {} rows", kMostLayerRows));
    else
      for (const JsonValue item : *list) row(item);
    LEKALO_CHECK(faults_.refused(name_));
    return LayerRules{name_, std::move(rows_)};
  }

 private:
  void complain(const std::string& what) { faults_.add(what); }

  void row(JsonValue json) {
    ++number_;
    faults_.where = fmt::format("row {}: ", number_);
    if (json.kind() == JsonKind::object)
      take(json);
    else
      complain(fmt::format("an object is needed, not {}", name_of(json.kind())));
    faults_.where.clear();
  }

  void take(JsonValue json) {
    LayerRule rule;
    bool has_role = false;
    const std::size_t before = faults_.count();
    for (const JsonValue item : json) {
      const std::string_view key = item.key();
      if (key == "name")
        rule.name = text(item);
      else if (key == "colour")
        rule.colour = colour(item);
      else if (key == "line_type")
        rule.line_type = text(item);
      else if (key == "role")
        has_role = true, rule.role = role(item);
      else
        complain(fmt::format("there is no key {}; known are name, colour, line_type and role", excerpt(key)));
    }
    if (!has_role) complain("role is missing: what the layer is, one of cut, mark, engrave, bend and ignore");
    if (faults_.count() > before) return;
    if (all_since_ != 0)
      complain(fmt::format("row {} names no layer and so fits all, so this row never counts; put it before",
                           all_since_));
    else if (const auto [place, is_new] = first_.emplace(
                 std::tuple(lower_case(rule.name), rule.colour, lower_case(rule.line_type)), number_);
             !is_new)
      complain(fmt::format("row {} fits the same layers already; leave one of them out", place->second));
    if (rule.name.empty() && rule.colour.empty() && rule.line_type.empty()) all_since_ = number_;
    rows_.push_back(std::move(rule));
  }

  std::string text(JsonValue item) {
    if (item.kind() == JsonKind::text) {
      const std::string_view said = item.text();
      const bool is_plain = std::none_of(
          said.begin(), said.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
      if (is_plain && !said.empty() && said.size() <= detail::kLongestText) return std::string(said);
    }
    complain(fmt::format(
        "{} has to be a text of 1 to {} bytes without control characters; leave it out to fit any",
        item.key(), detail::kLongestText));
    return "";
  }

  std::string colour(JsonValue item) {
    const std::string said = item.kind() == JsonKind::text ? lower_case(std::string(item.text())) : "";
    if (detail::is_colour(said)) return said;
    complain(fmt::format("colour {} has to be written as in \"#0000ff\"",
                         item.kind() == JsonKind::text ? excerpt(item.text()) : name_of(item.kind())));
    return "";
  }

  LayerRole role(JsonValue item) {
    const std::string_view said = item.kind() == JsonKind::text ? item.text() : std::string_view();
    if (const auto known = detail::value_among(kLayerRoles, said)) return *known;
    complain(fmt::format("role {} has to be one of cut, mark, engrave, bend and ignore",
                         item.kind() == JsonKind::text ? excerpt(said) : name_of(item.kind())));
    return LayerRole::mark;
  }

  const std::string& name_;
  FileFaults faults_;
  std::size_t number_ = 0, all_since_ = 0;
  std::vector<LayerRule> rows_;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> first_;
};

}  // namespace

Result<LayerRules> read_layer_rules(std::string_view bytes, const std::string& name) {
  LEKALO_TRY(const JsonTree tree, JsonTree::parse(bytes, name));
  return LayerRulesReader(name).read(tree.root());
}

std::optional<LayerRole> role_of(const LayerRules& rules, const Layer& layer) {
  for (const LayerRule& rule : rules.rows)
    if ((rule.name.empty() || same_layer(rule.name, layer.name)) &&
        (rule.colour.empty() || rule.colour == lower_case(layer.colour)) &&
        (rule.line_type.empty() || same_layer(rule.line_type, layer.line_type)))
      return rule.role;
  return std::nullopt;
}

}  // namespace lekalo::io
