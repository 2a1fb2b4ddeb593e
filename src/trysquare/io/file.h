// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace trysquare {

/// The bytes of a file (or of a pipe).
/// @throws IoError  naming the path and the reason: missing, a directory, not readable.
std::string read_file(const std::filesystem::path& path);

/// Writes a file whole or not at all: the bytes go to a temporary in the same folder, which then takes the file's
/// place. Devices and pipes are written to directly.
/// @throws IoError  naming the path and the reason. Nothing is left behind then, and an older file is as it was.
void write_file(const std::filesystem::path& path, std::string_view contents);

}  // namespace trysquare
