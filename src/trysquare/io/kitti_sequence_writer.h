// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/core/trajectory.h"

#include <cstddef>
#include <filesystem>

namespace trysquare {

/// Writes a sequence in the layout of KITTI's odometry, in the frame of the sensor: velodyne/000000.bin and so on,
/// poses.txt, times.txt (seconds) and calib.txt, whose Tr is the identity.
///
/// Everything goes to a hidden folder beside the target, which takes its place when all is there: nobody sees half a
/// sequence, and the destructor removes what was not finished.
class KittiSequenceWriter {
 public:
  /// @param folder    may exist when it is empty, or `replaces` is set: then these four entries of it are replaced, and
  ///                  whatever else is in it stays.
  /// @throws IoError  if it exists and is not empty, is no folder, or cannot be written to.
  explicit KittiSequenceWriter(const std::filesystem::path& folder, bool replaces = false);
  ~KittiSequenceWriter();
  KittiSequenceWriter(const KittiSequenceWriter&) = delete;
  KittiSequenceWriter& operator=(const KittiSequenceWriter&) = delete;
  KittiSequenceWriter(KittiSequenceWriter&&) = delete;
  KittiSequenceWriter& operator=(KittiSequenceWriter&&) = delete;

  /// May be called from several threads at once, for different scans.
  /// @throws IoError  if the file cannot be written.
  void write_scan(std::size_t index, PointsView points_in_scan) const;

  /// Adds poses, times and calibration, and puts the sequence in its place.
  /// @param world_from_scan   One pose for each scan; without time stamps, scan i has i seconds.
  /// @throws InvalidArgument  if there is no pose, or neither none nor one time stamp for each.
  /// @throws IoError          if it cannot be written.
  void finish(const Trajectory& world_from_scan);

 private:
  void put_in_place();

  std::filesystem::path folder_;
  std::filesystem::path temporary_;  ///< Empty when there is nothing to remove.
};

}  // namespace trysquare
