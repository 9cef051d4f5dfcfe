#pragma once

#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/verify/claims.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {

/// The fields of a report or of an object in it. Each is asked for by name, and refuse_others() complains
/// about those that nobody asked for: a field that is not known may be a claim.
class ReportFields {
 public:
  ReportFields(Json object, std::string path, std::string& complaint)
      : object_(object), fields_(object, std::move(path), complaint), complaint_(complaint) {}

  [[nodiscard]] Json get(std::string_view key) {
    known_.insert(std::string(key));
    return fields_.get(key);
  }
  [[nodiscard]] bool has(std::string_view key) { return !get(key).text.empty(); }
  [[nodiscard]] std::string text(std::string_view key) {
    known_.insert(std::string(key));
    return fields_.text(key);
  }
  [[nodiscard]] double number(std::string_view key) {
    known_.insert(std::string(key));
    return approximate(fields_.number(key));
  }
  [[nodiscard]] std::optional<double> number_or_null(std::string_view key) {
    if (get(key).is_null()) return std::nullopt;
    return number(key);
  }
  /// An item of a list.
  [[nodiscard]] double number_of(Json item, const std::string& path) {
    return approximate(fields_.number_of(item, path));
  }
  [[nodiscard]] std::optional<double> number_or_null_of(Json item, const std::string& path) {
    if (item.is_null()) return std::nullopt;
    return number_of(item, path);
  }
  /// A list of so many numbers.
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(std::string_view key) {
    std::array<double, N> numbers{};
    std::size_t count = 0;
    each(key, [&](Json item, const std::string& path) {
      const double number = number_of(item, path);
      if (count < N) numbers[count] = number;
      ++count;
    });
    if (count != N) complain(fmt::format("field {} has not {} numbers", name(key), N));
    return numbers;
  }
  [[nodiscard]] std::size_t index(std::string_view key) {
    known_.insert(std::string(key));
    return fields_.index(key);
  }
  template <class F>
  void each(std::string_view key, F f) {
    known_.insert(std::string(key));
    fields_.each(key, f);
  }
  [[nodiscard]] std::string& complaint() { return complaint_; }
  [[nodiscard]] std::string name(std::string_view key) const { return fields_.name(key); }
  void complain(const std::string& sentence) { fields_.complain(sentence); }

  void refuse_others() {
    if (!object_.is_object()) return;
    JsonItems items(object_);
    while (items.next())
      if (!known_.contains(items.key()))
        complain(fmt::format("field {} is not one of such a report", name(excerpt(items.key()))));
  }

 private:
  Json object_;
  Fields fields_;
  std::string& complaint_;
  std::set<std::string, std::less<>> known_;
};

/// Complains unless `format` says this name and version 1, and the units are mm.
inline void check_format(ReportFields& report, std::string_view name, std::string& complaint) {
  ReportFields format(report.get("format"), "format", complaint);
  if (!complaint.empty()) return;
  if (format.text("name") != name) report.complain(fmt::format("field format.name is not {}", name));
  if (format.index("version") != 1) report.complain("field format.version is not 1");
  format.refuse_others();
  if (report.text("units") != "mm") report.complain("field units is not \"mm\"");
}

/// Adds a finding where a number is not the one that the checker finds.
inline void compare(ReportFields& fields, std::string_view key, double found, ClaimReport& report) {
  const double written = fields.number(key);
  if (written != found)
    report.findings.push_back(fmt::format("{} is {} and is to be {}", fields.name(key), written, found));
}

/// Calls compare_item(fields, i) for as many items of a list as there are to be, and adds a finding where it
/// has more or fewer.
template <class F>
void compare_items(ReportFields& fields, std::string_view list, std::size_t wanted, ClaimReport& report,
                   F compare_item) {
  std::size_t count = 0;
  fields.each(list, [&](Json value, const std::string& path) {
    ReportFields item(value, path, fields.complaint());
    if (count < wanted) {
      compare_item(item, count);
      item.refuse_others();
    }
    ++count;
  });
  if (count != wanted)
    report.findings.push_back(fmt::format("{} has {} items and is to have {}", list, count, wanted));
}

}  // namespace lekalo::verify
