#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/nc/profile.hpp"

namespace lekalo::io {

/// Files of processes, "lekalo-process/1": what the machines of a shop need for each material and thickness.
/// docs/formats.md, "Processes", has the form.

/// One entry: how one material of one thickness is cut by one kind of machine.
struct CutProcess {
  std::string material;
  double thickness_mm = 0;              ///< 0.001 to 1000
  std::string kind;                     ///< the word for --process of lekalo export
  ExportForm form = ExportForm::gcode;  ///< of its programs: HPGL for knives
  /// All that the entry says, its kind among it, as words of an export in its form. They are complete.
  std::vector<ExportWord> words;
  std::vector<nc::HoleCut> holes;
};

struct ProcessFile {
  std::string name;  ///< of the file, for sentences
  /// In the order of the file; no two of one material, thickness and kind. Sentences count them from 1.
  std::vector<CutProcess> processes;
};

/// Fails with ErrorCode::bad_input: bytes that are no JSON, or one sentence that lists everything that is
/// wrong, each with the number of its entry. Cost: O(bytes), but for a logarithm.
[[nodiscard]] Result<ProcessFile> read_processes(std::string_view bytes, const std::string& name);

/// Returns the index of the one process for the material and thickness, which are compared exactly, whose
/// programs have this form.
/// \param kind  laser, plasma and so on; empty: any, if there is one only
///
/// Fails with ErrorCode::usage and one sentence: none fits, with those that are there; or several fit, with
/// all of them. Cost: O(processes).
[[nodiscard]] Result<std::size_t> find_process(const ProcessFile& file, const std::string& material,
                                               double thickness_mm, const std::string& kind,
                                               ExportForm form = ExportForm::gcode);

/// Returns the request that the process and the words give. A word replaces what the process says:
/// the length of leads that of holes, too; feeds of holes are shares of whichever feed holds.
///
/// Fails like read_export_words.
[[nodiscard]] Result<ExportRequest> process_request(const CutProcess& process,
                                                    const std::vector<ExportWord>& words,
                                                    const std::string& prefix);

}  // namespace lekalo::io
