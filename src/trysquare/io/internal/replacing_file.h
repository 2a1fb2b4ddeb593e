// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace trysquare::internal {

/// A file that is being written beside the one it will replace. Without commit() the destructor removes it.
class ReplacingFile {
 public:
  /// @throws IoError  if the folder is missing or cannot be written to.
  explicit ReplacingFile(const std::filesystem::path& target);
  ~ReplacingFile();
  ReplacingFile(const ReplacingFile&) = delete;
  ReplacingFile& operator=(const ReplacingFile&) = delete;
  ReplacingFile(ReplacingFile&&) = delete;
  ReplacingFile& operator=(ReplacingFile&&) = delete;

  /// @throws IoError  if the disk is full, for example.
  void write(std::string_view bytes);

  /// Puts the file in its place.
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void open_temporary();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_;      ///< As the caller named it, for messages.
  std::filesystem::path target_;     ///< With symbolic links resolved: the link stays, what it points to is replaced.
  std::filesystem::path temporary_;  ///< Empty when the target is a device or a pipe.
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace trysquare::internal
