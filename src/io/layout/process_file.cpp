#include "lekalo/io/layout/process_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "export_word_taker.hpp"
#include "io/text/file_faults.hpp"
#include "io/text/json_reader.hpp"
#include "io/text/json_tree.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::io {
namespace {

using detail::JsonKind;
using detail::JsonTree;
using detail::JsonValue;

constexpr std::string_view kProcessFormat = "lekalo-process/1";
constexpr std::size_t kMostProcesses = 10'000, kMostHoleRows = 100;

enum class KeyKind { text, number, text_or_number, truth };
/// A key of an entry and the word of an export that it stands for.
struct ProcessKey {
  const char *key, *word;
  KeyKind kind;
};
constexpr std::array kProcessKeys{ProcessKey{"process", "process", KeyKind::text},
                                  ProcessKey{"post", "post", KeyKind::text},
                                  ProcessKey{"kerf_mm", "kerf", KeyKind::number},
                                  ProcessKey{"feed_mm_per_min", "feed", KeyKind::number},
                                  ProcessKey{"speed", "speed", KeyKind::number},
                                  ProcessKey{"pierce_s", "pierce", KeyKind::number},
                                  ProcessKey{"lead", "lead", KeyKind::text},
                                  ProcessKey{"lead_in_mm", "lead-in", KeyKind::number},
                                  ProcessKey{"depth_mm", "depth", KeyKind::number},
                                  ProcessKey{"pass_mm", "pass", KeyKind::number},
                                  ProcessKey{"plunge_mm_per_min", "plunge", KeyKind::number},
                                  ProcessKey{"safe_height_mm", "safe-height", KeyKind::number},
                                  ProcessKey{"tool", "tool", KeyKind::number},
                                  ProcessKey{"engrave_tool", "engrave-tool", KeyKind::number},
                                  ProcessKey{"engrave_feed_mm_per_min", "engrave-feed", KeyKind::number},
                                  ProcessKey{"engrave_speed", "engrave-speed", KeyKind::number},
                                  ProcessKey{"engrave_depth_mm", "engrave-depth", KeyKind::number},
                                  ProcessKey{"pierce_diameter_mm", "pierce-diameter", KeyKind::number},
                                  ProcessKey{"heat_spread_mm", "heat-spread", KeyKind::number},
                                  ProcessKey{"corner_feed_share", "corner-feed", KeyKind::number},
                                  ProcessKey{"corner_distance_mm", "corner-distance", KeyKind::number},
                                  ProcessKey{"common_line", "common-line", KeyKind::truth},
                                  ProcessKey{"joints", "joints", KeyKind::text_or_number},
                                  ProcessKey{"joints_up_to_mm", "joints-up-to", KeyKind::number},
                                  ProcessKey{"joint_width_mm", "joint-width", KeyKind::number},
                                  ProcessKey{"slat_pitch_mm", "slat-pitch", KeyKind::number},
                                  ProcessKey{"slats", "slats", KeyKind::text},
                                  ProcessKey{"tab_height_mm", "tab-height", KeyKind::number},
                                  ProcessKey{"blade_offset_mm", "blade-offset", KeyKind::number},
                                  ProcessKey{"turn_above_deg", "turn-above", KeyKind::number},
                                  ProcessKey{"overcut_mm", "overcut", KeyKind::number},
                                  ProcessKey{"knife_tolerance_mm", "knife-tolerance", KeyKind::number}};

std::string process_key_of(const std::string& word) {
  const auto found = std::find_if(kProcessKeys.begin(), kProcessKeys.end(),
                                  [&](const ProcessKey& key) { return word == key.word; });
  return found == kProcessKeys.end() ? word : found->key;
}

const char* form_of(ExportForm form) { return form == ExportForm::hpgl ? "hpgl" : "gcode"; }

std::string described_process(const CutProcess& process) {
  return fmt::format("{}, {} mm ({})", process.material, process.thickness_mm, process.kind);
}

class ProcessReader {
 public:
  explicit ProcessReader(const std::string& name) : name_(name) {}

