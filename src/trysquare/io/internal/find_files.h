// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace trysquare::internal {

/// Order of names in which numbers count as numbers: scan2 before scan10.
bool natural_less(std::string_view a, std::string_view b);

/// The files of a folder in natural order, without those whose name starts with a dot.
/// @throws IoError  if the folder cannot be listed.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

/// The files that a pattern (* ? [..]) matches, in natural order; none is not an error.
std::vector<std::filesystem::path> files_matching(std::string_view pattern);

/// The files that a file's name, a pattern or a comma list of those stands for. Lists keep their order.
/// @throws IoError  if one of them is not there or is a directory.
std::vector<std::filesystem::path> files_named(std::string_view spec);

}  // namespace trysquare::internal
