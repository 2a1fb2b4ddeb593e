// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// One sweep of points in the frame of its sensor, without the points that carry no measurement.
struct Scan {
  std::vector<Eigen::Vector3d> points_in_scan;  ///< [m], all finite.
  std::optional<std::int64_t> stamp_ns;
  std::size_t num_not_finite = 0;  ///< Points dropped by the reader: a coordinate was NaN or infinite.
  std::size_t num_at_origin = 0;   ///< Points exactly at (0, 0, 0): some drivers write invalid returns like this.
};

/// N scans that are loaded one at a time, so that a sequence need not fit into memory.
class ScanSequence {
 public:
  virtual ~ScanSequence() = default;

  virtual std::size_t size() const = 0;

  /// @param index  < size().
  /// @throws IoError  if the scan cannot be read. May be called from several threads at once.
  virtual Scan load(std::size_t index) const = 0;

  /// What an error message or a report calls this scan: the path of its file, usually.
  virtual std::string name(std::size_t index) const = 0;
};

}  // namespace trysquare
