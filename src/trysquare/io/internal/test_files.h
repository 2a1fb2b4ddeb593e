// SPDX-License-Identifier: Apache-2.0
// For tests only: bytes of files, folders that go away, and the place of the real data.
#pragma once

#include "trysquare/core/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trysquare::internal {

/// What an IoError says, or "" when `read` throws none.
template <class Read>
std::string io_error_of(Read&& read) {
  try {
    std::forward<Read>(read)();
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

template <class T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return {raw.data(), raw.size()};
}

template <class T>
std::string bytes_of_all(const std::vector<double>& values, std::endian order = std::endian::little) {
  std::string bytes;
  for (const double value : values) bytes += bytes_of(static_cast<T>(value), order);
  return bytes;
}

/// A header as numpy.save writes it: padded with spaces so that the array begins at a multiple of 64.
inline std::string npy_header(const std::string& descr, const std::string& shape, bool fortran = false,
                              int version = 1) {
  std::string dictionary =
      "{'descr': " + descr + ", 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
  const std::size_t prefix = version == 1 ? 10 : 12;
  while ((prefix + dictionary.size() + 1) % 64 != 0) dictionary += ' ';
  dictionary += '\n';
  const std::string length = version == 1 ? bytes_of(static_cast<std::uint16_t>(dictionary.size()))
                                          : bytes_of(static_cast<std::uint32_t>(dictionary.size()));
  return std::string("\x93NUMPY") + static_cast<char>(version) + '\0' + length + dictionary;
}

/// LZF without any compression: runs of up to 32 literal bytes, each behind its length - 1.
inline std::string lzf_literals(std::string_view bytes) {
  std::string packed;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 32))) {
    const std::string_view run = bytes.substr(0, 32);
    packed += static_cast<char>(run.size() - 1);
    packed += run;
  }
  return packed;
}

/// The body of DATA binary_compressed.
inline std::string compressed_body(const std::string& packed, std::size_t unpacked_size) {
  return bytes_of(static_cast<std::uint32_t>(packed.size())) + bytes_of(static_cast<std::uint32_t>(unpacked_size)) +
         packed;
}

/// A folder of its own for one test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::random_device seed;
    do {
      path_ = std::filesystem::temp_directory_path() / ("trysquare_test_" + std::to_string(seed()));
    } while (!std::filesystem::create_directory(path_));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path add(const std::string& name, std::string_view contents) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << contents;
    return path_ / name;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// The folder with kitti00, arcore-depth and trajectories: $TRYSQUARE_DATA, or ../shared/data beside the repository.
inline std::optional<std::filesystem::path> real_data() {
  namespace fs = std::filesystem;
  const char* set = std::getenv("TRYSQUARE_DATA");
  const fs::path repository = fs::path(__FILE__).parent_path() / "../../../..";
  const fs::path folder = set != nullptr ? fs::path(set) : (repository / "../shared/data").lexically_normal();
  return fs::is_directory(folder / "kitti00") ? std::optional(folder) : std::nullopt;
}

}  // namespace trysquare::internal