  Result<ProcessFile> read(JsonValue root) {
    LEKALO_CHECK(expect_format(root, name_, "file of processes", kProcessFormat));
    for (const JsonValue item : root)
      if (item.key() != "format" && item.key() != "processes")
        complain(fmt::format("there is no key {} beside \"format\" and \"processes\"", excerpt(item.key())));
    const auto list = root.find("processes");
    if (!list || list->kind() != JsonKind::list || list->size() == 0 || list->size() > kMostProcesses)
      complain(fmt::format("\"processes\" has to be a list of 1 to {} entries", kMostProcesses));
    else
      for (const JsonValue item : *list) entry(item);
    LEKALO_CHECK(faults_.refused(name_));
    return ProcessFile{name_, std::move(processes_)};
  }

 private:
  void complain(const std::string& what) { faults_.add(what); }

  void entry(JsonValue json) {
    const std::size_t number = ++entries_;
    faults_.where = fmt::format("entry {}: ", number);
    CutProcess process;
    if (json.kind() != JsonKind::object)
      complain(fmt::format("an object is needed, not {}", name_of(json.kind())));
    else
      take(json, process);
    const auto [place, is_new] =
        first_.emplace(std::tuple(process.material, process.thickness_mm, process.kind), number);
    if (!is_new && !process.material.empty() && !process.kind.empty() && process.thickness_mm > 0)
      complain(fmt::format("{} is entry {} already", described_process(process), place->second));
    processes_.push_back(std::move(process));
    faults_.where.clear();
  }

  void take(JsonValue json, CutProcess& process) {
    ExportRequest request;
    // The kind decides which words an entry may have.
    if (const auto kind = json.find("process"); kind && kind->kind() == JsonKind::text)
      if (detail::is_knife(std::string(kind->text()))) process.form = ExportForm::hpgl;
    request.form = process.form;
    detail::ExportWordTaker taker(request, process_key_of);
    // Without a kind of machine and a control nobody knows what else has to be given.
    bool kind_is_known = true;
    bool has_material = false, has_thickness = false, has_kind = false;
    std::optional<JsonValue> holes;
    for (const JsonValue item : json) {
      const std::string_view key = item.key();
      if (key == "material") {
        has_material = true;
        if (const auto said = text(item)) process.material = *said;
      } else if (key == "thickness_mm") {
        has_thickness = true;
        if (const auto said = number(item, 0.001, 1000)) process.thickness_mm = *said;
      } else if (key == "holes") {
        holes = item;
      } else {
        const bool is_taken = word(item, taker, process);
        has_kind = has_kind || key == "process";
        if (!is_taken && (key == "process" || key == "post")) kind_is_known = false;
      }
    }
    if (!has_material) complain("material is missing: the name that --material says");
    if (!has_thickness) complain("thickness_mm is missing");
    if (!has_kind) complain("process is missing: the kind of machine");
    if (kind_is_known && has_kind)
      for (const std::string& complaint : taker.complete()) complain(complaint);
    if (holes && process.form == ExportForm::hpgl)
      complain("holes has no meaning for knives: leave it out");
    else if (holes)
      take_holes(*holes, request.profile.feed_mm_per_min, process);
  }

