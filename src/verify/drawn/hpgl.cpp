#include <fmt/core.h>

#include <array>

#include "drawn_file.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {
namespace {

constexpr double kUnit = 0.025;  // mm
/// By pen, from 1.
constexpr std::array<const char*, 7> kLayersOfPens{"CUT", "MARK", "LABEL", "SHEET", "DEFECT", "ZONE", "AREA"};

class HpglReader {
 public:
  explicit HpglReader(const Document& document) : name_(document.name), rest_(document.bytes) {}

  Result<DrawnFile> read() {
    while (complaint_.empty() && skip_blanks()) {
      // A label ends with the first character ETX, so that it may hold a semicolon.
      const bool label = rest_.starts_with("LB");
      const std::size_t end = rest_.find(label ? '\x03' : ';');
      if (end == std::string_view::npos) {
        complaint_ = "an instruction is cut off";
        break;
      }
      if (!label)
        instruction(rest_.substr(0, end));
      else if (pen_ != 3 || !rest_.substr(end + 1).starts_with(';'))
        complain(rest_.substr(0, end));
      rest_.remove_prefix(end + (label ? 2 : 1));
      ++number_;
    }
    if (complaint_.empty() && pen_ != 0) complaint_ = "it does not end with SP0";
    if (!complaint_.empty()) return failure(ErrorCode::bad_input, fmt::format("{}: {}", name_, complaint_));
    return DrawnFile{std::move(lines_), {}};
  }

 private:
  bool skip_blanks() {
    while (!rest_.empty() && (rest_.front() == '\n' || rest_.front() == '\r')) rest_.remove_prefix(1);
    return !rest_.empty();
  }
  void complain(std::string_view word) {
    complaint_ = fmt::format("instruction {}: lekalo writes no {} there", number_, excerpt(word));
  }

  void instruction(std::string_view word) {
    if (number_ < 2) {
      if (word != (number_ == 0 ? "IN" : "PA")) complain(word);
      return;
    }
    const std::string_view kind = word.substr(0, 2),
                           values = word.substr(std::min<std::size_t>(2, word.size()));
    if (pen_ == 0 && begun_) complain(word);
    if (kind == "SP") {
      if (values.size() != 1 || values[0] < '0' || values[0] > '7') return complain(word);
      pen_ = values[0] - '0';
      begun_ = true;
    } else if (kind == "PU") {
      const std::vector<Place> places = read_places(values);
      if (places.size() > 1) complain(word);
      if (!places.empty()) at_ = places[0];
    } else if (kind == "PD" && pen_ > 0 && pen_ != 3) {
      draw(read_places(values));
    } else if (!(pen_ == 3 && (kind == "SI" || word == "LO5"))) {
      complain(word);
    }
  }

  void draw(const std::vector<Place>& places) {
    DrawnLine line{kLayersOfPens[static_cast<std::size_t>(pen_ - 1)], {}, false};
    const Place begin = at_;
    for (const Place place : places) {
      line.edges.push_back(line_between(at_, place));
      at_ = place;
    }
    // A contour of less than a plotter unit is one place.
    if (places.empty()) line.edges.push_back(line_between(at_, at_));
    line.closed = begin.x == at_.x && begin.y == at_.y;
    lines_.push_back(std::move(line));
  }

  std::vector<Place> read_places(std::string_view values) {
    std::vector<double> numbers;
    while (!values.empty()) {
      const std::size_t comma = std::min(values.find(','), values.size());
      const std::optional<double> number = double_of_text(values.substr(0, comma));
      if (!number || *number != std::nearbyint(*number)) complain(values.substr(0, comma));
      numbers.push_back(number.value_or(0) * kUnit);
      values.remove_prefix(std::min(comma + 1, values.size()));
    }
    if (numbers.size() % 2 != 0) complain("odd list of numbers");
    std::vector<Place> places;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) places.push_back({numbers[i], numbers[i + 1]});
    return places;
  }

  const std::string& name_;
  std::string_view rest_;
  std::string complaint_;
  std::size_t number_ = 0;
  int pen_ = 0;
  bool begun_ = false;
  Place at_;
  std::vector<DrawnLine> lines_;
};

}  // namespace

Result<DrawnFile> read_hpgl(const Document& document) { return HpglReader(document).read(); }

}  // namespace lekalo::verify
