// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/simulation/ray_caster.h"
#include "trysquare/simulation/sensor_model.h"
#include "trysquare/simulation/simulated_world.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace trysquare {

/// Scans that a sensor takes in a simulated world, computed when they are asked for. load(i) may be called from several
/// threads at once; its points depend on the world, the pose i (with a rolling shutter also on the next one), the
/// sensor, the seed and i only.
///
/// Points are in the frame of the sensor, beam by beam, the nearest surface along each ray with noise along the ray.
/// With a rolling shutter every column is fired from where the sensor is by then, on the way from pose i at constant
/// velocity to pose i + 1 (after the last pose: on as before), and its points stay in the frame of that moment, as a
/// driver that knows nothing of the motion would write them.
class SimulatedScans : public ScanSequence {
 public:
  /// @param world       is needed during the call only.
  /// @param true_poses  world_from_scan at the first column of every scan. Without time stamps one every period_s.
  /// @throws InvalidArgument  if the sensor is out of range, the mesh is invalid, there are neither no time stamps nor
  ///                          one for each pose, or they do not rise.
  SimulatedScans(const SimulatedWorld& world, Trajectory true_poses, const SensorModel& sensor, std::uint64_t seed);
  ~SimulatedScans() override;
  SimulatedScans(const SimulatedScans&) = delete;
  SimulatedScans& operator=(const SimulatedScans&) = delete;
  SimulatedScans(SimulatedScans&&) = delete;
  SimulatedScans& operator=(SimulatedScans&&) = delete;

  std::size_t size() const override;
  /// @throws InvalidArgument  if there is no such scan.
  Scan load(std::size_t index) const override;
  std::string name(std::size_t index) const override;  ///< "scan 3".

  const Trajectory& true_poses() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace trysquare
