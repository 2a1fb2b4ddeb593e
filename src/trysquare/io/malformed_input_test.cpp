// SPDX-License-Identifier: Apache-2.0
// Properties of every reader: each truncation and 20 000 mutations, always the same, of a small valid file are either
// read or refused with an IoError, without a crash and without memory that the file does not account for. tests/fuzz
// looks for other mutations.
#include "trysquare/core/error.h"
#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/internal/test_readers.h"
#include "trysquare/io/read_points.h"

#include <gtest/gtest.h>

#include <ostream>
#include <random>
#include <string>

namespace trysquare::internal {

std::ostream& operator<<(std::ostream& stream, const ReaderUnderTest& reader) { return stream << reader.name; }

}  // namespace trysquare::internal

namespace trysquare {
namespace {

using MalformedInput = testing::TestWithParam<internal::ReaderUnderTest>;

TEST_P(MalformedInput, TheExampleItselfIsValid) { EXPECT_NO_THROW(GetParam().read(GetParam().valid)); }

TEST_P(MalformedInput, EveryTruncationIsReadOrRefused) {
  for (std::size_t size = 0; size < GetParam().valid.size(); ++size) {
    ASSERT_NO_THROW(read_or_refuse(GetParam(), GetParam().valid.substr(0, size))) << size;
  }
}

TEST_P(MalformedInput, EveryMutationIsReadOrRefused) {
  constexpr int kMutations = 20000;
  std::mt19937 random(20211);
  for (int i = 0; i < kMutations; ++i) {
    const std::string bytes = internal::mutated(GetParam().valid, random);
    ASSERT_NO_THROW(read_or_refuse(GetParam(), bytes)) << "mutation " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Parsers, MalformedInput, testing::ValuesIn(internal::readers_under_test()),
                         [](const auto& instance) { return instance.param.name; });

TEST(MalformedInput, HugeClaimsTakeNoMemory) {
  const auto largest_while = [](PointFormat format, const std::string& bytes) {
    return internal::largest_allocation_of(
        [&] { EXPECT_THROW(parse_points(bytes, format, "f", Columns::kAll), IoError) << bytes; });
  };
  const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1000000000000\nHEIGHT 1\nDATA ";
  for (const char* data : {"ascii\n", "binary\n", "binary_compressed\n        "}) {
    EXPECT_LT(largest_while(PointFormat::kPcd, pcd + data), 10000U);
  }
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    EXPECT_LT(largest_while(PointFormat::kPly, std::string("ply\nformat ") + format +
                                                   " 1.0\nelement vertex 1000000000000\nproperty float x\n"
                                                   "property float y\nproperty float z\nend_header\n"),
              10000U);
  }
  EXPECT_LT(largest_while(PointFormat::kNpy, internal::npy_header("'<f8'", "(1000000000000, 3)")), 10000U);
  EXPECT_LT(largest_while(PointFormat::kXyz, "1000000000000\n"), 10000U);
}

}  // namespace
}  // namespace trysquare
