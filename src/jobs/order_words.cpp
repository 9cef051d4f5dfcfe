#include "lekalo/jobs/order_words.hpp"

#include <fmt/core.h>

#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "lekalo/io/text/format.hpp"
#include "lekalo/io/text/length_word.hpp"

namespace lekalo::jobs {
namespace {

bool fine_side(double mm) { return limits::kShortestSide <= mm && mm <= limits::kLargestOutline; }

/// Takes "=5" off the end of a word. Fails where the number is out of range.
Result<std::optional<std::int64_t>> take_count(std::string& word) {
  const std::size_t equals = word.find_last_of('=');
  const bool digits = equals != std::string::npos && equals + 1 < word.size() &&
                      word.find_first_not_of("0123456789", equals + 1) == std::string::npos;
  if (!digits) return std::optional<std::int64_t>();
  const auto count = io::quantity_of(word.substr(equals + 1));
  if (!count) return failure(ErrorCode::usage, "does not end in a number from 1 to 1,000,000,000");
  word.resize(equals);
  return count;
}

bool ends_like_a_file(const std::string& word) {
  return io::drawing_format_by_ending(word) != nullptr || io::kJsonFormat.is_named_so(word) ||
         io::kPointsFormat.is_named_so(word);
}

/// Takes "@steel:2" off the end of a word.
Result<layout::Material> take_material(std::string& word) {
  layout::Material material;
  const std::size_t at = word.find_last_of('@');
  if (at == std::string::npos || ends_like_a_file(word)) return material;
  const std::string said = word.substr(at + 1);
  const std::size_t colon = said.find_last_of(':');
  const auto name = io::kept_text(said.substr(0, colon));
  if (!name)
    return failure(ErrorCode::usage, "names a material of more than 1,000 bytes or with control characters");
  material.name = *name;
  if (colon != std::string::npos) {
    const auto thickness = io::thickness_of(said.substr(colon + 1));
    if (!thickness)
      return failure(
          ErrorCode::usage,
          fmt::format("has the thickness {}, which is no length from 0.001 to 262144 mm, as 2 or 1/16in",
                      io::excerpt(said.substr(colon + 1))));
    material.thickness = *thickness;
  }
  word.resize(at);
  return material;
}

class TermsReader {
 public:
  TermsReader(const OrderWords& words, std::string_view prefix) : words_(words), prefix_(prefix) {}

  Result<OrderTerms> read() {
    for (const std::string& word : words_.sheets) add_sheet(word);
    for (const std::string& word : words_.strips) add_strip(word);
    for (const std::string& word : words_.builds) add_build(word);
    constexpr const char* kLength = "a length from 0 to 262144 mm, as 4, 1/8in or 3 mm";
    length("gap", words_.gap, 0, kLength, terms_.gap_mm);
    length("border", words_.border, 0, kLength, terms_.border_mm);
    length("kerf", words_.kerf, 0, kLength, terms_.kerf_mm);
    if (!words_.rotations.empty()) {
      const auto angles = io::rotations_of(words_.rotations);
      if (!angles) complain("rotations", words_.rotations, "is not \"any\" or degrees, as in 0,90");
      terms_.rotations = angles.value_or(std::vector<layout::AngleRange>{});
    }
    if (!words_.grain.empty()) {
      terms_.grain_degrees = io::grain_of(words_.grain);
      if (!terms_.grain_degrees) complain("grain", words_.grain, "is not x, y or a number of degrees");
    }
    terms_.may_mirror = words_.may_mirror;
    if (!complaint_.empty()) return failure(ErrorCode::usage, complaint_);
    return std::move(terms_);
  }

 private:
  void complain(const char* name, const std::string& word, const std::string& trouble) {
    complaint_ +=
        fmt::format("{}{}{}: \"{}\" {}", complaint_.empty() ? "" : "; ", prefix_, name, word, trouble);
  }

  void length(const char* name, const std::string& word, double low, const char* wanted, double& mm) {
    if (word.empty()) return;
    const std::optional<double> read = io::length_of(word);
    if (read && low <= *read && *read <= limits::kLargestOutline)
      mm = *read;
    else
      complain(name, word, fmt::format("is not {}", wanted));
  }

  void add_sheet(const std::string& word) {
    const auto read = ordered_word(word);
    if (!read) return complain("sheet", word, read.error().message);
    StockWord stock{read->word, io::size_of(read->word), read->count, read->material};
    if (stock.size && !(fine_side(stock.size->width_mm) && fine_side(stock.size->height_mm)))
      complain("sheet", word,
               fmt::format("has a side that is not from {} to {} mm", limits::kShortestSide,
                           limits::kLargestOutline));
    terms_.stocks.push_back(std::move(stock));
  }

  void add_strip(const std::string& word) {
    const auto read = ordered_word(word);
    if (!read) return complain("strip", word, read.error().message);
    if (read->count) return complain("strip", word, "has a number of pieces; there is one of a strip");
    StockWord stock{read->word, SheetSize{}, std::nullopt, read->material};
    length("strip", read->word, limits::kShortestSide, "the width of a strip from 0.001 to 262144 mm",
           stock.size->height_mm);
    terms_.stocks.push_back(std::move(stock));
  }

  void add_build(const std::string& word) {
    Build build{word, 1};
    const auto count = take_count(build.assembly);
    if (!count) return complain("build", word, count.error().message);
    build.count = count->value_or(1);
    terms_.builds.push_back(std::move(build));
  }

  const OrderWords& words_;
  std::string_view prefix_;
  OrderTerms terms_;
  std::string complaint_;
};

}  // namespace

Result<OrderTerms> read_order_words(const OrderWords& words, std::string_view prefix) {
  return TermsReader(words, prefix).read();
}

Result<OrderedWord> ordered_word(const std::string& word) {
  OrderedWord read{word, std::nullopt, {}};
  LEKALO_TRY(read.count, take_count(read.word));
  LEKALO_TRY(read.material, take_material(read.word));
  if (read.count) return read;
  LEKALO_TRY(read.count, take_count(read.word));
  return read;
}

OrderedPart ordered_part(const io::OrderRow& row, File file, const OrderTerms& terms) {
  OrderedPart part;
  part.file = std::move(file);
  part.quantity = row.quantity;
  part.name = row.name;
  part.rotations = row.rotations.value_or(terms.rotations);
  part.may_mirror = row.may_mirror.value_or(terms.may_mirror);
  part.grain = row.grain;
  if (!part.grain && terms.grain_degrees) part.grain = layout::Grain{*terms.grain_degrees, 0};
  part.priority = row.priority;
  part.material = row.material;
  part.purpose = row.purpose;
  part.said_in = row.said_in;
  return part;
}

Order order_of(const OrderTerms& terms) {
  Order order;
  order.gap_mm = terms.gap_mm;
  order.border_mm = terms.border_mm;
  order.kerf_mm = terms.kerf_mm;
  order.grain_degrees = terms.grain_degrees;
  return order;
}

}  // namespace lekalo::jobs
