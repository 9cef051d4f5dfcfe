// Any bytes into the checker's own readers, chosen by the first: JSON, contours in each form, regions,
// results and certificates, features. Each gives what can be used, or one sentence; and what the checker
// takes for JSON is JSON.

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "require.hpp"
#include "verify/locate/document.hpp"
#include "verify/locate/feature_file.hpp"
#include "verify/read/contour.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::verify;

void check_sentence(const Error& error) {
  require(error.code == ErrorCode::bad_input && !error.message.empty() && error.message.size() < 2000);
  require(error.message.find('\n') == std::string::npos);
}

/// Texts of other letters are only ever compared with plain words, so the checker does not look at their
/// encoding; and it has numbers that are no doubles.
bool plain(std::string_view bytes) {
  const bool ascii = std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c < 0x80; });
  const auto exponent = [](char a, char b) { return a >= '0' && a <= '9' && (b | 0x20) == 'e'; };
  const bool doubles = std::adjacent_find(bytes.begin(), bytes.end(), exponent) == bytes.end();
  return ascii && doubles && bytes.find("\\u") == std::string_view::npos;
}

std::size_t walk(Json value) {
  if (value.is_string()) return json_text(value).size();
  if (!value.is_object() && !value.is_array()) return 1;
  std::size_t found = 0;
  for (JsonItems items(value); const auto item = items.next();) {
    require(item->text.data() >= value.text.data() &&
            item->text.data() + item->text.size() <= value.text.data() + value.text.size());
    found += walk(*item) + items.key().size();
  }
  return found;
}

void try_contour(std::string_view bytes, std::string_view ending) {
  const auto contour = read_contour({"c" + std::string(ending), bytes});
  if (!contour) return check_sentence(contour.error());
  require(contour->x.size() == contour->y.size() && contour->size() > 0);
}

void try_shape(Json value, bool inch) {
  std::string complaint;
  const Shape shape = read_shape(value, "outline", complaint, inch);
  if (!complaint.empty()) return require(complaint.size() < 2000);
  require(shape.sides.size() == shape.exact.size() || !shape.sides.empty());
  require(shape.contour_starts.back() == shape.sides.size());
  require(shape.piece_starts.back() + 1 == shape.contour_starts.size());
  require(shape.low_x <= shape.high_x && shape.low_y <= shape.high_y);
}

void try_result(Json value) {
  const auto result = read_result_document(value, "r.json");
  if (!result) return check_sentence(result.error());
  if (!result->certificate || !result->certificate->is_array()) return;
  JsonItems items(*result->certificate);
  for (std::size_t i = 0; const auto item = items.next(); ++i)
    if (const auto one = read_interval(*item, i, "r.json"); !one) check_sentence(one.error());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr std::array<std::string_view, 4> kEndings{".csv", ".xyz", ".dxf", ".json"};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const unsigned choice = data[0] % 10;
  if (choice < kEndings.size()) {
    try_contour(bytes, kEndings[choice]);
    return 0;
  }
  const auto value = parse_json(bytes, "f.json");
  if (!value) {
    check_sentence(value.error());
    return 0;
  }
  if (plain(bytes)) require(nlohmann::json::accept(bytes));
  walk(*value);
  std::string complaint;
  if (choice < 6) try_shape(*value, choice == 5);
  if (choice == 6) try_result(*value);
  if (choice == 7) (void)read_features(*value, LengthUnit::inch, complaint);
  if (choice == 8)
    if (const auto list = read_certificate_document({"c.json", bytes}); !list) check_sentence(list.error());
  return 0;
}
