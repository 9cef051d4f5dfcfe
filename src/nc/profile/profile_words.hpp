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
  /// \param engraves  true if marks come before the cuts
  ProfileWriter(const std::string& name, const ProfileOptions& options, bool engraves);

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
  [[nodiscard]] bool has_tool_of_marks() const;
  /// Takes a tool, goes to the height of travels and turns the spindle on.
  void start_router(int tool, double speed);
  void rapid_to(WrittenPoint p) { out_.line("G0" + out_.pair('X', 'Y', p)); }
  /// \param feed  mm/min
  /// \param says_feed  false where the program has it in force already
  void follow(const std::vector<WrittenEdge>& edges, double feed, bool says_feed);
  /// A path with joints, below the upper face of the tabs that they are.
  void follow_with_tabs(const std::vector<WrittenEdge>& path, double depth, double feed, bool says_feed);
  [[nodiscard]] std::string length(double mm) const;

  const ProfileOptions& options_;
  Resolution resolution_;
  ProgramWriter out_;
};

}  // namespace lekalo::nc
