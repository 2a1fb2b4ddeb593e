// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trysquare::internal {
namespace {

constexpr int kSignificantDigits = 4;
constexpr std::string_view kMinus = "\u2212";
constexpr std::string_view kReplacement = "\uFFFD";
constexpr std::string_view kNoBreakSpace = "\u00A0";
constexpr std::string_view kNarrowNoBreakSpace = "\u202F";

/// A plain number with a true minus sign; what rounds to zero has no sign.
std::string with_minus_sign(const std::string& number) {
  if (number.empty() || number.front() != '-') return number;
  const bool is_zero = number.find_first_of("123456789") == std::string::npos;
  return (is_zero ? "" : std::string(kMinus)) + number.substr(1);
}

/// Exponent of the leading digit after rounding: 9.9999e-5 with four digits is 1.000e-4.
int rounded_exponent(double value) {
  const std::string text = fmt::format("{:.{}e}", value, kSignificantDigits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "not finite";
  if (value == 0) return "0";
  const int exponent = rounded_exponent(value);
  if (exponent >= -4 && exponent < 6) {
    return with_minus_sign(fmt::format("{:.{}f}", value, std::max(0, kSignificantDigits - 1 - exponent)));
  }
  const std::string text = fmt::format("{:.{}e}", value, kSignificantDigits - 1);
  return with_minus_sign(text.substr(0, text.find('e'))) + " \u00D7 " + power_of_ten(exponent);
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

struct UnitSuffix {
  std::string_view suffix;
  std::string_view unit;
};
constexpr std::array<UnitSuffix, 3> kUnitSuffixes = {{{"_m", "m"}, {"_m2", "m2"}, {"_deg", "deg"}}};

}  // namespace

std::string escape(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto byte = static_cast<unsigned char>(c);
    const std::string_view three = text.substr(i, 3);
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\'') {
      escaped += "&#39;";
    } else if ((byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F) {
      escaped += kReplacement;
    } else if (three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF") {
      escaped += kReplacement;
      i += 2;
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string unit_symbol(std::string_view unit) {
  if (unit == "m2") return "m²";
  if (unit == "deg") return "°";
  return std::string(unit);
}

std::string quantity(double value, std::string_view unit) {
  const std::string number = number_text(value);
  if (unit.empty()) return number;
  const std::string_view space = unit == "deg" ? std::string_view() : kNoBreakSpace;
  return number + std::string(space) + unit_symbol(unit);
}

std::string count(const Json& number) {
  std::string digits = std::to_string(number.get<long long>());
  const std::size_t first = digits.front() == '-' ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;) {
    at -= 3;
    digits.insert(at, kNarrowNoBreakSpace);
  }
  return with_minus_sign(digits);
}

std::string exact(double value) { return with_minus_sign(fmt::format("{}", value)); }

std::string tick_label(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return with_minus_sign(fmt::format("{:.{}f}", value, decimals));
}

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> kSuperscripts = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += kSuperscripts[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string reason_of(const Json& object, const std::string& key) {
  for (const std::string& name : {key + "_reason", std::string("reason")}) {
    if (has(object, name)) return object.at(name).get<std::string>();
  }
  return "no reason was given";
}

bool has(const Json& object, const std::string& key) {
  return object.is_object() && object.contains(key) && !object.at(key).is_null();
}

std::string unit_of(std::string_view key) {
  for (const UnitSuffix& entry : kUnitSuffixes) {
    if (ends_with(key, entry.suffix)) return std::string(entry.unit);
  }
  return "";
}

std::string label_of(std::string_view key) {
  for (const UnitSuffix& entry : kUnitSuffixes) {
    if (ends_with(key, entry.suffix)) {
      key.remove_suffix(entry.suffix.size());
      break;
    }
  }
  std::string label(key);
  if (label.rfind("num_", 0) == 0) label.replace(0, 4, "number of ");
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

std::string joined(const std::vector<std::string>& items, std::size_t limit) {
  std::string text;
  const std::size_t num_shown = std::min(items.size(), limit);
  for (std::size_t i = 0; i < num_shown; ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  if (items.size() > num_shown) text += fmt::format(" and {} more", items.size() - num_shown);
  return text;
}

}  // namespace trysquare::internal
