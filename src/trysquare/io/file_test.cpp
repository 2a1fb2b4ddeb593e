// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/file.h"

#include "trysquare/io/internal/replacing_file.h"
#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

namespace trysquare {
namespace {

namespace fs = std::filesystem;
using internal::io_error_of;
using internal::TemporaryFolder;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(ReadFile, GivesEveryByte) {
  const TemporaryFolder folder;
  const std::string bytes(
      "a\0\r\n\xFF"
      "b",
      6);
  EXPECT_EQ(read_file(folder.add("x", bytes)), bytes);
}

TEST(ReadFile, ReadsPipesToTheirEnd) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string bytes(200000, 'x');
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
  EXPECT_EQ(read_file(pipe), bytes);
  writer.join();
}

TEST(ReadFile, NamesThePathAndTheReason) {
  const TemporaryFolder folder;
  const std::string missing = (folder.path() / "missing.pcd").string();
  EXPECT_EQ(io_error_of([&] { read_file(missing); }), missing + ": cannot be read: no such file");
  EXPECT_EQ(io_error_of([&] { read_file(folder.path()); }),
            folder.path().string() + ": cannot be read: it is a directory, expected a file");
}

TEST(ReadFile, RefusesDevicesThatHaveNoEnd) {
  EXPECT_EQ(io_error_of([] { read_file("/dev/zero"); }),
            "/dev/zero: cannot be read: it is neither a regular file nor a pipe");
}

TEST(WriteFile, ReplacesTheOldFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder.add("x.txt", "old and longer");
  write_file(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_THAT(folder.names(), ElementsAre("x.txt"));
}

TEST(WriteFile, WritesThroughSymbolicLinks) {
  const TemporaryFolder folder;
  folder.add("target.txt", "old");
  fs::create_symlink("target.txt", folder.path() / "link.txt");
  write_file(folder.path() / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(read_file(folder.path() / "target.txt"), "new");
}

TEST(WriteFile, ReplacesNoDevices) {
  write_file("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteFile, NamesThePathAndTheReason) {
  const TemporaryFolder folder;
  const std::string nowhere = (folder.path() / "no" / "x.txt").string();
  EXPECT_EQ(io_error_of([&] { write_file(nowhere, "a"); }), nowhere + ": cannot be written: No such file or directory");
  const std::string inside_a_file = (folder.add("file", "") / "x.txt").string();
  EXPECT_EQ(io_error_of([&] { write_file(inside_a_file, "a"); }),
            inside_a_file + ": cannot be written: Not a directory");
  EXPECT_EQ(io_error_of([&] { write_file(folder.path(), "a"); }),
            folder.path().string() + ": cannot be written: Is a directory");
  EXPECT_EQ(io_error_of([&] { write_file("/dev/full", "a"); }),
            "/dev/full: cannot be written: No space left on device");
}

TEST(ReplacingFile, IsRemovedWithoutCommit) {
  const TemporaryFolder folder;
  {
    internal::ReplacingFile file(folder.path() / "x.txt");
    file.write("half");
    EXPECT_EQ(folder.names().size(), 1U);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ReplacingFile, IsRemovedWhenItCannotTakeItsPlace) {
  const TemporaryFolder folder;
  const std::string message = io_error_of([&] {
    internal::ReplacingFile file(folder.path() / "x.txt");
    file.write("whole");
    fs::create_directory(folder.path() / "x.txt");
    file.commit();
  });
  EXPECT_EQ(message, (folder.path() / "x.txt").string() + ": cannot be written: Is a directory");
  EXPECT_THAT(folder.names(), ElementsAre("x.txt"));
}

TEST(ReplacingFile, TwoInOneFolderDoNotMeet) {
  const TemporaryFolder folder;
  internal::ReplacingFile a(folder.path() / "a");
  internal::ReplacingFile b(folder.path() / "b");
  a.write("1");
  b.write("2");
  a.commit();
  b.commit();
  EXPECT_EQ(read_file(folder.path() / "a"), "1");
  EXPECT_EQ(read_file(folder.path() / "b"), "2");
}

}  // namespace
}  // namespace trysquare
