// SPDX-License-Identifier: Apache-2.0
#include "png.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <system_error>

namespace trysquare::app {
namespace {

constexpr const char* kConverter = "rsvg-convert";

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const std::string& why) { throw IoError(fmt::format("PNG: {}: {}", kConverter, why)); }

/// A file without a name, which is gone when it is closed.
File nameless_file(std::string_view contents = {}) {
  File file(std::tmpfile());
  if (!file || std::fwrite(contents.data(), 1, contents.size(), file.get()) != contents.size() ||
      std::fflush(file.get()) != 0) {
    fail("cannot write a temporary file: " + std::generic_category().message(errno));
  }
  std::rewind(file.get());
  return file;
}

std::string contents_of(std::FILE* file) {
  std::rewind(file);
  std::string bytes;
  std::array<char, 65536> chunk{};
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file)) bytes.append(chunk.data(), count);
  return bytes;
}

/// Exit code of the converter between two files. No shell is involved.
int convert(std::FILE* svg, std::FILE* png, std::FILE* messages) {
  std::string program = kConverter;
  std::string zoom = "--zoom=2";
  const std::array<char*, 3> arguments = {program.data(), zoom.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(svg), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(png), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, kConverter, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail("cannot be run: " + std::generic_category().message(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("was lost: " + std::generic_category().message(errno));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

void require_png_converter() {
  if (is_in_path(kConverter)) return;
  throw InvalidArgument(
      fmt::format("PNG needs the program {}, which is not in the PATH: install librsvg2-bin (Debian, Ubuntu), "
                  "librsvg2-tools (Fedora) or librsvg (Homebrew), or ask for .svg",
                  kConverter));
}

std::string png_of(const std::string& svg) {
  const File input = nameless_file(svg);
  const File output = nameless_file();
  const File messages = nameless_file();
  const int exit_code = convert(input.get(), output.get(), messages.get());
  std::string png = contents_of(output.get());
  if (exit_code != 0 || png.rfind("\x89PNG", 0) != 0) {
    fail(fmt::format("exit code {}: {}", exit_code, contents_of(messages.get())));
  }
  return png;
}

}  // namespace trysquare::app
