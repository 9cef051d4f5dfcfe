#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/layout/feature.hpp"

namespace lekalo::io {

/// Pieces of a layout as JSON on one line, for reports and for those who follow a layout as it changes.

/// The placement exactly as write_layout writes it. Cost: O(1). \pre part and stock are the document's
[[nodiscard]] std::string placement_json(const layout::Document& document,
                                         const layout::Placement& placement);

/// A defect or a zone exactly as write_layout writes it. Law: read_feature(feature_json(f)) is f. Cost:
/// O(points).
[[nodiscard]] std::string feature_json(const layout::Feature& feature);
/// Fails with ErrorCode::bad_input as read_layout does; `name` stands for the file.
[[nodiscard]] Result<layout::Feature> read_feature(layout::FeatureKind kind, std::string_view bytes,
                                                   const std::string& name);
/// A part and a stock as write_layout writes them, without the line ends. Law: read_part(part_json(p)) is p,
/// and likewise of stocks. Cost: O(points).
[[nodiscard]] std::string part_json(const layout::Part& part);
[[nodiscard]] std::string stock_json(const layout::Stock& stock);
/// These fail with ErrorCode::bad_input as read_layout does; `name` stands for the file.
[[nodiscard]] Result<layout::Part> read_part(std::string_view bytes, const std::string& name);
[[nodiscard]] Result<layout::Stock> read_stock(std::string_view bytes, const std::string& name);
/// A kit likewise, but its pieces name their parts by number.
[[nodiscard]] std::string kit_json(const layout::Kit& kit);
[[nodiscard]] Result<layout::Kit> read_kit(std::string_view bytes, const std::string& name);
/// The changes of features as docs/protocol.md has them. Cost: O(points).
[[nodiscard]] std::string features_json(const layout::Document& document,
                                        const std::vector<layout::FeatureChange>& changes);

/// A list of violations as `lekalo check --json` has it: docs/formats.md. Cost: O(violations).
void write_violations(JsonWriter& json, const layout::Document& document,
                      const std::vector<layout::Violation>& violations);
[[nodiscard]] std::string violations_json(const layout::Document& document,
                                          const std::vector<layout::Violation>& violations);

/// The pieces that are placed and those that are missing, as `lekalo show --json` has it: docs/cli.md. Cost:
/// O(parts, kits and sheets). \pre of write_completeness: an object is open, which gets the fields
void write_completeness(JsonWriter& json, const layout::Document& document,
                        const layout::Completeness& completeness);
[[nodiscard]] std::string completeness_json(const layout::Document& document,
                                            const layout::Completeness& completeness);
/// Its "kits" alone. Cost: O(kits).
[[nodiscard]] std::string kits_json(const layout::Document& document,
                                    const std::vector<layout::KitCount>& kits);

}  // namespace lekalo::io
