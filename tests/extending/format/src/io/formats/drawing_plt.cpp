#include <fmt/core.h>

#include <algorithm>

#include "io/drawing/drawn_shapes.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/io/drawing/drawing_format.hpp"

namespace lekalo::io {
namespace {

/// Files of cutters (HPGL): words of two letters with numbers behind them, in fortieths of a millimetre.
/// Every pen is a layer.
class PltReader {
 public:
  PltReader(std::string_view bytes, const std::string& name) : rest_(bytes) { drawing_.name = name; }

  Result<Drawing> read() {
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      if (word == "LB") {
        (void)taken(rest_.find('\x03'));  // a label ends with that
        skip(word);
      } else if (const std::string_view numbers = taken(rest_.find_first_of(";ABCDEFGHIJKLMNOPQRSTUVWXYZ"));
                 word == "PU" || word == "PD" || word == "PA") {
        if (word != "PA") down_ = word == "PD";
        LEKALO_CHECK(move(word, numbers));
      } else if (word == "SP") {
        pen_ = fmt::format("pen {}", numbers);
      } else if (word != "IN" && word != "SI" && word != "LO") {
        skip(word);
      }
    }
    return std::move(drawing_);
  }

 private:
  /// The bytes up to there; without such a place all that are left.
  std::string_view taken(std::size_t end) {
    const std::string_view bytes = rest_.substr(0, end);
    line_ += static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n'));
    rest_.remove_prefix(bytes.size());
    return bytes;
  }
  std::string_view next_word() {
    (void)taken(rest_.find_first_not_of("; \t\r\n\x03"));
    return taken(2);
  }

  void skip(std::string_view word) {
    const auto known = std::find_if(drawing_.unread.begin(), drawing_.unread.end(),
                                    [&](const Unread& unread) { return unread.name == word; });
    if (known == drawing_.unread.end()) return drawing_.unread.push_back({std::string(word), 1, line_});
    ++known->count;
  }

  /// Along the points that the numbers are, two and two.
  Result<void> move(std::string_view word, std::string_view numbers) {
    drawing_.entities.push_back({std::string(word), "", line_});
    Millimetres pair[2];
    for (std::size_t k = 0;; ++k) {
      numbers.remove_prefix(std::min(numbers.find_first_not_of(", \t\r\n"), numbers.size()));
      if (numbers.empty()) {
        if (k % 2 == 0) return {};
        return refuse_line(drawing_.name, line_, fmt::format("{} has an x without y", word));
      }
      const std::string_view number = numbers.substr(0, numbers.find_first_of(", \t\r\n"));
      numbers.remove_prefix(number.size());
      const auto read = read_millimetres(number, DecimalFactor{25, -3});
      if (!read) return refuse_line(drawing_.name, line_, number_sentence(read.error(), number));
      pair[k % 2] = *read;
      if (k % 2 == 1) go({{pair[0].value, pair[1].value}, std::max(pair[0].error, pair[1].error)});
    }
  }
  void go(const BoundedPoint& to) {
    if (down_ && !(to.at == at_.at)) {
      const BoundedShape line = line_between(at_, to);
      drawing_.curves.push_back(
          {line.shape, static_cast<std::uint32_t>(drawing_.entities.size() - 1), layer(), line.error});
    }
    at_ = to;
  }
  std::uint32_t layer() {
    std::size_t k = 0;
    while (k < drawing_.layers.size() && drawing_.layers[k].name != pen_) ++k;
    if (k == drawing_.layers.size()) drawing_.layers.push_back({pen_, false});
    return static_cast<std::uint32_t>(k);
  }

  std::string_view rest_;
  std::size_t line_ = 1;
  Drawing drawing_;
  BoundedPoint at_;
  std::string pen_ = "pen 1";
  bool down_ = false;
};

Result<Drawing> parse_plt(std::string_view bytes, const std::string& name, std::optional<LengthUnit> unit) {
  LEKALO_CHECK(agree_on_unit(name, LengthUnit::millimetre, "a plotter's fortieth of a millimetre", unit));
  return PltReader(bytes, name).read();
}

}  // namespace

DrawingFormat drawing_plt() {
  return {.file = {.name = "PLT", .endings = {".plt", ".hpgl"}, .first_bytes = "IPS"}, .parse = parse_plt};
}

}  // namespace lekalo::io
