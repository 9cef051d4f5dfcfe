#include "json_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "decimal.hpp"
#include "lekalo/base/joined_text.hpp"

namespace lekalo::io::detail {
namespace {

/// The most names of fields that a notice tells one by one.
constexpr std::size_t kMostNamesTold = 10;

std::string shown(JsonValue value) {
  return value.kind() == JsonKind::integer ? fmt::format("{}", value.integer())
                                           : fmt::format("{}", value.number());
}

}  // namespace

void JsonReader::refuse(JsonValue at, const std::string& why) {
  if (!ok()) return;
  const std::string path = at.path();
  fault_ = Error{ErrorCode::bad_input, fmt::format("{}: {}{}{}", name_, path, path.empty() ? "" : ": ", why)};
}

bool JsonReader::expect_object(JsonValue value, std::initializer_list<std::string_view> known) {
  if (!ok()) return false;
  if (value.kind() != JsonKind::object) {
    refuse(value, fmt::format("an object is needed, not {}", name_of(value.kind())));
    return false;
  }
  for (const JsonValue item : value) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    if (item.key().substr(0, own_.size()) != own_) {
      refuse(value, fmt::format("unknown field {}; known here: {}, and {}... for notes of your own",
                                excerpt(item.key()), joined_text(known, ", "), own_));
      return false;
    }
    const auto found = left_out_.find(item.key());
    if (found != left_out_.end()) {
      ++found->second;
    } else if (left_out_.size() <= kMostNamesTold) {
      left_out_.emplace(item.key(), 1);
    }
  }
  return true;
}

bool JsonReader::expect_list(JsonValue value, std::size_t most) {
  if (!ok()) return false;
  if (value.kind() != JsonKind::list) {
    refuse(value, fmt::format("a list is needed, not {}", name_of(value.kind())));
  } else if (value.size() > most) {
    refuse(value, fmt::format("{} items; at most {} are read", value.size(), most));
  }
  return ok();
}

std::optional<JsonValue> JsonReader::need(JsonValue object, std::string_view key, std::string_view what) {
  if (!ok()) return std::nullopt;
  const auto value = object.find(key);
  if (!value) refuse(object, fmt::format("\"{}\", {}, is missing", key, what));
  return value;
}

double JsonReader::number(JsonValue value, double low, double high) {
  if (!ok()) return 0;
  if (!value.is_number()) {
    refuse(value, fmt::format("a number is needed, not {}", name_of(value.kind())));
  } else if (!(value.number() >= low && value.number() <= high)) {
    refuse(value, fmt::format("{} is out of range; from {} to {} is allowed", shown(value), low, high));
  }
  return ok() ? value.number() : 0;
}

std::int64_t JsonReader::integer(JsonValue value, std::int64_t low, std::int64_t high) {
  if (!ok()) return 0;
  if (!value.is_number() ||
      (value.kind() == JsonKind::number && std::nearbyint(value.number()) != value.number())) {
    refuse(value, value.is_number() ? fmt::format("{} is no whole number", shown(value))
                                    : fmt::format("a whole number is needed, not {}", name_of(value.kind())));
    return 0;
  }
  // Numbers with a point or an exponent are compared as doubles, because casting one out of range is
  // undefined; the limits are at most 2^53, so it is exact. Integers may be larger than doubles hold.
  const bool in_range = value.kind() == JsonKind::integer ? value.integer() >= low && value.integer() <= high
                                                          : value.number() >= static_cast<double>(low) &&
                                                                value.number() <= static_cast<double>(high);
  if (!in_range) {
    refuse(value, fmt::format("{} is out of range; from {} to {} is allowed", shown(value), low, high));
    return 0;
  }
  return value.kind() == JsonKind::integer ? value.integer() : static_cast<std::int64_t>(value.number());
}

bool JsonReader::truth(JsonValue value) {
  if (!ok()) return false;
  if (value.kind() == JsonKind::boolean) return value.truth();
  refuse(value, fmt::format("true or false is needed, not {}", name_of(value.kind())));
  return false;
}

std::string JsonReader::text(JsonValue value) {
  if (!ok()) return {};
  if (value.kind() != JsonKind::text) {
    refuse(value, fmt::format("a text is needed, not {}", name_of(value.kind())));
  } else if (value.text().size() > kLongestText) {
    refuse(value, fmt::format("a text of {} bytes; at most {} are read", value.text().size(), kLongestText));
  } else if (std::any_of(value.text().begin(), value.text().end(),
                         [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; })) {
    refuse(value, fmt::format("the text {} has a control character", excerpt(value.text())));
  }
  return ok() ? std::string(value.text()) : std::string();
}

std::string JsonReader::text_not_empty(JsonValue value) {
  std::string got = text(value);
  if (ok() && got.empty()) refuse(value, "an empty text; give it at least one character");
  return got;
}

std::int64_t JsonReader::length(JsonValue value, double low_mm, double high_mm, double mm_per_unit) {
  const double got = number(value, low_mm / mm_per_unit, high_mm / mm_per_unit) * mm_per_unit;
  return geom::grid_from_mm(std::clamp(got, low_mm, high_mm));
}

std::int64_t JsonReader::gap(JsonValue value, double mm_per_unit) {
  constexpr double kMost = limits::kLargestOutline;
  const double got = number(value, 0, kMost / mm_per_unit) * mm_per_unit;
  return ok() ? geom::grid_from_mm_up(std::clamp(got, 0.0, kMost)) : 0;
}

std::vector<std::string> JsonReader::left_out() const {
  std::vector<std::string> names;
  for (const auto& [key, count] : left_out_) {
    if (names.size() == kMostNamesTold) {
      names.emplace_back("and others");
      break;
    }
    names.push_back(count == 1 ? plain_key(key) : fmt::format("{} ({} times)", plain_key(key), count));
  }
  return names;
}

}  // namespace lekalo::io::detail
