// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/json.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trysquare::internal {
namespace {

/// File names need not be UTF-8; JSON must be.
std::string scalar(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void append(std::string& text, const Json& json, std::size_t depth);

void append_lines(std::string& text, const Json& json, std::size_t depth) {
  const std::string indent(2 * (depth + 1), ' ');
  bool is_first = true;
  for (const auto& [key, value] : json.items()) {
    text += is_first ? "\n" : ",\n";
    text += indent;
    if (json.is_object()) text += scalar(Json(key)) + ": ";
    append(text, value, depth + 1);
    is_first = false;
  }
  text += "\n" + std::string(2 * depth, ' ');
}

void append(std::string& text, const Json& json, std::size_t depth) {
  if (!json.is_structured() || json.empty()) {
    text += scalar(json);
  } else if (json.is_object()) {
    text += '{';
    append_lines(text, json, depth);
    text += '}';
  } else if (std::any_of(json.begin(), json.end(), [](const Json& element) { return element.is_structured(); })) {
    text += '[';
    append_lines(text, json, depth);
    text += ']';
  } else {
    std::string separator = "[";
    for (const Json& element : json) {
      text += separator + scalar(element);
      separator = ", ";
    }
    text += ']';
  }
}

}  // namespace

Json number_or_null(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return *value + 0.0;  // -0.0 + 0.0 is 0.0
}

void set_or_explain(Json& object, const std::string& key, std::optional<double> value, const std::string& reason) {
  object[key] = number_or_null(value);
  if (object[key].is_null()) object[key + "_reason"] = reason;
}

Json array_of(const Eigen::Vector3d& vector) {
  return Json::array({number_or_null(vector.x()), number_or_null(vector.y()), number_or_null(vector.z())});
}

std::string dump(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

Json parse(std::string_view text, std::string_view schema) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InvalidArgument(fmt::format("JSON: byte {}: not well-formed; expected {}", error.byte, schema));
  }
  const bool has_schema = json.is_object() && json.contains("schema") && json["schema"].is_string();
  const std::string found = has_schema ? json["schema"].get<std::string>() : "no schema";
  if (found != schema) throw InvalidArgument(fmt::format("JSON: found {}, expected {}", found, schema));
  return json;
}

}  // namespace trysquare::internal
