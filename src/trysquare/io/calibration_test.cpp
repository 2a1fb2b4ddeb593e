// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/calibration.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::io_error_of;
using internal::real_data;
using internal::TemporaryFolder;
using testing::HasSubstr;

const std::string kNumbers = "0 -1 0 0.5 0 0 -1 0.25 1 0 0 -2";

void expect_example(const Pose& pose) {
  EXPECT_EQ(pose.rotation, (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished());
  EXPECT_EQ(pose.translation, Eigen::Vector3d(0.5, 0.25, -2));
}

TEST(KittiCalibration, FindsTrAmongOtherLines) {
  for (const std::string key : {"Tr:", "Tr_velo_to_cam:", "Tr_velo_cam", "Tr :"}) {
    expect_example(
        parse_kitti_calibration("P0: 7.2e+02 0 6 0\n\n" + key + " " + kNumbers + "\r\nTr_imu_to_velo: 1 2\n", "c"));
  }
}

TEST(KittiCalibration, SaysWhatItFoundInstead) {
  EXPECT_EQ(io_error_of([] { parse_kitti_calibration("P0: 1\nR_rect 1\n", "c.txt"); }),
            "c.txt: line 2: the file ends without a line Tr: (or Tr_velo_to_cam:); found \"P0\" \"R_rect\"");
  EXPECT_THAT(io_error_of([] { parse_kitti_calibration("", "c.txt"); }), HasSubstr("c.txt: line 1: "));
}

TEST(KittiCalibration, RefusesBadLines) {
  EXPECT_EQ(io_error_of([] { parse_kitti_calibration("P0: 1\nTr: 1 0 0\n", "c.txt"); }),
            "c.txt: line 2: found 3 numbers behind Tr, expected 12");
  EXPECT_EQ(io_error_of([] { parse_kitti_calibration("Tr: 1 0 0 x 0 1 0 0 0 0 1 0\n", "c.txt"); }),
            "c.txt: line 1: value 4 is \"x\", expected a number");
  EXPECT_THAT(io_error_of([] { parse_kitti_calibration("Tr: 1.1 0 0 0 0 1 0 0 0 0 1 0\n", "c.txt"); }),
              HasSubstr("c.txt: line 1: the 3×3 part is no rotation"));
  EXPECT_EQ(io_error_of([] { parse_kitti_calibration("Tr: " + kNumbers + "\nTr: " + kNumbers + "\n", "c.txt"); }),
            "c.txt: line 2: found Tr after another Tr");
}

TEST(KittiCalibration, ReadsTheRealFile) {
  const auto data = real_data();
  if (!data) GTEST_SKIP() << "no real data: set TRYSQUARE_DATA";
  const Pose pose = read_kitti_calibration(*data / "kitti00/calib.txt");
  EXPECT_EQ(pose.rotation(0, 1), -9.999672484946e-01);
  EXPECT_EQ(pose.translation.z(), -2.921968648686e-01);
}

TEST(ReadExtrinsic, TakesNumbersOrAFile) {
  const TemporaryFolder folder;
  expect_example(read_extrinsic(kNumbers));
  expect_example(read_extrinsic("0,-1,0,0.5, 0,0,-1,0.25, 1,0,0,-2, 0,0,0,1"));
  expect_example(read_extrinsic(folder.add("e.txt", "# body from sensor\n" + kNumbers + "\n0 0 0 1\n").string()));
}

TEST(ReadExtrinsic, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_EQ(io_error_of([] { read_extrinsic("extrinsic7.txt"); }),
            "extrinsic7.txt: no such file, and not 12 or 16 numbers either");
  EXPECT_NE(io_error_of([] { read_extrinsic(""); }), "");
  EXPECT_EQ(io_error_of([] { read_extrinsic("1 2 3"); }),
            "extrinsic: line 1: found 3 numbers, expected the 12 of a 3×4 or the 16 of a 4×4 matrix");
  const std::string path = folder.add("e.txt", "\n" + kNumbers + "\n0 0 0 2\n").string();
  EXPECT_EQ(io_error_of([&] { read_extrinsic(path); }),
            path + ": line 2: the last row of the matrix is 0 0 0 2, expected 0 0 0 1");
}

}  // namespace
}  // namespace trysquare
