// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

/// Every reader, for the tests and the fuzzer: what it does with files that are not what it expects.
namespace trysquare::internal {

struct ReaderUnderTest {
  std::string name;
  std::string valid;  ///< A small file that it reads.
  std::function<void(std::string_view)> read;
};

std::vector<ReaderUnderTest> readers_under_test();

/// The reader reads the bytes, or refuses them with an IoError that begins with the file's name, and asks for no more
/// memory than they can account for.
/// @return  Whether they were read.
/// @throws std::runtime_error  if it does anything else; says what.
bool read_or_refuse(const ReaderUnderTest& reader, std::string_view bytes);

/// Size of the largest piece of memory that `run` asks for [byte]. Replaces the operators new of the whole program, the
/// only way to see that. One thread at a time.
std::size_t largest_allocation_of(const std::function<void()>& run);

/// One to four small changes: other bytes, digits in rows, pieces left out or doubled.
std::string mutated(std::string bytes, std::mt19937& random);

}  // namespace trysquare::internal
