#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// A feature is what people draw on a stock: a defect or a quality zone.
enum class FeatureKind : std::uint8_t { defect, zone };
/// Returns "defect" or "zone".
[[nodiscard]] std::string_view name_of(FeatureKind kind) noexcept;

/// The limits of features that commands make; files have the same ones.
inline constexpr int kMostSeverity = 1'000'001;
inline constexpr int kMostQuality = 1'000'000;
/// The points of one outline.
inline constexpr std::size_t kMostFeaturePoints = 100'000;
/// The features of one kind on one stock.
inline constexpr std::size_t kMostFeatures = 100'000;
inline constexpr std::size_t kLongestFeatureId = 1000;  ///< bytes

/// A defect or a quality zone.
struct Feature {
  FeatureKind kind = FeatureKind::defect;
  /// Unique among those of its kind on one stock.
  std::string id;
  int grade = 1;  ///< Defect::severity or QualityZone::quality
  Outline outline;
  friend bool operator==(const Feature&, const Feature&) = default;
};

/// A change of one feature. `index` is its place in the list of its kind on the stock: before the change
/// where the feature goes, after the change where it comes.
struct FeatureChange {
  std::uint32_t stock = 0;
  std::uint32_t index = 0;
  /// At least one of the two, of one kind and id.
  std::optional<Feature> before, after;
  [[nodiscard]] const Feature& either() const { return after ? *after : *before; }
  friend bool operator==(const FeatureChange&, const FeatureChange&) = default;
};

[[nodiscard]] std::size_t feature_count(const Stock& stock, FeatureKind kind) noexcept;
/// \pre index < feature_count
[[nodiscard]] Feature feature_at(const Stock& stock, FeatureKind kind, std::uint32_t index);
/// Returns the place of a feature in the list of its kind. Cost: O(features).
[[nodiscard]] std::optional<std::uint32_t> find_feature(const Stock& stock, FeatureKind kind,
                                                        std::string_view id) noexcept;

/// The place of a feature in its list, and whether the feature is a new one there.
struct FeaturePlace {
  std::uint32_t index = 0;
  bool is_new = false;
};
/// Puts a feature in the place of the one with its id. Where there is none, it goes in at `index`, or at the
/// end of a shorter list.
FeaturePlace put_feature(Stock& stock, std::uint32_t index, const Feature& feature);
/// \pre index < feature_count
void take_feature(Stock& stock, FeatureKind kind, std::uint32_t index);

/// Returns the changes from the features of one document to those of another with the same stocks, in order.
[[nodiscard]] std::vector<FeatureChange> feature_difference(const Document& from, const Document& to);

}  // namespace lekalo::layout
