// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/sequence_check.h"

#include "trysquare/synthetic/memory_scans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using testing::HasSubstr;

std::vector<Scan> different_scans(std::size_t count) {
  std::vector<Scan> scans(count);
  for (std::size_t i = 0; i < count; ++i) {
    scans[i].points_in_scan = {{1, 2, 3}, {static_cast<double>(i), 0.5, -0.25}};
  }
  return scans;
}

std::vector<ScanIdentity> named(const std::vector<std::string>& names) {
  std::vector<ScanIdentity> scans;
  for (const std::string& name : names) scans.push_back({.num_points = 1, .digest = scans.size(), .name = name});
  return scans;
}

/// A drive along x with the given steps.
Trajectory drive(const std::vector<double>& steps_m) {
  Trajectory trajectory;
  trajectory.world_from_scan.emplace_back();
  for (const double step_m : steps_m) {
    Pose next = trajectory.world_from_scan.back();
    next.translation.x() += step_m;
    trajectory.world_from_scan.push_back(next);
  }
  return trajectory;
}

TEST(CheckDuplicates, NamesScansWhosePointsAreEqualToTheBit) {
  std::vector<Scan> scans = different_scans(8);
  scans[5] = scans[4];
  const std::optional<Finding> found = check_duplicates(identify_scans(MemoryScans(scans)));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->id, "duplicate_scans");
  EXPECT_THAT(found->message, HasSubstr("first 4 and 5"));
  EXPECT_EQ(found->evidence.value().found, 1);
}

TEST(CheckDuplicates, AcceptsScansThatDifferInTheLastBitOfOneCoordinate) {
  std::vector<Scan> scans = different_scans(2);
  scans[1] = scans[0];
  scans[1].points_in_scan[1].z() = std::nextafter(scans[1].points_in_scan[1].z(), 1);
  EXPECT_FALSE(check_duplicates(identify_scans(MemoryScans(scans))));
}

TEST(CheckDuplicates, AcceptsEmptyScans) { EXPECT_FALSE(check_duplicates(std::vector<ScanIdentity>(4))); }

TEST(CheckGaps, NamesAStepInTimeThatIsTwiceTheUsual) {
  std::vector<std::int64_t> stamps_ns;
  for (std::int64_t i = 0; i < 8; ++i) stamps_ns.push_back((i < 5 ? i : i + 1) * 100'000'000 + 3'000'000 * (i % 2));
  const std::optional<Finding> found = check_gaps(named(std::vector<std::string>(8)), stamps_ns, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->id, "missing_scans");
  EXPECT_EQ(found->severity, Severity::kWarning);
  EXPECT_THAT(found->message, HasSubstr("between scans 4 and 5"));
  EXPECT_NEAR(found->evidence.value().found, 0.203, 1e-9);
}

TEST(CheckGaps, AcceptsStepsThatVaryByATenth) {
  std::vector<std::int64_t> stamps_ns;
  for (std::int64_t i = 0; i < 8; ++i) stamps_ns.push_back(i * 100'000'000 + 10'000'000 * (i % 2));
  EXPECT_FALSE(check_gaps(named(std::vector<std::string>(8)), stamps_ns, {}));
}

TEST(CheckGaps, NamesANumberThatIsMissingWhereThereAreNoStamps) {
  const std::optional<Finding> found =
      check_gaps(named({"a/s_07.bin", "a/s_08.bin", "a/s_09.bin", "a/s_10.bin", "a/s_12.bin", "a/s_13.bin"}), {}, {});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->message, HasSubstr("numbers of the scans, first between scans 3 and 4"));
}

TEST(CheckGaps, AcceptsEverySecondScanAndNamesWithoutNumbers) {
  EXPECT_FALSE(check_gaps(named({"0.bin", "2.bin", "4.bin", "6.bin", "8.bin", "10.bin"}), {}, drive({1, 1, 1, 1, 1})));
  EXPECT_FALSE(check_gaps(named({"a", "b", "c", "d", "e", "f"}), {}, drive({1, 1, 1, 1, 1})));
}

TEST(CheckGaps, NotesALongWayBetweenPosesOnASteadyDriveOnly) {
  const std::vector<ScanIdentity> scans = named({"a", "b", "c", "d", "e", "f", "g"});
  const std::optional<Finding> found = check_gaps(scans, {}, drive({1, 1.1, 1, 2.1, 1, 1.05}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->severity, Severity::kNote);
  EXPECT_THAT(found->message, HasSubstr("between scans 3 and 4"));
  EXPECT_FALSE(check_gaps(scans, {}, drive({0.3, 1.7, 1, 2.1, 0.5, 1.05})));
}

}  // namespace
}  // namespace trysquare
