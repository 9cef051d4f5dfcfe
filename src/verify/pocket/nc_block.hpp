#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "nc_expression.hpp"

namespace lekalo::verify {

/// The words of one line of an NC program, of which the control knows each.
struct NcBlock {
  std::size_t line = 0;
  std::vector<const words::Word*> codes;
  /// M words that the shop allows, in the order of the block.
  std::vector<int> allowed;
  /// The numbers of the letters but for G and M; 0 for N and O.
  std::array<std::optional<double>, 26> words;
  /// The letters of numbers but 0 that have no decimal point, in their order.
  std::string pointless;

  [[nodiscard]] std::optional<double> operator[](char letter) const {
    return words[static_cast<std::size_t>(letter - 'A')];
  }
  [[nodiscard]] const words::Word* code(words::Group group) const {
    for (const words::Word* each : codes)
      if (each->group == group) return each;
    return nullptr;
  }
  [[nodiscard]] bool has_axis() const { return (*this)['X'] || (*this)['Y'] || (*this)['Z']; }
  [[nodiscard]] bool has_rotary() const { return (*this)['A'] || (*this)['B'] || (*this)['C']; }
  [[nodiscard]] bool empty() const;
};

/// The word as people write it, `G59.3`.
[[nodiscard]] std::string name_of(const words::Word& word);

/// Takes the lines of a program apart, and computes its variables and expressions. An object reads one
/// program from its first line on, because the lines before decide what a variable, `O` and `%` mean.
class NcLines {
 public:
  /// \param allowed_m  M words that pass beside those of the table
  NcLines(words::Control control, std::vector<int> allowed_m)
      : control_(control), allowed_m_(std::move(allowed_m)) {}

  /// Reads the next line into `block`, whose `line` is set. False where the line is not understood:
  /// complaint() says why.
  [[nodiscard]] bool read(std::string_view text, bool in_subprogram, NcBlock& block);

  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  /// True after a `%` that ends the program.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  bool complain(const std::string& sentence);
  bool check_bytes(std::string_view& text);
  bool tape_mark(std::string_view text);
  bool set_variable(std::string_view code);
  bool knows_variables(std::string_view code);
  bool take_apart(std::string_view text, NcBlock& block);
  bool take_word(std::string_view text, std::size_t& at, NcBlock& block);
  bool take_comment(std::string_view text, std::size_t& at);
  bool take_name(char letter, std::string_view digits, NcBlock& block);
  bool keep(char letter, double value, NcBlock& block);
  bool fit(const NcBlock& block);

  words::Control control_;
  std::vector<int> allowed_m_;
  std::string complaint_;
  NcVariables variables_;
  bool in_subprogram_ = false;
  bool any_text_ = false, any_words_ = false, begun_by_mark_ = false, ended_ = false;
};

}  // namespace lekalo::verify
