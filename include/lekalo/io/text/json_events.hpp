#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lekalo::io {

/// The place where a text stops being JSON.
struct JsonBreak {
  std::size_t line = 1;           ///< 1-based
  std::size_t byte = 1;           ///< 1-based; one beyond the last where the text ends early
  std::string token;              ///< the characters that the parser could not take
  bool number_too_large = false;  ///< they are a number beyond doubles
  bool ends_early = false;        ///< they are the end of the text
};

/// Hears a JSON text value by value, in the order of the file. Every function but the last says whether the
/// parse goes on. Strings live until the function returns.
class JsonEvents {
 public:
  virtual bool null() = 0;
  virtual bool boolean(bool value) = 0;
  /// A whole number that is written without point and exponent; -0 is 0.
  virtual bool integer(std::int64_t value) = 0;
  /// Any other number.
  /// \param text  the number as the file writes it: only its decimal tells whether it is a double exactly
  virtual bool number(double value, std::string_view text) = 0;
  virtual bool text(std::string_view value) = 0;
  virtual bool begin_list() = 0;
  virtual bool end_list() = 0;
  virtual bool begin_object() = 0;
  virtual bool key(std::string_view value) = 0;
  virtual bool end_object() = 0;
  virtual void broken(const JsonBreak& at) = 0;

 protected:
  ~JsonEvents() = default;
};

/// Parses the text and tells the listener. This is the only parser of JSON in lekalo but for that of the
/// checker: trees of values, the points of a contour and the messages of clients listen to it. True when the
/// text is JSON and the listener never ended the parse. It needs no more memory for lists a million deep than
/// a bit for each.
[[nodiscard]] bool parse_json(std::string_view bytes, JsonEvents& listener);

}  // namespace lekalo::io
