// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace trysquare::app {

/// The arguments as CLI11 gets them: underscores in option names become dashes, and the settings of the config file and
/// of the environment stand before those of the command line. Of an option that is there several times the last one
/// counts, so the command line wins over TRYSQUARE_* variables, and these over the file.
/// @param app  With all verbs declared.
/// @throws CLI::ParseError  on a verb that does not exist.
/// @throws InvalidArgument  on a format before the files of `ape` and `rpe`, as evo has it.
/// @throws IoError          on a config file that cannot be read, is no TOML or has an unknown key.
std::vector<std::string> expand_arguments(std::vector<std::string> arguments, const CLI::App& app);

}  // namespace trysquare::app
