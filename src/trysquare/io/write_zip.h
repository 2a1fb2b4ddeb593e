// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace trysquare {

struct ZipEntry {
  std::string name;
  std::string bytes;
};

/// A ZIP archive of uncompressed entries, in the order given, dated 1980-01-01: same input, same bytes.
/// @throws InvalidArgument  if there are 65535 entries or more, or 4 GiB or more in all: the format's extension for
/// more is
///                          not written.
/// Source: PKWARE, APPNOTE.TXT 6.3.
std::string format_zip(std::span<const ZipEntry> entries);

/// format_zip into a file, whole or not at all.
/// @throws IoError  if the file cannot be written.
void write_zip(const std::filesystem::path& path, std::span<const ZipEntry> entries);

}  // namespace trysquare
