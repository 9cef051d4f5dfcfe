#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/layout/layout_export.hpp"

namespace lekalo::io::detail {

/// Takes words one after the other into a request, and at the end says which are missing and which do not go
/// together. Words of a command line, of a request and of a file of processes have their ranges here.
class ExportWordTaker {
 public:
  /// The name of a word where the user wrote it: "--lead-in", "lead_in_mm".
  using Shown = std::function<std::string(const std::string&)>;

  ExportWordTaker(ExportRequest& request, Shown shown) : request_(request), shown_(std::move(shown)) {}

  /// \pre the value is not empty
  [[nodiscard]] Result<void> take(const ExportWord& word);
  /// The sentences about words that have to be given but were not, and about those that contradict each
  /// other. Gives the tolerance its value where none was given.
  [[nodiscard]] std::vector<std::string> complete();

 private:
  [[nodiscard]] bool was_given(const char* name) const;
  [[nodiscard]] const char* form_name() const;
  [[nodiscard]] bool fits_form(const std::string& name) const;
  [[nodiscard]] Result<void> layers(const std::string& value);
  template <class T>
  [[nodiscard]] Result<void> choice(const ExportWord& word,
                                    std::initializer_list<std::pair<const char*, T>> choices, T& to) const;
  [[nodiscard]] Result<void> post(const ExportWord& word);
  [[nodiscard]] tl::unexpected<Error> none_of(const ExportWord& word, const std::string& list) const;
  [[nodiscard]] Result<void> number(const ExportWord& word, double low, double high, double& to) const;
  [[nodiscard]] Result<void> tool_number(const ExportWord& word, int& to) const;
  [[nodiscard]] Result<void> profile_number(const ExportWord& word);
  /// Words of pierces and joints: export_joint_words.cpp.
  [[nodiscard]] Result<void> joint_rule(const ExportWord& word);
  [[nodiscard]] Result<void> joints_of(const ExportWord& word);
  void complain_of_pierces(std::vector<std::string>& complaints) const;
  void complain_of_joints(std::vector<std::string>& complaints) const;

  /// Words of knives: export_knife_words.cpp.
  [[nodiscard]] Result<void> process(const ExportWord& word);
  [[nodiscard]] Result<void> knife_number(const ExportWord& word);
  void complete_knife(std::vector<std::string>& complaints);

  /// Takes the words for engraving into the request.
  void complete_engraving(std::vector<std::string>& complaints);

  ExportRequest& request_;
  Shown shown_;
  nc::Engraving engraving_;
  nc::KnifeOptions knife_;
  std::vector<std::string> given_;
};

/// Says whether the word has a meaning for knives alone.
[[nodiscard]] bool is_knife_word(const std::string& name);
/// Says whether the value of the word `process` is a knife, whose programs are plots.
[[nodiscard]] bool is_knife(const std::string& process);

}  // namespace lekalo::io::detail
