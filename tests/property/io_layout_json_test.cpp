// read_layout(write_layout(d)) is d, and the decimals between them have no more places than they need.

#include <gtest/gtest.h>

#include <cmath>

#include "io/text/grid_decimal.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "support/cases.hpp"
#include "support/layout_documents.hpp"
#include "support/stopwatch.hpp"

namespace lekalo::io::io_layout_json_test {
namespace {

TEST(LayoutJson, WhatIsWrittenReadsBackEqual) {
  std::size_t placements = 0, curves = 0, holes = 0, kits = 0, zones = 0;
  for (std::uint64_t i = 0; i < cases::case_count(300); ++i) {
    const layout::Document document = cases::random_document(cases::seed(), i);
    const std::string text = write_layout(document);
    const auto file = read_layout(text, "again.json");
    ASSERT_TRUE(file.has_value()) << file.error().message << "\nseed " << cases::seed() << " case " << i;
    ASSERT_EQ(file->document, document) << "seed " << cases::seed() << " case " << i << "\n" << text;
    ASSERT_TRUE(file->notices.empty()) << file->notices[0];
    ASSERT_EQ(write_layout(file->document), text);
    // Parts and stocks alone, as the store keeps them, are one line each.
    for (const layout::Part& part : document.parts) {
      const std::string line = part_json(part);
      ASSERT_EQ(line.find('\n'), std::string::npos);
      ASSERT_EQ(read_part(line, "a part").value(), part) << line;
    }
    for (const layout::Stock& stock : document.stocks) {
      const std::string line = stock_json(stock);
      ASSERT_EQ(line.find('\n'), std::string::npos);
      ASSERT_EQ(read_stock(line, "a stock").value(), stock) << line;
    }
    placements += document.placements.size();
    kits += document.kits.size();
    for (const auto& stock : document.stocks) zones += stock.zones.size() + stock.defects.size();
    for (const auto& part : document.parts) {
      curves += part.outline.curves.size();
      holes += part.outline.polygon.loops() - 1;
    }
  }
  if (cases::case_count(300) >= 100) {
    EXPECT_TRUE(placements > 100 && curves > 20 && holes > 20 && kits > 20 && zones > 20)
        << placements << ' ' << curves << ' ' << holes << ' ' << kits << ' ' << zones;
  }
}

/// Whether some decimal with one place less comes back to the same step.
template <class Back>
bool shorter_serves(const std::string& text, std::int64_t steps, const Back& back) {
  const std::size_t point = text.find('.');
  if (point == std::string::npos) return false;
  std::string shorter = text.substr(0, text.size() - 1);
  if (shorter.back() == '.') shorter.pop_back();
  const double places = static_cast<double>(shorter.size()) - static_cast<double>(point) - 1;
  const double unit = std::pow(10.0, -std::max(0.0, places)), at = std::strtod(shorter.c_str(), nullptr);
  for (const double value : {at, at + unit, at - unit}) {
    char exact[64];
    std::snprintf(exact, sizeof exact, "%.*f", static_cast<int>(std::max(0.0, places)), value);
    if (back(std::strtod(exact, nullptr)) == steps) return true;
  }
  return false;
}

TEST(LayoutJson, DecimalsAreTheShortestThatReadBack) {
  Random random(cases::seed(), 77);
  const auto mm = [](double v) { return geom::grid_from_mm(v); };
  const auto up = [](double v) { return geom::grid_from_mm_up(v); };
  const auto pair = [](double v) { return geom::rotation_from_pair(v, 0).c; };
  for (std::size_t i = 0; i < cases::case_count(20'000); ++i) {
    const auto bits = static_cast<unsigned>(random.below(41));
    std::int64_t steps = static_cast<std::int64_t>(random.below(std::uint64_t{1} << bits));
    if (i % 3 == 0) steps = geom::grid_from_mm(static_cast<double>(random.below(1'000'000)) / 100);
    std::string text;
    detail::append_gap(text, steps);
    ASSERT_EQ(up(std::strtod(text.c_str(), nullptr)), steps) << text;
    ASSERT_FALSE(shorter_serves(text, steps, up)) << text << " for " << steps;
    if (i % 2 == 1) steps = -steps;
    text.clear();
    detail::append_mm(text, steps);
    ASSERT_EQ(mm(std::strtod(text.c_str(), nullptr)), steps) << text;
    ASSERT_FALSE(shorter_serves(text, steps, mm)) << text << " for " << steps;
    const auto turn =
        static_cast<std::int64_t>(random.below(std::uint64_t{1} << (12 + bits))) * (i % 2 == 0 ? 1 : -1);
    text.clear();
    detail::append_rotation_step(text, turn);
    ASSERT_EQ(pair(std::strtod(text.c_str(), nullptr)), turn) << text;
    ASSERT_FALSE(shorter_serves(text, turn, pair)) << text << " for " << turn;
  }
  std::string text;
  detail::append_mm(text, geom::grid_from_mm(0.1));
  detail::append_gap(text += ' ', geom::grid_from_mm_up(0.1));
  detail::append_rotation_step(text += ' ', geom::rotation_from_pair(0.6, 0.8).s);
  EXPECT_EQ(text, "0.1 0.1 0.8");
}

TEST(LayoutJson, AHundredThousandPlacementsTakeLittleTime) {
  layout::Document document;
  Random random(cases::seed(), 5);
  for (const char* id : {"a", "b"}) {
    layout::Part part;
    part.id = id;
    part.outline = cases::random_outline(random, geom::ChordSide::grow);
    document.parts.push_back(part);
  }
  layout::Stock strip;
  strip.id = "roll";
  strip.kind = layout::StockKind::strip;
  strip.open_length = true;
  strip.outline.polygon = {
      {{0, 0}, {layout::kLongestStrip, 0}, {layout::kLongestStrip, 1 << 30}, {0, 1 << 30}}, {0, 4}};
  document.stocks.push_back(strip);
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    layout::Placement p;
    p.id = document.next_id++;
    p.part = i % 2;
    p.rotation = geom::rotation_from_degrees(random.uniform(0, 360));
    p.at = {static_cast<std::int64_t>(random.below(1 << 30)),
            static_cast<std::int64_t>(random.below(1 << 30))};
    document.placements.push_back(p);
  }
  const cases::Stopwatch watch;
  const std::string text = write_layout(document);
  const double written = watch.seconds();
  const auto file = read_layout(text, "many.json");
  const double read = watch.seconds() - written;
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_TRUE(file->document == document);
  std::printf("%zu bytes, written in %.2f s, read in %.2f s\n", text.size(), written, read);
  EXPECT_LT(written + read, 5 * cases::kSlowdown);  // usually half a second
}

}  // namespace
}  // namespace lekalo::io::io_layout_json_test
