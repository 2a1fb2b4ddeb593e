// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare::internal {

/// @throws IoError  "<name>: line <line>: <message>". Lines count from 1.
[[noreturn]] void fail_at_line(std::string_view name, std::size_t line, std::string_view message);

/// @throws IoError  "<name>: byte <byte>: <message>". Bytes count from 0.
[[noreturn]] void fail_at_byte(std::string_view name, std::size_t byte, std::string_view message);

/// A piece of a file, in quotes, fit for a message: shortened, and everything that is not printable escaped.
std::string in_quotes(std::string_view token);

/// The lines of a text without their line ends (LF or CRLF) and without a byte order mark.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  /// False at the end of the text.
  bool next(std::string_view& line);

  /// Of the line that next() gave last, from 1.
  std::size_t line_number() const { return line_number_; }

  /// First byte behind the line that next() gave last.
  std::size_t offset() const { return offset_; }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  std::size_t line_number_ = 0;
};

/// The part of a line before `#` or `//`.
std::string_view without_comment(std::string_view line);

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);

/// The fields of a line, between white space, commas and semicolons. Two commas with nothing between them hold an empty
/// field, so a missing value cannot shift the ones behind it; one separator at the end of a line is ignored.
class FieldReader {
 public:
  explicit FieldReader(std::string_view line) : line_(line) { skip_space(); }

  bool next(std::string_view& field);

 private:
  void skip_space();

  std::string_view line_;
  std::size_t at_ = 0;
};

/// All fields of a line, into `fields`, whose memory is used again.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// A whole token as a number, whatever the locale: decimal or scientific, nan, inf. Too large is infinite, too small is
/// zero, as in numpy. Empty when the token is anything else.
std::optional<double> parse_double(std::string_view token);

/// A whole token as a decimal integer.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// token · 10^exponent, rounded to the nearest integer, digit by digit: 1311868164.363181 s are 1311868164363181000 ns,
/// which no double holds. Empty when the token is not a finite decimal number or the result has no place in 64 bits.
std::optional<std::int64_t> parse_scaled_integer(std::string_view token, int exponent);

/// How many digits behind the decimal point a number was printed with; 1.25e-02 has four.
int printed_decimals(std::string_view token);

/// The numbers of a line, into `values`.
/// @throws IoError  if a field is not a number.
void read_numbers(std::string_view name, std::size_t line_number, std::string_view line, std::vector<double>& values);

}  // namespace trysquare::internal
