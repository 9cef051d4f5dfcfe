#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "profile_path.hpp"

namespace lekalo::nc {

/// Writes motions as the words of one post. Positions are the rounded ones, digit by digit.
class ProfileWriter {
 public:
  ProfileWriter(const std::string& name, const ProfileOptions& options);

  /// Text for the operator, letters and digits alone; everything else becomes a blank.
  void comment(const std::string& words);
  /// A contour from its pierce: the lead, perhaps, and the closed path.
  void cut(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path);
  [[nodiscard]] std::string finish();
  [[nodiscard]] std::size_t size() const noexcept { return text_.size(); }

 private:
  void line(const std::string& words);
  void rapid_to(WrittenPoint p);
  void follow(const std::vector<WrittenEdge>& edges, bool feed_changed);
  [[nodiscard]] std::string length(double mm) const;
  [[nodiscard]] std::string feed(double mm_per_min) const;
  [[nodiscard]] std::string count(std::int64_t units) const;

  const ProfileOptions& options_;
  Resolution resolution_;
  std::string text_;
};

}  // namespace lekalo::nc
