#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "profile_path.hpp"

namespace lekalo::nc {

/// Writes cuts as a program. Positions are the rounded ones, digit by digit.
class ProfileWriter {
 public:
  ProfileWriter(const std::string& name, const ProfileOptions& options);

  void comment(const std::string& words) { out_.comment(words); }
  /// A contour from its pierce, or a stretch between joints: the lead, perhaps, and the path. A router goes
  /// over the joints in it at the height of tabs.
  void cut(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path,
           double feed_mm_per_min);
  /// Marks, one after the other, between these two; all of them before the first cut.
  void begin_engraving();
  void engrave(const std::vector<WrittenEdge>& path);
  void end_engraving();
  [[nodiscard]] std::string finish();
  [[nodiscard]] std::size_t size() const noexcept { return out_.size(); }
  [[nodiscard]] std::size_t line_count() const noexcept { return out_.line_count(); }

 private:
  void cut_by_beam(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path, double feed);
  void cut_by_router(const std::vector<WrittenEdge>& lead, const std::vector<WrittenEdge>& path, double feed);
  void rapid_to(WrittenPoint p) { out_.line("G0" + out_.pair('X', 'Y', p)); }
  /// \param feed  mm/min, for the first of the edges; nothing: the feed stands already
  void follow(const std::vector<WrittenEdge>& edges, std::optional<double> feed);
  /// A path with joints, below the upper face of the tabs that they are.
  void follow_with_tabs(const std::vector<WrittenEdge>& path, double depth, double feed, bool says_feed);
  [[nodiscard]] std::string length(double mm) const;

  const ProfileOptions& options_;
  Resolution resolution_;
  ProgramWriter out_;
};

}  // namespace lekalo::nc
