// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>

namespace trysquare::oracle {

/// Folder of the real data sets: $TRYSQUARE_DATA, or shared/data beside the repository. The files of expected values
/// lie in oracle/ beside it. None of it belongs to the repository: a test asks exists() and skips.
inline std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("TRYSQUARE_DATA")) return folder;
  return std::filesystem::path(TRYSQUARE_SOURCE_DIR) / ".." / "shared" / "data";
}

inline std::filesystem::path oracle_folder() { return data_folder() / ".." / "oracle"; }

}  // namespace trysquare::oracle

/// Skips a test whose data is not there; fails when somebody said where it is, or has it, but not all of it.
#define TRYSQUARE_REQUIRE_ORACLE(file)                                                                     \
  do {                                                                                                     \
    if (!std::filesystem::exists(trysquare::oracle::oracle_folder() / (file))) {                           \
      if (std::getenv("TRYSQUARE_DATA") || std::filesystem::exists(trysquare::oracle::data_folder())) {    \
        FAIL() << trysquare::oracle::oracle_folder() / (file) << " is missing beside the data";            \
      }                                                                                                    \
      GTEST_SKIP() << "NOT COMPARED: no data in " << trysquare::oracle::data_folder()                      \
                   << "; set TRYSQUARE_DATA to the folder that holds arcore-depth, kitti00, trajectories"; \
    }                                                                                                      \
  } while (false)
