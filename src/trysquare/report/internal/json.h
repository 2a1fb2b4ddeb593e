// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace trysquare::internal {

/// Keys stay in the order in which they were written, so that a JSON reads like a report.
using Json = nlohmann::ordered_json;

/// The number, or null when there is none or when it is not finite: JSON has no NaN. Minus zero becomes zero.
Json number_or_null(std::optional<double> value);

/// object[key] = value; when there is none: null, and object[key_reason] = reason.
void set_or_explain(Json& object, const std::string& key, std::optional<double> value, const std::string& reason);

Json array_of(const Eigen::Vector3d& vector);

/// JSON text with two spaces of indent and a final newline. An array without objects and arrays in it stays on one
/// line.
std::string dump(const Json& json);

/// @throws InvalidArgument  if the text is no JSON or not of the named schema.
Json parse(std::string_view text, std::string_view schema);

inline constexpr std::string_view kEvaluationSchema = "trysquare.evaluation/1";

}  // namespace trysquare::internal
