// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/text.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace trysquare::internal {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r'; }
bool is_separator(char c) { return c == ',' || c == ';'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// from_chars knows no leading plus.
std::string_view without_plus(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && (is_digit(token[1]) || token[1] == '.');
  return plus ? token.substr(1) : token;
}

/// A decimal number taken apart: digits · 10^exponent.
struct Decimal {
  bool negative = false;
  std::string digits;  ///< Without leading zeros; empty for zero.
  std::int64_t exponent = 0;
  std::int64_t num_fraction_digits = 0;
};

std::optional<Decimal> parse_decimal(std::string_view token) {
  Decimal decimal;
  std::size_t at = 0;
  if (!token.empty() && (token[0] == '-' || token[0] == '+')) decimal.negative = token[at++] == '-';
  bool any_digit = false;
  bool point = false;
  for (; at < token.size() && (is_digit(token[at]) || (token[at] == '.' && !point)); ++at) {
    if (token[at] == '.') {
      point = true;
      continue;
    }
    any_digit = true;
    decimal.num_fraction_digits += point ? 1 : 0;
    if (token[at] != '0' || !decimal.digits.empty()) decimal.digits += token[at];
  }
  if (!any_digit) return std::nullopt;
  decimal.exponent = -decimal.num_fraction_digits;
  if (at == token.size()) return decimal;
  if (token[at] != 'e' && token[at] != 'E') return std::nullopt;
  const std::optional<std::int64_t> exponent = parse_integer(token.substr(at + 1));
  if (!exponent || std::abs(*exponent) > 1'000'000) return std::nullopt;
  decimal.exponent += *exponent;
  return decimal;
}

}  // namespace

void fail_at_line(std::string_view name, std::size_t line, std::string_view message) {
  throw IoError(fmt::format("{}: line {}: {}", name, line, message));
}

void fail_at_byte(std::string_view name, std::size_t byte, std::string_view message) {
  throw IoError(fmt::format("{}: byte {}: {}", name, byte, message));
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t kMaxLength = 40;
  std::string out = "\"";
  for (const char c : token.substr(0, kMaxLength)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7F) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out + (token.size() > kMaxLength ? "…\"" : "\"");
}

LineReader::LineReader(std::string_view text)
    : text_(text), offset_(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0) {}

bool LineReader::next(std::string_view& line) {
  if (offset_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', offset_), text_.size());
  line = text_.substr(offset_, end - offset_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  offset_ = std::min(end + 1, text_.size());
  ++line_number_;
  return true;
}

std::string_view without_comment(std::string_view line) {
  const std::size_t hash = line.find('#');
  return line.substr(0, std::min(hash, line.find("//")));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

void FieldReader::skip_space() {
  while (at_ < line_.size() && is_space(line_[at_])) ++at_;
}

bool FieldReader::next(std::string_view& field) {
  if (at_ >= line_.size()) return false;
  const std::size_t first = at_;
  while (at_ < line_.size() && !is_space(line_[at_]) && !is_separator(line_[at_])) ++at_;
  field = line_.substr(first, at_ - first);
  skip_space();
  if (at_ < line_.size() && is_separator(line_[at_])) {
    ++at_;
    skip_space();
  }
  return true;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  FieldReader reader(line);
  for (std::string_view field; reader.next(field);) fields.push_back(field);
}

std::optional<double> parse_double(std::string_view token) {
  token = without_plus(token);
  const char* last = token.data() + token.size();
  double value = 0;
  const auto [end, error] = std::from_chars(token.data(), last, value);
  if (error == std::errc() && end == last) return value;
  if (error != std::errc::result_out_of_range || end != last) return std::nullopt;
  const std::optional<Decimal> decimal = parse_decimal(token);  // from_chars does not say which end of the range it was
  if (!decimal) return std::nullopt;
  const bool large = static_cast<std::int64_t>(decimal->digits.size()) + decimal->exponent > 0;
  return std::copysign(large ? std::numeric_limits<double>::infinity() : 0.0, decimal->negative ? -1.0 : 1.0);
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  token = without_plus(token);
  const char* last = token.data() + token.size();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), last, value);
  if (error != std::errc() || end != last) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_scaled_integer(std::string_view token, int exponent) {
  constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  constexpr std::int64_t kMaxDigits = 19;
  const std::optional<Decimal> decimal = parse_decimal(token);
  if (!decimal) return std::nullopt;
  const auto num_digits = static_cast<std::int64_t>(decimal->digits.size());
  const std::int64_t num_integer_digits = num_digits + decimal->exponent + exponent;
  if (num_digits == 0 || num_integer_digits < 0) return 0;
  if (num_integer_digits > kMaxDigits) return std::nullopt;
  std::uint64_t value = 0;
  for (std::int64_t i = 0; i < num_integer_digits; ++i) {
    value = 10 * value +
            (i < num_digits ? static_cast<std::uint64_t>(decimal->digits[static_cast<std::size_t>(i)] - '0') : 0);
  }
  if (num_integer_digits < num_digits && decimal->digits[static_cast<std::size_t>(num_integer_digits)] >= '5') ++value;
  if (value > kMax) return std::nullopt;
  const auto magnitude = static_cast<std::int64_t>(value);
  return decimal->negative ? -magnitude : magnitude;
}

int printed_decimals(std::string_view token) {
  const std::optional<Decimal> decimal = parse_decimal(token);
  if (!decimal) return 0;
  return static_cast<int>(std::clamp<std::int64_t>(-decimal->exponent, 0, 1'000'000));
}

void read_numbers(std::string_view name, std::size_t line_number, std::string_view line, std::vector<double>& values) {
  values.clear();
  FieldReader reader(line);
  for (std::string_view field; reader.next(field);) {
    const std::optional<double> value = parse_double(field);
    if (!value) {
      fail_at_line(name, line_number,
                   fmt::format("value {} is {}, expected a number", values.size() + 1, in_quotes(field)));
    }
    values.push_back(*value);
  }
}

}  // namespace trysquare::internal
