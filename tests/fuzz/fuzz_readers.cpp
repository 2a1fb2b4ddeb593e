// SPDX-License-Identifier: Apache-2.0
// Feeds random variations of small files to every reader. Each is read in a process of its own from memory that ends
// where an inaccessible page begins: reading one byte too far, crashing, hanging, another exception than IoError or too
// much memory are failures, also without sanitizers. The input that failed is written to a file.
#include "trysquare/io/internal/test_readers.h"

#include <CLI/CLI.hpp>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using trysquare::internal::ReaderUnderTest;

constexpr std::size_t kLargestInput = 4096;
constexpr std::size_t kPoolSize = 64;
constexpr unsigned kSlow_s = 20;  // for a thousand inputs of a few kilobytes

/// Where both processes see it: what is being read, and what was wrong with it.
class SharedInput {
 public:
  SharedInput() {
    const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    capacity_ = (kLargestInput + page - 1) / page * page;
    bytes_ = static_cast<char*>(map(capacity_ + page));
    facts_ = new (map(sizeof(Facts))) Facts();
    if (mprotect(bytes_ + capacity_, page, PROT_NONE) != 0) throw std::bad_alloc();
  }

  /// A view of the copy, whose last byte is the last that may be read.
  std::string_view put(const std::string& input) {
    facts_->size = input.size();
    ++facts_->num_inputs;
    std::memcpy(bytes_ + capacity_ - input.size(), input.data(), input.size());
    return current();
  }

  void complain(const std::string& why) { std::strncpy(facts_->complaint, why.c_str(), sizeof(Facts::complaint) - 1); }

  void clear() { *facts_ = {}; }

  std::string_view current() const { return {bytes_ + capacity_ - facts_->size, facts_->size}; }
  std::uint64_t num_inputs() const { return facts_->num_inputs; }
  std::string complaint() const { return facts_->complaint; }

 private:
  struct Facts {
    std::size_t size = 0;
    std::uint64_t num_inputs = 0;
    char complaint[1000] = {};
  };

  static void* map(std::size_t size) {
    void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return memory;
  }

  std::size_t capacity_ = 0;
  char* bytes_ = nullptr;
  Facts* facts_ = nullptr;
};

/// Runs in the child. Variations of variations that are still valid lead further than those of the example alone.
void read_variations(const ReaderUnderTest& reader, std::uint64_t seed, Clock::time_point end, SharedInput& shared) {
  std::seed_seq seeds{static_cast<unsigned>(seed), static_cast<unsigned>(seed >> 32),
                      static_cast<unsigned>(std::hash<std::string>()(reader.name))};
  std::mt19937 random(seeds);
  std::vector<std::string> pool = {reader.valid};
  for (std::uint64_t i = 0;; ++i) {
    if (i % 1024 == 0) {
      if (Clock::now() >= end) return;
      alarm(kSlow_s);  // ends the process
    }
    const std::string input = trysquare::internal::mutated(pool[random() % pool.size()], random);
    if (input.size() > kLargestInput || !read_or_refuse(reader, shared.put(input))) continue;
    if (pool.size() < kPoolSize) {
      pool.push_back(input);
    } else {
      pool[1 + random() % (kPoolSize - 1)] = input;  // the example stays
    }
  }
}

/// Reads one file, or variations until `end`, in a child process. @return  Empty, or what went wrong.
template <class Work>
std::string in_a_child(const Work& work, SharedInput& shared) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return "cannot fork";
  if (child == 0) {
    try {
      work();
      _exit(0);
    } catch (const std::exception& error) {
      shared.complain(error.what());
    }
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) {
    return WTERMSIG(status) == SIGALRM ? "takes too long" : std::string("crashes: ") + strsignal(WTERMSIG(status));
  }
  if (WEXITSTATUS(status) == 0) return "";
  return shared.complaint().empty() ? "ends with exit code " + std::to_string(WEXITSTATUS(status)) : shared.complaint();
}

std::string bytes_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw CLI::ValidationError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Options {
  double seconds = 60;
  std::uint64_t seed = (std::uint64_t{std::random_device()()} << 32) | std::random_device()();
  std::vector<std::string> readers;
  std::string failures = ".";
  std::string replay;
  bool list = false;
};

/// @return  Whether all went well.
bool fuzz(const ReaderUnderTest& reader, double seconds, const Options& options, SharedInput& shared) {
  shared.clear();
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  const std::string wrong = in_a_child([&] { read_variations(reader, options.seed, end, shared); }, shared);
  std::printf("%s: %llu inputs%s%s\n", reader.name.c_str(), static_cast<unsigned long long>(shared.num_inputs()),
              wrong.empty() ? "" : "; FAILED: ", wrong.c_str());
  if (wrong.empty()) return true;
  std::filesystem::create_directories(options.failures);
  const std::string path = options.failures + "/" + reader.name + "-" + std::to_string(options.seed);
  std::ofstream(path, std::ios::binary) << shared.current();
  std::printf("  input written to %s; again: trysquare_fuzz_readers --reader %s --replay %s\n", path.c_str(),
              reader.name.c_str(), path.c_str());
  return false;
}

bool replay(const ReaderUnderTest& reader, const Options& options, SharedInput& shared) {
  const std::string input = bytes_of_file(options.replay);
  if (input.size() > kLargestInput) throw CLI::ValidationError(options.replay + ": larger than 4096 bytes");
  shared.clear();
  bool is_read = false;
  const std::string wrong = in_a_child([&] { is_read = read_or_refuse(reader, shared.put(input)); }, shared);
  std::printf("%s: %s\n", reader.name.c_str(), wrong.empty() ? "read or refused" : wrong.c_str());
  return wrong.empty();
}

int run(const Options& options) {
  std::vector<ReaderUnderTest> readers = trysquare::internal::readers_under_test();
  std::erase_if(readers, [&](const ReaderUnderTest& reader) {
    return !options.readers.empty() && std::count(options.readers.begin(), options.readers.end(), reader.name) == 0;
  });
  if (readers.empty()) throw CLI::ValidationError("--reader: no reader of this name; see --list");
  SharedInput shared;
  bool all_well = true;
  if (!options.list && options.replay.empty()) {
    std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed));
  }
  for (const ReaderUnderTest& reader : readers) {
    if (options.list) {
      std::printf("%s\n", reader.name.c_str());
    } else if (!options.replay.empty()) {
      all_well = replay(reader, options, shared) && all_well;
    } else {
      all_well = fuzz(reader, options.seconds / static_cast<double>(readers.size()), options, shared) && all_well;
    }
  }
  return all_well ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Random files for every reader: each must be read or refused with an IoError.");
  app.add_option("--seconds", options.seconds, "Time in all, evenly for each reader")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the random numbers; without it another one each time");
  app.add_option("--reader", options.readers, "Only this one; may be given several times");
  app.add_option("--failures", options.failures, "Folder for inputs that fail")->capture_default_str();
  app.add_option("--replay", options.replay, "Read this file instead of random ones");
  app.add_flag("--list", options.list, "Names of the readers");
  try {
    app.parse(argc, argv);
    return run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
}
