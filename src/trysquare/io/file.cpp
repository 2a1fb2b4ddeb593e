// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/file.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/replacing_file.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace trysquare {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_to_read(const fs::path& path, std::string_view reason) {
  throw IoError(fmt::format("{}: cannot be read: {}", path.string(), reason));
}

void require_readable_kind(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail_to_read(path, "no such file");
  if (error) fail_to_read(path, error.message());
  if (fs::is_directory(status)) fail_to_read(path, "it is a directory, expected a file");
  if (!fs::is_regular_file(status) && !fs::is_fifo(status)) {
    fail_to_read(path, "it is neither a regular file nor a pipe");  // a device such as /dev/zero has no end
  }
}

}  // namespace

std::string read_file(const fs::path& path) {
  require_readable_kind(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail_to_read(path, std::generic_category().message(errno));
  std::error_code no_size;
  const std::uintmax_t size = fs::file_size(path, no_size);
  std::string bytes;
  if (!no_size) {
    bytes.resize(static_cast<std::size_t>(size));
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
  }
  std::array<char, 65536> chunk{};  // pipes have no size, and a file may have grown
  while (stream.read(chunk.data(), chunk.size()), stream.gcount() > 0) {
    bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) fail_to_read(path, std::generic_category().message(errno));
  return bytes;
}

void write_file(const fs::path& path, std::string_view contents) {
  internal::ReplacingFile file(path);
  file.write(contents);
  file.commit();
}

}  // namespace trysquare
