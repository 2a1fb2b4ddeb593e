// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_zip.h"

#include "trysquare/core/error.h"
#include "trysquare/io/read_npy.h"
#include "trysquare/io/write_npy.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trysquare {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes.at(at + i))} << (8 * i);
  return value;
}

TEST(FormatZip, HasTheChecksumOfTheStandardExample) {
  const std::string zip = format_zip(std::vector<ZipEntry>{{"a.txt", "123456789"}});
  EXPECT_EQ(zip.substr(0, 4), "PK\x03\x04");
  EXPECT_EQ(number_at(zip, 14), 0xCBF43926U);  // the check value of CRC-32
  EXPECT_EQ(number_at(zip, 18), 9U);
  EXPECT_EQ(zip.substr(30, 14), "a.txt123456789");
}

TEST(FormatZip, TheDirectoryPointsToTheEntries) {
  const std::string zip = format_zip(std::vector<ZipEntry>{{"a", "first"}, {"bc", ""}});
  const std::size_t end = zip.size() - 22;
  ASSERT_EQ(zip.substr(end, 4), "PK\x05\x06");
  const std::uint32_t directory = number_at(zip, end + 16);
  ASSERT_EQ(zip.substr(directory, 4), "PK\x01\x02");
  const std::size_t second = directory + 46 + 1;
  ASSERT_EQ(zip.substr(second, 4), "PK\x01\x02");
  EXPECT_EQ(zip.substr(number_at(zip, second + 42), 4), "PK\x03\x04");
  EXPECT_EQ(zip.substr(second + 46, 2), "bc");
}

TEST(FormatZip, OfNothingIsAnEmptyArchive) { EXPECT_EQ(format_zip({}).size(), 22U); }

TEST(FormatZip, RefusesEntriesWithoutAName) {
  EXPECT_THROW(format_zip(std::vector<ZipEntry>{{"", "x"}}), InvalidArgument);
}

TEST(FormatNpy, IsReadBack) {
  const std::vector<double> values = {1, 2, 3, 0.1, 1e-300, -6};
  const PointTable table = parse_npy(format_npy(values, 3), "f", Columns::kNone);
  ASSERT_EQ(table.points.size(), 2U);
  EXPECT_EQ(table.points[1], Eigen::Vector3d(0.1, 1e-300, -6));
}

TEST(FormatNpy, BeginsItsNumbersAtAMultipleOf64) {
  for (std::size_t size = 0; size < 200; ++size) {
    const std::string bytes = format_npy(std::vector<double>(size, 1.0));
    EXPECT_EQ((bytes.size() - 8 * size) % 64, 0U) << size;
    EXPECT_EQ(bytes[bytes.size() - 8 * size - 1], '\n') << size;
  }
}

}  // namespace
}  // namespace trysquare
