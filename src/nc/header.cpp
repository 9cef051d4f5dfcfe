#include "lekalo/nc/header.hpp"

#include <algorithm>

#include "lekalo/nc/program_writer.hpp"

namespace lekalo::nc {
namespace {

/// Returns the place behind the line that begins at `at`, and behind its line end.
std::size_t next_line(std::string_view text, std::size_t at) {
  const std::size_t newline = text.find('\n', at);
  return newline == std::string_view::npos ? text.size() : newline + 1;
}

/// The first place where a comment may stand: behind the tape mark, and the number that must follow it.
std::size_t top_of(std::string_view text) {
  std::size_t at = 0;
  if (text.starts_with('%')) at = next_line(text, 0);
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
  const bool numbered = first < text.size() && (text[first] == 'O' || text[first] == 'o');
  return numbered ? next_line(text, first) : at;
}

/// The sentence in lines of at most `longest` letters, cut between words.
std::vector<std::string> wrapped(std::string_view sentence, std::size_t longest) {
  std::vector<std::string> lines(1);
  while (!sentence.empty()) {
    const std::size_t end = std::min(sentence.find(' '), sentence.size());
    const std::string_view word = sentence.substr(0, end);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > longest) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + std::string(word);
    sentence.remove_prefix(std::min(end + 1, sentence.size()));
  }
  return lines;
}

}  // namespace

std::string with_header(std::string_view program, const std::vector<std::string>& sentences,
                        words::Control control) {
  const Dialect& dialect = post_of(control);
  const std::size_t top = top_of(program), newline = program.find('\n');
  const bool returns = newline != std::string_view::npos && newline > 0 && program[newline - 1] == '\r';
  const std::string_view line_end = returns ? "\r\n" : "\n";
  std::string header;
  for (const std::string& sentence : sentences)
    for (const std::string& line : wrapped(sentence, dialect.comment.longest))
      header.append(comment_of(dialect, line)).append(line_end);
  const bool open = top > 0 && program[top - 1] != '\n';  // the whole program is one line without an end
  return std::string(program.substr(0, top)) + std::string(open ? line_end : "") + header +
         std::string(program.substr(top));
}

}  // namespace lekalo::nc
