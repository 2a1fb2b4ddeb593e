// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

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

/// The values of a key as arguments: several for an array.
std::vector<std::string> values_of(const toml::node& node, const std::string& where) {
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> values;
    for (const toml::node& element : *array) {
      for (std::string& value : values_of(element, where)) values.push_back(std::move(value));
    }
    return values;
  }
  if (const auto* text = node.as_string()) return {text->get()};
  if (const auto* flag = node.as_boolean()) return {flag->get() ? "true" : "false"};
  if (const auto* whole = node.as_integer()) return {std::to_string(whole->get())};
  if (const auto* number = node.as_floating_point()) return {fmt::format("{}", number->get())};
  throw IoError(where + ": a text, number, true or false was expected");
}

/// The keys of one table that `verb` has an option for. Keys at the top level may be for other verbs.
std::vector<std::string> keys_of(const toml::table& table, const CLI::App& app, const CLI::App& verb, bool is_top_level,
                                 const std::string& path) {
  std::vector<std::string> arguments;
  for (const auto& [key, node] : table) {
    const std::string where = fmt::format("{}: line {}: {}", path, node.source().begin.line, key.str());
    if (is_top_level && node.is_table()) {
      if (find_verb(app, std::string(key.str())) == nullptr) throw IoError(where + ": no such verb");
      continue;
    }
    const std::string option = with_dashes("--" + std::string(key.str())).substr(2);
    if (find_option(verb, option) == nullptr) {
      const auto has_it = [&](const CLI::App* other) { return find_option(*other, option) != nullptr; };
      if (!is_top_level || app.get_subcommands(has_it).empty()) throw IoError(where + ": no such option");
      continue;
    }
    for (const std::string& value : values_of(node, where)) arguments.push_back("--" + option + "=" + value);
  }
  return arguments;
}

/// Keys stand at the top level, for every verb that has them, or in a table [verb], which wins.
std::vector<std::string> from_config(const std::string& path, const CLI::App& app, const CLI::App& verb) {
  toml::table config;
  try {
    config = toml::parse(read_file(path), path);
  } catch (const toml::parse_error& error) {
    throw IoError(fmt::format("{}: line {}: {}", path, error.source().begin.line, error.description()));
  }
  std::vector<std::string> arguments = keys_of(config, app, verb, true, path);
  if (const toml::table* own = config[verb.get_name()].as_table()) {
    const std::vector<std::string> more = keys_of(*own, app, verb, false, path);
    arguments.insert(arguments.end(), more.begin(), more.end());
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

/// A preset stands for a radius: one from a stronger source wins over a radius from a weaker one.
void let_preset_win(std::vector<std::string>& weaker, const std::vector<std::string>& stronger) {
  const auto is_preset = [](const std::string& argument) { return argument.rfind("--preset", 0) == 0; };
  if (std::none_of(stronger.begin(), stronger.end(), is_preset)) return;
  std::erase_if(weaker, [](const std::string& argument) { return argument.rfind("--radius=", 0) == 0; });
}

[[noreturn]] void refuse_verb(const std::string& word, const CLI::App& app) {
  std::string known;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    known += " " + verb->get_name();
  throw CLI::RequiredError(
      word.empty() ? "no verb; known are" + known : fmt::format("unknown verb '{}'; known are{}", word, known),
      CLI::ExitCodes::RequiredError);
}

/// The place of the verb; the end when there is only --help or --version.
std::size_t find_verb_word(const std::vector<std::string>& arguments, const CLI::App& app) {
  std::size_t i = 0;
  while (i < arguments.size() && arguments[i].rfind('-', 0) == 0) ++i;
  const bool wants_help = i > 0;
  if (i == arguments.size() && wants_help) return i;
  if (i == arguments.size()) refuse_verb("", app);
  if (find_verb(app, arguments[i]) == nullptr) refuse_verb(arguments[i], app);
  return i;
}

/// evo has the format as a word before the files; CLI11 would complain of the last file.
void refuse_format_word(const std::string& verb, const std::vector<std::string>& own) {
  if ((verb != "ape" && verb != "rpe") || own.empty() || std::filesystem::exists(own[0])) return;
  if (own[0] != "tum" && own[0] != "kitti" && own[0] != "euroc") return;
  throw InvalidArgument(fmt::format(
      "leave out the word {0}: trysquare {1} REFERENCE ESTIMATE finds the format itself, or takes --poses-format {0}",
      own[0], verb));
}

}  // namespace

std::vector<std::string> expand_arguments(std::vector<std::string> arguments, const CLI::App& app) {
  std::transform(arguments.begin(), arguments.end(), arguments.begin(), with_dashes);
  const std::size_t at = find_verb_word(arguments, app);
  if (at == arguments.size()) return arguments;
  const CLI::App& verb = *find_verb(app, arguments[at]);
  const auto own_begin = arguments.begin() + static_cast<std::ptrdiff_t>(at) + 1;
  const std::vector<std::string> own(own_begin, arguments.end());
  refuse_format_word(verb.get_name(), own);

  std::optional<std::string> config = value_of_option(own, "--config");
  if (const char* path = std::getenv("TRYSQUARE_CONFIG"); !config && path != nullptr) config = path;
  std::vector<std::string> of_config = config ? from_config(*config, app, verb) : std::vector<std::string>();
  std::vector<std::string> of_environment = from_environment(verb);
  let_preset_win(of_config, of_environment);
  let_preset_win(of_config, own);
  let_preset_win(of_environment, own);

  std::vector<std::string> expanded(arguments.begin(), own_begin);
  for (const std::vector<std::string>* source : {&of_config, &of_environment}) {
    expanded.insert(expanded.end(), source->begin(), source->end());
  }
  expanded.insert(expanded.end(), own.begin(), own.end());
  return expanded;
}

}  // namespace trysquare::app
