#include "lekalo/io/text/json_writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/io/text/words.hpp"
#include "support/cases.hpp"

// Random trees, written by the writer and by nlohmann/json, in whose layouts reports have stood since 0.1.

namespace lekalo::io::io_json_writer_test {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes of which most are plain, some need escapes, and some are no UTF-8.
std::string random_text(Random& random) {
  std::string text;
  for (std::uint64_t left = random.below(12); left > 0; --left) {
    switch (random.below(8)) {
      case 0:
        text += static_cast<char>(random.below(256));
        break;
      case 1:
        text += static_cast<char>(0x80 + random.below(0x80));
        break;
      case 2:
        text += "\xf0\x9f\x98\x80";
        break;
      case 3:
        text += "\xd0\xb6";
        break;
      default:
        text += static_cast<char>('a' + random.below(26));
    }
  }
  return text;
}

double random_number(Random& random) {
  switch (random.below(4)) {
    case 0:
      return static_cast<double>(random.below(1000)) / 8;
    case 1:
      return std::bit_cast<double>(random.below(std::uint64_t{1} << 63));  // some are not finite
    case 2:
      return -std::round(random.uniform(0, 1e6)) / 1000;
    default:
      return random.uniform(-1e3, 1e3);
  }
}

Json random_tree(Random& random, int depth) {
  const std::uint64_t kind = depth == 0 ? 6 + random.below(4) : random.below(depth > 4 ? 6 : 10);
  switch (kind) {
    case 0:
      return nullptr;
    case 1:
      return random.below(2) == 0;
    case 2:
      return random.below(1000) << random.below(50);
    case 3:
      return -static_cast<std::int64_t>(random.below(1000) << random.below(50));
    case 4:
      return random_number(random);
    case 5:
      return random_text(random);
    case 6:
    case 7: {
      Json list = Json::array();
      for (std::uint64_t left = random.below(6); left > 0; --left)
        list.push_back(random_tree(random, depth + 1));
      return list;
    }
    default: {
      Json object = Json::object();
      for (std::uint64_t left = random.below(6); left > 0; --left)
        object[random_text(random)] = random_tree(random, depth + 1);
      return object;
    }
  }
}

void write(JsonWriter& json, const Json& tree) {
  if (tree.is_object()) {
    json.begin_object();
    for (const auto& [key, value] : tree.items()) write(json.key(key), value);
    json.end();
  } else if (tree.is_array()) {
    json.list(tree, [&](const Json& item) { write(json, item); });
  } else if (tree.is_string()) {
    json.value(tree.get_ref<const std::string&>());
  } else if (tree.is_number_float()) {
    json.value(tree.get<double>());
  } else if (tree.is_number_unsigned()) {
    json.value(tree.get<std::uint64_t>());
  } else if (tree.is_number_integer()) {
    json.value(tree.get<std::int64_t>());
  } else {
    tree.is_boolean() ? json.value(tree.get<bool>()) : json.value(nullptr);
  }
}

std::string written(const Json& tree, JsonLayout layout) {
  JsonWriter json(layout);
  write(json, tree);
  return json.take();
}

/// Neither library writes numbers that are not finite in this layout.
Json finite(Json tree) {
  if (tree.is_number_float() && !std::isfinite(tree.get<double>())) return nullptr;
  if (tree.is_structured())
    for (Json& item : tree) item = finite(std::move(item));
  return tree;
}

TEST(JsonWriterDifferential, AThousandRandomTreesAreTheTextThatNlohmannWrites) {
  constexpr auto kReplace = Json::error_handler_t::replace;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(cases::seed(), 70'000 + i);
    const Json tree = random_tree(random, 0);
    const std::string compact = tree.dump(-1, ' ', false, kReplace);
    ASSERT_EQ(written(tree, JsonLayout::compact), compact) << cases::seed() << ' ' << i;
    ASSERT_EQ(written(tree, JsonLayout::indented), tree.dump(2, ' ', false, kReplace)) << i;
    ASSERT_EQ(ascii_json(compact), tree.dump(-1, ' ', true, kReplace)) << i;
    const std::string spaced = written(finite(tree), JsonLayout::spaced);
    ASSERT_EQ(Json::parse(spaced), Json::parse(compact)) << i << ' ' << spaced;
  }
}

TEST(JsonWriterDifferential, AnyBytesBecomeTheUtf8ThatNlohmannMakesOfThem) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(cases::seed(), 80'000 + i);
    std::string bytes;
    for (std::uint64_t left = random.below(30); left > 0; --left)
      bytes += static_cast<char>(random.below(4) == 0 ? random.below(128) : 0x80 + random.below(128));
    const std::string text = Json(bytes).dump(-1, ' ', false, Json::error_handler_t::replace);
    ASSERT_EQ(json_string(bytes), text) << cases::seed() << ' ' << i;
    ASSERT_EQ(as_utf8(bytes), Json::parse(text).get<std::string>()) << i;
  }
}

}  // namespace
}  // namespace lekalo::io::io_json_writer_test
