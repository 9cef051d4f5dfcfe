#pragma once

#include <string>
#include <vector>

#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// The JSON of a job, which begins with the name of its format; its object is open.
[[nodiscard]] io::JsonWriter begin_document(const char* format);
/// Closes the object, and hands out the text.
[[nodiscard]] std::string end_document(io::JsonWriter& json);

/// A file as reports name it: its role, its name and the digest of its bytes.
void write_file(io::JsonWriter& json, const char* role, const File& file);
/// The same of programs that ran before, into a list that is open.
void write_earlier(io::JsonWriter& json, const std::vector<EarlierProgram>& earlier);

/// The options that a program was judged with, into an object that is open.
void write_machining(io::JsonWriter& json, const verify::SimulateOptions& machining);

/// The checker's figures under their names in docs/formats.md, into an object that is open.
void write_report(io::JsonWriter& json, const verify::SimulateReport& report);

}  // namespace lekalo::jobs
