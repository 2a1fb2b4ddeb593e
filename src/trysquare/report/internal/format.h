// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/report/internal/json.h"

#include <string>
#include <string_view>
#include <vector>

namespace trysquare::internal {

/// Text for HTML and XML, also inside attributes. Characters that XML forbids (controls, U+FFFE, U+FFFF) become U+FFFD.
std::string escape(std::string_view text);

/// "m2" -> "m²", "deg" -> "°"; other units stay.
std::string unit_symbol(std::string_view unit);

/// A measured number for people: four significant digits, a true minus sign, powers of ten below 1e-4 and from 1e6 on,
/// then the unit ("m", "m2", "nats", "deg", "%", ...) behind a no-break space: "0.002203 m²", "4.690 × 10⁻⁵ m²".
std::string quantity(double value, std::string_view unit = "");

/// A number of things, grouped by thousands with narrow no-break spaces.
std::string count(const Json& number);

/// A number as it was set: as many digits as it has, nothing rounded.
std::string exact(double value);

/// A number at a multiple of `step` on an axis: all ticks get the same decimals.
std::string tick_label(double value, double step);

/// "10⁻³" for -3.
std::string power_of_ten(int exponent);

/// Why object[key] is null: object[key_reason], else object["reason"], else that no reason was given. Not escaped.
std::string reason_of(const Json& object, const std::string& key);

/// True if object[key] is there and not null.
bool has(const Json& object, const std::string& key);

/// Words for people from a JSON key: "num_scans" -> "number of scans", "radius_m" -> "radius".
std::string label_of(std::string_view key);

/// The unit that a JSON key ends in: "radius_m" -> "m"; empty if there is none.
std::string unit_of(std::string_view key);

/// "a, b and 3 more": at most `limit` of the items.
std::string joined(const std::vector<std::string>& items, std::size_t limit);

}  // namespace trysquare::internal