  /// Takes a key that stands for a word of an export; false after a complaint.
  bool word(JsonValue item, detail::ExportWordTaker& taker, CutProcess& process) {
    const auto known = std::find_if(kProcessKeys.begin(), kProcessKeys.end(),
                                    [&](const ProcessKey& key) { return item.key() == key.key; });
    if (known == kProcessKeys.end()) {
      complain(fmt::format("there is no key {}{}", excerpt(item.key()), unknown_told_ ? "" : known_keys()));
      unknown_told_ = true;
      return false;
    }
    // A value that is no number is refused like those out of range.
    std::string value;
    const bool may_be_number = known->kind == KeyKind::text_or_number;
    if (known->kind == KeyKind::number || (may_be_number && item.is_number())) {
      value = item.is_number() ? fmt::format("{}", item.number()) : name_of(item.kind());
    } else if (known->kind == KeyKind::truth) {
      if (item.kind() != JsonKind::boolean) {
        complain(fmt::format("{} has to be true or false, not {}", known->key, name_of(item.kind())));
        return false;
      }
      value = item.truth() ? "yes" : "no";
    } else {
      const auto said = text(item);
      if (!said) return false;
      value = *said;
      if (may_be_number && value.find_first_not_of("0123456789") == std::string::npos) {
        complain(fmt::format("{} \"{}\": a number stands without quotation marks", known->key, value));
        return false;
      }
    }
    const ExportWord made{known->word, std::move(value)};
    if (const Result<void> taken = taker.take(made); !taken) {
      complain(taken.error().message);
      return false;
    }
    if (made.first == "process") process.kind = made.second;
    process.words.push_back(made);
    return true;
  }

  static std::string known_keys() {
    std::string known = "; known are material, thickness_mm";
    for (const ProcessKey& key : kProcessKeys) known += std::string(", ") + key.key;
    return known + " and holes";
  }

