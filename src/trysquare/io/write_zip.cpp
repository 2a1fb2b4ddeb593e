// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_zip.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/append_scalar.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace trysquare {
namespace {

using internal::append_little_endian;

constexpr std::uint32_t kLocalHeader = 0x04034b50;
constexpr std::uint32_t kCentralHeader = 0x02014b50;
constexpr std::uint32_t kEndOfCentralDirectory = 0x06054b50;
constexpr std::uint16_t kVersion = 20;
constexpr std::uint16_t kNamesAreUtf8 = 1U << 11U;
constexpr std::uint16_t kStored = 0;
constexpr std::uint16_t kMidnight = 0;
constexpr std::uint16_t kFirstOfJanuary1980 = (1U << 5U) | 1U;

/// CRC-32 of ISO 3309, reflected, as ZIP has it.
constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    table[byte] = crc;
  }
  return table;
}

std::uint32_t crc32_of(std::string_view bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (crc >> 8U);
  return ~crc;
}

/// The fields that the header before an entry and its line in the directory share.
void append_description(std::string& bytes, const ZipEntry& entry) {
  append_little_endian(kVersion, bytes);  // needed to extract
  append_little_endian(kNamesAreUtf8, bytes);
  append_little_endian(kStored, bytes);
  append_little_endian(kMidnight, bytes);
  append_little_endian(kFirstOfJanuary1980, bytes);
  append_little_endian(crc32_of(entry.bytes), bytes);
  append_little_endian(static_cast<std::uint32_t>(entry.bytes.size()), bytes);  // compressed
  append_little_endian(static_cast<std::uint32_t>(entry.bytes.size()), bytes);
  append_little_endian(static_cast<std::uint16_t>(entry.name.size()), bytes);
  append_little_endian(std::uint16_t{0}, bytes);  // extra field
}

void append_directory_line(std::string& bytes, const ZipEntry& entry, std::size_t offset) {
  append_little_endian(kCentralHeader, bytes);
  append_little_endian(kVersion, bytes);  // made by
  append_description(bytes, entry);
  append_little_endian(std::uint16_t{0}, bytes);  // comment
  append_little_endian(std::uint16_t{0}, bytes);  // disk
  append_little_endian(std::uint16_t{0}, bytes);  // internal attributes
  append_little_endian(std::uint32_t{0}, bytes);  // external attributes
  append_little_endian(static_cast<std::uint32_t>(offset), bytes);
  bytes += entry.name;
}

void validate(std::span<const ZipEntry> entries) {
  constexpr std::size_t kEntryOverhead = 30 + 46 + 22;
  if (entries.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw InvalidArgument(fmt::format("{} entries, fewer than 65535 were expected", entries.size()));
  }
  std::size_t size = 0;
  for (const ZipEntry& entry : entries) {
    if (entry.name.empty() || entry.name.size() > std::numeric_limits<std::uint16_t>::max()) {
      throw InvalidArgument(fmt::format("the name of an entry has {} bytes, expected 1 to 65535", entry.name.size()));
    }
    size += entry.bytes.size() + 2 * entry.name.size() + kEntryOverhead;
  }
  if (size >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument(fmt::format("the archive would have {} bytes, less than 4 GiB were expected", size));
  }
}

}  // namespace

std::string format_zip(std::span<const ZipEntry> entries) {
  validate(entries);
  std::string bytes;
  std::string directory;
  for (const ZipEntry& entry : entries) {
    append_directory_line(directory, entry, bytes.size());
    append_little_endian(kLocalHeader, bytes);
    append_description(bytes, entry);
    bytes += entry.name;
    bytes += entry.bytes;
  }
  const std::size_t directory_offset = bytes.size();
  bytes += directory;
  append_little_endian(kEndOfCentralDirectory, bytes);
  append_little_endian(std::uint32_t{0}, bytes);  // disks
  append_little_endian(static_cast<std::uint16_t>(entries.size()), bytes);
  append_little_endian(static_cast<std::uint16_t>(entries.size()), bytes);
  append_little_endian(static_cast<std::uint32_t>(directory.size()), bytes);
  append_little_endian(static_cast<std::uint32_t>(directory_offset), bytes);
  append_little_endian(std::uint16_t{0}, bytes);  // comment
  return bytes;
}

void write_zip(const std::filesystem::path& path, std::span<const ZipEntry> entries) {
  write_file(path, format_zip(entries));
}

}  // namespace trysquare
