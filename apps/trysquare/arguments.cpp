// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include "trysquare/io/file.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace trysquare::app {
namespace {

bool is_long_option(const std::string& argument) { return argument.rfind("--", 0) == 0 && argument.size() > 2; }

std::string with_dashes(std::string argument) {
  if (!is_long_option(argument)) return argument;
  const auto name_end = std::find(argument.begin(), argument.end(), '=');
  std::replace(argument.begin(), name_end, '_', '-');
  return argument;
}

std::optional<std::string> value_of_option(const std::vector<std::string>& arguments, const std::string& name) {
  for (std::size_t i = arguments.size(); i-- > 0;) {
    if (arguments[i] == name && i + 1 < arguments.size()) return arguments[i + 1];
    if (arguments[i].rfind(name + "=", 0) == 0) return arguments[i].substr(name.size() + 1);
  }
  return std::nullopt;
}

std::string environment_name(std::string option) {
  for (char& c : option) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return "TRYSQUARE_" + option;
}

const CLI::App* find_verb(const CLI::App& app, const std::string& name) {
  const auto found = app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

const CLI::Option* find_option(const CLI::App& verb, const std::string& name) {
  return verb.get_option_no_throw("--" + name);
}

/// Keys stand at the top level, for every verb that has them, or in a table [verb].
std::vector<std::string> from_config(const std::string& path, const CLI::App& app, const CLI::App& verb) {
  std::istringstream text(read_file(path));
  std::vector<std::string> arguments;
  for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(text)) {
    if (item.name == "++" || item.name == "--") continue;  // CLI11's marks for the begin and end of a table
    const bool in_other_table = !item.parents.empty() && item.parents.front() != verb.get_name();
    if (in_other_table) {
      if (find_verb(app, item.parents.front()) == nullptr) {
        throw CLI::ConfigError(path + ": unknown table [" + item.parents.front() + "]");
      }
      continue;
    }
    const std::string key = with_dashes("--" + item.name).substr(2);
    if (find_option(verb, key) == nullptr) {
      const auto verbs =
          app.get_subcommands([&](const CLI::App* other) { return find_option(*other, key) != nullptr; });
      if (verbs.empty() || !item.parents.empty()) throw CLI::ConfigError(path + ": unknown key '" + item.name + "'");
      continue;  // of another verb
    }
    for (const std::string& input : item.inputs) arguments.push_back("--" + key + "=" + input);
  }
  return arguments;
}

std::vector<std::string> from_environment(const CLI::App& verb) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      if (name == "help" || name == "config") continue;
      const char* value = std::getenv(environment_name(name).c_str());
      if (value != nullptr) arguments.push_back("--" + name + "=" + value);
    }
  }
  return arguments;
}

}  // namespace

std::vector<std::string> expand_arguments(std::vector<std::string> arguments, const CLI::App& app) {
  std::transform(arguments.begin(), arguments.end(), arguments.begin(), with_dashes);
  const auto verb_at = std::find_if(arguments.begin(), arguments.end(), [&](const std::string& argument) {
    return find_verb(app, argument) != nullptr;
  });
  if (verb_at == arguments.end()) return arguments;
  const CLI::App& verb = *find_verb(app, *verb_at);
  std::vector<std::string> expanded(arguments.begin(), verb_at + 1);
  std::optional<std::string> config = value_of_option(arguments, "--config");
  if (const char* path = std::getenv("TRYSQUARE_CONFIG"); !config && path != nullptr) config = path;
  if (config) {
    const std::vector<std::string> more = from_config(*config, app, verb);
    expanded.insert(expanded.end(), more.begin(), more.end());
  }
  const std::vector<std::string> more = from_environment(verb);
  expanded.insert(expanded.end(), more.begin(), more.end());
  expanded.insert(expanded.end(), verb_at + 1, arguments.end());
  return expanded;
}

}  // namespace trysquare::app
