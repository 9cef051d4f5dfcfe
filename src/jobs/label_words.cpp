#include "lekalo/jobs/label_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "lekalo/io/text/length_word.hpp"

namespace lekalo::jobs {
namespace {

constexpr double kLargestPaper = 1000;  // mm
constexpr int kMostLabelsAcross = 100;

struct NamedPaper {
  std::string_view name;
  io::PlaneSize size;
};
constexpr std::array kPapers{NamedPaper{"A4", {210, 297}}, NamedPaper{"A5", {148, 210}},
                             NamedPaper{"letter", {215.9, 279.4}}};

bool fine_page(const io::PlaneSize& size) {
  const auto fine = [](double mm) { return mm > 0 && mm <= kLargestPaper; };
  return fine(size.width_mm) && fine(size.height_mm);
}

/// One or two lengths from 0 to those of the largest paper.
std::optional<io::PlaneSize> distances_of(const std::string& word) {
  const std::optional<double> both = io::length_of(word);
  const auto read = both ? io::PlaneSize{*both, *both} : io::size_of(word);
  const auto fine = [](double mm) { return mm >= 0 && mm <= kLargestPaper; };
  if (!read || !fine(read->width_mm) || !fine(read->height_mm)) return std::nullopt;
  return read;
}

/// Reads "3x8", from 1x1 on.
bool read_counts(std::string_view word, int& columns, int& rows) {
  const auto number = [](std::string_view text, int& to) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, to);
    return error == std::errc{} && stop == end && to >= 1 && to <= kMostLabelsAcross;
  };
  const std::size_t x = word.find('x');
  return x != std::string_view::npos && number(word.substr(0, x), columns) &&
         number(word.substr(x + 1), rows);
}

class LabelWordReader {
 public:
  explicit LabelWordReader(const std::string& prefix) : prefix_(prefix) {}

  Result<void> take(const io::ExportWord& word) {
    const std::string& name = word.first;
    const auto& known = label_words();
    if (std::none_of(known.begin(), known.end(), [&](const auto& help) { return help.name == name; }))
      return failure(ErrorCode::usage, fmt::format("{}{} has no meaning for the form labels", prefix_, name));
    given_.push_back(name);
    if (name == "label-size") return size(word);
    if (name == "label-sheet") return sheet(word);
    if (name == "label-remnant") return remnant(word);
    const auto read = distances_of(word.second);
    if (!read)
      return wrong(word, fmt::format("one length from 0 to {} mm, or two as in 7x13", kLargestPaper));
    draw::LabelPaper& paper = options_.paper;
    (name == "label-gap" ? paper.gap_x : paper.margin_x) = read->width_mm;
    (name == "label-gap" ? paper.gap_y : paper.margin_y) = read->height_mm;
    return {};
  }

  Result<LabelOptions> complete() const {
    const bool on_sheet = has("label-sheet");
    if (on_sheet && has("label-size"))
      return failure(
          ErrorCode::usage,
          fmt::format("{0}label-size is for labels on a roll and {0}label-sheet for those on sheets, "
                      "whose size follows from their number: leave one out",
                      prefix_));
    for (const char* const name : {"label-margin", "label-gap"})
      if (!on_sheet && has(name))
        return failure(
            ErrorCode::usage,
            fmt::format("{0}{1} has a meaning for sheets of labels alone: {0}label-sheet", prefix_, name));
    const draw::LabelPaper& paper = options_.paper;
    if (!(paper.label_width() > 0 && paper.label_height() > 0))
      return failure(
          ErrorCode::usage,
          fmt::format("{0}label-margin and {0}label-gap leave no room for {1} x {2} labels on paper of "
                      "{3:g} x {4:g} mm",
                      prefix_, paper.columns, paper.rows, paper.page_width, paper.page_height));
    return options_;
  }

 private:
  [[nodiscard]] bool has(const char* name) const {
    return std::find(given_.begin(), given_.end(), name) != given_.end();
  }
  [[nodiscard]] tl::unexpected<Error> wrong(const io::ExportWord& word, const std::string& wanted) const {
    return failure(ErrorCode::usage,
                   fmt::format("{}{} {}: has to be {}", prefix_, word.first, word.second, wanted));
  }

  Result<void> size(const io::ExportWord& word) {
    const auto read = io::size_of(word.second);
    if (!read || !fine_page(*read))
      return wrong(word, fmt::format("width and height of a label, up to {} mm, as in 62x29", kLargestPaper));
    options_.paper.page_width = read->width_mm, options_.paper.page_height = read->height_mm;
    return {};
  }

  Result<void> sheet(const io::ExportWord& word) {
    const std::size_t colon = word.second.rfind(':');
    const std::string paper = word.second.substr(0, colon);
    const auto named = std::find_if(kPapers.begin(), kPapers.end(),
                                    [&](const NamedPaper& one) { return one.name == paper; });
    const auto page = named != kPapers.end() ? named->size : io::size_of(paper).value_or(io::PlaneSize{});
    draw::LabelPaper& to = options_.paper;
    if (!fine_page(page) || colon == std::string::npos ||
        !read_counts(std::string_view(word.second).substr(colon + 1), to.columns, to.rows))
      return wrong(word,
                   fmt::format("A4, A5, letter or a size up to {} mm, and the labels across and down, up to "
                               "{}, as in A4:3x8",
                               kLargestPaper, kMostLabelsAcross));
    to.page_width = page.width_mm, to.page_height = page.height_mm;
    return {};
  }

  Result<void> remnant(const io::ExportWord& word) {
    const auto read = io::length_of(word.second);
    if (!read || !(*read >= 0)) return wrong(word, "a length from 0 mm");
    options_.least_remnant_mm = *read;
    return {};
  }

  LabelOptions options_;
  const std::string& prefix_;
  std::vector<std::string> given_;
};

}  // namespace

const std::vector<io::ExportWordHelp>& label_words() {
  static const std::vector<io::ExportWordHelp> words{
      {"label-size", "WxH", "labels: on a roll, mm [62x29]"},
      {"label-sheet", "PAPER:COLUMNSxROWS", "labels: on sheets; A4, A5, letter or WxH"},
      {"label-margin", "MM|XxY", "labels, sheets: from the paper's edges to the labels [0]"},
      {"label-gap", "MM|XxY", "labels, sheets: between labels [0]"},
      {"label-remnant", "MM", "labels: also for remnants with no shorter side [100]"}};
  return words;
}

Result<LabelOptions> read_label_words(const std::vector<io::ExportWord>& words, const std::string& prefix) {
  LabelWordReader reader(prefix);
  for (const io::ExportWord& word : words) LEKALO_CHECK(reader.take(word));
  return reader.complete();
}

}  // namespace lekalo::jobs