  std::optional<std::string> text(JsonValue item) {
    if (item.kind() == JsonKind::text) {
      const std::string_view said = item.text();
      const bool is_plain = std::none_of(
          said.begin(), said.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
      if (is_plain && !said.empty() && said.size() <= detail::kLongestText) return std::string(said);
    }
    complain(fmt::format("{} has to be a text of 1 to {} bytes without control characters", item.key(),
                         detail::kLongestText));
    return std::nullopt;
  }

  std::optional<double> number(JsonValue item, double low, double high) {
    if (item.is_number() && item.number() >= low && item.number() <= high) return item.number();
    complain(fmt::format("{}{} has to be a number from {:g} to {:g}", item.key(),
                         item.is_number() ? fmt::format(" {}:", item.number()) : "", low, high));
    return std::nullopt;
  }

  void take_holes(JsonValue list, double feed, CutProcess& process) {
    if (list.kind() != JsonKind::list || list.size() > kMostHoleRows)
      return complain(fmt::format("holes has to be a list of at most {} rows", kMostHoleRows));
    const std::string entry = faults_.where;
    double before = 0;
    std::size_t row = 0;
    for (const JsonValue item : list) {
      faults_.where = fmt::format("{}, row {} of holes: ", entry.substr(0, entry.size() - 2), ++row);
      if (item.kind() != JsonKind::object) {
        complain(fmt::format("an object is needed, not {}", name_of(item.kind())));
        continue;
      }
      process.holes.push_back(hole_of(item, feed));
      const double up_to = process.holes.back().up_to_diameter_mm;
      if (up_to > 0 && up_to <= before)
        complain(fmt::format("up_to_diameter_mm {}: has to be above that of the row before", up_to));
      before = std::max(before, up_to);
    }
    faults_.where = entry;
  }

  nc::HoleCut hole_of(JsonValue json, double feed) {
    nc::HoleCut hole;
    for (const JsonValue item : json) {
      if (item.key() == "up_to_diameter_mm")
        hole.up_to_diameter_mm = number(item, 0.01, 1e4).value_or(-1);
      else if (item.key() == "lead_in_mm")
        hole.lead_in_mm = number(item, 0, 1000);
      else if (item.key() == "feed_share")
        hole.feed_share = number(item, 0.01, 1).value_or(1);
      else
        complain(
            fmt::format("there is no key {} in a row; known are up_to_diameter_mm, lead_in_mm and feed_share",
                        excerpt(item.key())));
    }
    if (hole.up_to_diameter_mm == 0) complain("up_to_diameter_mm is missing");
    if (feed > 0 && !(hole.feed_share * feed >= 0.1))
      complain(fmt::format("feed_share {} leaves less than 0.1 of {} mm/min", hole.feed_share, feed));
    return hole;
  }

  const std::string& name_;
  FileFaults faults_;
  std::size_t entries_ = 0;
  bool unknown_told_ = false;
  std::vector<CutProcess> processes_;
  std::map<std::tuple<std::string, double, std::string>, std::size_t> first_;
};

/// Processes of the material if there are any, and else all, as far as a sentence holds them.
std::string processes_there(const ProcessFile& file, const std::string& material) {
  const bool knows_material =
      std::any_of(file.processes.begin(), file.processes.end(),
                  [&](const CutProcess& process) { return process.material == material; });
  std::string list;
  std::size_t told = 0, left = 0;
  for (const CutProcess& process : file.processes) {
    if (knows_material && process.material != material) continue;
    if (told == FileFaults::kMostTold) {
      ++left;
      continue;
    }
    list += (told++ == 0 ? "" : "; ") + described_process(process);
  }
  return left == 0 ? list : fmt::format("{}; and {} more", list, left);
}

}  // namespace

Result<ProcessFile> read_processes(std::string_view bytes, const std::string& name) {
  LEKALO_TRY(const JsonTree tree, JsonTree::parse(bytes, name));
  return ProcessReader(name).read(tree.root());
}

Result<std::size_t> find_process(const ProcessFile& file, const std::string& material, double thickness_mm,
                                 const std::string& kind, ExportForm form) {
  std::vector<std::size_t> fits;
  for (std::size_t i = 0; i < file.processes.size(); ++i) {
    const CutProcess& process = file.processes[i];
    if (process.form == form && process.material == material && process.thickness_mm == thickness_mm &&
        (kind.empty() || process.kind == kind))
      fits.push_back(i);
  }
  if (fits.size() == 1) return fits.front();
  const std::string wanted =
      fmt::format("{}, {} mm{}", material, thickness_mm, kind.empty() ? "" : fmt::format(" ({})", kind));
  if (fits.empty())
    for (const CutProcess& process : file.processes)
      if (process.form != form && process.material == material && process.thickness_mm == thickness_mm &&
          (kind.empty() || process.kind == kind))
        return failure(ErrorCode::usage,
                       fmt::format("{}: the programs of {} have the form {}, and {} was asked for", file.name,
                                   described_process(process), form_of(process.form), form_of(form)));
  if (fits.empty())
    return failure(ErrorCode::usage, fmt::format("{}: there is no process for {}; there are: {}", file.name,
                                                 wanted, processes_there(file, material)));
  std::string entries, kinds;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const char* const between = k == 0 ? "" : k + 1 == fits.size() ? " and " : ", ";
    entries += between + std::to_string(fits[k] + 1);
    kinds += between + file.processes[fits[k]].kind;
  }
  return failure(ErrorCode::usage, fmt::format("{}: entries {} are for {}: {}; say which with --process",
                                               file.name, entries, wanted, kinds));
}

Result<ExportRequest> process_request(const CutProcess& process, const std::vector<ExportWord>& words,
                                      const std::string& prefix) {
  const auto is_given = [&](const std::string& name) {
    return std::any_of(words.begin(), words.end(),
                       [&](const ExportWord& word) { return word.first == name; });
  };
  std::vector<ExportWord> all;
  std::copy_if(process.words.begin(), process.words.end(), std::back_inserter(all),
               [&](const ExportWord& word) { return !is_given(word.first); });
  all.insert(all.end(), words.begin(), words.end());
  LEKALO_TRY(ExportRequest request, read_export_words(process.form, all, prefix));
  request.profile.holes = process.holes;
  if (is_given("lead-in"))
    for (nc::HoleCut& hole : request.profile.holes) hole.lead_in_mm.reset();
  return request;
}

}  // namespace lekalo::io
