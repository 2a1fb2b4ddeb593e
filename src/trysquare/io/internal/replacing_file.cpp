// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/replacing_file.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace trysquare::internal {

namespace fs = std::filesystem;

ReplacingFile::ReplacingFile(const fs::path& target) : shown_(target), target_(target) {
  std::error_code ignored;
  if (fs::is_symlink(target, ignored)) {
    const fs::path resolved = fs::weakly_canonical(target, ignored);
    if (!resolved.empty()) target_ = resolved;
  }
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::is_directory(status)) fail(EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_.reset(std::fopen(target_.c_str(), "wb"));
    if (!file_) fail(errno);
  } else {
    open_temporary();
  }
}

ReplacingFile::~ReplacingFile() {
  file_.reset();
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void ReplacingFile::open_temporary() {
  constexpr int kMaxAttempts = 100;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    const fs::path candidate = target_.parent_path() / fmt::format(".trysquare-{}-{}.tmp", ::getpid(), attempt);
    file_.reset(std::fopen(candidate.c_str(), "wbx"));  // x: never a file that is there already, another thread's say
    if (file_) {
      temporary_ = candidate;
      return;
    }
    if (errno != EEXIST) break;
  }
  fail(errno);
}

void ReplacingFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail(errno);
}

void ReplacingFile::commit() {
  if (std::fclose(file_.release()) != 0) fail(errno);
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(error.value());
  temporary_.clear();
}

void ReplacingFile::fail(int error) const {
  throw IoError(fmt::format("{}: cannot be written: {}", shown_.string(), std::generic_category().message(error)));
}

}  // namespace trysquare::internal
