#include "lekalo/jobs/material.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

#include "lekalo/layout/job.hpp"
#include "lekalo/layout/material_words.hpp"

namespace lekalo::jobs {
namespace {

using layout::Material, layout::thickness_text;

bool stands_in_names(char c) {
  const bool letter =
      (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
  return letter || (c >= '0' && c <= '9') || c == '.' || c == '_';
}

/// The words with a dash for all that stands between them, and no longer than names of files may be.
std::string dashed(std::string_view words) {
  constexpr std::size_t kLongest = 80;
  std::string text;
  for (const char c : words) {
    if (stands_in_names(c))
      text += c;
    else if (!text.empty() && text.back() != '-')
      text += '-';
  }
  if (text.size() > kLongest) {
    // A character of several bytes is not cut.
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    text.resize(end);
  }
  text.resize(text.find_last_not_of('-') + 1);
  return text;
}

std::string file_word_of(const Material& material) {
  std::string word = dashed(material.name);
  if (word.empty() && !material.name.empty()) word = "material";
  if (material.thickness != 0) word += (word.empty() ? "" : "-") + thickness_text(material.thickness);
  return word.empty() ? "no-material" : word;
}

std::string small(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// Gives a value that is the only one besides the empty one to those that have none.
template <class Value>
void share(const std::vector<Material*>& materials, Value Material::*of) {
  Value only{};
  for (const Material* one : materials) {
    if (one->*of == Value{}) continue;
    if (!(only == Value{}) && !(only == one->*of)) return;
    only = one->*of;
  }
  for (Material* one : materials) one->*of = only;
}

}  // namespace

std::string order_word_of(const Material& material) {
  return material.name + (material.thickness != 0 ? ":" + thickness_text(material.thickness) : "");
}

std::vector<std::string> file_words(const std::vector<Material>& materials) {
  layout::FreeIds taken;
  std::vector<std::string> words;
  for (const Material& material : materials) {
    std::string word = file_word_of(material);
    word += taken.take(small(word)).substr(word.size());
    words.push_back(std::move(word));
  }
  return words;
}

std::string path_with(const std::string& path, const std::string& word) {
  if (path.empty() || word.empty()) return path;
  const std::size_t folder = path.find_last_of('/') + 1;  // 0 where there is none
  const std::size_t point = path.find_last_of('.');
  const bool has_ending = point != std::string::npos && point > folder;
  return path.substr(0, has_ending ? point : path.size()) + "-" + word +
         (has_ending ? path.substr(point) : "");
}

void share_materials(std::vector<Material>& materials) {
  std::vector<Material*> all;
  for (Material& one : materials) all.push_back(&one);
  share(all, &Material::name);
  std::map<std::string, std::vector<Material*>> by_name;
  for (Material* one : all) by_name[one->name].push_back(one);
  for (const auto& [name, of_name] : by_name) share(of_name, &Material::thickness);
}

}  // namespace lekalo::jobs
